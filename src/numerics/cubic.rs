//! Hermite cubics between two speeds.

use nalgebra::Complex;

use super::Eigenvalue;

/// A complex Hermite cubic over 0…1.
#[derive(Debug, Clone, Copy)]
pub struct Cubic([Complex<f64>; 4]);

impl Cubic {
    /// Cubic with values and slopes at both ends.
    pub fn new([a, da]: [Complex<f64>; 2], [b, db]: [Complex<f64>; 2]) -> Self {
        let change = b - a;
        Self([a, da, 3.0 * change - 2.0 * da - db, da + db - 2.0 * change])
    }

    /// Value at `t`.
    pub fn value(&self, t: f64) -> Complex<f64> {
        let [c0, c1, c2, c3] = self.0;
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    /// Slope at `t`.
    pub fn slope(&self, t: f64) -> Complex<f64> {
        let [_, c1, c2, c3] = self.0;
        c1 + t * (2.0 * c2 + 3.0 * t * c3)
    }
}

/// An eigenvalue between two speeds, as a cubic in ln V with the values and slopes there.
pub struct Between {
    /// Lower speed, m/s.
    low: f64,
    /// Distance to the higher speed in ln V.
    length: f64,
    cubic: Cubic,
}

/// Limit on the steps of the secant.
const MAX_STEPS: usize = 60;
/// Accuracy of a root, as a share of the interval.
const ROOT_ACCURACY: f64 = 1e-10;

impl Between {
    /// Cubic between an eigenvalue at a lower and at a higher speed.
    pub fn new(low: &Eigenvalue, high: &Eigenvalue) -> Self {
        let length = (high.speed / low.speed).ln();
        let [a, b] = [low, high].map(|known| [known.s, known.slope * length]);
        Self {
            low: low.speed,
            length,
            cubic: Cubic::new(a, b),
        }
    }

    /// s and ds/d ln V at a share `t` of the interval.
    fn at(&self, t: f64) -> [Complex<f64>; 2] {
        [self.cubic.value(t), self.cubic.slope(t) / self.length]
    }

    /// s at a speed, m/s.
    pub fn at_speed(&self, speed: f64) -> Complex<f64> {
        self.cubic.value((speed / self.low).ln() / self.length)
    }

    /// Eigenvalue at a share `t` of the interval.
    pub fn eigenvalue(&self, t: f64) -> Eigenvalue {
        let [s, slope] = self.at(t);
        let speed = self.low * (t * self.length).exp();
        Eigenvalue { speed, s, slope }
    }

    /// Root, as a share of the interval, of a function of s and its slope that is negative at the lower
    /// end: regula falsi that halves the value of a retained end (Illinois algorithm, Dowell and Jarratt
    /// 1971).
    pub fn root(&self, function: impl Fn([Complex<f64>; 2]) -> f64) -> f64 {
        let ([mut a, mut b], mut t) = ([0.0, 1.0], 1.0);
        let [mut below, mut above] = [a, b].map(|t| function(self.at(t)));
        let mut stayed = None;
        for _ in 0..MAX_STEPS {
            let before = t;
            t = (a * above - b * below) / (above - below);
            if (t - before).abs() < ROOT_ACCURACY {
                break;
            }
            let value = function(self.at(t));
            let is_below = value < 0.0;
            if is_below {
                (a, below) = (t, value);
            } else {
                (b, above) = (t, value);
            }
            if stayed == Some(is_below) {
                if is_below {
                    above /= 2.0;
                } else {
                    below /= 2.0;
                }
            }
            stayed = Some(is_below);
        }
        t
    }
}
