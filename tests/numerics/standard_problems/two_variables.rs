//! Problems in two variables by Hock & Schittkowski (1981).
//!
//! Where bounds are infinite in the book they are finite here, and contain start and optimum; each
//! such choice is noted. Optima and solutions were checked by sequential quadratic programming
//! (SciPy) from forty starts.

use std::f64::consts::{PI, SQRT_2};

use super::adapter::{PLAIN, Standard};

/// The collection's source.
pub const HOCK_SCHITTKOWSKI: &str = "Hock & Schittkowski 1981";
const BASE: Standard = Standard {
    source: HOCK_SCHITTKOWSKI,
    ..PLAIN
};
pub const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// Rosenbrock's valley.
fn valley(x: &[f64]) -> f64 {
    100.0 * (x[1] - x[0].powi(2)).powi(2) + (1.0 - x[0]).powi(2)
}

pub const PROBLEMS: &[Standard] = &[
    // Bounded in the book: x2 ≥ -1.5.
    Standard {
        name: "HS 1",
        bounds: &[[-3.0, 3.0], [-1.5, 3.0]],
        start: &[-2.0, 1.0],
        objective: |x| vec![valley(x)],
        optimum: 0.0,
        solution: Some(&[1.0, 1.0]),
        ..BASE
    },
    // Bounded in the book: x2 ≥ 1.5. The start is in the valley of the local optimum.
    Standard {
        name: "HS 2",
        bounds: &[[-3.0, 3.0], [1.5, 3.0]],
        start: &[-2.0, 1.0],
        objective: |x| vec![valley(x)],
        optimum: 0.050_426_187_894,
        solution: Some(&[1.224_370_749, 1.5]),
        local_optima: &[4.941_229_317_989],
        hidden: true,
        ..BASE
    },
    // Bounded in the book: x2 ≥ 0. The curvature along x1 is 2e-5: f* leaves x1 undetermined.
    Standard {
        name: "HS 3",
        bounds: &[[-20.0, 20.0], [0.0, 20.0]],
        start: &[10.0, 1.0],
        objective: |x| vec![x[1] + 1e-5 * (x[1] - x[0]).powi(2)],
        optimum: 0.0,
        ..BASE
    },
    // Bounded in the book: x1 ≥ 1, x2 ≥ 0.
    Standard {
        name: "HS 4",
        bounds: &[[1.0, 5.0], [0.0, 5.0]],
        start: &[1.125, 0.125],
        objective: |x| vec![(x[0] + 1.0).powi(3) / 3.0 + x[1]],
        optimum: 8.0 / 3.0,
        solution: Some(&[1.0, 0.0]),
        ..BASE
    },
    // A second local optimum, π further in both variables, is not where the start leads.
    Standard {
        name: "HS 5",
        bounds: &[[-1.5, 4.0], [-3.0, 3.0]],
        start: &[0.0, 0.0],
        objective: |x| {
            let [a, b] = [x[0], x[1]];
            vec![(a + b).sin() + (a - b).powi(2) - 1.5 * a + 2.5 * b + 1.0]
        },
        optimum: -SQRT_3 / 2.0 - PI / 3.0,
        solution: Some(&[0.5 - PI / 3.0, -0.5 - PI / 3.0]),
        ..BASE
    },
    // Unbounded in the book.
    Standard {
        name: "HS 10",
        bounds: &[[-20.0, 20.0], [-20.0, 20.0]],
        start: &[-10.0, 10.0],
        objective: |x| vec![x[0] - x[1]],
        constraints: |x| vec![3.0 * x[0].powi(2) - 2.0 * x[0] * x[1] + x[1].powi(2) - 1.0],
        optimum: -1.0,
        solution: Some(&[0.0, 1.0]),
        ..BASE
    },
    // Unbounded in the book.
    Standard {
        name: "HS 11",
        bounds: &[[-10.0, 10.0], [-10.0, 10.0]],
        start: &[4.9, 0.1],
        objective: |x| vec![(x[0] - 5.0).powi(2) + x[1].powi(2) - 25.0],
        constraints: |x| vec![x[0].powi(2) - x[1]],
        optimum: -8.498_464_223_155,
        solution: Some(&[1.234_772_825, 1.524_663_929]),
        ..BASE
    },
    // Unbounded in the book.
    Standard {
        name: "HS 12",
        bounds: &[[-10.0, 10.0], [-10.0, 10.0]],
        start: &[0.0, 0.0],
        objective: |x| {
            let [a, b] = [x[0], x[1]];
            vec![a * a / 2.0 + b * b - a * b - 7.0 * (a + b)]
        },
        constraints: |x| vec![(4.0 * x[0].powi(2) + x[1].powi(2)) / 25.0 - 1.0],
        optimum: -30.0,
        solution: Some(&[2.0, 3.0]),
        ..BASE
    },
    // Bounded in the book: x1 ≤ 0.5.
    Standard {
        name: "HS 15",
        bounds: &[[-3.0, 0.5], [-3.0, 3.0]],
        start: &[-2.0, 1.0],
        objective: |x| vec![valley(x)],
        constraints: |x| vec![1.0 - x[0] * x[1], -x[0] - x[1].powi(2)],
        optimum: 306.5,
        solution: Some(&[0.5, 2.0]),
        local_optima: &[360.379_767_174],
        hidden: true,
        ..BASE
    },
    // Bounded in the book: |x1| ≤ 0.5, x2 ≤ 1. The start is near the local optimum (-0.5, √0.5).
    Standard {
        name: "HS 16",
        bounds: &[[-0.5, 0.5], [-3.0, 1.0]],
        start: &[-2.0, 1.0],
        objective: |x| vec![valley(x)],
        constraints: |x| vec![-x[0] - x[1].powi(2), -x[0].powi(2) - x[1]],
        optimum: 0.25,
        solution: Some(&[0.5, 0.25]),
        local_optima: &[58.5 - 25.0 * SQRT_2],
        ..BASE
    },
    // Bounded in the book: |x1| ≤ 0.5, x2 ≤ 1.
    Standard {
        name: "HS 17",
        bounds: &[[-0.5, 0.5], [-3.0, 1.0]],
        start: &[-2.0, 1.0],
        objective: |x| vec![valley(x)],
        constraints: |x| vec![x[0] - x[1].powi(2), x[1] - x[0].powi(2)],
        optimum: 1.0,
        solution: Some(&[0.0, 0.0]),
        ..BASE
    },
    Standard {
        name: "HS 18",
        bounds: &[[2.0, 50.0], [0.0, 50.0]],
        start: &[2.0, 2.0],
        objective: |x| vec![0.01 * x[0].powi(2) + x[1].powi(2)],
        constraints: |x| {
            let [a, b] = [x[0], x[1]];
            vec![1.0 - a * b / 25.0, 1.0 - (a * a + b * b) / 25.0]
        },
        optimum: 5.0,
        solution: Some(&[15.811_388_301, 1.581_138_830]),
        ..BASE
    },
    // The feasible designs form a thin crescent; the objective's slope there is a thousand.
    Standard {
        name: "HS 19",
        bounds: &[[13.0, 100.0], [0.0, 100.0]],
        start: &[20.1, 5.84],
        objective: |x| vec![(x[0] - 10.0).powi(3) + (x[1] - 20.0).powi(3)],
        constraints: |x| {
            vec![
                1.0 - ((x[0] - 5.0).powi(2) + (x[1] - 5.0).powi(2)) / 100.0,
                ((x[0] - 6.0).powi(2) + (x[1] - 5.0).powi(2)) / 82.81 - 1.0,
            ]
        },
        optimum: -6_961.813_875_580,
        solution: Some(&[14.095, 0.842_960_789]),
        ..BASE
    },
    // Bounded in the book: |x1| ≤ 0.5. The start is near the local optimum (-0.5, √0.75).
    Standard {
        name: "HS 20",
        bounds: &[[-0.5, 0.5], [-3.0, 3.0]],
        start: &[-2.0, 1.0],
        objective: |x| vec![valley(x)],
        constraints: |x| {
            let [a, b] = [x[0], x[1]];
            vec![-a - b * b, -a * a - b, 1.0 - a * a - b * b]
        },
        optimum: 81.5 - 25.0 * SQRT_3,
        solution: Some(&[0.5, SQRT_3 / 2.0]),
        local_optima: &[83.5 - 25.0 * SQRT_3],
        hidden: true,
        ..BASE
    },
    Standard {
        name: "HS 21",
        bounds: &[[2.0, 50.0], [-50.0, 50.0]],
        start: &[-1.0, -1.0],
        objective: |x| vec![0.01 * x[0].powi(2) + x[1].powi(2) - 100.0],
        constraints: |x| vec![1.0 - x[0] + x[1] / 10.0],
        optimum: -99.96,
        solution: Some(&[2.0, 0.0]),
        ..BASE
    },
    // Unbounded in the book.
    Standard {
        name: "HS 22",
        bounds: &[[-5.0, 5.0], [-5.0, 5.0]],
        start: &[2.0, 2.0],
        objective: |x| vec![(x[0] - 2.0).powi(2) + (x[1] - 1.0).powi(2)],
        constraints: |x| vec![f64::midpoint(x[0], x[1]) - 1.0, x[0].powi(2) - x[1]],
        optimum: 1.0,
        solution: Some(&[1.0, 1.0]),
        ..BASE
    },
    Standard {
        name: "HS 23",
        bounds: &[[-50.0, 50.0], [-50.0, 50.0]],
        start: &[3.0, 1.0],
        objective: |x| vec![x[0].powi(2) + x[1].powi(2)],
        constraints: |x| {
            let [a, b] = [x[0], x[1]];
            vec![
                1.0 - a - b,
                1.0 - a * a - b * b,
                1.0 - a * a - b * b / 9.0,
                b - a * a,
                a - b * b,
            ]
        },
        optimum: 2.0,
        solution: Some(&[1.0, 1.0]),
        local_optima: &[9.472_135_955],
        hidden: true,
        ..BASE
    },
    // Bounded in the book: x ≥ 0; the third constraint bounds the rest.
    Standard {
        name: "HS 24",
        bounds: &[[0.0, 6.0], [0.0, 6.0]],
        start: &[1.0, 0.5],
        objective: |x| vec![((x[0] - 3.0).powi(2) - 9.0) * x[1].powi(3) / (27.0 * SQRT_3)],
        constraints: |x| {
            let [a, b] = [x[0], SQRT_3 * x[1]];
            vec![x[1] - a / SQRT_3, -a - b, (a + b) / 6.0 - 1.0]
        },
        optimum: -1.0,
        solution: Some(&[3.0, SQRT_3]),
        ..BASE
    },
];
