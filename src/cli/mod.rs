//! Command line: reads a spec, runs a command, writes its result.
//!
//! Results go to standard output or under `--out`, everything else to standard error. The exit codes are
//! those of [`arguments::EXIT_CODES`].

mod arguments;
mod chart;
mod commands;
mod design;
mod fault;
mod input;
mod interrupt;
mod output;
mod progress;
mod report;
mod sweep;

use std::{fmt::Display, path::Path, process::ExitCode};

use arguments::{Arguments, Command};
use bogie::design::procedure::DesignError;

/// Why a command ends without a result.
#[derive(Debug)]
enum Failure {
    /// The spec or the call is wrong: the text says where and how to mend it.
    Invalid(String),
    /// Something else went wrong.
    Failed(String),
    /// The reader of a result that comes in parts went away.
    Closed,
}

impl Failure {
    /// Of something that is neither the call's nor the spec's mistake.
    fn failed(error: impl Display) -> Self {
        Self::Failed(error.to_string())
    }

    /// Of a call that is wrong.
    fn wrong(text: impl Display) -> Self {
        Self::Invalid(format!("error: {text}"))
    }

    /// Of an option with a wrong value.
    fn option<E: Display>(name: &str) -> impl Fn(E) -> Self {
        move |error| Self::wrong(format_args!("{name}: {error}"))
    }

    /// Of a call for what this build leaves out.
    fn needs(what: &str, feature: &str) -> Self {
        Self::wrong(format_args!(
            "{what} need a build with `--features {feature}`"
        ))
    }

    /// Of a spec that leaves nothing to choose, or nothing to choose by.
    fn design(spec: &Path, error: DesignError) -> Self {
        match error {
            DesignError::NothingOpen | DesignError::NoRequirement => {
                Self::wrong(format_args!("{}: {error}", spec.display()))
            }
            error @ DesignError::Eigen(_) => Self::failed(error),
        }
    }
}

/// How a command that has a result ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Done {
    /// As asked.
    Complete,
    /// Requirements are not met.
    Unmet,
    /// The budget was spent or the run interrupted: the result is the best so far.
    Early,
}

impl Done {
    /// Of a run that may have ended early and may meet what is asked: what might have become of a run
    /// that ended early is not known.
    fn of(early: bool, met: bool) -> Self {
        match (early, met) {
            (true, _) => Self::Early,
            (false, true) => Self::Complete,
            (false, false) => Self::Unmet,
        }
    }
}

/// Runs the command that was called. A fault of the program ends it with a message, too.
pub fn run() -> ExitCode {
    let arguments = Arguments::read();
    fault::keep_silent();
    let result = fault::catch(|| command(&arguments.command))
        .unwrap_or_else(|fault| Err(Failure::Failed(fault.message(&arguments.command))));
    match result {
        Ok(Done::Complete) | Err(Failure::Closed) => ExitCode::SUCCESS,
        Ok(Done::Unmet) => ExitCode::from(3),
        Ok(Done::Early) => ExitCode::from(4),
        Err(Failure::Failed(text)) => {
            output::say(format_args!("error: {text}"));
            ExitCode::from(1)
        }
        Err(Failure::Invalid(text)) => {
            output::say(text.trim_end());
            ExitCode::from(2)
        }
    }
}

fn command(command: &Command) -> Result<Done, Failure> {
    match command {
        Command::Optimize(call) => design::optimize(call),
        Command::Pareto(call) => design::pareto(call),
        Command::Sensitivity(call) => design::sensitivity(call),
        Command::Sweep(call) => sweep::sweep(call),
        Command::Evaluate(call) => commands::evaluate(call),
        Command::Report(call) => report::report(call),
        Command::Modes(call) => commands::modes(call),
        Command::Curve(call) => commands::curve(call),
        Command::Psd(call) => commands::psd(call),
        Command::Chart(call) => chart::chart(call),
        Command::Check(call) => commands::check(call),
        Command::Schema => commands::schema(),
        Command::Init(call) => commands::init(call),
    }
}
