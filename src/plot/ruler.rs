//! Rulers: the ticks at the sides of a panel.

use super::{
    Axis, Panel, Scale, Unit,
    layout::{WIDTH, size},
    text,
    tick::{Tick, ticks},
};

/// Ticks of one axis in one unit, with their places.
#[derive(Debug, Clone)]
pub(super) struct Ruler {
    /// Tick, and fraction of the axis.
    pub ticks: Vec<(Tick, f64)>,
    /// Title with unit.
    pub title: String,
}

impl Ruler {
    fn new(axis: &Axis, unit: &Unit, length: f64, room: f64) -> Self {
        let [low, high] = axis.range.map(|x| x / unit.factor);
        let count = (length / room).floor().max(2.0);
        // Logarithmic labels are wider.
        let count = if axis.scale == Scale::Log {
            1.6 * count
        } else {
            count
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small positive count"
        )]
        let found = ticks(axis.scale, low, high, count as usize);
        Self {
            ticks: found
                .into_iter()
                .map(|tick| {
                    let fraction = axis.fraction(tick.value * unit.factor);
                    (tick, fraction)
                })
                .collect(),
            title: axis.text(unit),
        }
    }

    /// Width of the widest label.
    pub fn width(&self) -> f64 {
        self.ticks
            .iter()
            .filter_map(|(tick, _)| tick.label.as_deref())
            .map(|label| text::width(label, size::LABEL))
            .fold(0.0, f64::max)
    }
}

/// Rulers at the four sides of a panel.
#[derive(Debug, Clone)]
pub(super) struct Rulers {
    pub bottom: Ruler,
    pub left: Ruler,
    pub top: Option<Ruler>,
    pub right: Option<Ruler>,
}

/// The rulers of a panel in a cell so many pixels wide, with a frame so many high.
pub(super) fn rulers(panel: &Panel, cell: f64, height: f64) -> Rulers {
    let room = match panel.x.scale {
        Scale::Linear => 46.0,
        Scale::Log => 62.0,
    };
    let across = |unit: &Unit| Ruler::new(&panel.x, unit, cell - 110.0, room);
    let up = |unit: &Unit| Ruler::new(&panel.y, unit, height, 38.0);
    // Panels side by side have no room to say it twice.
    let narrow = cell < WIDTH / 2.0;
    let second = |ruler: Ruler, unit: &Unit| Ruler {
        title: if narrow {
            unit.label.clone()
        } else {
            ruler.title
        },
        ..ruler
    };
    let plain = Unit::new("", 1.0);
    let first = |axis: &Axis| axis.units.first().unwrap_or(&plain).clone();
    Rulers {
        bottom: across(&first(&panel.x)),
        left: up(&first(&panel.y)),
        top: panel.x.units.get(1).map(|unit| second(across(unit), unit)),
        right: panel.y.units.get(1).map(|unit| second(up(unit), unit)),
    }
}
