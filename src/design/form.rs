//! The design form of Table 4.6.1, filled line by line from the full models.

use super::outcome::DesignResult;
use crate::{
    closed_form::natural_frequencies as closed,
    spec::{Limits, Requirements},
    units::Quantity,
};

/// A line of the form.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Step of Table 4.6.1.
    pub step: &'static str,
    /// What is entered.
    pub text: &'static str,
    /// Symbol in the report.
    pub symbol: &'static str,
    /// Kind of quantity, for units.
    pub quantity: Quantity,
    /// The entry, SI; `None`: not specified, or no such performance.
    pub value: Option<f64>,
}

/// Fills the form. Where the report adds up chart readings (steps 6, 7, 14, 15, 22, 23), the full
/// models give the sum directly.
pub fn form(result: &DesignResult, requirements: &Requirements, limits: &Limits) -> Vec<Line> {
    use Quantity::{
        Acceleration, Damping, DegreeOfCurve, Dimensionless, Force, Frequency, LateralSpinCreep,
        RotationalDamping, RotationalStiffness, Speed, SpinCreep, Stiffness, Stroke,
    };
    let case = &result.case;
    let vehicle = &case.vehicle;
    let (primary, secondary) = (&vehicle.suspension.primary, &vehicle.suspension.secondary);
    let contact = case.wheel_rail.contact();
    let mass = vehicle.carbody.mass;
    let lateral = result.evaluation.lateral.as_ref();
    let vertical = result.evaluation.vertical.as_ref();
    // The report's strokes are RMS averages of both ends; the limits are peaks.
    let rms = |peak: Option<f64>| peak.map(|p| p / super::ride::PEAK);
    let line = |step, text, symbol, quantity, value| Line {
        step,
        text,
        symbol,
        quantity,
        value,
    };
    vec![
        line(
            "1",
            "desired critical speed",
            "V_cr*",
            Speed,
            requirements.critical_speed,
        ),
        line(
            "2",
            "desired degree curve",
            "D*",
            DegreeOfCurve,
            requirements.degree_curve.map(f64::to_radians),
        ),
        line(
            "3",
            "wheel conicity",
            "λ",
            Dimensionless,
            Some(contact.conicity),
        ),
        line(
            "",
            "contact angle difference coefficient",
            "Δ",
            Dimensionless,
            Some(contact.delta),
        ),
        line(
            "",
            "centred contact angle",
            "δ0",
            Dimensionless,
            Some(contact.delta_0),
        ),
        line(
            "",
            "wheelset roll coefficient",
            "a11",
            Dimensionless,
            Some(contact.a11),
        ),
        line(
            "",
            "lateral creep coefficient",
            "f11",
            Force,
            Some(contact.f11),
        ),
        line(
            "",
            "lateral–spin creep coefficient",
            "f12",
            LateralSpinCreep,
            Some(contact.f12),
        ),
        line(
            "",
            "spin creep coefficient",
            "f22",
            SpinCreep,
            Some(contact.f22),
        ),
        line(
            "",
            "longitudinal creep coefficient",
            "f33",
            Force,
            Some(contact.f33),
        ),
        line(
            "4",
            "primary lateral stiffness",
            "K_py",
            Stiffness,
            Some(primary.lateral_stiffness),
        ),
        line(
            "",
            "primary bending stiffness",
            "K_b",
            RotationalStiffness,
            Some(vehicle.bending_stiffness()),
        ),
        line(
            "",
            "critical speed",
            "V_cr",
            Speed,
            result.evaluation.stability.critical_speed(),
        ),
        line(
            "",
            "degree curve",
            "D",
            DegreeOfCurve,
            result
                .evaluation
                .curving
                .as_ref()
                .ok()
                .map(|c| c.degree().to_radians()),
        ),
        line(
            "5",
            "primary longitudinal stiffness",
            "K_px",
            Stiffness,
            Some(primary.longitudinal_stiffness),
        ),
        line(
            "6d",
            "RMS primary stroke, wheelset 4",
            "PS",
            Stroke,
            lateral.map(|r| r.primary_stroke[3]),
        ),
        line(
            "7d",
            "RMS wheelset excursion, wheelset 1",
            "WE",
            Stroke,
            lateral.map(|r| r.excursion[0]),
        ),
        line(
            "9",
            "desired RMS lateral acceleration",
            "ACC_L*",
            Acceleration,
            requirements.lateral_acceleration,
        ),
        line(
            "10",
            "desired RMS secondary lateral stroke",
            "ST_L*",
            Stroke,
            rms(limits.secondary_lateral_stroke),
        ),
        line(
            "11",
            "lateral natural frequency",
            "f_nL",
            Frequency,
            Some(closed::secondary_frequency(
                mass,
                secondary.lateral_stiffness,
            )),
        ),
        line(
            "",
            "lateral damping ratio",
            "ξ_L",
            Dimensionless,
            Some(closed::secondary_damping_ratio(
                mass,
                secondary.lateral_stiffness,
                secondary.lateral_damping,
            )),
        ),
        line(
            "12",
            "secondary lateral stiffness",
            "K_sy",
            Stiffness,
            Some(secondary.lateral_stiffness),
        ),
        line(
            "13",
            "secondary lateral damping",
            "C_sy",
            Damping,
            Some(secondary.lateral_damping),
        ),
        line(
            "14d",
            "RMS lateral acceleration",
            "ACC_L",
            Acceleration,
            lateral.map(|r| r.average_acceleration()),
        ),
        line(
            "15d",
            "RMS secondary lateral stroke",
            "ST_L",
            Stroke,
            lateral.map(|r| r.average_stroke()),
        ),
        line(
            "17",
            "desired RMS vertical acceleration",
            "ACC_v*",
            Acceleration,
            requirements.vertical_acceleration,
        ),
        line(
            "18",
            "desired RMS secondary vertical stroke",
            "ST_v*",
            Stroke,
            rms(limits.secondary_vertical_stroke),
        ),
        line(
            "19",
            "vertical natural frequency",
            "f_nv",
            Frequency,
            Some(closed::secondary_frequency(
                mass,
                secondary.vertical_stiffness,
            )),
        ),
        line(
            "",
            "vertical damping ratio",
            "ξ_v",
            Dimensionless,
            Some(closed::secondary_damping_ratio(
                mass,
                secondary.vertical_stiffness,
                secondary.vertical_damping,
            )),
        ),
        line(
            "20",
            "secondary vertical stiffness",
            "K_sz",
            Stiffness,
            Some(secondary.vertical_stiffness),
        ),
        line(
            "21",
            "secondary vertical damping",
            "C_sz",
            Damping,
            Some(secondary.vertical_damping),
        ),
        line(
            "22",
            "RMS vertical acceleration",
            "ACC_v",
            Acceleration,
            vertical.map(|r| r.average_acceleration()),
        ),
        line(
            "23",
            "RMS secondary vertical stroke",
            "ST_v",
            Stroke,
            vertical.map(|r| r.average_stroke()),
        ),
        line(
            "25",
            "primary longitudinal damping",
            "C_px",
            Damping,
            Some(primary.c_px()),
        ),
        line(
            "",
            "primary lateral damping",
            "C_py",
            Damping,
            Some(primary.c_py()),
        ),
        line(
            "",
            "primary vertical stiffness",
            "K_pz",
            Stiffness,
            Some(primary.vertical_stiffness),
        ),
        line(
            "",
            "primary vertical damping",
            "C_pz",
            Damping,
            Some(primary.c_pz()),
        ),
        line(
            "",
            "secondary yaw damping",
            "C_sψ",
            RotationalDamping,
            Some(secondary.c_spsi()),
        ),
    ]
}
