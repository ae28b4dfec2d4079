//! Obstacles of labels: lines and points.

use super::{Direction, Frame, Ink, Limit, Panel, PlacedLabel, Symbol, polyline::visible};

/// Lines and points of a panel, in pixels.
pub(super) struct Obstacles {
    /// Pieces of curves and limits, by number of the curve.
    pub lines: Vec<(usize, Vec<[f64; 2]>)>,
    /// Boxes of the points.
    pub points: Vec<PlacedLabel>,
}

impl Symbol {
    /// Its extent with the space around it, px.
    pub(super) fn extent(self) -> f64 {
        match self {
            Self::Design => 16.0,
            Self::Disc | Self::Ring | Self::Square | Self::Triangle => 11.0,
            Self::Dot => 8.0,
        }
    }
}

impl Obstacles {
    pub fn new(panel: &Panel, frame: &Frame) -> Self {
        let mut lines = Vec::new();
        let curves = panel.families.iter().flat_map(|f| &f.curves);
        for (number, curve) in curves.enumerate() {
            for piece in &curve.pieces {
                for visible in visible(panel, frame, piece) {
                    lines.push((number, visible));
                }
            }
        }
        let count = panel.families.iter().map(|f| f.curves.len()).sum::<usize>();
        for (i, limit) in panel.limits.iter().enumerate() {
            lines.push((count + i, limit.line(frame, panel).to_vec()));
        }
        let points = panel
            .marks
            .iter()
            .map(|mark| PlacedLabel {
                panel: 0,
                text: String::new(),
                centre: frame.point(panel, mark.at),
                size: [mark.symbol.extent(); 2],
                angle: 0.0,
                ink: Ink::Black,
            })
            .collect();
        Self { lines, points }
    }

    /// How often other lines than its own pass through a label, up to three times each.
    pub fn crossings(&self, label: &PlacedLabel, own: usize) -> usize {
        self.lines
            .iter()
            .filter(|(number, _)| *number != own)
            .map(|(_, line)| {
                line.windows(2)
                    .filter(|w| label.crossed_by(w[0], w[1]))
                    .count()
                    .min(3)
            })
            .sum()
    }
}

impl Limit {
    /// Its ends on the frame.
    pub(super) fn line(&self, frame: &Frame, panel: &Panel) -> [[f64; 2]; 2] {
        match self.axis {
            Direction::X => {
                let x = frame.x + frame.width * panel.x.fraction(self.value);
                [[x, frame.y + frame.height], [x, frame.y]]
            }
            Direction::Y => {
                let y = frame.y + frame.height * (1.0 - panel.y.fraction(self.value));
                [[frame.x, y], [frame.x + frame.width, y]]
            }
        }
    }
}
