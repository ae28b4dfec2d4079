//! The design form of Table 4.6.1, filled line by line from the full models.

use super::outcome::DesignResult;
use crate::{
    closed_form::natural_frequencies as closed,
    evaluate::limits::PEAK,
    index::{Demands, Index},
    units::Quantity,
};

/// A line of the form.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Step of Table 4.6.1; empty for a further entry of the same step.
    pub step: &'static str,
    /// Name of the entry.
    pub text: &'static str,
    /// Symbol in the report.
    pub symbol: &'static str,
    /// Kind of quantity, for units.
    pub quantity: Quantity,
    /// The entry, SI; `None`: not specified, or no such performance.
    pub value: Option<f64>,
}

fn line(
    step: &'static str,
    text: &'static str,
    symbol: &'static str,
    quantity: Quantity,
    value: impl Into<Option<f64>>,
) -> Line {
    Line {
        step,
        text,
        symbol,
        quantity,
        value: value.into(),
    }
}

/// Fills the form. Where the report adds up chart readings (steps 6, 7, 14, 15, 22, 23), the full
/// models give the sum directly.
pub fn form(result: &DesignResult, demands: &Demands) -> Vec<Line> {
    let mut lines = wheel_rail(result, demands);
    lines.extend(stability_curving(result));
    lines.extend(lateral(result, demands));
    lines.extend(vertical(result, demands));
    lines.extend(dependent(result));
    lines
}

/// Steps 1–3.
fn wheel_rail(result: &DesignResult, demands: &Demands) -> Vec<Line> {
    use Quantity::{DegreeOfCurve, Dimensionless, Force, LateralSpinCreep, Speed, SpinCreep};
    let c = result.case.wheel_rail.contact();
    let degree = demands.get(Index::DegreeCurve);
    vec![
        line(
            "1",
            "desired critical speed",
            "V_cr*",
            Speed,
            demands.get(Index::CriticalSpeed),
        ),
        line("2", "desired degree curve", "D*", DegreeOfCurve, degree),
        line("3", "wheel conicity", "λ", Dimensionless, c.conicity),
        line(
            "",
            "contact angle difference coefficient",
            "Δ",
            Dimensionless,
            c.delta,
        ),
        line("", "centred contact angle", "δ0", Dimensionless, c.delta_0),
        line("", "wheelset roll coefficient", "a11", Dimensionless, c.a11),
        line("", "lateral creep coefficient", "f11", Force, c.f11),
        line(
            "",
            "lateral–spin creep coefficient",
            "f12",
            LateralSpinCreep,
            c.f12,
        ),
        line("", "spin creep coefficient", "f22", SpinCreep, c.f22),
        line("", "longitudinal creep coefficient", "f33", Force, c.f33),
    ]
}

/// Steps 4–8.
fn stability_curving(result: &DesignResult) -> Vec<Line> {
    use Quantity::{DegreeOfCurve, RotationalStiffness, Speed, Stiffness, Stroke};
    let vehicle = &result.case.vehicle;
    let primary = &vehicle.suspension.primary;
    let evaluation = &result.evaluation;
    let ride = evaluation.lateral.as_ref().ok();
    let degree = evaluation
        .curving
        .as_ref()
        .ok()
        .map(|c| c.degree().to_radians());
    let bending = vehicle.bending_stiffness();
    vec![
        line(
            "4",
            "primary lateral stiffness",
            "K_py",
            Stiffness,
            primary.lateral_stiffness,
        ),
        line(
            "",
            "primary bending stiffness",
            "K_b",
            RotationalStiffness,
            bending,
        ),
        line(
            "",
            "critical speed",
            "V_cr",
            Speed,
            evaluation.stability.critical_speed(),
        ),
        line("", "degree curve", "D", DegreeOfCurve, degree),
        line(
            "5",
            "primary longitudinal stiffness",
            "K_px",
            Stiffness,
            primary.longitudinal_stiffness,
        ),
        line(
            "6d",
            "RMS primary stroke, wheelset 4",
            "PS",
            Stroke,
            ride.map(|r| r.primary_stroke[3]),
        ),
        line(
            "7d",
            "RMS wheelset excursion, wheelset 1",
            "WE",
            Stroke,
            ride.map(|r| r.excursion[0]),
        ),
    ]
}

/// The report's desired strokes are RMS values; limits are peaks.
fn rms(peak: Option<f64>) -> Option<f64> {
    peak.map(|p| p / PEAK)
}

/// Step, text and symbol of an entry.
type Entry = [&'static str; 3];

/// Steps 9–16.
#[rustfmt::skip]
const LATERAL: [Entry; 8] = [
    ["9", "desired RMS lateral acceleration", "ACC_L*"],
    ["10", "desired RMS secondary lateral stroke", "ST_L*"],
    ["11", "lateral natural frequency", "f_nL"],
    ["", "lateral damping ratio", "ξ_L"],
    ["12", "secondary lateral stiffness", "K_sy"],
    ["13", "secondary lateral damping", "C_sy"],
    ["14d", "RMS lateral acceleration", "ACC_L"],
    ["15d", "RMS secondary lateral stroke", "ST_L"],
];

/// Steps 17–24.
#[rustfmt::skip]
const VERTICAL: [Entry; 8] = [
    ["17", "desired RMS vertical acceleration", "ACC_v*"],
    ["18", "desired RMS secondary vertical stroke", "ST_v*"],
    ["19", "vertical natural frequency", "f_nv"],
    ["", "vertical damping ratio", "ξ_v"],
    ["20", "secondary vertical stiffness", "K_sz"],
    ["21", "secondary vertical damping", "C_sz"],
    ["22", "RMS vertical acceleration", "ACC_v"],
    ["23", "RMS secondary vertical stroke", "ST_v"],
];

/// Secondary suspension of one direction: stiffness and damping `k` and `c`, acceleration and stroke
/// `desired` and `reached`.
fn secondary(
    entries: &[Entry; 8],
    mass: f64,
    [k, c]: [f64; 2],
    desired: [Option<f64>; 2],
    reached: Option<[f64; 2]>,
) -> Vec<Line> {
    use Quantity::{Acceleration, Damping, Dimensionless, Frequency, Stiffness, Stroke};
    let values = [
        (Acceleration, desired[0]),
        (Stroke, rms(desired[1])),
        (Frequency, Some(closed::secondary_frequency(mass, k))),
        (
            Dimensionless,
            Some(closed::secondary_damping_ratio(mass, k, c)),
        ),
        (Stiffness, Some(k)),
        (Damping, Some(c)),
        (Acceleration, reached.map(|[acceleration, _]| acceleration)),
        (Stroke, reached.map(|[_, stroke]| stroke)),
    ];
    let lines = entries.iter().zip(values);
    lines
        .map(|([step, text, symbol], (quantity, value))| line(step, text, symbol, quantity, value))
        .collect()
}

fn lateral(result: &DesignResult, demands: &Demands) -> Vec<Line> {
    let vehicle = &result.case.vehicle;
    let s = &vehicle.suspension.secondary;
    let ride = result.evaluation.lateral.as_ref().ok();
    secondary(
        &LATERAL,
        vehicle.carbody.mass,
        [s.lateral_stiffness, s.lateral_damping],
        [Index::LateralAcceleration, Index::SecondaryLateralStroke].map(|index| demands.get(index)),
        ride.map(|ride| [ride.average_acceleration(), ride.average_stroke()]),
    )
}

fn vertical(result: &DesignResult, demands: &Demands) -> Vec<Line> {
    let vehicle = &result.case.vehicle;
    let s = &vehicle.suspension.secondary;
    let ride = result.evaluation.vertical.as_ref().ok();
    secondary(
        &VERTICAL,
        vehicle.carbody.mass,
        [s.vertical_stiffness, s.vertical_damping],
        [Index::VerticalAcceleration, Index::SecondaryVerticalStroke]
            .map(|index| demands.get(index)),
        ride.map(|ride| [ride.average_acceleration(), ride.average_stroke()]),
    )
}

/// Step 25.
fn dependent(result: &DesignResult) -> Vec<Line> {
    use Quantity::{Damping, RotationalDamping, Stiffness};
    let (p, s) = (
        &result.case.vehicle.suspension.primary,
        &result.case.vehicle.suspension.secondary,
    );
    vec![
        line(
            "25",
            "primary longitudinal damping",
            "C_px",
            Damping,
            p.c_px(),
        ),
        line("", "primary lateral damping", "C_py", Damping, p.c_py()),
        line(
            "",
            "primary vertical stiffness",
            "K_pz",
            Stiffness,
            p.vertical_stiffness,
        ),
        line("", "primary vertical damping", "C_pz", Damping, p.c_pz()),
        line(
            "",
            "secondary yaw damping",
            "C_sψ",
            RotationalDamping,
            s.c_spsi(),
        ),
    ]
}
