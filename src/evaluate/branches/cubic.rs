//! Cubics between two speeds.

use nalgebra::Complex;

use crate::dynamics::Known;

/// A complex cubic over 0…1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubic([Complex<f64>; 4]);

impl Cubic {
    /// With values and slopes at both ends.
    pub fn new([a, da]: [Complex<f64>; 2], [b, db]: [Complex<f64>; 2]) -> Self {
        let change = b - a;
        Self([a, da, 3.0 * change - 2.0 * da - db, da + db - 2.0 * change])
    }

    /// Value.
    pub fn value(&self, t: f64) -> Complex<f64> {
        let [c0, c1, c2, c3] = self.0;
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    /// Slope.
    pub fn slope(&self, t: f64) -> Complex<f64> {
        let [_, c1, c2, c3] = self.0;
        c1 + t * (2.0 * c2 + 3.0 * t * c3)
    }
}

/// An eigenvalue between two speeds, as a cubic in ln V with the values and slopes there.
pub(super) struct Between {
    /// Lower speed, m/s, and the way to the higher in ln V.
    low: f64,
    length: f64,
    cubic: Cubic,
}

/// Steps in which a root is found, and the share of the way that it is found to.
const STEPS: usize = 60;
const FOUND: f64 = 1e-10;

impl Between {
    pub fn new(low: &Known, high: &Known) -> Self {
        let length = (high.speed / low.speed).ln();
        let [a, b] = [low, high].map(|known| [known.s, known.slope * length]);
        Self {
            low: low.speed,
            length,
            cubic: Cubic::new(a, b),
        }
    }

    /// s and ds/d ln V at a share `t` of the way.
    fn at(&self, t: f64) -> [Complex<f64>; 2] {
        [self.cubic.value(t), self.cubic.slope(t) / self.length]
    }

    /// s at a speed, m/s.
    pub fn at_speed(&self, speed: f64) -> Complex<f64> {
        self.cubic.value((speed / self.low).ln() / self.length)
    }

    /// All of it at a share `t` of the way.
    pub fn known(&self, t: f64) -> Known {
        let [s, slope] = self.at(t);
        let speed = self.low * (t * self.length).exp();
        Known { speed, s, slope }
    }

    /// Share of the way at which a function of s and its slope, negative at the lower end, is no
    /// longer so: by the secant, with half the value of an end that stays (the Illinois algorithm,
    /// Dowell and Jarratt 1971).
    pub fn root(&self, function: impl Fn([Complex<f64>; 2]) -> f64) -> f64 {
        let ([mut a, mut b], mut t) = ([0.0, 1.0], 1.0);
        let [mut below, mut above] = [a, b].map(|t| function(self.at(t)));
        let mut stayed = None;
        for _ in 0..STEPS {
            let before = t;
            t = (a * above - b * below) / (above - below);
            if (t - before).abs() < FOUND {
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
