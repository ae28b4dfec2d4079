//! Problems in three to five variables by Hock & Schittkowski (1981). As in two variables, infinite
//! bounds are replaced by finite ones, with a note.

use std::f64::consts::{LN_10, SQRT_2};

use super::{
    adapter::{PLAIN, Standard},
    two_variables::{HOCK_SCHITTKOWSKI, SQRT_3},
};

const BASE: Standard = Standard {
    source: HOCK_SCHITTKOWSKI,
    ..PLAIN
};
fn square_sum(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

fn product(x: &[f64]) -> f64 {
    x.iter().product()
}

/// HS 34 and 66: e^x1 ≤ x2, e^x2 ≤ x3.
fn exponentials(x: &[f64]) -> Vec<f64> {
    vec![x[0].exp() - x[1], x[1].exp() - x[2]]
}

/// HS 36 and 37: 72 is allowed.
fn girth(x: &[f64]) -> f64 {
    (x[0] + 2.0 * x[1] + 2.0 * x[2]) / 72.0
}

/// Objective of HS 43 (Rosen & Suzuki 1965).
pub fn rosen_suzuki(x: &[f64]) -> f64 {
    let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
    a * a + b * b + 2.0 * c * c + d * d - 5.0 * (a + b) - 21.0 * c + 7.0 * d
}

/// Its constraints as they were published.
pub fn rosen_suzuki_limits(x: &[f64]) -> [f64; 3] {
    let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
    [
        a * a + b * b + c * c + d * d + a - b + c - d - 8.0,
        a * a + 2.0 * b * b + c * c + 2.0 * d * d - a - d - 10.0,
        2.0 * a * a + b * b + c * c + 2.0 * a - b - d - 5.0,
    ]
}

/// Each value divided by what its constraint allows.
pub fn shares<const N: usize>(values: [f64; N], allowed: [f64; N]) -> Vec<f64> {
    values.iter().zip(allowed).map(|(v, a)| v / a).collect()
}

pub const PROBLEMS: &[Standard] = &[
    // Unbounded in the book. Four optima by symmetry: any will do.
    Standard {
        name: "HS 29",
        bounds: &[[-10.0, 10.0]; 3],
        start: &[1.0; 3],
        objective: |x| vec![-product(x)],
        constraints: |x| {
            vec![(x[0].powi(2) + 2.0 * x[1].powi(2) + 4.0 * x[2].powi(2)) / 48.0 - 1.0]
        },
        optimum: -16.0 * SQRT_2,
        ..BASE
    },
    Standard {
        name: "HS 30",
        bounds: &[[1.0, 10.0], [-10.0, 10.0], [-10.0, 10.0]],
        start: &[1.0; 3],
        objective: |x| vec![square_sum(x)],
        constraints: |x| vec![1.0 - square_sum(&x[..2])],
        optimum: 1.0,
        solution: Some(&[1.0, 0.0, 0.0]),
        ..BASE
    },
    Standard {
        name: "HS 31",
        bounds: &[[-10.0, 10.0], [1.0, 10.0], [-10.0, 1.0]],
        start: &[1.0; 3],
        objective: |x| vec![9.0 * x[0].powi(2) + x[1].powi(2) + 9.0 * x[2].powi(2)],
        constraints: |x| vec![1.0 - x[0] * x[1]],
        optimum: 6.0,
        solution: Some(&[1.0 / SQRT_3, SQRT_3, 0.0]),
        ..BASE
    },
    // Bounded in the book: x ≥ 0, x3 ≤ 5. The start is a corner, straight above the local optimum
    // (0, 0, 2).
    Standard {
        name: "HS 33",
        bounds: &[[0.0, 5.0]; 3],
        start: &[0.0, 0.0, 3.0],
        objective: |x| vec![(x[0] - 1.0) * (x[0] - 2.0) * (x[0] - 3.0) + x[2]],
        constraints: |x| {
            vec![
                square_sum(&x[..2]) - x[2].powi(2),
                1.0 - square_sum(x) / 4.0,
            ]
        },
        optimum: SQRT_2 - 6.0,
        solution: Some(&[0.0, SQRT_2, SQRT_2]),
        local_optima: &[-4.0],
        ..BASE
    },
    // Exponentials reach 1e43 inside the bounds.
    Standard {
        name: "HS 34",
        bounds: &[[0.0, 100.0], [0.0, 100.0], [0.0, 10.0]],
        start: &[0.0, 1.05, 2.9],
        objective: |x| vec![-x[0]],
        constraints: exponentials,
        optimum: -0.834_032_445_248,
        solution: Some(&[0.834_032_445, LN_10, 10.0]),
        ..BASE
    },
    // Bounded in the book: x ≥ 0; the constraint bounds the rest.
    Standard {
        name: "HS 35",
        bounds: &[[0.0, 3.0]; 3],
        start: &[0.5; 3],
        objective: |x| {
            let [a, b, c] = [x[0], x[1], x[2]];
            let linear = 9.0 - 8.0 * a - 6.0 * b - 4.0 * c;
            vec![linear + 2.0 * (a * a + b * b) + c * c + 2.0 * a * (b + c)]
        },
        constraints: |x| vec![(x[0] + x[1] + 2.0 * x[2]) / 3.0 - 1.0],
        optimum: 1.0 / 9.0,
        solution: Some(&[4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0]),
        ..BASE
    },
    Standard {
        name: "HS 36",
        bounds: &[[0.0, 20.0], [0.0, 11.0], [0.0, 42.0]],
        start: &[10.0; 3],
        objective: |x| vec![-product(x)],
        constraints: |x| vec![girth(x) - 1.0],
        optimum: -3300.0,
        solution: Some(&[20.0, 11.0, 15.0]),
        ..BASE
    },
    Standard {
        name: "HS 37",
        bounds: &[[0.0, 42.0]; 3],
        start: &[10.0; 3],
        objective: |x| vec![-product(x)],
        constraints: |x| vec![girth(x) - 1.0, -girth(x)],
        optimum: -3456.0,
        solution: Some(&[24.0, 12.0, 12.0]),
        ..BASE
    },
    // Wood's function.
    Standard {
        name: "HS 38",
        bounds: &[[-10.0, 10.0]; 4],
        start: &[-3.0, -1.0, -3.0, -1.0],
        objective: |x| {
            let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
            let valleys = 100.0 * (b - a * a).powi(2)
                + (1.0 - a).powi(2)
                + 90.0 * (d - c * c).powi(2)
                + (1.0 - c).powi(2);
            let squares = 10.1 * ((b - 1.0).powi(2) + (d - 1.0).powi(2));
            vec![valleys + squares + 19.8 * (b - 1.0) * (d - 1.0)]
        },
        optimum: 0.0,
        solution: Some(&[1.0; 4]),
        ..BASE
    },
    // Unbounded in the book.
    Standard {
        name: "HS 43",
        bounds: &[[-5.0, 5.0]; 4],
        start: &[0.0; 4],
        objective: |x| vec![rosen_suzuki(x)],
        constraints: |x| shares(rosen_suzuki_limits(x), [8.0, 10.0, 5.0]),
        optimum: -44.0,
        solution: Some(&[0.0, 1.0, 2.0, -1.0]),
        ..BASE
    },
    // Bounded in the book: x ≥ 0; the constraints bound the rest but for x2 ≤ 4. The start is a
    // corner from which either optimum is downhill.
    Standard {
        name: "HS 44",
        bounds: &[[0.0, 5.0]; 4],
        start: &[0.0; 4],
        objective: |x| {
            let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
            vec![a - b - c - a * c + a * d + b * c - b * d]
        },
        constraints: |x| {
            let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
            let used = [
                a + 2.0 * b,
                4.0 * a + b,
                3.0 * a + 4.0 * b,
                2.0 * c + d,
                c + 2.0 * d,
                c + d,
            ];
            let allowed = [8.0, 12.0, 12.0, 8.0, 8.0, 5.0];
            used.iter().zip(allowed).map(|(u, a)| u / a - 1.0).collect()
        },
        optimum: -15.0,
        solution: Some(&[0.0, 3.0, 0.0, 4.0]),
        local_optima: &[-13.0],
        hidden: true,
        ..BASE
    },
    Standard {
        name: "HS 45",
        bounds: &[[0.0, 1.0], [0.0, 2.0], [0.0, 3.0], [0.0, 4.0], [0.0, 5.0]],
        start: &[2.0; 5],
        objective: |x| vec![2.0 - product(x) / 120.0],
        optimum: 1.0,
        solution: Some(&[1.0, 2.0, 3.0, 4.0, 5.0]),
        ..BASE
    },
    Standard {
        name: "HS 65",
        bounds: &[[-4.5, 4.5], [-4.5, 4.5], [-5.0, 5.0]],
        start: &[-5.0, 5.0, 0.0],
        objective: |x| {
            let [a, b, c] = [x[0], x[1], x[2]];
            vec![(a - b).powi(2) + (a + b - 10.0).powi(2) / 9.0 + (c - 5.0).powi(2)]
        },
        constraints: |x| vec![square_sum(x) / 48.0 - 1.0],
        optimum: 0.953_528_856_805,
        solution: Some(&[3.650_461_725, 3.650_461_725, 4.620_417_555]),
        ..BASE
    },
    Standard {
        name: "HS 66",
        bounds: &[[0.0, 100.0], [0.0, 100.0], [0.0, 10.0]],
        start: &[0.0, 1.05, 2.9],
        objective: |x| vec![0.2 * x[2] - 0.8 * x[0]],
        constraints: exponentials,
        optimum: 0.518_163_274_182,
        solution: Some(&[0.184_126_488, 1.202_167_873, 3.327_322_323]),
        ..BASE
    },
    // The equality as two inequalities: they fulfil no constraint qualification.
    Standard {
        name: "HS 71",
        bounds: &[[1.0, 5.0]; 4],
        start: &[1.0, 5.0, 5.0, 1.0],
        objective: |x| vec![x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]],
        constraints: |x| {
            let equality = square_sum(x) / 40.0 - 1.0;
            vec![1.0 - product(x) / 25.0, equality, -equality]
        },
        optimum: 17.014_017_289,
        solution: Some(&[1.0, 4.742_999_643, 3.821_149_977, 1.379_408_294]),
        ..BASE
    },
    // Bounded in the book: x ≥ 0.
    Standard {
        name: "HS 76",
        bounds: &[[0.0, 5.0]; 4],
        start: &[0.5; 4],
        objective: |x| {
            let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
            let squares = a * a + b * b / 2.0 + c * c + d * d / 2.0;
            vec![squares - a * c + c * d - a - 3.0 * b + c - d]
        },
        constraints: |x| {
            let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
            vec![
                (a + 2.0 * b + c + d) / 5.0 - 1.0,
                (3.0 * a + b + 2.0 * c - d) / 4.0 - 1.0,
                1.0 - (b + 4.0 * c) / 1.5,
            ]
        },
        optimum: -103.0 / 22.0,
        solution: Some(&[3.0 / 11.0, 23.0 / 11.0, 0.0, 6.0 / 11.0]),
        ..BASE
    },
    // Colville's third: limits on both sides.
    Standard {
        name: "HS 83",
        bounds: &[
            [78.0, 102.0],
            [33.0, 45.0],
            [27.0, 45.0],
            [27.0, 45.0],
            [27.0, 45.0],
        ],
        start: &[78.0, 33.0, 27.0, 27.0, 27.0],
        objective: |x| {
            let [a, c, e] = [x[0], x[2], x[4]];
            vec![5.357_854_7 * c * c + 0.835_689_1 * a * e + 37.293_239 * a - 40_792.141]
        },
        constraints: |x| {
            let [a, b, c, d, e] = [x[0], x[1], x[2], x[3], x[4]];
            let p = 85.334_407 + 0.005_685_8 * b * e + 0.000_626_2 * a * d - 0.002_205_3 * c * e;
            let q = 80.512_49 + 0.007_131_7 * b * e + 0.002_995_5 * a * b + 0.002_181_3 * c * c;
            let r = 9.300_961 + 0.004_702_6 * c * e + 0.001_254_7 * a * c + 0.001_908_5 * c * d;
            vec![
                -p / 92.0,
                p / 92.0 - 1.0,
                1.0 - q / 90.0,
                q / 110.0 - 1.0,
                1.0 - r / 20.0,
                r / 25.0 - 1.0,
            ]
        },
        optimum: -30_665.538_671_783,
        solution: Some(&[78.0, 33.0, 29.995_256_026, 45.0, 36.775_812_906]),
        ..BASE
    },
];
