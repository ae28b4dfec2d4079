//! A finished design as the page that a designer hands on.

use super::{
    evaluation_text::{constraint_table, stability, title},
    number::{both, significant},
    sheet::Sheet,
};
use crate::{
    design::{
        form::{Line, form},
        local::Status,
        outcome::{Bound, DesignResult, StageResult},
    },
    evaluate::{Evaluation, checks::checks},
    spec::{Limits, Requirements},
    units::Quantity,
    vehicle::GRAVITY,
};

/// Everything that `bogie optimize` prints.
pub fn design(
    name: &str,
    result: &DesignResult,
    requirements: &Requirements,
    limits: &Limits,
    warnings: &[String],
) -> String {
    let mut sheet = Sheet::new(&title(name, &result.case));
    for warning in warnings {
        sheet.line(&format!("warning: {warning}"));
    }
    verdict(&mut sheet, result);
    for stage in &result.stages {
        trade_off(&mut sheet, stage);
    }
    performance(&mut sheet, result);
    stability(&mut sheet, &result.evaluation);
    constraint_table(&mut sheet, &checks(&result.case, &result.evaluation));
    sheet.heading("Design form (Table 4.6.1)");
    let rows: Vec<Vec<String>> = form(result, requirements, limits)
        .iter()
        .map(form_row)
        .collect();
    sheet.table(&["step", "", "", "SI", "US"], &[1, 2], &rows);
    sheet.finish()
}

fn verdict(sheet: &mut Sheet, result: &DesignResult) {
    if result.unmet.is_empty() {
        sheet.heading("All requirements and limits are met.");
    } else {
        sheet.heading("Not everything can be met; this is the best compromise:");
        for unmet in &result.unmet {
            let value = |si: f64| {
                let [si, us] = both(unmet.quantity, si);
                if us.is_empty() {
                    si
                } else {
                    format!("{si} ({us})")
                }
            };
            let reached = unmet
                .reached
                .map_or_else(|| "none: unstable at the operating speed".into(), value);
            sheet.line(&format!(
                "{}: asked {}, reached {reached}",
                unmet.key,
                value(unmet.required)
            ));
        }
    }
    if !result.settled {
        sheet.line(&format!(
            "The coupling loop still changed the design after {} rounds.",
            result.rounds
        ));
    }
}

fn trade_off(sheet: &mut Sheet, stage: &StageResult) {
    let mut name = stage.stage.to_string();
    if let Some(first) = name.get_mut(0..1) {
        first.make_ascii_uppercase();
    }
    sheet.heading(&format!("{name}: {}", stage.goal));
    let rows: Vec<Vec<String>> = stage
        .chosen
        .iter()
        .map(|chosen| {
            let [si, us] = both(chosen.variable.quantity, chosen.value);
            let note = match chosen.at_bound {
                Some(Bound::Lower) => "at its lower bound",
                Some(Bound::Upper) => "at its upper bound",
                None => "",
            };
            vec![
                chosen.variable.name.to_string(),
                chosen.variable.symbol.to_string(),
                si,
                us,
                note.into(),
            ]
        })
        .collect();
    sheet.table(&[], &[1, 4], &rows);
    if !stage.active.is_empty() {
        sheet.line(&format!("held back by: {}", stage.active.join("; ")));
    }
    let failed = if stage.failed > 0 {
        format!(", {} without a result", stage.failed)
    } else {
        String::new()
    };
    sheet.line(&format!(
        "{}; {} evaluations{failed}; first-order residual {:.0e}",
        status(stage.status),
        stage.evaluations,
        stage.kkt_residual
    ));
    if !stage.alternatives.is_empty() {
        let rows: Vec<Vec<String>> = stage
            .alternatives
            .iter()
            .map(|a| {
                let speed = a
                    .critical_speed
                    .map_or("none".into(), |v| both(Quantity::Speed, v)[1].clone());
                vec![
                    significant(a.conicity, 3),
                    speed,
                    format!("{}°", significant(a.degree, 4)),
                    both(Quantity::RotationalStiffness, a.bending_stiffness)[1].clone(),
                    both(Quantity::Stiffness, a.lateral_stiffness)[1].clone(),
                    status(a.status).into(),
                ]
            })
            .collect();
        sheet.table(
            &[
                "conicity",
                "critical speed",
                "degree curve",
                "K_b",
                "K_py",
                "",
            ],
            &[5],
            &rows,
        );
    }
}

pub(super) fn status(status: Status) -> &'static str {
    match status {
        Status::Optimal => "optimal",
        Status::Stalled => "feasible, but not converged to an optimum",
        Status::Infeasible => "requirement out of reach: least violation",
    }
}

/// The performance table of Table 4.7.1: as given, designed, and at half Kalker.
fn performance(sheet: &mut Sheet, result: &DesignResult) {
    sheet.heading("Performance (Table 4.7.1)");
    let columns = [&result.before, &result.evaluation, &result.half_kalker];
    let line = |name: &str, unit: &str, of: &dyn Fn(&Evaluation) -> Option<f64>, factor: f64| {
        let mut row = vec![name.to_string(), unit.to_string()];
        row.extend(columns.map(|e| of(e).map_or("–".into(), |v| significant(v / factor, 4))));
        row
    };
    let mph = Quantity::Speed.us().factor;
    let kmh = Quantity::Speed.si().factor;
    let inch = Quantity::Stroke.us().factor;
    let mut rows = Vec::new();
    for (unit, factor) in [("mph", mph), ("km/h", kmh)] {
        rows.push(line(
            "critical speed",
            unit,
            &|e| e.stability.critical_speed(),
            factor,
        ));
    }
    rows.push(line(
        "degree curve",
        "°",
        &|e| {
            e.curving
                .as_ref()
                .ok()
                .map(super::super::evaluate::curving::CurvingLimits::degree)
        },
        1.0,
    ));
    rows.push(line(
        "kinematic mode damping ratio",
        "",
        &|e| e.modes.kinematic().map(|m| m.damping_ratio),
        1.0,
    ));
    for (unit, factor) in [("in", inch), ("mm", 1e-3)] {
        rows.push(line(
            "RMS primary stroke, wheelset 4",
            unit,
            &|e| e.lateral.as_ref().map(|r| r.primary_stroke[3]),
            factor,
        ));
        rows.push(line(
            "RMS wheelset excursion, wheelset 1",
            unit,
            &|e| e.lateral.as_ref().map(|r| r.excursion[0]),
            factor,
        ));
        rows.push(line(
            "RMS secondary lateral stroke",
            unit,
            &|e| {
                e.lateral
                    .as_ref()
                    .map(super::super::evaluate::ride::LateralRide::average_stroke)
            },
            factor,
        ));
        rows.push(line(
            "RMS secondary vertical stroke",
            unit,
            &|e| {
                e.vertical
                    .as_ref()
                    .map(super::super::evaluate::ride::VerticalRide::average_stroke)
            },
            factor,
        ));
    }
    for (unit, factor) in [("g", GRAVITY), ("m/s²", 1.0)] {
        rows.push(line(
            "RMS lateral acceleration",
            unit,
            &|e| {
                e.lateral
                    .as_ref()
                    .map(super::super::evaluate::ride::LateralRide::average_acceleration)
            },
            factor,
        ));
        rows.push(line(
            "RMS vertical acceleration",
            unit,
            &|e| {
                e.vertical
                    .as_ref()
                    .map(super::super::evaluate::ride::VerticalRide::average_acceleration)
            },
            factor,
        ));
    }
    sheet.table(
        &["", "", "as given", "designed", "at half Kalker"],
        &[1],
        &rows,
    );
}

fn form_row(line: &Line) -> Vec<String> {
    let [si, us] = line
        .value
        .map_or(["–".into(), String::new()], |v| both(line.quantity, v));
    vec![
        line.step.into(),
        line.text.into(),
        line.symbol.into(),
        si,
        us,
    ]
}
