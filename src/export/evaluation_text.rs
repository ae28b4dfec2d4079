//! An evaluation as a page that a designer reads at a glance.

use super::sheet::Sheet;
use crate::{
    case::Case,
    evaluate::{
        Evaluation,
        checks::{Check, Verdict, checks},
        curving::LimitedCurve,
        modes::LateralShape,
        ride::{PassengerRide, average},
        stability::{Hunting, Outcome},
    },
    track::curvature_of_degree,
    units::{
        Quantity,
        number::{both, significant},
    },
};

/// Everything that `bogie evaluate` prints.
pub fn evaluation(name: &str, case: &Case, evaluation: &Evaluation, warnings: &[String]) -> String {
    let mut sheet = Sheet::new(&title(name, case));
    for warning in warnings {
        sheet.line(&format!("warning: {warning}"));
    }
    stability(&mut sheet, evaluation);
    curving(&mut sheet, evaluation);
    ride(&mut sheet, evaluation);
    constraint_table(&mut sheet, &checks(case, evaluation));
    super::cross_checks::table(&mut sheet, case, evaluation);
    sheet.finish()
}

pub(crate) fn title(name: &str, case: &Case) -> String {
    let [si, us] = both(Quantity::Speed, case.service.speed);
    format!(
        "{name} at {si} ({us}) on {}, conicity {}",
        case.service.track.name,
        significant(case.wheel_rail.conicity, 3)
    )
}

pub(crate) fn stability(sheet: &mut Sheet, evaluation: &Evaluation) {
    sheet.heading("Stability");
    let mut rows = Vec::new();
    let found = &evaluation.stability;
    let speed = |v: f64| both(Quantity::Speed, v);
    let range = format!(
        "{} to {}",
        speed(found.range[0])[1],
        speed(found.range[1])[1]
    );
    if found.outcome() == Outcome::Diverges {
        rows.push(row(
            "critical speed",
            ["none".into(), String::new()],
            &Outcome::Diverges.to_string(),
        ));
    } else if found.unstable_at_start {
        let [si, us] = speed(found.range[0]);
        rows.push(row(
            "critical speed",
            [format!("below {si}"), format!("below {us}")],
            "hunts at every speed searched",
        ));
    } else if found.onsets.is_empty() {
        let note = format!("stable over the whole range searched, {range}");
        rows.push(row("critical speed", ["none".into(), String::new()], &note));
    }
    for kind in [Hunting::Truck, Hunting::Carbody] {
        if let Some(onset) = found.onset(kind) {
            let lowest = found.onsets.first().is_some_and(|o| o.kind == kind);
            let name = if lowest && found.critical_speed() == Some(onset.speed) {
                "critical speed"
            } else {
                "also"
            };
            let note = format!("{kind} at {} Hz", significant(onset.frequency, 3));
            rows.push(row(name, speed(onset.speed), &note));
        }
    }
    if let Some(v) = found.divergence {
        rows.push(row("divergence", speed(v), "at every speed"));
    }
    let mode = |frequency: f64, damping_ratio: f64| {
        [
            format!("{} Hz", significant(frequency, 4)),
            format!("ζ {}", significant(damping_ratio, 3)),
        ]
    };
    if let Some(kinematic) = &evaluation.modes.kinematic {
        let values = mode(kinematic.frequency, kinematic.damping_ratio);
        let note = format!("{}, carbody at rest", LateralShape::Kinematic);
        rows.push(row("kinematic mode", values, &note));
    }
    if let Some(least) = evaluation.modes.least_damped() {
        let values = mode(least.frequency, least.damping_ratio);
        rows.push(row("least-damped mode", values, &least.shape.to_string()));
    }
    sheet.table(&[], &[3], &rows);
}

pub(crate) fn curving(sheet: &mut Sheet, evaluation: &Evaluation) {
    sheet.heading("Curving at zero cant deficiency");
    let limits = match &evaluation.curving {
        Ok(limits) => limits,
        Err(error) => return sheet.line(&error.to_string()),
    };
    let line = |name: &str, limited: Option<LimitedCurve>| match limited {
        Some(limited) => {
            let radius = 1.0 / curvature_of_degree(limited.degree);
            let [si, us] = both(Quantity::Length, radius);
            vec![
                name.into(),
                format!("{}°", significant(limited.degree, 4)),
                format!("R {si}"),
                format!("R {us}"),
                limited.limit.to_string(),
            ]
        }
        None => vec![
            name.into(),
            "none".into(),
            String::new(),
            String::new(),
            "up to 25°".into(),
        ],
    };
    let rows = [
        line("flange-limited curve", limits.flange),
        line("slip-limited curve", limits.slip),
    ];
    sheet.table(&[], &[4], &rows);
}

pub(crate) fn ride(sheet: &mut Sheet, evaluation: &Evaluation) {
    sheet.heading("Lateral ride, RMS");
    match &evaluation.lateral {
        Err(reason) => sheet.line(&format!("none: {reason}")),
        Ok(ride) => {
            if let Some(points) = &evaluation.lateral_passengers {
                passengers(sheet, points, "W_d");
            }
            let rows = [
                strokes("secondary stroke, trucks 1, 2", &ride.secondary_stroke),
                strokes("primary stroke, wheelsets 1–4", &ride.primary_stroke),
                strokes("wheelset excursion, 1–4", &ride.excursion),
            ];
            sheet.table(&[], &[], &rows);
            sheet.line(&format!(
                "carbody roll acceleration {} rad/s²",
                significant(ride.roll_acceleration, 3)
            ));
        }
    }
    sheet.heading("Vertical ride, RMS");
    match &evaluation.vertical {
        Err(reason) => sheet.line(&format!("none: {reason}")),
        Ok(ride) => {
            if let Some(points) = &evaluation.vertical_passengers {
                passengers(sheet, points, "W_k");
            }
            let rows = [
                strokes("secondary stroke, trucks 1, 2", &ride.secondary_stroke),
                strokes("primary stroke, wheelsets 1–4", &ride.primary_stroke),
            ];
            sheet.table(&[], &[], &rows);
            let load = average(&ride.wheel_load);
            let [si, us] = both(Quantity::Force, load);
            sheet.line(&format!(
                "wheel load variation {si} ({us}), mean of wheelsets 1–4"
            ));
        }
    }
}

fn passengers(sheet: &mut Sheet, points: &[PassengerRide; 3], weighting: &str) {
    let line = |name: &str, unit: &str, value: &dyn Fn(&PassengerRide) -> f64, factor: f64| {
        let values = points.each_ref().map(|p| value(p) / factor);
        let mut cells = vec![name.to_string()];
        cells.extend(values.iter().map(|v| significant(*v, 4)));
        cells.push(significant(average(&values), 4));
        cells.push(unit.into());
        cells
    };
    let rows = [
        line("acceleration", "m/s²", &|p| p.acceleration, 1.0),
        line("", "g", &|p| p.acceleration, crate::vehicle::GRAVITY),
        line(
            &format!("ISO 2631-1, {weighting}"),
            "m/s²",
            &|p| p.iso_weighted,
            1.0,
        ),
        line(
            &format!(
                "EN 12299, {}",
                if weighting == "W_k" { "W_b" } else { "W_d" }
            ),
            "m/s²",
            &|p| p.en_weighted,
            1.0,
        ),
        line("Sperling W_z", "", &|p| p.w_z, 1.0),
        line(
            "of ISO 2631 1 h reduced comfort",
            "",
            &|p| p.boundary_ratio().map_or(f64::NAN, |r| r.0),
            1.0,
        ),
    ];
    sheet.table(&["", "c.g.", "front", "rear", "mean", ""], &[5], &rows);
}

fn strokes(name: &str, rms: &[f64]) -> Vec<String> {
    let mut cells = vec![name.to_string()];
    for unit in [Quantity::Stroke.si(), Quantity::Stroke.us()] {
        let values: Vec<String> = rms.iter().map(|v| significant(unit.of(*v), 3)).collect();
        cells.push(format!("{} {}", values.join("  "), unit.label));
    }
    cells
}

pub(crate) fn constraint_table(sheet: &mut Sheet, checks: &[Check]) {
    sheet.heading("Constraints (nominal limits of 3.3, 3.5.3 and 4.3)");
    let rows: Vec<Vec<String>> = checks.iter().map(check_row).collect();
    sheet.table(&[], &[1, 6], &rows);
}

/// Verdict, name, value (or why there is none) and limit in SI, value and limit in US units, section of the report.
pub(crate) fn check_row(check: &Check) -> Vec<String> {
    let [si, us] = match check.value {
        Ok(value) => both(check.quantity, value),
        Err(status) => [status.code().into(), String::new()],
    };
    let [si_limit, us_limit] = both(check.quantity, check.limit);
    let sign = if check.at_least { "≥" } else { "≤" };
    let limit_us = if us_limit.is_empty() {
        us_limit
    } else {
        format!("{sign} {us_limit}")
    };
    vec![
        match check.verdict() {
            Verdict::Exceeded => "EXCEEDED".into(),
            verdict => verdict.code().into(),
        },
        check.name.clone(),
        si,
        format!("{sign} {si_limit}"),
        us,
        limit_us,
        check.source.to_string(),
    ]
}

fn row(name: &str, [si, us]: [String; 2], note: &str) -> Vec<String> {
    vec![name.into(), si, us, note.into()]
}
