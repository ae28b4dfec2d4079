//! `bogie report`, and the page of `bogie optimize --report`.

use std::path::Path;

use bogie::{
    design::doubts::warnings,
    design::{
        outcome::DesignResult,
        pareto::{self, Front},
        sensitivity::Sensitivity,
    },
    export::file,
    optimize::archive::Archive,
    report::{Report, charts, page},
    spec::Spec,
};

use super::{
    Done, Failure, arguments,
    commands::{failed, together, wrong},
    design::tell,
    input::{self, Named},
    interrupt, output,
    progress::Line,
};

pub fn report(call: &arguments::Report) -> Result<Done, Failure> {
    let named = input::read(&call.source.spec)?;
    ready(&call.page)?;
    let result = DesignResult::as_given(&named.spec).map_err(failed)?;
    let command = format!("bogie report {0}.toml {0}.html", named.name);
    let progress = Line::new();
    let archive = Archive::new(&progress).with_interrupt(interrupt::flag());
    let front = front(&named.spec, &archive);
    progress.finish();
    tell(&archive);
    let made = Made {
        named: &named,
        result: &result,
        designed: false,
        matters: None,
        front: front.as_ref(),
        command,
    };
    made.write(&call.page)?;
    Ok(Done::of(archive.stopped().is_some(), true))
}

/// The page of an optimisation.
pub fn optimized(
    named: &Named,
    result: &DesignResult,
    matters: Option<&Sensitivity>,
    front: Option<&Front>,
    call: &arguments::Optimize,
    page: &Path,
) -> Result<(), Failure> {
    let limit = call
        .search
        .budget
        .map_or_else(String::new, |n| format!(" --budget {n}"));
    let command = format!(
        "bogie optimize {0}.toml{limit}{1} --report {0}.html",
        named.name,
        call.search.written()
    );
    let made = Made {
        named,
        result,
        designed: true,
        matters,
        front,
        command,
    };
    made.write(page)
}

/// Makes sure that a page can be written, before the work for it.
pub fn ready(page: &Path) -> Result<(), Failure> {
    if page.as_os_str() == "-" {
        return Ok(());
    }
    if page.is_dir() {
        return Err(wrong(&format!(
            "{} is a folder: name a file for the report",
            page.display()
        )));
    }
    let folder = page
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    output::ready(folder.unwrap_or(Path::new(".")))
}

/// A result of which a page is made.
struct Made<'a> {
    named: &'a Named,
    result: &'a DesignResult,
    designed: bool,
    matters: Option<&'a Sensitivity>,
    front: Option<&'a Front>,
    command: String,
}

impl Made<'_> {
    fn write(&self, path: &Path) -> Result<(), Failure> {
        let Named {
            name,
            spec,
            source,
            digest,
            warnings: doubts,
        } = self.named;
        let result = self.result;
        let progress = Line::charts(charts::entries(&result.case).len());
        let figures = charts::figures(spec, name, &result.case, &progress, |entry| {
            progress.chart(&entry.number());
        });
        progress.finish();
        let all = together(
            doubts,
            &warnings(&result.case, &result.evaluation, &spec.demands),
        );
        let html = page(&Report {
            name,
            source,
            digest,
            command: &self.command,
            spec,
            result,
            designed: self.designed,
            matters: self.matters,
            front: self.front,
            figures: &figures,
            warnings: &all,
        });
        if path.as_os_str() == "-" {
            return output::print(html);
        }
        file::write(path, html).map_err(|error| output::cannot_write(path, &error))?;
        output::say(format_args!("wrote {}", path.display()));
        Ok(())
    }
}

/// The front, where the spec asks for one and something is open to trace it with.
pub fn front(spec: &Spec, archive: &Archive) -> Option<Front> {
    if !spec.front.asked || spec.design.parameters.is_empty() {
        return None;
    }
    let front = pareto::pareto(spec, archive);
    if let Some(failure) = front.failure {
        output::say(format_args!("warning: no front: {failure}"));
        return None;
    }
    Some(front)
}
