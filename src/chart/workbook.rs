//! Data that the charts of one spec share: the case, units, fields that several charts are drawn from.

use std::sync::OnceLock;

use rayon::prelude::*;

use super::{sweep::Sweep, value::written};
use crate::{
    case::Case,
    index::Index,
    parameter::Parameter,
    plot::{Axis, Direction, Layer, Limit, Mark, Scale, System, Unit},
    spec::Spec,
    units::{DisplayUnit, Quantity, us},
    wheel_rail::CONICITY_MAX,
};

/// Conicities of Table 4.5.1 and Figure 4.5.13, of which charts show lines.
pub const CONICITIES: [f64; 5] = [0.025, 0.05, 0.10, 0.15, 0.25];

/// m/s.
pub const MPH: f64 = us::MILE / 3600.0;

/// Conicities over which sweeps run: from the least of [`CONICITIES`] to the end of Table 4.1.1.
pub(super) const CONICITY_RANGE: [f64; 2] = [CONICITIES[0], CONICITY_MAX];

/// Grid lines of a field along each axis: so many make contours smooth to the eye.
const GRID: usize = 57;

/// Who wants to know how far the work is.
pub trait Progress: Sync {
    /// `count` more evaluations are done.
    fn done(&self, count: usize);
}

/// Nobody.
impl Progress for () {
    fn done(&self, _: usize) {}
}

/// A spec whose charts are drawn.
pub struct Workbook<'a> {
    /// The spec.
    pub spec: &'a Spec,
    /// Its name.
    pub name: String,
    /// Units that come first.
    pub system: System,
    /// Grid lines of fields along each axis: contours are as smooth as they are many.
    pub grid: usize,
    progress: &'a dyn Progress,
    /// Critical speed over the primary stiffnesses, for each of [`CONICITIES`].
    pub(super) speeds: [OnceLock<Layer>; CONICITIES.len()],
    /// Grid lines of both.
    pub(super) grids: [OnceLock<[Vec<f64>; 2]>; CONICITIES.len()],
    /// Degree curve likewise.
    pub(super) degrees: [OnceLock<Layer>; CONICITIES.len()],
    pub(super) over_conicity: OnceLock<Sweep>,
    pub(super) over_bending: OnceLock<Sweep>,
    pub(super) over_lateral: OnceLock<Sweep>,
    pub(super) over_speed: OnceLock<Vec<(f64, Sweep)>>,
}

impl<'a> Workbook<'a> {
    /// A workbook for the charts of a spec.
    pub fn new(
        spec: &'a Spec,
        name: impl Into<String>,
        system: System,
        progress: &'a dyn Progress,
    ) -> Self {
        Self {
            spec,
            name: name.into(),
            system,
            grid: GRID,
            progress,
            grids: [const { OnceLock::new() }; CONICITIES.len()],
            speeds: [const { OnceLock::new() }; CONICITIES.len()],
            degrees: [const { OnceLock::new() }; CONICITIES.len()],
            over_conicity: OnceLock::new(),
            over_bending: OnceLock::new(),
            over_lateral: OnceLock::new(),
            over_speed: OnceLock::new(),
        }
    }

    /// The case as it stands.
    pub fn case(&self) -> &Case {
        &self.spec.case
    }

    /// The case with some parameters set, SI.
    pub fn with(&self, values: &[(Parameter, f64)]) -> Case {
        let mut case = self.case().clone();
        for (parameter, value) in values {
            parameter.set(&mut case, *value);
        }
        case
    }

    /// The unit of a quantity that comes first.
    pub fn unit(&self, quantity: Quantity) -> DisplayUnit {
        match self.system {
            System::Us => quantity.us(),
            System::Si => quantity.si(),
        }
    }

    /// A value in the unit that comes first, and in the other one behind it.
    pub fn both(&self, quantity: Quantity, si: f64, figures: u8) -> String {
        let (first, second) = match self.system {
            System::Us => (quantity.us(), quantity.si()),
            System::Si => (quantity.si(), quantity.us()),
        };
        let text = written(first, si, figures);
        if first == second {
            text
        } else {
            format!("{text} ({})", written(second, si, figures))
        }
    }

    /// A value in the unit that comes first.
    pub fn value(&self, quantity: Quantity, si: f64, figures: u8) -> String {
        written(self.unit(quantity), si, figures)
    }

    /// An axis of a quantity over an SI range.
    pub fn axis(
        &self,
        title: &str,
        symbol: &str,
        column: &str,
        quantity: Quantity,
        scale: Scale,
        range: [f64; 2],
    ) -> Axis {
        Axis::new(
            title,
            symbol,
            column,
            scale,
            range,
            self.system.units(quantity),
        )
    }

    /// A logarithmic axis of a parameter, wide enough for the design.
    pub fn parameter_axis(&self, parameter: Parameter, range: [f64; 2]) -> Axis {
        let axis = self.axis(
            parameter.words(),
            parameter.symbol(),
            &parameter.column(),
            parameter.quantity(),
            Scale::Log,
            range,
        );
        axis.holding([parameter.get(self.case())])
    }

    /// The design of the spec at its values of two parameters.
    pub fn design(&self, x: Parameter, y: Parameter) -> Mark {
        Mark::design([x.get(self.case()), y.get(self.case())])
    }

    /// Computes something at every value, on all cores; results in the order of the values.
    pub fn each<X: Sync, Y: Send>(&self, values: &[X], compute: impl Fn(&X) -> Y + Sync) -> Vec<Y> {
        values
            .par_iter()
            .map(|x| {
                let y = compute(x);
                self.progress.done(1);
                y
            })
            .collect()
    }

    /// An axis of operating speeds: 40–160 mph, or as far as the design runs.
    pub fn speed_axis(&self) -> Axis {
        let speed = self.case().service.speed;
        self.axis(
            "speed",
            "V",
            "speed_m_per_s",
            Quantity::Speed,
            Scale::Linear,
            [40.0 * MPH, 160.0 * MPH],
        )
        .holding([speed])
    }

    /// An axis of critical speeds, m/s, wide enough for the required one.
    pub fn critical_speed_axis(&self, range: [f64; 2]) -> Axis {
        self.axis(
            "critical speed",
            "V_cr",
            "critical_speed_m_per_s",
            Quantity::Speed,
            Scale::Linear,
            range,
        )
        .holding(self.spec.demands.get(Index::CriticalSpeed))
    }

    /// The least value that the spec requires of an index, across an axis of it: SI, but degree
    /// curves in degrees, as their axes are.
    pub fn required(&self, index: Index, axis: Direction) -> Option<Limit> {
        let value = self.spec.demands.get(index)?;
        Some(Limit {
            axis,
            value: match index {
                Index::DegreeCurve => value.to_degrees(),
                _ => value,
            },
            at_least: true,
            label: format!("required {}", self.value(index.quantity(), value, 3)),
        })
    }

    /// An axis of the conicity.
    pub fn conicity_axis(&self) -> Axis {
        Axis::new(
            "wheel conicity",
            "λ",
            "conicity",
            Scale::Linear,
            [0.0, CONICITY_RANGE[1]],
            [Unit::new("", 1.0)],
        )
    }

    /// Name, speed and track, and what else the chart holds fixed.
    pub fn subtitle(&self, speed: Option<f64>, fixed: &[Parameter]) -> String {
        let mut parts = Vec::new();
        if let Some(speed) = speed {
            let speed = self.both(Quantity::Speed, speed, 3);
            parts.push(format!("{speed} on {}", self.case().service.track.name));
        }
        for parameter in fixed {
            let value = self.value(parameter.quantity(), parameter.get(self.case()), 3);
            // Not to be broken at the end of a line.
            let equation = format!("{} = {value}", parameter.symbol());
            parts.push(equation.replace(' ', "\u{a0}"));
        }
        if parts.is_empty() {
            return self.name.clone();
        }
        format!("{}: {}", self.name, parts.join(", "))
    }
}
