//! One function per command.

use std::ops::RangeInclusive;

use bogie::{
    design::doubts::warnings,
    evaluate::Evaluation,
    export::{self, curve::Curving, evaluation_json, modes, origin::sign, psd::Spectra},
    spec::{STARTER, Spec, schema},
    track::{MAX_DEGREE, SUPERELEVATION_BASE},
    units::Quantity,
};
use serde_json::{Value, json};

use super::{
    Done, Failure,
    arguments::{Check, Curve, Format, Init, Modes, Psd, Run},
    input, output,
};

/// A curve of over 1700 km radius is a straight.
const LEAST_DEGREE: f64 = 0.001;
/// Speeds, m/s, at which the damping can be listed: any at which an eigenvalue is one.
const SPEEDS: RangeInclusive<f64> = 1e-3..=1e4;

pub fn evaluate(run: &Run) -> Result<Done, Failure> {
    let input::Named {
        name,
        spec,
        digest,
        warnings: doubts,
        ..
    } = input::read(&run.source.spec)?;
    let evaluation = Evaluation::new(&spec.case).map_err(failed)?;
    let warnings = warnings(&spec.case, &evaluation, &spec.demands);
    deliver(
        run,
        "evaluate",
        || export::evaluation(&name, &spec.case, &evaluation, &warnings),
        || {
            let all = together(&doubts, &warnings);
            let result = evaluation_json::evaluation(&name, &spec.case, &evaluation, &all);
            with_origin(result, &digest, &all)
        },
    )?;
    Ok(Done::Complete)
}

pub fn modes(call: &Modes) -> Result<Done, Failure> {
    let input::Named {
        name,
        spec,
        digest,
        warnings,
        ..
    } = input::read(&call.run.source.spec)?;
    let speeds = if call.speeds.is_empty() {
        (1..=10)
            .map(|i| 0.2 * f64::from(i) * spec.case.service.speed)
            .collect()
    } else {
        call.speeds
            .iter()
            .map(|text| speed(text))
            .collect::<Result<Vec<_>, _>>()?
    };
    let modes = modes::Modes::new(&spec.case, &speeds).map_err(failed)?;
    deliver(
        &call.run,
        "modes",
        || modes.text(&name, &spec.case),
        || with_origin(modes.json(&name, &spec.case), &digest, &warnings),
    )?;
    Ok(Done::Complete)
}

pub fn curve(call: &Curve) -> Result<Done, Failure> {
    let input::Named {
        name,
        spec,
        digest,
        warnings,
        ..
    } = input::read(&call.run.source.spec)?;
    if let Some(degree) = call.degree
        && !(LEAST_DEGREE..=MAX_DEGREE).contains(&degree)
    {
        return Err(wrong(&format!(
            "--degree {degree}: expected {LEAST_DEGREE} to {MAX_DEGREE}"
        )));
    }
    let cant_deficiency = call.cant_deficiency.as_deref().map(cant_deficiency);
    let cant_deficiency = cant_deficiency.transpose()?;
    let curving = Curving::new(&spec.case, call.degree, cant_deficiency).map_err(failed)?;
    deliver(
        &call.run,
        "curve",
        || curving.text(&name, &spec.case),
        || with_origin(curving.json(&name, &spec.case), &digest, &warnings),
    )?;
    Ok(Done::Complete)
}

pub fn psd(call: &Psd) -> Result<Done, Failure> {
    let input::Named {
        name,
        spec,
        digest,
        warnings,
        ..
    } = input::read(&call.run.source.spec)?;
    let spectra = Spectra::new(&spec.case, call.points as usize).map_err(failed)?;
    for (model, columns) in [
        ("lateral", &spectra.lateral),
        ("vertical", &spectra.vertical),
    ] {
        if let Err(reason) = columns {
            output::say(format_args!("no {model} spectra: {reason}"));
        }
    }
    if call.csv {
        output::write(spectra.csv(), call.run.out.as_deref(), "psd.csv")?;
        return Ok(Done::Complete);
    }
    deliver(
        &call.run,
        "psd",
        || spectra.text(&name, &spec.case),
        || with_origin(spectra.json(&name, &spec.case), &digest, &warnings),
    )?;
    Ok(Done::Complete)
}

pub fn check(call: &Check) -> Result<Done, Failure> {
    let file = input::open(&call.source.spec)?;
    let read = Spec::read(&file.bytes);
    match call.format {
        Format::Json => {
            let report = export::check::json(&file.name, &file.text(), &read);
            let text = serde_json::to_string_pretty(&report).map_err(failed)?;
            output::print(text + "\n")?;
        }
        Format::Text => {
            if let Ok(spec) = &read {
                file.show(&spec.doubts);
                output::print(export::check::text(&file.name, spec))?;
            }
        }
    }
    match read {
        Ok(_) => Ok(Done::Complete),
        Err(mistakes) => Err(file.refuse(&mistakes)),
    }
}

pub fn schema() -> Result<Done, Failure> {
    let text = serde_json::to_string_pretty(&schema::schema()).map_err(failed)?;
    output::print(text + "\n")?;
    Ok(Done::Complete)
}

pub fn init(call: &Init) -> Result<Done, Failure> {
    if call.spec.as_os_str() == "-" {
        output::print(STARTER)?;
        return Ok(Done::Complete);
    }
    if call.spec.exists() {
        return Err(wrong(&format!(
            "{} exists; name another file",
            call.spec.display()
        )));
    }
    export::file::write(&call.spec, STARTER)
        .map_err(|error| output::cannot_write(&call.spec, &error))?;
    output::say(format_args!("wrote {}", call.spec.display()));
    Ok(Done::Complete)
}

/// Doubts about a spec and about its evaluation; what both say stands once.
pub(super) fn together(doubts: &[String], warnings: &[String]) -> Vec<String> {
    let more = warnings.iter().filter(|text| !doubts.contains(text));
    doubts.iter().chain(more).cloned().collect()
}

/// A result with what it comes from and what is doubtful in its spec.
pub(super) fn with_origin(mut result: Value, digest: &str, warnings: &[String]) -> Value {
    if let Value::Object(object) = &mut result {
        sign(object);
        object.insert("spec_sha256".into(), json!(digest));
        object.insert("warnings".into(), json!(warnings));
    }
    result
}

pub(super) fn deliver(
    run: &Run,
    command: &str,
    text: impl FnOnce() -> String,
    json: impl FnOnce() -> Value,
) -> Result<(), Failure> {
    let (text, ending) = match run.format {
        Format::Text => (text(), "txt"),
        Format::Json => (
            serde_json::to_string_pretty(&json()).map_err(failed)? + "\n",
            "json",
        ),
    };
    output::write(&text, run.out.as_deref(), &format!("{command}.{ending}"))
}

pub(super) fn failed(error: impl std::fmt::Display) -> Failure {
    Failure::Failed(error.to_string())
}

pub(super) fn wrong(text: &str) -> Failure {
    Failure::Invalid(format!("error: {text}"))
}

fn speed(text: &str) -> Result<f64, Failure> {
    let speed = Quantity::Speed
        .parse(text)
        .map_err(|error| wrong(&format!("--speeds: {error}")))?;
    if SPEEDS.contains(&speed) {
        Ok(speed)
    } else {
        let (least, most) = (SPEEDS.start(), SPEEDS.end());
        Err(wrong(&format!(
            "--speeds {text}: expected {least} m/s to {most} m/s"
        )))
    }
}

/// An angle, or a height over [`SUPERELEVATION_BASE`]; within 30° either way.
fn cant_deficiency(text: &str) -> Result<f64, Failure> {
    let angle = Quantity::Angle
        .parse(text)
        .or_else(|_| Quantity::Length.parse(text).map(|height| height / SUPERELEVATION_BASE))
        .map_err(|_| wrong(&format!("--cant-deficiency {text}: expected an angle such as \"3 deg\" or a height such as \"3 in\"")))?;
    if angle.abs() <= 30_f64.to_radians() {
        Ok(angle)
    } else {
        Err(wrong(&format!(
            "--cant-deficiency {text}: beyond 30 degrees small angles no longer hold"
        )))
    }
}
