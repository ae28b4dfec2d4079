//! Labels: boxes of text at an angle.

use serde::Serialize;

use super::Ink;

/// A label and where it stands.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlacedLabel {
    /// Number of its panel.
    pub panel: usize,
    /// Text.
    pub text: String,
    /// Its middle, px.
    pub centre: [f64; 2],
    /// Its extent along and across its direction, px.
    pub size: [f64; 2],
    /// Its direction, degrees clockwise from the horizontal.
    pub angle: f64,
    /// Colour.
    pub ink: Ink,
}

impl PlacedLabel {
    fn axes(&self) -> [[f64; 2]; 2] {
        let (s, c) = self.angle.to_radians().sin_cos();
        [[c, s], [-s, c]]
    }

    /// Its corners, px.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let [along, across] = self.axes();
        let [half_length, half_height] = self.size.map(|x| x / 2.0);
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(s, t)| {
            [0, 1]
                .map(|k| self.centre[k] + s * half_length * along[k] + t * half_height * across[k])
        })
    }

    /// Whether two labels overlap: no direction of a side of either separates them.
    pub fn overlaps(&self, other: &Self) -> bool {
        let corners = [self.corners(), other.corners()];
        self.axes().into_iter().chain(other.axes()).all(|axis| {
            let [a, b] = corners.map(|corners| {
                let along = corners.map(|p| p[0] * axis[0] + p[1] * axis[1]);
                [
                    along.into_iter().fold(f64::INFINITY, f64::min),
                    along.into_iter().fold(f64::NEG_INFINITY, f64::max),
                ]
            });
            a[0] < b[1] && b[0] < a[1]
        })
    }

    /// Whether a line from p to q passes through it.
    pub(super) fn crossed_by(&self, p: [f64; 2], q: [f64; 2]) -> bool {
        // Clipping in the coordinates of the label.
        let [along, across] = self.axes();
        let local = |point: [f64; 2]| {
            let d = [point[0] - self.centre[0], point[1] - self.centre[1]];
            [
                d[0] * along[0] + d[1] * along[1],
                d[0] * across[0] + d[1] * across[1],
            ]
        };
        let (p, q) = (local(p), local(q));
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for k in 0..2 {
            let half = self.size[k] / 2.0;
            let d = q[k] - p[k];
            if d.abs() < 1e-12 {
                if p[k].abs() > half {
                    return false;
                }
            } else {
                let (a, b) = ((-half - p[k]) / d, (half - p[k]) / d);
                from = from.max(a.min(b));
                to = to.min(a.max(b));
            }
        }
        from < to
    }
}
