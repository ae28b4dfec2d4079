//! Problems of our own, with what the project's problems have and published ones lack: failed
//! evaluations, no feasible design, dependent constraints, pieces that change places. All optima
//! are in closed form.

use super::{
    adapter::{PLAIN, Standard},
    many_variables::HS_100,
};

const BASE: Standard = Standard {
    source: "own",
    ..PLAIN
};
/// √2.5.
const SQRT_5_2: f64 = 1.581_138_830_084_189_8;
/// √(2/3).
const SQRT_2_3: f64 = 0.816_496_580_927_726;

pub const PROBLEMS: &[Standard] = &[
    // Evaluations fail two per cent beyond the limit, in half of the box; so near the optimum.
    // The start leads to the global optimum, not to the corner with f = -√2.5 / 2.
    Standard {
        name: "failures beyond a limit",
        bounds: &[[-0.5, 3.0], [-2.0, 2.0]],
        start: &[0.5, 0.5],
        objective: |x| vec![-x[0] * x[1]],
        constraints: |x| vec![f64::midpoint(x[0], x[1].powi(2)) - 1.0],
        fails: |x| x[0] + x[1].powi(2) > 2.04,
        optimum: -4.0 / 3.0 * SQRT_2_3,
        solution: Some(&[4.0 / 3.0, SQRT_2_3]),
        ..BASE
    },
    // The same from the other side, where the corner is what the start leads to.
    Standard {
        name: "failures near a corner",
        bounds: &[[-0.5, 3.0], [-2.0, 2.0]],
        start: &[-0.25, -1.0],
        objective: |x| vec![-x[0] * x[1]],
        constraints: |x| vec![f64::midpoint(x[0], x[1].powi(2)) - 1.0],
        fails: |x| x[0] + x[1].powi(2) > 2.04,
        optimum: -4.0 / 3.0 * SQRT_2_3,
        solution: Some(&[4.0 / 3.0, SQRT_2_3]),
        local_optima: &[-SQRT_5_2 / 2.0],
        ..BASE
    },
    // The unit ball is forbidden, evaluations fail within it but for its outermost two per cent,
    // and the start is on its far side.
    Standard {
        name: "failures in a ball",
        bounds: &[[-2.0, 2.0]; 3],
        start: &[-1.5, -1.0, 0.5],
        objective: |x| vec![(x[0] - 0.3).powi(2) + (x[1] - 0.4).powi(2) + x[2].powi(2)],
        constraints: |x| vec![1.0 - x.iter().map(|x| x * x).sum::<f64>()],
        fails: |x| x.iter().map(|x| x * x).sum::<f64>() < 0.98 * 0.98,
        optimum: 0.25,
        solution: Some(&[0.6, 0.8, 0.0]),
        ..BASE
    },
    // On x1 = x2 = t the violation is max(3 - 2t, 2t² - 1).
    Standard {
        name: "infeasible",
        bounds: &[[-2.0, 2.0]; 2],
        start: &[-1.0, 0.0],
        objective: |x| vec![x[0].powi(2) + x[1].powi(2)],
        constraints: |x| vec![3.0 - x[0] - x[1], x[0].powi(2) + x[1].powi(2) - 1.0],
        optimum: 2.0,
        solution: Some(&[1.0, 1.0]),
        least_violation: 1.0,
        ..BASE
    },
    // The apex of a pyramid with one face twice and a paraboloid upon it: six active constraints
    // in three variables.
    Standard {
        name: "dependent constraints",
        bounds: &[[-2.0, 2.0]; 3],
        start: &[1.5, -1.0, -1.0],
        objective: |x| vec![(x[0] - 0.3).powi(2) + (x[1] + 0.2).powi(2) + (x[2] - 3.0).powi(2)],
        constraints: |x| {
            let [a, b, c] = [x[0], x[1], x[2] - 1.0];
            vec![c + a, c - a, c + b, c - b, 3.0 * (c + a), c + a * a + b * b]
        },
        optimum: 4.13,
        solution: Some(&[0.0, 0.0, 1.0]),
        ..BASE
    },
    // Two constraints of one index that exchange their ranks where x1 = 0, at the optimum.
    Standard {
        name: "crossing constraints",
        bounds: &[[-2.0, 2.0], [-1.0, 3.0]],
        start: &[-1.5, 2.5],
        objective: |x| vec![x[1] + 0.2 * (x[0] - 0.5).powi(2)],
        constraints: |x| vec![(0.5 * x[0]).exp() - x[1], (-0.8 * x[0]).exp() - x[1]],
        one_index: true,
        optimum: 1.05,
        solution: Some(&[0.0, 1.0]),
        ..BASE
    },
    Standard {
        name: "HS 100 with one index",
        one_index: true,
        ..HS_100
    },
];
