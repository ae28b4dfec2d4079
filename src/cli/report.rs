//! `bogie report`, and the page of `bogie optimize --report`.

use std::path::Path;

use bogie::{
    design::pareto::Front,
    export::file,
    run::{Archive, Page, Run},
};

use super::{Done, Failure, arguments, design::tell, input, interrupt, output, progress::Line};

pub fn report(call: &arguments::Report) -> Result<Done, Failure> {
    let input = input::read(&call.source.spec)?;
    ready(&call.page)?;
    let progress = Line::new();
    let run = Run::new(&input).watched(&progress, interrupt::flag());
    let design = run.as_given().map_err(Failure::failed)?;
    let archive = run.archive(None);
    let front = front(run, &archive);
    progress.finish();
    tell(&archive);
    let shown = Page {
        design: &design,
        matters: None,
        front: front.as_ref(),
    };
    let command = format!("bogie report {0}.toml {0}.html", input.name);
    write(run, shown, &command, &call.page)?;
    Ok(Done::of(archive.stopped().is_some(), true))
}

/// The call that makes the page of an optimisation again.
pub fn command(name: &str, call: &arguments::Optimize) -> String {
    let limit = call
        .search
        .budget
        .map_or_else(String::new, |n| format!(" --budget {n}"));
    let thorough = if call.search.thorough {
        " --thorough"
    } else {
        ""
    };
    format!("bogie optimize {name}.toml{limit}{thorough} --report {name}.html")
}

/// Makes sure that a page can be written, before the work for it.
pub fn ready(page: &Path) -> Result<(), Failure> {
    if page.as_os_str() == "-" {
        return Ok(());
    }
    if page.is_dir() {
        return Err(Failure::wrong(format_args!(
            "{} is a folder: name a file for the report",
            page.display()
        )));
    }
    let folder = page
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    output::ready(folder.unwrap_or(Path::new(".")))
}

/// Makes and writes a page.
pub fn write(run: Run, shown: Page, command: &str, path: &Path) -> Result<(), Failure> {
    let progress = Line::charts(run.charts(shown.design));
    let html = run.page(shown, command, &progress, |entry| {
        progress.chart(&entry.number());
    });
    progress.finish();
    if path.as_os_str() == "-" {
        return output::print(html);
    }
    file::write(path, html).map_err(|error| output::cannot_write(path, &error))?;
    output::say(format_args!("wrote {}", path.display()));
    Ok(())
}

/// The front of a page, where the spec asks for one and there is one.
pub fn front(run: Run, archive: &Archive) -> Option<Front> {
    let front = run.front(archive)?;
    if let Some(failure) = front.failure {
        output::say(format_args!("warning: no front: {failure}"));
        return None;
    }
    Some(front)
}
