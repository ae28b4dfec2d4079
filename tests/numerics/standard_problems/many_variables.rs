//! Problems in seven to ten variables by Hock & Schittkowski (1981).

use super::{
    adapter::{PLAIN, Standard},
    several_variables::shares,
    two_variables::HOCK_SCHITTKOWSKI,
};

const BASE: Standard = Standard {
    source: HOCK_SCHITTKOWSKI,
    ..PLAIN
};

/// Objective of HS 100.
pub fn hs100(x: &[f64]) -> f64 {
    (x[0] - 10.0).powi(2)
        + 5.0 * (x[1] - 12.0).powi(2)
        + x[2].powi(4)
        + 3.0 * (x[3] - 11.0).powi(2)
        + 10.0 * x[4].powi(6)
        + 7.0 * x[5].powi(2)
        + x[6].powi(4)
        - 4.0 * x[5] * x[6]
        - 10.0 * x[5]
        - 8.0 * x[6]
}

/// Its constraints as they were published.
pub fn hs100_limits(x: &[f64]) -> [f64; 4] {
    [
        2.0 * x[0].powi(2) + 3.0 * x[1].powi(4) + x[2] + 4.0 * x[3].powi(2) + 5.0 * x[4] - 127.0,
        7.0 * x[0] + 3.0 * x[1] + 10.0 * x[2].powi(2) + x[3] - x[4] - 282.0,
        23.0 * x[0] + x[1].powi(2) + 6.0 * x[5].powi(2) - 8.0 * x[6] - 196.0,
        4.0 * x[0].powi(2) + x[1].powi(2) - 3.0 * x[0] * x[1] + 2.0 * x[2].powi(2) + 5.0 * x[5]
            - 11.0 * x[6],
    ]
}

/// Objective of HS 113.
pub fn hs113(x: &[f64]) -> f64 {
    x[0].powi(2) + x[1].powi(2) + x[0] * x[1] - 14.0 * x[0] - 16.0 * x[1]
        + (x[2] - 10.0).powi(2)
        + 4.0 * (x[3] - 5.0).powi(2)
        + (x[4] - 3.0).powi(2)
        + 2.0 * (x[5] - 1.0).powi(2)
        + 5.0 * x[6].powi(2)
        + 7.0 * (x[7] - 11.0).powi(2)
        + 2.0 * (x[8] - 10.0).powi(2)
        + (x[9] - 7.0).powi(2)
        + 45.0
}

/// Its constraints as they were published.
pub fn hs113_limits(x: &[f64]) -> [f64; 8] {
    [
        4.0 * x[0] + 5.0 * x[1] - 3.0 * x[6] + 9.0 * x[7] - 105.0,
        10.0 * x[0] - 8.0 * x[1] - 17.0 * x[6] + 2.0 * x[7],
        -8.0 * x[0] + 2.0 * x[1] + 5.0 * x[8] - 2.0 * x[9] - 12.0,
        3.0 * (x[0] - 2.0).powi(2) + 4.0 * (x[1] - 3.0).powi(2) + 2.0 * x[2].powi(2)
            - 7.0 * x[3]
            - 120.0,
        5.0 * x[0].powi(2) + 8.0 * x[1] + (x[2] - 6.0).powi(2) - 2.0 * x[3] - 40.0,
        0.5 * (x[0] - 8.0).powi(2) + 2.0 * (x[1] - 4.0).powi(2) + 3.0 * x[4].powi(2) - x[5] - 30.0,
        x[0].powi(2) + 2.0 * (x[1] - 2.0).powi(2) - 2.0 * x[0] * x[1] + 14.0 * x[4] - 6.0 * x[5],
        -3.0 * x[0] + 6.0 * x[1] + 12.0 * (x[8] - 8.0).powi(2) - 7.0 * x[9],
    ]
}

pub const HS_100: Standard = Standard {
    // Unbounded in the book.
    name: "HS 100",
    bounds: &[[-5.0, 5.0]; 7],
    start: &[1.0, 2.0, 0.0, 4.0, 0.0, 1.0, 1.0],
    objective: |x| vec![hs100(x)],
    // The last constraint has no constant term: its terms are of order ten.
    constraints: |x| shares(hs100_limits(x), [127.0, 282.0, 196.0, 10.0]),
    optimum: 680.630_057_374,
    solution: Some(&[
        2.330_499_356,
        1.951_372_341,
        -0.477_541_395,
        4.365_726_329,
        -0.624_487_031,
        1.038_130_924,
        1.594_226_659,
    ]),
    ..BASE
};

pub const HS_113: Standard = Standard {
    // Unbounded in the book.
    name: "HS 113",
    bounds: &[[-5.0, 15.0]; 10],
    start: &[2.0, 3.0, 5.0, 5.0, 1.0, 2.0, 7.0, 3.0, 6.0, 10.0],
    objective: |x| vec![hs113(x)],
    constraints: |x| {
        let allowed = [105.0, 10.0, 12.0, 120.0, 40.0, 30.0, 10.0, 10.0];
        shares(hs113_limits(x), allowed)
    },
    optimum: 24.306_209_068,
    solution: Some(&[
        2.171_996_324,
        2.363_683_071,
        8.773_925_717,
        5.095_984_303,
        0.990_654_702,
        1.430_573_789,
        1.321_644_128,
        9.828_725_748,
        8.280_091_553,
        8.375_926_657,
    ]),
    ..BASE
};

pub const PROBLEMS: &[Standard] = &[
    HS_100,
    // The book's limits on the objective itself are not active at the optimum: left out.
    Standard {
        name: "HS 104",
        bounds: &[[0.1, 10.0]; 8],
        start: &[6.0, 3.0, 0.4, 0.2, 6.0, 6.0, 1.0, 0.5],
        objective: |x| {
            let ratios = (x[0] / x[6]).powf(0.67) + (x[1] / x[7]).powf(0.67);
            vec![0.4 * ratios + 10.0 - x[0] - x[1]]
        },
        constraints: |x| {
            let stage = |p: f64, q: f64, r: f64| {
                4.0 * p / q + 2.0 / (p.powf(0.71) * q) + 0.0588 * r / p.powf(1.3) - 1.0
            };
            vec![
                0.0588 * x[4] * x[6] + 0.1 * x[0] - 1.0,
                0.0588 * x[5] * x[7] + 0.1 * (x[0] + x[1]) - 1.0,
                stage(x[2], x[4], x[6]),
                stage(x[3], x[5], x[7]),
            ]
        },
        optimum: 3.951_163_440,
        solution: Some(&[
            6.465_114_459,
            2.232_708_413,
            0.667_397_426,
            0.595_756_349,
            5.932_675_593,
            5.527_234_527,
            1.013_321_901,
            0.400_668_172,
        ]),
        ..BASE
    },
    Standard {
        name: "HS 110",
        bounds: &[[2.001, 9.999]; 10],
        start: &[9.0; 10],
        objective: |x| {
            let logarithms: f64 = x
                .iter()
                .map(|x| (x - 2.0).ln().powi(2) + (10.0 - x).ln().powi(2))
                .sum();
            vec![logarithms - x.iter().product::<f64>().powf(0.2)]
        },
        optimum: -45.778_469_707,
        solution: Some(&[9.350_265_833; 10]),
        ..BASE
    },
    HS_113,
];
