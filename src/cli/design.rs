//! The commands that take many evaluations: `optimize`, `pareto` and `sensitivity`.

use std::path::Path;

use bogie::{
    design::{
        doubts::warnings,
        pareto,
        procedure::{self, DesignError},
        sensitivity::{self, Factors, Settings, Watch, analysis::indices_of},
    },
    export::{self, design_json, design_text, origin::PROGRAM, table::Table},
    index::Index,
    optimize::{
        archive::Archive,
        journal::{Entry, Header, Journal, JournalError},
        solve::UNSEEN_THOROUGH,
    },
    spec::{FRONT_POINTS, Spec},
};

use super::{
    Done, Failure,
    arguments::{Method, Optimize, Pareto, Search, Sensitivity, TableFormat},
    commands::{deliver, failed, together, with_origin, wrong},
    input, interrupt, output,
    progress::Line,
    report,
};

pub fn optimize(call: &Optimize) -> Result<Done, Failure> {
    let mut named = input::read(&call.run.source.spec)?;
    set(&mut named.spec, &call.search);
    if let Some(page) = &call.report {
        report::ready(page)?;
    }
    let input::Named {
        name,
        spec,
        digest,
        warnings: doubts,
        ..
    } = &named;
    let progress = Line::new();
    let header = header("optimize", &format!("{digest}{}", call.search.written()));
    let archive = archive(&progress, &call.search, call.run.out.as_deref(), &header)?;
    let designed = procedure::design_beside(spec, &archive, |case| {
        let watch = Watch {
            interrupt: Some(interrupt::flag()),
            progress: &progress,
        };
        sensitivity::screen(case, &indices_of(spec), spec.design.seed, &watch)
    });
    progress.finish();
    tell(&archive);
    let (result, matters) = designed.map_err(|error| match error {
        DesignError::NothingOpen | DesignError::NoRequirement => Failure::Invalid(format!(
            "error: {}: {error}",
            call.run.source.spec.display()
        )),
        error @ DesignError::Eigen(_) => failed(error),
    })?;
    let warnings = warnings(&result.case, &result.evaluation, &spec.demands);
    deliver(
        &call.run,
        "optimize",
        || design_text::design(name, &result, spec, Some(&matters), &warnings),
        || {
            let all = together(doubts, &warnings);
            design_json::design(name, &result, spec, digest, Some(&matters), &all)
        },
    )?;
    if let Some(page) = &call.report {
        let whole = archive.stopped().is_none();
        let front = report::front(spec, &archive);
        progress.finish();
        if whole {
            tell(&archive);
        }
        let (matters, front) = (Some(&matters), front.as_ref());
        report::optimized(&named, &result, matters, front, call, page)?;
    }
    let early = archive.stopped().is_some() || matters.interrupted();
    Ok(Done::of(early, result.met()))
}

pub fn pareto(call: &Pareto) -> Result<Done, Failure> {
    let input::Named {
        name,
        mut spec,
        digest,
        warnings,
        ..
    } = input::read(&call.source.spec)?;
    set(&mut spec, &call.search);
    if !call.indices.is_empty() {
        spec.front.indices = indices(&call.indices)?;
        if !(2..=3).contains(&spec.front.indices.len()) {
            return Err(wrong("--indices: expected two or three indices"));
        }
    }
    if let Some(points) = call.points {
        if !FRONT_POINTS.contains(&points) {
            let (least, most) = (FRONT_POINTS.start(), FRONT_POINTS.end());
            return Err(wrong(&format!(
                "--points {points}: expected {least} to {most}"
            )));
        }
        spec.front.points = points;
    }
    let traded: Vec<&str> = spec.front.indices.iter().map(|i| i.name()).collect();
    if spec.design.parameters.is_empty() {
        let shown = call.source.spec.display();
        return Err(Failure::Invalid(format!(
            "error: {shown}: {}",
            DesignError::NothingOpen
        )));
    }
    let progress = Line::new();
    let search = format!(
        "{digest} {} {}{}",
        traded.join(","),
        spec.front.points,
        call.search.written()
    );
    let header = header("pareto", &search);
    let archive = archive(&progress, &call.search, call.out.as_deref(), &header)?;
    let front = pareto::pareto(&spec, &archive);
    progress.finish();
    tell(&archive);
    if let Some(failure) = front.failure {
        output::say(format_args!(
            "no design within the bounds could be evaluated ({failure}): there is no front; `bogie \
             evaluate` says more of the vehicle as given, `bogie sweep` of others within the bounds of \
             [design]"
        ));
    } else if front.points.is_empty() && front.stopped.is_none() {
        output::say("no design keeps the remaining requirements and limits: there is no front");
    }
    deliver_table(
        (call.format, call.out.as_deref(), "pareto"),
        || export::pareto::text(&name, &front),
        || {
            let result = export::pareto::json(&name, &front, &spec, &digest);
            with_origin(result, &digest, &warnings)
        },
        || export::pareto::table(&name, &front, &digest),
    )?;
    Ok(Done::of(front.stopped.is_some(), !front.points.is_empty()))
}

pub(super) fn indices(names: &[String]) -> Result<Vec<Index>, Failure> {
    let mut indices = Vec::new();
    for name in names {
        let index = Index::named(name.trim()).ok_or_else(|| {
            let known = Index::ALL.map(Index::name).join(", ");
            wrong(&format!(
                "--indices: unknown index `{name}`; known are {known}"
            ))
        })?;
        if indices.contains(&index) {
            return Err(wrong(&format!("--indices: `{name}` stands twice")));
        }
        indices.push(index);
    }
    Ok(indices)
}

pub fn sensitivity(call: &Sensitivity) -> Result<Done, Failure> {
    let input::Named {
        name,
        spec,
        digest,
        warnings,
        ..
    } = input::read(&call.source.spec)?;
    if !(0.0..1.0).contains(&call.spread) {
        return Err(wrong(&format!(
            "--spread {}: expected a share from 0 to below 1, such as 0.1",
            call.spread
        )));
    }
    let indices = if call.indices.is_empty() {
        indices_of(&spec)
    } else {
        indices(&call.indices)?
    };
    let samples = call.samples.map(|n| n as usize);
    let method = match call.method {
        Method::Morris => samples.map_or(sensitivity::Method::MORRIS, |trajectories| {
            sensitivity::Method::Morris { trajectories }
        }),
        Method::Sobol => samples.map_or(sensitivity::Method::SOBOL, |rows| {
            sensitivity::Method::Sobol { rows }
        }),
    };
    let factors = Factors::new(&spec.case, &spec.design, call.spread);
    if factors.list().is_empty() {
        return Err(wrong(
            "nothing varies: open [design] or give a --spread above 0",
        ));
    }
    if let Some(folder) = &call.out {
        output::ready(folder)?;
    }
    let progress = Line::new();
    let watch = Watch {
        interrupt: Some(interrupt::flag()),
        progress: &progress,
    };
    let settings = Settings {
        method,
        seed: spec.design.seed,
    };
    let found = sensitivity::Sensitivity::new(&factors, &indices, settings, &watch);
    progress.finish();
    deliver_table(
        (call.format, call.out.as_deref(), "sensitivity"),
        || export::sensitivity::text(&name, &found),
        || with_origin(export::sensitivity::json(&name, &found), &digest, &warnings),
        || export::sensitivity::table(&found),
    )?;
    Ok(Done::of(found.interrupted(), true))
}

fn deliver_table(
    (format, out, command): (TableFormat, Option<&Path>, &str),
    text: impl FnOnce() -> String,
    json: impl FnOnce() -> serde_json::Value,
    table: impl FnOnce() -> Table,
) -> Result<(), Failure> {
    let (content, ending) = match format {
        TableFormat::Text => (text().into_bytes(), "txt"),
        TableFormat::Json => {
            let text = serde_json::to_string_pretty(&json()).map_err(failed)?;
            ((text + "\n").into_bytes(), "json")
        }
        TableFormat::Csv => (table().csv().into_bytes(), "csv"),
        #[cfg(feature = "parquet")]
        TableFormat::Parquet => (table().parquet().map_err(failed)?, "parquet"),
    };
    output::write(content, out, &format!("{command}.{ending}"))
}

/// Puts options of a search in place of what the spec says.
fn set(spec: &mut Spec, search: &Search) {
    if search.thorough {
        spec.design.unseen = spec.design.unseen.min(UNSEEN_THOROUGH);
    }
}

/// What a journal must belong to: all that decides the search but the budget, which may be raised.
fn header(command: &str, digest: &str) -> Header {
    Header {
        program: PROGRAM.into(),
        digest: format!("{command} {digest}"),
    }
}

/// The archive of a run, with its journal where there is a folder to keep it.
fn archive<'a>(
    progress: &'a Line,
    search: &Search,
    out: Option<&Path>,
    header: &Header,
) -> Result<Archive<'a>, Failure> {
    let budget = search
        .budget
        .map(|n| usize::try_from(n).unwrap_or(usize::MAX));
    let archive = Archive::new(progress)
        .with_budget(budget)
        .with_interrupt(interrupt::flag());
    let Some(folder) = out else {
        return Ok(archive);
    };
    let command = header.digest.split(' ').next().unwrap_or_default();
    let path = folder.join(format!("{command}.journal"));
    let (journal, recorded) = journal(&path, header, search.resume)?;
    Ok(archive.with_journal(journal, recorded))
}

/// A journal, new or to be gone on with.
pub(super) fn journal(
    path: &Path,
    header: &Header,
    resume: bool,
) -> Result<(Journal, Vec<Entry>), Failure> {
    let opened = if resume {
        Journal::resume(path, header)
    } else {
        Journal::create(path, header).map(|journal| (journal, Vec::new()))
    };
    opened.map_err(|error| match error {
        JournalError::Io(error) => output::cannot_write(path, &error),
        JournalError::Busy => Failure::Failed(format!("{}: {error}", path.display())),
        JournalError::Foreign | JournalError::Missing => Failure::Invalid(format!(
            "error: cannot resume from {}: {error}",
            path.display()
        )),
    })
}

/// What a user should know of a run beside its result.
pub(super) fn tell(archive: &Archive) {
    if let Some(error) = archive.journal_error() {
        output::say(format_args!(
            "warning: the journal could not be written ({error}): no --resume from here"
        ));
    }
    if let Some(stop) = archive.stopped() {
        output::say(format_args!("ended early: {stop}"));
    }
}
