//! Minimax problems from Lukšan & Vlček (2000), Test problems for nonsmooth unconstrained and
//! linearly constrained optimization. They are unbounded there; the bounds here contain start and
//! optimum.

use super::{
    adapter::{PLAIN, Standard},
    many_variables::{HS_100, HS_113, hs100, hs100_limits, hs113, hs113_limits},
    several_variables::{rosen_suzuki, rosen_suzuki_limits},
};

const BASE: Standard = Standard {
    source: "Lukšan & Vlček 2000",
    ..PLAIN
};

/// CB2 and CB3 (Charalambous & Bandler 1976) have two of their pieces in common.
fn charalambous_bandler(first: f64, x: &[f64]) -> Vec<f64> {
    let [a, b] = [x[0], x[1]];
    vec![
        first,
        (2.0 - a).powi(2) + (2.0 - b).powi(2),
        2.0 * (b - a).exp(),
    ]
}

/// f and every f + 10 c_j: an exact penalty in the form of a minimax problem.
fn penalised(f: f64, limits: &[f64]) -> Vec<f64> {
    let shifted = limits.iter().map(|c| f + 10.0 * c);
    std::iter::once(f).chain(shifted).collect()
}

/// MAD1 and MAD2 (Madsen) differ in their constraint.
fn madsen(x: &[f64]) -> Vec<f64> {
    let [a, b] = [x[0], x[1]];
    vec![a * a + b * b + a * b - 1.0, a.sin(), -b.cos()]
}

pub const PROBLEMS: &[Standard] = &[
    Standard {
        name: "CB2",
        bounds: &[[-3.0, 3.0]; 2],
        start: &[1.0, -0.1],
        objective: |x| charalambous_bandler(x[0].powi(2) + x[1].powi(4), x),
        optimum: 1.952_224_494,
        solution: Some(&[1.139_037_661, 0.899_559_931]),
        ..BASE
    },
    Standard {
        name: "CB3",
        bounds: &[[-3.0, 3.0]; 2],
        start: &[2.0, 2.0],
        objective: |x| charalambous_bandler(x[0].powi(4) + x[1].powi(2), x),
        optimum: 2.0,
        solution: Some(&[1.0, 1.0]),
        ..BASE
    },
    Standard {
        name: "DEM",
        bounds: &[[-5.0, 5.0]; 2],
        start: &[1.0, 1.0],
        objective: |x| {
            let [a, b] = [x[0], x[1]];
            vec![5.0 * a + b, -5.0 * a + b, a * a + b * b + 4.0 * b]
        },
        optimum: -3.0,
        solution: Some(&[0.0, -3.0]),
        ..BASE
    },
    Standard {
        name: "EVD52",
        bounds: &[[-3.0, 3.0]; 3],
        start: &[1.0; 3],
        objective: |x| {
            let [a, b, c] = [x[0], x[1], x[2]];
            vec![
                a * a + b * b + c * c - 1.0,
                a * a + b * b + (c - 2.0).powi(2),
                a + b + c - 1.0,
                a + b - c + 1.0,
                2.0 * a.powi(3) + 6.0 * b * b + 2.0 * (5.0 * c - a + 1.0).powi(2),
                a * a - 9.0 * c,
            ]
        },
        optimum: 3.599_719_300,
        solution: Some(&[0.328_259_952, 0.0, 0.131_320_064]),
        ..BASE
    },
    Standard {
        name: "Rosen–Suzuki",
        bounds: &[[-5.0, 5.0]; 4],
        start: &[0.0; 4],
        objective: |x| penalised(rosen_suzuki(x), &rosen_suzuki_limits(x)),
        optimum: -44.0,
        solution: Some(&[0.0, 1.0, 2.0, -1.0]),
        ..BASE
    },
    // Its other local optimum, f = 0.998, is not where the start leads.
    Standard {
        name: "MAD1",
        bounds: &[[-3.0, 3.0]; 2],
        start: &[1.0, 2.0],
        objective: madsen,
        constraints: |x| vec![1.0 - (x[0] + x[1]) / 0.5],
        optimum: -0.389_659_516_097,
        solution: Some(&[-0.400_261_858, 0.900_261_858]),
        ..BASE
    },
    Standard {
        name: "MAD2",
        bounds: &[[-3.0, 3.0]; 2],
        start: &[-2.0, -1.0],
        objective: madsen,
        constraints: |x| vec![1.0 + (3.0 * x[0] + x[1]) / 2.5],
        optimum: -37.0 / 112.0,
        solution: Some(&[-25.0 / 28.0, 5.0 / 28.0]),
        ..BASE
    },
    // HS 100 as a minimax problem.
    Standard {
        name: "Wong 1",
        source: BASE.source,
        objective: |x| penalised(hs100(x), &hs100_limits(x)),
        constraints: PLAIN.constraints,
        ..HS_100
    },
    // HS 113 as a minimax problem.
    Standard {
        name: "Wong 2",
        source: BASE.source,
        objective: |x| penalised(hs113(x), &hs113_limits(x)),
        constraints: PLAIN.constraints,
        ..HS_113
    },
];
