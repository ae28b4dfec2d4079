//! The commands that answer at once.

use std::ops::RangeInclusive;

use bogie::{
    export,
    run::{Answer, Run, Written},
    spec::{STARTER, Spec, schema},
    track::{MAX_DEGREE, SUPERELEVATION_BASE},
    units::Quantity,
};

use super::{
    Done, Failure,
    arguments::{self, Check, Curve, Format, Init, Modes, Psd, TableFormat},
    input, output,
};

/// A curve of over 1700 km radius is a straight.
const LEAST_DEGREE: f64 = 0.001;
/// Speeds, m/s, at which the damping can be listed: any at which an eigenvalue is one.
const SPEEDS: RangeInclusive<f64> = 1e-3..=1e4;

pub fn evaluate(call: &arguments::Run) -> Result<Done, Failure> {
    let input = input::read(&call.source.spec)?;
    deliver(call, "evaluate", Run::new(&input).evaluate())
}

pub fn modes(call: &Modes) -> Result<Done, Failure> {
    let input = input::read(&call.run.source.spec)?;
    let speeds = call.speeds.iter().map(|text| speed(text));
    let speeds = speeds.collect::<Result<Vec<_>, _>>()?;
    deliver(&call.run, "modes", Run::new(&input).modes(&speeds))
}

pub fn curve(call: &Curve) -> Result<Done, Failure> {
    let input = input::read(&call.run.source.spec)?;
    if let Some(degree) = call.degree
        && !(LEAST_DEGREE..=MAX_DEGREE).contains(&degree)
    {
        return Err(Failure::wrong(format_args!(
            "--degree {degree}: expected {LEAST_DEGREE} to {MAX_DEGREE}"
        )));
    }
    let cant_deficiency = call.cant_deficiency.as_deref().map(cant_deficiency);
    let curving = Run::new(&input).curve(call.degree, cant_deficiency.transpose()?);
    deliver(&call.run, "curve", curving)
}

pub fn psd(call: &Psd) -> Result<Done, Failure> {
    let input = input::read(&call.run.source.spec)?;
    let points = call.points as usize;
    let answer = Run::new(&input).spectra(points).map_err(Failure::failed)?;
    for (model, columns) in [
        ("lateral", &answer.result.lateral),
        ("vertical", &answer.result.vertical),
    ] {
        if let Err(reason) = columns {
            output::say(format_args!("no {model} spectra: {reason}"));
        }
    }
    let format = if call.csv {
        TableFormat::Csv
    } else {
        call.run.format.into()
    };
    output::deliver(&answer, "psd", format, call.run.out.as_deref())?;
    Ok(Done::Complete)
}

pub fn check(call: &Check) -> Result<Done, Failure> {
    let file = input::open(&call.source.spec)?;
    let read = Spec::read(&file.bytes);
    match call.format {
        Format::Json => {
            let report = export::check::json(&file.name, &file.text(), &read);
            output::print(output::json(&report)?)?;
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
    output::print(output::json(&schema::schema())?)?;
    Ok(Done::Complete)
}

pub fn init(call: &Init) -> Result<Done, Failure> {
    if call.spec.as_os_str() == "-" {
        output::print(STARTER)?;
        return Ok(Done::Complete);
    }
    if call.spec.exists() {
        return Err(Failure::wrong(format_args!(
            "{} exists; name another file",
            call.spec.display()
        )));
    }
    export::file::write(&call.spec, STARTER)
        .map_err(|error| output::cannot_write(&call.spec, &error))?;
    output::say(format_args!("wrote {}", call.spec.display()));
    Ok(Done::Complete)
}

/// Writes the answer of a command that has one.
fn deliver<T: Written>(
    call: &arguments::Run,
    command: &str,
    answer: Result<Answer<T>, impl std::fmt::Display>,
) -> Result<Done, Failure> {
    let answer = answer.map_err(Failure::failed)?;
    output::deliver(&answer, command, call.format, call.out.as_deref())?;
    Ok(Done::Complete)
}

fn speed(text: &str) -> Result<f64, Failure> {
    let speed = Quantity::Speed.parse(text);
    let speed = speed.map_err(Failure::option("--speeds"))?;
    if SPEEDS.contains(&speed) {
        Ok(speed)
    } else {
        let (least, most) = (SPEEDS.start(), SPEEDS.end());
        Err(Failure::wrong(format_args!(
            "--speeds {text}: expected {least} m/s to {most} m/s"
        )))
    }
}

/// An angle, or a height over [`SUPERELEVATION_BASE`]; within 30° either way.
fn cant_deficiency(text: &str) -> Result<f64, Failure> {
    let option = format!("--cant-deficiency {text}");
    let wrong = Failure::option(&option);
    let angle = Quantity::Angle
        .parse(text)
        .or_else(|_| {
            Quantity::Length
                .parse(text)
                .map(|height| height / SUPERELEVATION_BASE)
        })
        .map_err(|_| wrong("expected an angle such as \"3 deg\" or a height such as \"3 in\""))?;
    if angle.abs() <= 30_f64.to_radians() {
        Ok(angle)
    } else {
        Err(wrong("beyond 30 degrees small angles no longer hold"))
    }
}
