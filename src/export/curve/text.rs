//! Result of `bogie curve` as text.

use super::{Curving, breakaway};
use crate::{
    case::Case,
    dynamics::curving::Side,
    evaluate::curving::{CurveStatus, CurvingLimits, CurvingState, LimitedCurve},
    export::{evaluation_text::title, sheet::Sheet},
    track::{SUPERELEVATION_BASE, curvature_of_degree, fra_speed_limit},
    units::{
        Quantity,
        number::{both, significant},
    },
};

impl Curving {
    /// As text.
    pub fn text(&self, name: &str, case: &Case) -> String {
        let mut sheet = Sheet::new(&title(name, case));
        self.head(&mut sheet);
        match (&self.state, self.covered()) {
            (Err(_), _) => {}
            (Ok(state), None) => {
                sheet.heading("Displacements by linear extrapolation, without forces and strokes");
                motion(&mut sheet, state, None);
            }
            (Ok(state), Some(_)) => {
                motion(&mut sheet, state, Some(state));
                wheels(&mut sheet, state);
                trucks(&mut sheet, state);
            }
        }
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

    /// Which curve, and whether the model covers it.
    fn head(&self, sheet: &mut Sheet) {
        let inches = self.cant_deficiency * SUPERELEVATION_BASE / 0.0254;
        let cant_deficiency = format!(
            "cant deficiency {}° ({} in)",
            significant(self.cant_deficiency.to_degrees(), 3),
            significant(inches, 3),
        );
        let shown = self.shown;
        if let Some(degree) = self.degree {
            let radius = both(Quantity::Length, 1.0 / curvature_of_degree(degree));
            sheet.heading(&format!(
                "Steady curve to the right, {shown}: D = {}° (R {}, {}), {cant_deficiency}",
                significant(degree, 4),
                radius[0],
                radius[1],
            ));
            let limit = fra_speed_limit(6.0 * 0.0254, 3.0 * 0.0254, degree);
            let [si, us] = both(Quantity::Speed, limit);
            sheet.line(&format!(
                "FRA speed limit with 6 in superelevation and 3 in unbalance: {si} ({us})"
            ));
        } else {
            sheet.heading(&format!(
                "Steady curve to the right, {shown}: none, {cant_deficiency}"
            ));
        }
        if self.covered().is_none() {
            sheet.line(&self.status().to_string());
        }
    }
}

/// Places of the wheelsets; strokes of `covered`, or the status in their place.
fn motion(sheet: &mut Sheet, state: &CurvingState, covered: Option<&CurvingState>) {
    let mm = |x: f64| significant(1e3 * x, 4);
    let inch = |x: f64| significant(x / 0.0254, 3);
    let stroke = |of: fn(&CurvingState) -> [f64; 4], i: usize| {
        covered.map_or_else(|| state.status.code().into(), |state| mm(of(state)[i]))
    };
    let rows: Vec<Vec<String>> = (0..4)
        .map(|i| {
            vec![
                format!("wheelset {}", i + 1),
                mm(state.wheelset_lateral[i]),
                inch(state.wheelset_lateral[i]),
                mm(state.wheelset_yaw[i]),
                stroke(|state| state.primary_lateral_stroke, i),
                stroke(|state| state.primary_longitudinal_stroke, i),
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

fn wheels(sheet: &mut Sheet, state: &CurvingState) {
    let kn = |x: f64| significant(x / 1e3, 4);
    let mut rows = Vec::new();
    for (i, wheels) in state.wheels.iter().enumerate() {
        for (side, w) in Side::BOTH.into_iter().zip(wheels) {
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

fn trucks(sheet: &mut Sheet, state: &CurvingState) {
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

fn boundary_row((angle, found): &(f64, Result<CurvingLimits, CurveStatus>)) -> Vec<String> {
    let mut row = vec![
        significant(angle.to_degrees(), 3),
        significant(angle * SUPERELEVATION_BASE / 0.0254, 3),
    ];
    let limits = match found {
        Ok(limits) => limits,
        Err(status) => {
            let code = status.code();
            row.extend([code, "", code, "", ""].map(str::to_owned));
            return row;
        }
    };
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
