//! `bogie chart`: the report's design charts for the vehicle of a spec.

use std::{fmt::Write, path::Path};

use bogie::{
    chart::{self as book, BOOK, Entry, Workbook},
    export::{figure::tables, origin::sign},
    plot::{Drawing, Figure, System, Theme},
};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::{
    Done, Failure,
    arguments::{Chart, ChartFile, Format, Units},
    input, output,
    progress::Line,
};

/// A file that is ready to be written.
struct File {
    name: String,
    content: Vec<u8>,
}

pub fn chart(call: &Chart) -> Result<Done, Failure> {
    let Some(path) = call.spec.as_deref().filter(|_| !call.list) else {
        output::print(list(call.format)?)?;
        return Ok(Done::Complete);
    };
    let input = input::read(path)?;
    let entries = wanted(call)?;
    let system = match call.units {
        Units::Us => System::Us,
        Units::Si => System::Si,
    };
    // Alone on standard output a chart is a picture; in a folder its numbers stand beside it.
    let files: &[ChartFile] = match (&call.files[..], &call.out) {
        ([], None) => &[ChartFile::Svg],
        ([], Some(_)) => &[ChartFile::Svg, ChartFile::Csv],
        (files, _) => files,
    };
    if files.contains(&ChartFile::Png) && !cfg!(feature = "png") {
        return Err(Failure::needs("charts as PNG", "png"));
    }
    if call.out.is_none() && (entries.len() > 1 || files.len() > 1) {
        return Err(Failure::wrong(
            "more than one file does not go to standard output: name a folder with --out DIR",
        ));
    }
    if let Some(folder) = &call.out {
        output::ready(folder)?;
    }
    let progress = Line::charts(entries.len());
    let workbook = Workbook::new(&input.spec, &input.name, system, &progress);
    let figures: Vec<(&Entry, Figure)> = entries
        .into_iter()
        .map(|entry| {
            progress.chart(&entry.number());
            (entry, entry.draw(&workbook))
        })
        .collect();
    let drawn = figures
        .par_iter()
        .map(|(entry, figure)| Ok((*entry, draw(entry, figure, files)?)))
        .collect::<Result<Vec<_>, Failure>>()?;
    progress.finish();
    let Some(folder) = call.out.as_deref() else {
        let mut all = drawn.into_iter().flat_map(|(_, files)| files);
        let (Some(only), None) = (all.next(), all.next()) else {
            return Err(Failure::wrong(
                "this chart has a table for each of its panels: name a folder with --out DIR",
            ));
        };
        output::print(only.content)?;
        return Ok(Done::Complete);
    };
    write(&input.name, folder, drawn, call.format)
}

/// Writes everything; nothing is written before all is drawn.
fn write(
    name: &str,
    folder: &Path,
    drawn: Vec<(&Entry, Vec<File>)>,
    format: Format,
) -> Result<Done, Failure> {
    let mut written = Vec::new();
    for (entry, files) in drawn {
        let names: Vec<String> = files.iter().map(|file| file.name.clone()).collect();
        for file in files {
            output::write(file.content, Some(folder), &file.name)?;
        }
        let mut entry = describe(entry);
        entry["files"] = json!(names);
        written.push(entry);
    }
    if format == Format::Json {
        let result =
            json!({ "name": name, "folder": folder.display().to_string(), "charts": written });
        output::print(signed(result)?)?;
    }
    Ok(Done::Complete)
}

/// The charts that were asked for; none: the list is.
fn wanted(call: &Chart) -> Result<Vec<&'static Entry>, Failure> {
    if call.all {
        return Ok(BOOK.iter().collect());
    }
    let mut entries: Vec<&Entry> = Vec::new();
    for name in &call.charts {
        let entry = book::find(name).ok_or_else(|| {
            let near = book::suggestion(name)
                .map(|near| format!("did you mean `{near}`? "))
                .unwrap_or_default();
            Failure::wrong(format_args!(
                "unknown chart `{name}`; {near}`bogie chart --list` names all"
            ))
        })?;
        if !entries.iter().any(|known| known.name == entry.name) {
            entries.push(entry);
        }
    }
    Ok(entries)
}

fn describe(entry: &Entry) -> Value {
    json!({ "figures": entry.numbers, "name": entry.name, "title": entry.title })
}

fn list(format: Format) -> Result<String, Failure> {
    if format == Format::Json {
        let charts: Vec<Value> = BOOK.iter().map(describe).collect();
        return signed(json!({ "charts": charts }));
    }
    let mut text =
        String::from("figure          name                                what it shows\n");
    for entry in &BOOK {
        let _ = writeln!(
            text,
            "{:<15} {:<35} {}",
            entry.numbers.join(", "),
            entry.name,
            entry.title
        );
    }
    text.push_str(
        "\ndraw them with `bogie chart SPEC.toml`, by figure or name, or all with --all\n",
    );
    Ok(text)
}

/// JSON with the program that made it.
fn signed(mut result: Value) -> Result<String, Failure> {
    if let Value::Object(object) = &mut result {
        sign(object);
    }
    output::json(&result)
}

fn draw(entry: &Entry, figure: &Figure, wanted: &[ChartFile]) -> Result<Vec<File>, Failure> {
    let drawing = Drawing::new(figure);
    let stem = format!("{}-{}", entry.numbers[0], entry.name);
    let mut files = Vec::new();
    let mut add = |ending: &str, content: Vec<u8>| {
        files.push(File {
            name: format!("{stem}{ending}"),
            content,
        });
    };
    for kind in wanted {
        match kind {
            ChartFile::Svg => add(".svg", drawing.svg(Theme::Print).into_bytes()),
            ChartFile::Png => add(".png", png(&drawing)?),
            ChartFile::Csv => {
                for (panel, table) in tables(figure) {
                    let panel = if panel.is_empty() {
                        panel
                    } else {
                        format!("-{panel}")
                    };
                    add(&format!("{panel}.csv"), table.csv().into_bytes());
                }
            }
            ChartFile::Json => {
                add(".json", signed(drawing.json())?.into_bytes());
            }
        }
    }
    Ok(files)
}

#[cfg(feature = "png")]
fn png(drawing: &Drawing) -> Result<Vec<u8>, Failure> {
    bogie::plot::png::png(drawing).map_err(Failure::failed)
}

#[cfg(not(feature = "png"))]
fn png(_: &Drawing) -> Result<Vec<u8>, Failure> {
    Err(Failure::needs("charts as PNG", "png"))
}
