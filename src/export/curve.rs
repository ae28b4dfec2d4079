//! `bogie curve`: the vehicle in a curve, its limits, and the performance boundary.

mod text;

use serde_json::{Value, json};

use crate::{
    case::Case,
    dynamics::curving::{Breakaway, CurvingError, WheelForces},
    evaluate::curving::{CurveStatus, CurvingLimits, CurvingState, LimitedCurve, level_curves},
    track::curvature_of_degree,
};

/// Result of `bogie curve`.
#[derive(Debug, Clone)]
pub struct Curving {
    /// Which curve is shown.
    pub shown: Shown,
    /// D, degrees; `None` where the tightest curve was asked for and a wheel is lifted.
    pub degree: Option<f64>,
    /// φ_d, rad.
    pub cant_deficiency: f64,
    /// The vehicle in it; the status where a wheel is lifted.
    pub state: Result<CurvingState, CurveStatus>,
    /// Limits at the same cant deficiency.
    pub limits: Result<CurvingLimits, CurveStatus>,
    /// Cant deficiencies, rad, and the limits there: the boundary of Figure 4.5.5.
    pub boundary: Vec<(f64, Result<CurvingLimits, CurveStatus>)>,
}

/// Which curve is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// The one asked for.
    Asked,
    /// That of the service.
    Service,
    /// The tightest without flange contact or slip at zero cant deficiency, which stands for that of
    /// the service where it gives none.
    TightestAtZero,
    /// The tightest without flange contact or slip at the cant deficiency shown.
    TightestHere,
}

impl std::fmt::Display for Shown {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Asked => "curve asked for",
            Self::Service => "service curve",
            Self::TightestAtZero => "tightest curve at zero cant deficiency",
            Self::TightestHere => "tightest curve at this cant deficiency",
        })
    }
}

/// Largest cant deficiency of the boundary, degrees, and its steps.
const BOUNDARY: (f64, usize) = (6.0, 24);

impl Curving {
    /// A case in a curve of `degree` degrees at a cant deficiency φ_d, rad. Without one of them that of
    /// the service; without a curve there either, the tightest without flange contact or slip.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady-state solution.
    pub fn new(
        case: &Case,
        degree: Option<f64>,
        cant_deficiency: Option<f64>,
    ) -> Result<Self, CurvingError> {
        let here = cant_deficiency.unwrap_or_else(|| case.service.cant_deficiency());
        let limits = CurveStatus::or_lifted(CurvingLimits::new(case, here))?;
        let service = case.service.curve.map(f64::to_degrees);
        let (shown, degree) = match (degree, service, cant_deficiency) {
            (Some(degree), _, _) => (Shown::Asked, Some(degree)),
            (None, Some(degree), _) => (Shown::Service, Some(degree)),
            (None, None, None) => {
                let (_, level) = level_curves(case)?;
                (Shown::TightestAtZero, Some(level.degree()))
            }
            (None, None, Some(_)) => {
                let tightest = limits.as_ref().ok().map(CurvingLimits::degree);
                (Shown::TightestHere, tightest)
            }
        };
        let state = match (degree, &limits) {
            (Some(degree), _) => CurveStatus::or_lifted(CurvingState::new(case, degree, here))?,
            (None, Err(status)) => Err(*status),
            (None, Ok(limits)) => Ok(CurvingState::new(case, limits.degree(), here)?),
        };
        let (largest, steps) = BOUNDARY;
        let boundary = (0..=steps).map(|i| {
            let angle = (largest * i as f64 / steps as f64).to_radians();
            Ok((
                angle,
                CurveStatus::or_lifted(CurvingLimits::new(case, angle))?,
            ))
        });
        Ok(Self {
            shown,
            degree,
            cant_deficiency: here,
            state,
            limits,
            boundary: boundary.collect::<Result<_, _>>()?,
        })
    }

    /// Whether the model covers what is shown.
    pub fn status(&self) -> CurveStatus {
        match &self.state {
            Ok(state) => state.status,
            Err(status) => *status,
        }
    }

    /// The vehicle where the model covers it: what forces and strokes are read from.
    fn covered(&self) -> Option<&CurvingState> {
        let state = self.state.as_ref().ok();
        state.filter(|state| state.status == CurveStatus::WithinModel)
    }

    /// As JSON. Where the model does not cover the curve, forces and strokes are null, and `status` says
    /// why; where a wheel is lifted, displacements too.
    pub fn json(&self, name: &str, case: &Case) -> Value {
        let status = self.status();
        let mut object = json!({
            "name": name,
            "speed_m_per_s": case.service.speed,
            "curve_shown": self.shown.to_string(),
            "degree_curve_deg": self.degree,
            "radius_m": self.degree.map(|degree| 1.0 / curvature_of_degree(degree)),
            "cant_deficiency_rad": self.cant_deficiency,
            "status": status.code(),
            "limits": limits(self.cant_deficiency, &self.limits),
            "performance_boundary": self
                .boundary
                .iter()
                .map(|(angle, found)| limits(*angle, found))
                .collect::<Vec<_>>(),
        });
        if let Some((limit, ratio)) = status.exceeded() {
            object["limit"] = json!(limit.to_string());
            object["ratio"] = json!(ratio);
        }
        let motion = |of: fn(&CurvingState) -> Value| self.state.as_ref().map_or(Value::Null, of);
        let force = |of: fn(&CurvingState) -> Value| self.covered().map_or(Value::Null, of);
        for (key, value) in [
            ("wheelset_lateral_m", motion(|s| json!(s.wheelset_lateral))),
            ("wheelset_yaw_rad", motion(|s| json!(s.wheelset_yaw))),
            ("truck_lateral_m", motion(|s| json!(s.truck_lateral))),
            ("truck_yaw_rad", motion(|s| json!(s.truck_yaw))),
            ("carbody_lateral_m", motion(|s| json!(s.carbody[0]))),
            ("carbody_yaw_rad", motion(|s| json!(s.carbody[1]))),
            ("carbody_roll_rad", motion(|s| json!(s.carbody[2]))),
            (
                "primary_lateral_stroke_m",
                force(|s| json!(s.primary_lateral_stroke)),
            ),
            (
                "primary_longitudinal_stroke_m",
                force(|s| json!(s.primary_longitudinal_stroke)),
            ),
            (
                "secondary_lateral_stroke_m",
                force(|s| json!(s.secondary_lateral_stroke)),
            ),
            (
                "secondary_yaw_torque_n_m",
                force(|s| json!(s.secondary_yaw_torque)),
            ),
            (
                "secondary_yaw_state",
                force(|s| json!(s.breakaway.map(breakaway))),
            ),
            (
                "wheels_outer_inner",
                force(|s| json!(s.wheels.map(|wheels| wheels.map(|w| wheel(&w))))),
            ),
            (
                "largest_wheel_l_over_v",
                force(|s| json!(s.wheel_lateral_to_vertical())),
            ),
            (
                "largest_truck_side_l_over_v",
                force(|s| json!(s.truck_side_lateral_to_vertical())),
            ),
            (
                "largest_net_axle_l_over_v",
                force(|s| json!(s.net_axle_lateral_to_vertical())),
            ),
        ] {
            object[key] = value;
        }
        object
    }
}

fn breakaway(state: Breakaway) -> &'static str {
    match state {
        Breakaway::Stuck => "stuck",
        Breakaway::SlippingPositive => "slipping +",
        Breakaway::SlippingNegative => "slipping −",
    }
}

fn wheel(w: &WheelForces) -> Value {
    json!({
        "longitudinal_creep_force_n": w.longitudinal_creep,
        "lateral_creep_force_n": w.lateral_creep,
        "lateral_force_n": w.lateral,
        "vertical_force_n": w.vertical,
        "adhesion_used": w.adhesion_used,
        "l_over_v": w.lateral_to_vertical(),
    })
}

fn limits(cant_deficiency: f64, found: &Result<CurvingLimits, CurveStatus>) -> Value {
    let limited = |l: Option<LimitedCurve>| {
        l.map(|l| {
            json!({
                "degree_curve_deg": l.degree,
                "limit": l.limit.to_string(),
                "other_wheel_adhesion_left": l.other_wheel_reserve,
            })
        })
    };
    json!({
        "cant_deficiency_rad": cant_deficiency,
        "status": found.as_ref().map_or_else(|status| status.code(), |_| "solved"),
        "flange": found.as_ref().ok().map(|l| limited(l.flange)),
        "slip": found.as_ref().ok().map(|l| limited(l.slip)),
    })
}
