//! Comparison of a design with the constraints of 3.3 and the separations of 3.5.3 and 4.3.

mod curves;

use super::{
    Evaluation, curving::CurveStatus, equalization::wheel_load_changes, limits,
    modes::flexible_separations, ride::NoRide,
};
use crate::{
    case::Case, closed_form::natural_frequencies as closed, units::Quantity, vehicle::Vehicle,
};

/// A constraint, with the value that a design reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// Name of the value compared.
    pub name: String,
    /// Source of the limit.
    pub source: &'static str,
    /// Kind of quantity, for units.
    pub quantity: Quantity,
    /// Value of the design, SI, or the reason why it has none.
    pub value: Result<f64, NotAssessed>,
    /// Limit, SI.
    pub limit: f64,
    /// True if the value should be at least, rather than at most, the limit.
    pub at_least: bool,
}

/// Reason why a constraint cannot be assessed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotAssessed {
    /// The model does not cover the curve.
    Curve(CurveStatus),
    /// There is no stationary response.
    Ride(NoRide),
}

impl NotAssessed {
    /// Code in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::Curve(status) => status.code(),
            Self::Ride(reason) => reason.code(),
        }
    }
}

/// Verdict on a constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The limit is kept.
    Ok,
    /// The limit is exceeded.
    Exceeded,
    /// The model does not cover the value compared.
    NotAssessed,
}

impl Verdict {
    /// Name in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Exceeded => "exceeded",
            Self::NotAssessed => "not-assessed",
        }
    }
}

impl Check {
    /// Verdict on the design.
    pub fn verdict(&self) -> Verdict {
        let Ok(value) = self.value else {
            return Verdict::NotAssessed;
        };
        let excess = if self.at_least {
            self.limit - value
        } else {
            value - self.limit
        };
        if excess <= limits::MET * self.limit {
            Verdict::Ok
        } else {
            Verdict::Exceeded
        }
    }
}

/// All checks that apply to an evaluated case.
pub fn checks(case: &Case, evaluation: &Evaluation) -> Vec<Check> {
    let mut list = Vec::new();
    strokes(&mut list, evaluation);
    curves::forces(&mut list, evaluation);
    curves::strokes(&mut list, case, evaluation);
    equalization(&mut list, case);
    frequencies(&mut list, case, evaluation);
    list
}

fn at_most(
    name: impl Into<String>,
    source: &'static str,
    quantity: Quantity,
    value: f64,
    limit: f64,
) -> Check {
    Check {
        name: name.into(),
        source,
        quantity,
        value: Ok(value),
        limit,
        at_least: false,
    }
}

fn peak(rms: &[f64]) -> f64 {
    limits::PEAK * rms.iter().copied().fold(0.0, f64::max)
}

fn strokes(list: &mut Vec<Check>, evaluation: &Evaluation) {
    let lateral = evaluation.lateral.as_ref();
    let vertical = evaluation.vertical.as_ref();
    let mut stroke = |name: &str, source, rms: Result<&[f64], &NoRide>, limit| {
        list.push(Check {
            value: rms.map(peak).map_err(|reason| NotAssessed::Ride(*reason)),
            ..at_most(name, source, Quantity::Stroke, 0.0, limit)
        });
    };
    stroke(
        "primary lateral stroke, 3σ",
        "3.3.4",
        lateral.map(|ride| &ride.primary_stroke[..]),
        limits::PRIMARY_STOP,
    );
    stroke(
        "primary longitudinal stroke, 3σ",
        "3.3.4",
        lateral.map(|ride| &ride.longitudinal_stroke[..]),
        limits::PRIMARY_STOP,
    );
    stroke(
        "secondary lateral stroke, 3σ",
        "3.3.4",
        lateral.map(|ride| &ride.secondary_stroke[..]),
        limits::SECONDARY_STOP,
    );
    stroke(
        "wheelset excursion, 3σ",
        "3.3.5",
        lateral.map(|ride| &ride.excursion[..]),
        limits::EXCURSION,
    );
    stroke(
        "primary vertical stroke, 3σ",
        "3.3.4",
        vertical.map(|ride| &ride.primary_stroke[..]),
        limits::PRIMARY_STOP,
    );
    stroke(
        "secondary vertical stroke, 3σ",
        "3.3.4",
        vertical.map(|ride| &ride.secondary_stroke[..]),
        limits::SECONDARY_STOP,
    );
}

fn equalization(list: &mut Vec<Check>, case: &Case) {
    if let Some(changes) = wheel_load_changes(case) {
        let largest = changes.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        list.push(at_most(
            "wheel load change, one wheel raised 5 cm (rigid frame)",
            "3.3.2",
            Quantity::Dimensionless,
            largest / case.vehicle.wheel_load(),
            limits::LOAD_CHANGE,
        ));
    }
}

/// Ratios of truck frame to carbody natural frequencies (3.5-6 … 3.5-15); none where the carbody
/// overturns.
pub fn separations(vehicle: &Vehicle) -> [(&'static str, Option<f64>); 5] {
    let pairs = [
        (
            "lateral",
            closed::truck_lateral(vehicle),
            Some(closed::carbody_lateral(vehicle)),
        ),
        (
            "vertical",
            closed::truck_vertical(vehicle),
            Some(closed::carbody_vertical(vehicle)),
        ),
        (
            "roll",
            closed::truck_roll(vehicle),
            closed::carbody_roll(vehicle),
        ),
        (
            "yaw",
            closed::truck_yaw(vehicle),
            Some(closed::carbody_yaw(vehicle)),
        ),
        (
            "pitch",
            closed::truck_pitch(vehicle),
            Some(closed::carbody_pitch(vehicle)),
        ),
    ];
    pairs.map(|(name, truck, carbody)| {
        (
            name,
            carbody.map(|carbody| truck.frequency / carbody.frequency),
        )
    })
}

/// Factor of two between truck frame and carbody frequencies (3.5.3), and of the truck's vertical
/// modes from the carbody's flexible ones (4.3).
fn frequencies(list: &mut Vec<Check>, case: &Case, evaluation: &Evaluation) {
    let at_least = |name, source, value, limit| Check {
        name,
        source,
        quantity: Quantity::Dimensionless,
        value: Ok(value),
        limit,
        at_least: true,
    };
    for (name, ratio) in separations(&case.vehicle) {
        if let Some(ratio) = ratio {
            let name = format!("truck over carbody frequency, {name}");
            list.push(at_least(name, "3.5.3", ratio, limits::SEPARATION));
        }
    }
    let nearest = flexible_separations(&evaluation.vertical_modes)
        .into_iter()
        .min_by(|a, b| a.ratio.total_cmp(&b.ratio));
    if let Some(nearest) = nearest {
        let [truck, flexible] = nearest.shapes;
        // 4.3 asks that they do not align and gives no number: 10 % apart keeps their peaks apart.
        let name = format!("{truck} against {flexible}, frequency ratio");
        list.push(at_least(name, "4.3", nearest.ratio, 1.1));
    }
}
