//! The commands that take many evaluations: `optimize`, `pareto` and `sensitivity`.

use std::path::Path;

use bogie::{
    design::sensitivity,
    index::Index,
    optimize::journal::{Entry, Journal, JournalError},
    run::{Archive, Input, Journaled, Page, Run, RunError},
};

use super::{
    Done, Failure,
    arguments::{Method, Optimize, Pareto, Search, Sensitivity},
    input, interrupt, output,
    progress::Line,
    report,
};

pub fn optimize(call: &Optimize) -> Result<Done, Failure> {
    let mut input = input::read(&call.run.source.spec)?;
    if call.search.thorough {
        input.search_thoroughly();
    }
    if let Some(page) = &call.report {
        report::ready(page)?;
    }
    let progress = Line::new();
    let run = Run::new(&input).watched(&progress, interrupt::flag());
    let out = call.run.out.as_deref();
    let archive = archive(run, &call.search, Journaled::Optimize, out)?;
    let designed = run.optimize(&archive);
    progress.finish();
    tell(&archive);
    let answer = designed.map_err(|error| Failure::design(&call.run.source.spec, error))?;
    output::deliver(&answer, "optimize", call.run.format, out)?;
    if let Some(page) = &call.report {
        let whole = archive.stopped().is_none();
        let front = report::front(run, &archive);
        progress.finish();
        if whole {
            tell(&archive);
        }
        let shown = Page::designed(&answer, front.as_ref());
        report::write(run, shown, &report::command(&input.name, call), page)?;
    }
    let early = archive.stopped().is_some() || answer.result.ended_early();
    Ok(Done::of(early, answer.result.design.met()))
}

pub fn pareto(call: &Pareto) -> Result<Done, Failure> {
    output::can_write(call.format)?;
    let mut input = input::read(&call.source.spec)?;
    if call.search.thorough {
        input.search_thoroughly();
    }
    if !call.indices.is_empty() {
        let wrong = Failure::option("--indices");
        input.trade_off(indices(&call.indices)?).map_err(wrong)?;
    }
    if let Some(points) = call.points {
        let option = format!("--points {points}");
        let wrong = Failure::option(&option);
        input.front_points(points).map_err(wrong)?;
    }
    let progress = Line::new();
    let run = Run::new(&input).watched(&progress, interrupt::flag());
    let out = call.out.as_deref();
    let refused = |error| Failure::design(&call.source.spec, error);
    run.has_choice().map_err(refused)?;
    let archive = archive(run, &call.search, Journaled::Pareto, out)?;
    let answer = run.pareto(&archive);
    progress.finish();
    tell(&archive);
    let answer = answer.map_err(refused)?;
    let front = &answer.result;
    if let Some(failure) = front.failure {
        output::say(format_args!(
            "no design within the bounds could be evaluated ({failure}): there is no front; `bogie \
             evaluate` says more of the vehicle as given, `bogie sweep` of others within the bounds of \
             [design]"
        ));
    } else if front.points.is_empty() && front.stopped.is_none() {
        output::say("no design keeps the remaining requirements and limits: there is no front");
    }
    output::deliver(&answer, "pareto", call.format, out)?;
    Ok(Done::of(front.stopped.is_some(), !front.points.is_empty()))
}

/// The indices named in a call.
pub(super) fn indices(names: &[String]) -> Result<Vec<Index>, Failure> {
    Input::indices(names).map_err(Failure::option("--indices"))
}

pub fn sensitivity(call: &Sensitivity) -> Result<Done, Failure> {
    output::can_write(call.format)?;
    let input = input::read(&call.source.spec)?;
    let progress = Line::new();
    let run = Run::new(&input).watched(&progress, interrupt::flag());
    let indices = indices(&call.indices)?;
    let samples = call.samples.map(|n| n as usize);
    let method = match call.method {
        Method::Morris => samples.map_or(sensitivity::Method::MORRIS, |trajectories| {
            sensitivity::Method::Morris { trajectories }
        }),
        Method::Sobol => samples.map_or(sensitivity::Method::SOBOL, |rows| {
            sensitivity::Method::Sobol { rows }
        }),
    };
    let factors = run.factors(call.spread).map_err(|error| match error {
        RunError::Spread => Failure::wrong(format_args!("--spread {}: {error}", call.spread)),
        error => Failure::wrong(error),
    })?;
    if let Some(folder) = &call.out {
        output::ready(folder)?;
    }
    let answer = run.sensitivity(&factors, &indices, method);
    progress.finish();
    output::deliver(&answer, "sensitivity", call.format, call.out.as_deref())?;
    Ok(Done::of(answer.result.interrupted(), true))
}

/// The archive of a run, with its budget and, where there is a folder to keep it, its journal.
fn archive<'a>(
    run: Run<'a>,
    search: &Search,
    request: Journaled,
    out: Option<&Path>,
) -> Result<Archive<'a>, Failure> {
    let budget = search
        .budget
        .map(|n| usize::try_from(n).unwrap_or(usize::MAX));
    let archive = run.archive(budget);
    let Some(folder) = out else {
        return Ok(archive);
    };
    let (journal, recorded) = journal(run, request, folder, search.resume)?;
    Ok(archive.with_journal(journal, recorded))
}

/// The journal of a run in a folder, new or to be gone on with.
pub(super) fn journal(
    run: Run,
    request: Journaled,
    folder: &Path,
    resume: bool,
) -> Result<(Journal, Vec<Entry>), Failure> {
    let path = folder.join(format!("{}.journal", request.name()));
    let opened = run.journal(request, &path, resume);
    opened.map_err(|error| match error {
        JournalError::Io(error) => output::cannot_write(&path, &error),
        JournalError::Busy => Failure::Failed(format!("{}: {error}", path.display())),
        JournalError::Foreign | JournalError::Missing => Failure::wrong(format_args!(
            "cannot resume from {}: {error}",
            path.display()
        )),
    })
}

/// Notes of a run beside its result.
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
