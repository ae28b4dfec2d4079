//! Does the program answer every spec and call, and does its documentation say the same?

mod browser;
mod check;
mod cli;
mod doubtful_specs;
mod edges_of_commands;
mod examples;
mod figures;
mod hostile_specs;
mod invalid_specs;
mod long_runs;
mod outputs;
mod report;
mod report_browser;
mod reports;
mod schema;
mod spec_reference;
mod starter;
#[path = "../support/mod.rs"]
mod support;
mod sweep;
