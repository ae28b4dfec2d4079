//! A finished design as the page that a designer hands on.

use super::{
    certificate::{certificate, conflict, joint, margins},
    evaluation_text::{constraint_table, stability, title},
    freedom::freedom,
    sheet::Sheet,
    status,
    verdict::verdict,
};
use crate::{
    design::{
        explain::Bound,
        form::{Line, form},
        outcome::{DesignResult, Profile, StageResult},
        sensitivity::Sensitivity,
    },
    evaluate::{
        Evaluation,
        checks::checks,
        curving::CurvingLimits,
        ride::{LateralRide, VerticalRide},
    },
    parameter::TradeOff,
    spec::Spec,
    units::{
        Quantity,
        number::{both, signed_percent, significant},
    },
    vehicle::GRAVITY,
};

/// Everything that `bogie optimize` prints.
pub fn design(
    name: &str,
    result: &DesignResult,
    spec: &Spec,
    matters: Option<&Sensitivity>,
    warnings: &[String],
) -> String {
    let mut sheet = Sheet::new(&title(name, &result.case));
    for warning in warnings {
        sheet.line(&format!("warning: {warning}"));
    }
    verdict(&mut sheet, result);
    conflict(&mut sheet, result);
    for stage in &result.stages {
        trade_off(&mut sheet, stage);
    }
    joint(&mut sheet, result);
    freedom(&mut sheet, result, &spec.design);
    margins(&mut sheet, result);
    performance(&mut sheet, result);
    stability(&mut sheet, &result.evaluation);
    constraint_table(&mut sheet, &checks(&result.case, &result.evaluation));
    if let Some(matters) = matters {
        sheet.heading(
            "What matters: change as an input goes from 10 % below the design to 10 % above",
        );
        let rows = super::sensitivity::summary(matters, MATTERS);
        sheet.table(&[], &[1], &rows);
    }
    sheet.heading("Design form (Table 4.6.1)");
    let rows: Vec<Vec<String>> = form(result, &spec.demands).iter().map(form_row).collect();
    sheet.table(&["step", "", "", "SI", "US"], &[1, 2], &rows);
    let failed = match result.effort.failed() {
        0 => String::new(),
        n => format!(", {n} of them without a result"),
    };
    sheet.heading(&format!(
        "{} full-model evaluations{failed}, {} s",
        result.effort.evaluations,
        significant(result.effort.seconds, 2)
    ));
    sheet.finish()
}

/// Inputs named per index.
pub(crate) const MATTERS: usize = 6;

/// Name of a trade-off as a heading.
pub(crate) fn stage_name(trade_off: Option<TradeOff>) -> String {
    let mut name = trade_off.map_or_else(|| "all at once".into(), |t| t.to_string());
    if let Some(first) = name.get_mut(0..1) {
        first.make_ascii_uppercase();
    }
    name
}

pub(crate) fn trade_off(sheet: &mut Sheet, stage: &StageResult) {
    let explained = &stage.explained;
    sheet.heading(&format!(
        "{}: {}",
        stage_name(stage.trade_off),
        explained.goal
    ));
    let rows: Vec<Vec<String>> = explained
        .chosen
        .iter()
        .map(|chosen| {
            let [si, us] = both(chosen.variable.quantity, chosen.value);
            let note = match chosen.at_bound {
                Some(Bound::Lower) => "at its lower bound",
                Some(Bound::Upper) => "at its upper bound",
                None => "",
            };
            let slope = match explained.gain_per_share(chosen) {
                Some(gain) => format!("1 % more: {}", signed_percent(gain)),
                None => String::new(),
            };
            vec![
                chosen.variable.name.to_string(),
                chosen.variable.symbol.to_string(),
                si,
                us,
                slope,
                note.into(),
            ]
        })
        .collect();
    sheet.table(&[], &[1, 5], &rows);
    if !explained.active.is_empty() {
        sheet.line(&format!("held back by: {}", explained.active.join("; ")));
    }
    unused(sheet, stage);
    // With nothing to choose there is nothing to certify.
    if !explained.chosen.is_empty() || stage.unused.is_empty() {
        certificate(sheet, explained);
    }
    if !stage.profiles.is_empty() {
        let rows: Vec<Vec<String>> = stage.profiles.iter().map(profile_row).collect();
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

/// Open parameters without influence.
fn unused(sheet: &mut Sheet, stage: &StageResult) {
    if !stage.unused.is_empty() {
        let names = stage
            .unused
            .iter()
            .map(|p| format!("{} ({})", p.words(), p.symbol()));
        let names: Vec<String> = names.collect();
        sheet.line(&format!(
            "without influence here, left as given: {}",
            names.join(", ")
        ));
    }
}

fn profile_row(profile: &Profile) -> Vec<String> {
    let us = |quantity, si| both(quantity, si)[1].clone();
    let speed = profile.critical_speed;
    vec![
        significant(profile.conicity, 3),
        speed.map_or("none in range".into(), |v| us(Quantity::Speed, v)),
        format!("{}°", significant(profile.degree, 4)),
        us(Quantity::RotationalStiffness, profile.bending_stiffness),
        us(Quantity::Stiffness, profile.lateral_stiffness),
        status::words(profile.status),
    ]
}

fn performance(sheet: &mut Sheet, result: &DesignResult) {
    sheet.heading("Performance (Table 4.7.1)");
    let mut header = vec!["", "", "as given", "designed", "at half Kalker"];
    header.extend(result.conditions.iter().map(|c| c.name.as_str()));
    sheet.table(&header, &[1], &performance_rows(result));
}

/// Rows of Table 4.7.1: what, unit, as given, designed, at half Kalker, and in every condition.
pub(crate) fn performance_rows(result: &DesignResult) -> Vec<Vec<String>> {
    let mut columns = vec![&result.before, &result.evaluation, &result.half_kalker];
    columns.extend(result.conditions.iter().map(|c| &c.evaluation));
    let line = |name: &str, unit: &str, of: &dyn Fn(&Evaluation) -> Option<f64>, factor: f64| {
        let mut row = vec![name.to_string(), unit.to_string()];
        row.extend(
            columns
                .iter()
                .map(|e| of(e).map_or("–".into(), |v| significant(v / factor, 4))),
        );
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
        &|e| e.curving.as_ref().ok().map(CurvingLimits::degree),
        1.0,
    ));
    rows.push(line(
        "kinematic mode damping ratio",
        "",
        &|e| e.modes.kinematic.as_ref().map(|m| m.damping_ratio),
        1.0,
    ));
    for (unit, factor) in [("in", inch), ("mm", 1e-3)] {
        rows.push(line(
            "RMS primary stroke, wheelset 4",
            unit,
            &|e| e.lateral.as_ref().ok().map(|r| r.primary_stroke[3]),
            factor,
        ));
        rows.push(line(
            "RMS wheelset excursion, wheelset 1",
            unit,
            &|e| e.lateral.as_ref().ok().map(|r| r.excursion[0]),
            factor,
        ));
        rows.push(line(
            "RMS secondary lateral stroke",
            unit,
            &|e| e.lateral.as_ref().ok().map(LateralRide::average_stroke),
            factor,
        ));
        rows.push(line(
            "RMS secondary vertical stroke",
            unit,
            &|e| e.vertical.as_ref().ok().map(VerticalRide::average_stroke),
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
                    .ok()
                    .map(LateralRide::average_acceleration)
            },
            factor,
        ));
        rows.push(line(
            "RMS vertical acceleration",
            unit,
            &|e| {
                e.vertical
                    .as_ref()
                    .ok()
                    .map(VerticalRide::average_acceleration)
            },
            factor,
        ));
    }
    rows
}

/// Step, entry, symbol, SI, US.
pub(crate) fn form_row(line: &Line) -> Vec<String> {
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
