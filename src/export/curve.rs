//! `bogie curve`: the vehicle in a curve, its limits, and the performance boundary.

use serde_json::{Value, json};

use super::{
    evaluation_text::title,
    number::{both, significant},
    sheet::Sheet,
};
use crate::{
    case::Case,
    dynamics::curving::{Breakaway, CurvingError, WheelForces},
    evaluate::curving::{CurvingLimits, CurvingState, LimitedCurve},
    track::{SUPERELEVATION_BASE, curvature_of_degree, fra_speed_limit},
    units::Quantity,
};

/// What `bogie curve` shows.
#[derive(Debug, Clone)]
pub struct Curving {
    /// The vehicle in one curve.
    pub state: CurvingState,
    /// Limits at the same cant deficiency.
    pub limits: CurvingLimits,
    /// Limits at other cant deficiencies: the boundary of Figure 4.5.5.
    pub boundary: Vec<CurvingLimits>,
}

/// Largest cant deficiency of the boundary, degrees, and its steps.
const BOUNDARY: (f64, usize) = (6.0, 24);

impl Curving {
    /// A case in a curve of `degree` degrees (default: the governing limit's) at a cant deficiency
    /// φ_d, rad.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady-state solution.
    pub fn new(
        case: &Case,
        degree: Option<f64>,
        cant_deficiency: f64,
    ) -> Result<Self, CurvingError> {
        let limits = CurvingLimits::new(case, cant_deficiency)?;
        let degree = degree.unwrap_or_else(|| limits.degree());
        let (largest, steps) = BOUNDARY;
        let boundary = (0..=steps)
            .map(|i| CurvingLimits::new(case, (largest * i as f64 / steps as f64).to_radians()))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            state: CurvingState::new(case, degree, cant_deficiency)?,
            limits,
            boundary,
        })
    }

    /// As text.
    pub fn text(&self, name: &str, case: &Case) -> String {
        let state = &self.state;
        let mut sheet = Sheet::new(&title(name, case));
        let radius = both(Quantity::Length, 1.0 / curvature_of_degree(state.degree));
        let inches = state.cant_deficiency * SUPERELEVATION_BASE / 0.0254;
        sheet.heading(&format!(
            "Steady curve to the right, D = {}° (R {}, {}), cant deficiency {}° ({} in)",
            significant(state.degree, 4),
            radius[0],
            radius[1],
            significant(state.cant_deficiency.to_degrees(), 3),
            significant(inches, 3),
        ));
        let limit = fra_speed_limit(6.0 * 0.0254, 3.0 * 0.0254, state.degree);
        let [si, us] = both(Quantity::Speed, limit);
        sheet.line(&format!(
            "FRA speed limit with 6 in superelevation and 3 in unbalance: {si} ({us})"
        ));
        self.motion(&mut sheet);
        self.wheels(&mut sheet);
        self.trucks(&mut sheet);
        sheet.heading("Performance boundary: first limit met as the curve tightens");
        let rows: Vec<Vec<String>> = self.boundary.iter().map(boundary_row).collect();
        sheet.table(
            &[
                "cant deficiency °",
                "in",
                "flange °",
                "wheelset",
                "slip °",
                "wheel",
                "left at other wheel %",
            ],
            &[3, 5],
            &rows,
        );
        sheet.finish()
    }

    fn motion(&self, sheet: &mut Sheet) {
        let state = &self.state;
        let mm = |x: f64| significant(1e3 * x, 4);
        let inch = |x: f64| significant(x / 0.0254, 3);
        let mrad = |x: f64| significant(1e3 * x, 4);
        let rows: Vec<Vec<String>> = (0..4)
            .map(|i| {
                vec![
                    format!("wheelset {}", i + 1),
                    mm(state.wheelset_lateral[i]),
                    inch(state.wheelset_lateral[i]),
                    mrad(state.wheelset_yaw[i]),
                    mm(state.primary_lateral_stroke[i]),
                    mm(state.primary_longitudinal_stroke[i]),
                ]
            })
            .collect();
        sheet.table(
            &[
                "",
                "y mm",
                "y in",
                "yaw mrad",
                "primary lateral mm",
                "longitudinal mm",
            ],
            &[],
            &rows,
        );
    }

    fn wheels(&self, sheet: &mut Sheet) {
        let kn = |x: f64| significant(x / 1e3, 4);
        let mut rows = Vec::new();
        for (i, wheels) in self.state.wheels.iter().enumerate() {
            for (side, w) in ["outer", "inner"].into_iter().zip(wheels) {
                rows.push(vec![
                    format!("wheelset {} {side}", i + 1),
                    kn(w.longitudinal_creep),
                    kn(w.lateral_creep),
                    significant(100.0 * w.adhesion_used, 3),
                    kn(w.vertical),
                    significant(w.lateral_to_vertical(), 3),
                ]);
            }
        }
        sheet.table(
            &["", "F_x kN", "F_y kN", "% of μN", "V kN", "L/V"],
            &[],
            &rows,
        );
    }

    fn trucks(&self, sheet: &mut Sheet) {
        let state = &self.state;
        let rows: Vec<Vec<String>> = (0..2)
            .map(|j| {
                let stroke = both(Quantity::Stroke, state.secondary_lateral_stroke[j]);
                let torque = both(Quantity::Torque, state.secondary_yaw_torque[j]);
                vec![
                    format!("truck {}", j + 1),
                    stroke[0].clone(),
                    stroke[1].clone(),
                    torque[0].clone(),
                    torque[1].clone(),
                    breakaway(state.breakaway[j]).into(),
                ]
            })
            .collect();
        sheet.table(
            &[
                "",
                "secondary lateral stroke",
                "",
                "yaw torque on truck",
                "",
                "yaw element",
            ],
            &[5],
            &rows,
        );
        sheet.line(&format!(
            "largest L/V: wheel {}, truck side {}, net axle {}",
            significant(state.wheel_lateral_to_vertical(), 3),
            significant(state.truck_side_lateral_to_vertical(), 3),
            significant(state.net_axle_lateral_to_vertical(), 3),
        ));
    }

    /// As JSON.
    pub fn json(&self, name: &str, case: &Case) -> Value {
        let s = &self.state;
        json!({
            "name": name,
            "speed_m_per_s": case.service.speed,
            "degree_curve_deg": s.degree,
            "radius_m": 1.0 / curvature_of_degree(s.degree),
            "cant_deficiency_rad": s.cant_deficiency,
            "wheelset_lateral_m": s.wheelset_lateral,
            "wheelset_yaw_rad": s.wheelset_yaw,
            "truck_lateral_m": s.truck_lateral,
            "truck_yaw_rad": s.truck_yaw,
            "carbody_lateral_m": s.carbody[0],
            "carbody_yaw_rad": s.carbody[1],
            "carbody_roll_rad": s.carbody[2],
            "primary_lateral_stroke_m": s.primary_lateral_stroke,
            "primary_longitudinal_stroke_m": s.primary_longitudinal_stroke,
            "secondary_lateral_stroke_m": s.secondary_lateral_stroke,
            "secondary_yaw_torque_n_m": s.secondary_yaw_torque,
            "secondary_yaw_state": s.breakaway.map(breakaway),
            "wheels_outer_inner": s.wheels.map(|wheels| wheels.map(|w| wheel(&w))),
            "largest_wheel_l_over_v": s.wheel_lateral_to_vertical(),
            "largest_truck_side_l_over_v": s.truck_side_lateral_to_vertical(),
            "largest_net_axle_l_over_v": s.net_axle_lateral_to_vertical(),
            "limits": limits(&self.limits),
            "performance_boundary": self.boundary.iter().map(limits).collect::<Vec<_>>(),
        })
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

fn limits(l: &CurvingLimits) -> Value {
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
        "cant_deficiency_rad": l.cant_deficiency,
        "flange": limited(l.flange),
        "slip": limited(l.slip),
    })
}

fn boundary_row(limits: &CurvingLimits) -> Vec<String> {
    let angle = limits.cant_deficiency;
    let mut row = vec![
        significant(angle.to_degrees(), 3),
        significant(angle * SUPERELEVATION_BASE / 0.0254, 3),
    ];
    let name = |l: &LimitedCurve| {
        let text = l.limit.to_string();
        text.rsplit("wheelset ")
            .next()
            .unwrap_or_default()
            .trim_end_matches(" wheel")
            .to_string()
    };
    match limits.flange {
        Some(l) => row.extend([significant(l.degree, 4), name(&l)]),
        None => row.extend(["> 25".into(), String::new()]),
    }
    match limits.slip {
        Some(l) => row.extend([
            significant(l.degree, 4),
            name(&l),
            significant(100.0 * l.other_wheel_reserve, 2),
        ]),
        None => row.extend(["> 25".into(), String::new(), String::new()]),
    }
    row
}
