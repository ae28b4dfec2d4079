//! The legend: what lines and symbols mean that have no label beside them.

use super::{
    Drawing, Ink, Labels, Stroke, Symbol,
    layout::{LEADING, MARGIN, WIDTH, size},
    text,
};

/// An entry of the legend.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub text: String,
    pub look: Look,
    /// Left end of its base line.
    pub at: [f64; 2],
}

/// Sample of an entry of the legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Look {
    Line(Stroke, bool),
    Hatched,
    Symbol(Symbol, Ink),
}

/// Length of the sample of a line in the legend, with the space behind it.
pub(super) const SAMPLE: f64 = 28.0;

impl Drawing<'_> {
    /// Adds the legend below what is there.
    pub(super) fn lay_legend(&mut self, missing: &[(String, Look)]) {
        let mut entries: Vec<(String, Look)> = Vec::new();
        let mut add = |text: &str, look: Look| {
            let entry = (text.to_owned(), look);
            if !text.is_empty() && !entries.contains(&entry) {
                entries.push(entry);
            }
        };
        for panel in &self.figure.panels {
            for key in &panel.keys {
                add(&key.label, Look::Symbol(key.symbol, key.ink));
            }
            for family in &panel.families {
                let dots = family.curves.iter().any(|c| c.dots);
                add(&family.title, Look::Line(family.stroke, dots));
                if family.labels == Labels::Legend {
                    for curve in &family.curves {
                        add(
                            &curve.label,
                            Look::Line(family.stroke_of(curve), curve.dots),
                        );
                    }
                }
            }
        }
        for (text, look) in missing {
            add(text, *look);
        }
        if entries.is_empty() {
            return;
        }
        let mut x = MARGIN;
        self.height += LEADING * size::LABEL;
        for (text, look) in entries {
            let width = SAMPLE + text::width(&text, size::LABEL) + 18.0;
            if x + width - 18.0 > WIDTH - MARGIN && x > MARGIN {
                x = MARGIN;
                self.height += LEADING * size::LABEL + 1.0;
            }
            self.legend.push(Entry {
                text,
                look,
                at: [x, self.height - 0.3 * size::LABEL],
            });
            x += width;
        }
        self.height += 6.0;
    }
}
