//! Command line: reads a spec, runs a command, writes its result.
//!
//! Results go to standard output or under `--out`, everything else to standard error. Exit codes:
//! 0 done, 1 a failure, 2 a wrong call or an invalid spec, 3 requirements that cannot all be met
//! (the result then holds the best compromise).

mod arguments;
mod chart;
mod commands;
mod design;
mod input;
mod interrupt;
mod output;
mod progress;
mod report;
mod sweep;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command};

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

/// How a command that has a result ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Done {
    /// As asked.
    Complete,
    /// Requirements are not met.
    Unmet,
}

/// Runs the command that was called.
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match &arguments.command {
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
    };
    match result {
        Ok(Done::Complete) | Err(Failure::Closed) => ExitCode::SUCCESS,
        Ok(Done::Unmet) => ExitCode::from(3),
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
