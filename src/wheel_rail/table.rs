//! The report's table of wheel–rail coefficients by conicity (Table 4.1.1).

use super::Contact;
use crate::units::us::{FOOT, LBF};

/// Largest conicity of the table; beyond it nothing is known.
pub const CONICITY_MAX: f64 = 0.25;

/// Rows of Table 4.1.1 as printed (lb, ft-lb, ft²-lb): λ, f11, f12, f22, f33, a11 = δ0, Δ.
/// Its f22 is not monotone; the printed value stands.
const ROWS: [[f64; 7]; 4] = [
    [0.05, 2_120_000.0, 17_500.0, 160.0, 2_300_000.0, 0.05, 0.0],
    [0.10, 2_245_000.0, 17_525.0, 375.0, 2_520_000.0, 0.0675, 4.5],
    [0.15, 2_370_000.0, 17_550.0, 274.0, 2_760_000.0, 0.075, 9.0],
    [
        0.25,
        2_620_000.0,
        17_600.0,
        1_020.0,
        3_180_000.0,
        0.095,
        17.8,
    ],
];

/// Conicities of the profiles that the report tabulates.
pub const PROFILES: [f64; 4] = [ROWS[0][0], ROWS[1][0], ROWS[2][0], ROWS[3][0]];

/// Ends of the interval of conicities around one on which every coefficient is linear. At a row of the
/// table it is the one below, at the first the one above.
pub fn rows_around(conicity: f64) -> [f64; 2] {
    if conicity < ROWS[0][0] {
        return [0.0, ROWS[0][0]];
    }
    let upper = upper_row(conicity);
    [ROWS[upper - 1][0], ROWS[upper][0]]
}

fn upper_row(conicity: f64) -> usize {
    (1..ROWS.len() - 1)
        .find(|&i| conicity <= ROWS[i][0])
        .unwrap_or(ROWS.len() - 1)
}

impl Contact {
    /// Full Kalker coefficients for conicity λ, linear between rows.
    ///
    /// Below 0.05 the tread is a plain cone: a11 = δ0 = λ, Δ = 0, f12 and f22 as at 0.05, f11 and f33
    /// extrapolated from the first two rows. Above 0.25 the last two rows are extrapolated; spec
    /// reading does not let that happen.
    pub fn tabulated(conicity: f64) -> Self {
        let upper = upper_row(conicity);
        let (low, high) = (&ROWS[upper - 1], &ROWS[upper]);
        let t = (conicity - low[0]) / (high[0] - low[0]);
        let linear = |column: usize| low[column] + t * (high[column] - low[column]);
        let cone = conicity < ROWS[0][0];
        let cylindrical = |column: usize| if cone { low[column] } else { linear(column) };
        Self {
            conicity,
            f11: linear(1) * LBF,
            f12: cylindrical(2) * LBF * FOOT,
            f22: cylindrical(3) * LBF * FOOT * FOOT,
            f33: linear(4) * LBF,
            a11: if cone { conicity } else { linear(5) },
            delta_0: if cone { conicity } else { linear(5) },
            delta: if cone { 0.0 } else { linear(6) },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_reproduced() {
        for row in ROWS {
            let c = Contact::tabulated(row[0]);
            let us = [
                c.f11 / LBF,
                c.f12 / LBF / FOOT,
                c.f22 / LBF / FOOT / FOOT,
                c.f33 / LBF,
            ];
            for (value, printed) in us.iter().zip(&row[1..5]) {
                assert!(
                    (value / printed - 1.0).abs() < 1e-12,
                    "{value} against {printed}"
                );
            }
            assert!((c.a11 - row[5]).abs() < 1e-12 && (c.delta_0 - row[5]).abs() < 1e-12);
            assert!((c.delta - row[6]).abs() < 1e-12);
        }
    }

    #[test]
    fn plain_cone_below_the_table() {
        let c = Contact::tabulated(0.025);
        // 2.12e6 − (2.245e6 − 2.12e6)/2 and 2.3e6 − (2.52e6 − 2.3e6)/2 lb
        assert!((c.f11 / LBF - 2.0575e6).abs() < 1e-3);
        assert!((c.f33 / LBF - 2.19e6).abs() < 1e-3);
        assert_eq!((c.a11, c.delta_0, c.delta), (0.025, 0.025, 0.0));
        assert!((c.f22 / LBF / FOOT / FOOT - 160.0).abs() < 1e-9);
    }

    #[test]
    fn halfway_between_rows_is_the_mean() {
        let c = Contact::tabulated(0.20);
        assert!((c.f22 / LBF / FOOT / FOOT - 647.0).abs() < 1e-9);
        assert!((c.delta - 13.4).abs() < 1e-12);
    }
}
