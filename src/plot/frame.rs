//! The frames of panels.

use serde::Serialize;

use super::Panel;

/// The rectangle between the axes of a panel, and where data stand in it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Frame {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Frame {
    /// Where a point stands; outside the frame too.
    pub fn point(&self, panel: &Panel, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.x + self.width * panel.x.fraction(x),
            self.y + self.height * (1.0 - panel.y.fraction(y)),
        ]
    }

    /// Whether a place is in the frame, at least `inside` away from its edges.
    pub fn holds(&self, [x, y]: [f64; 2], inside: f64) -> bool {
        (self.x + inside..=self.x + self.width - inside).contains(&x)
            && (self.y + inside..=self.y + self.height - inside).contains(&y)
    }
}
