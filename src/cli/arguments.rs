//! The commands and their options.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// Early design of rail vehicle suspensions: ride, stability and curving.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What can be done with a spec.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Choose the suspension that is best within the spec's limits
    Optimize(Run),
    /// Compute every performance index of the design as it stands
    Evaluate(Run),
    /// List the modes of vibration, and damping against speed
    Modes(Modes),
    /// Show the vehicle in a curve, its limits and the performance boundary
    Curve(Curve),
    /// Compute power spectra of accelerations and strokes
    Psd(Psd),
    /// Check a spec and do nothing else
    Check(Check),
    /// Write a commented spec to start from
    Init(Init),
}

/// Where the spec comes from.
#[derive(Debug, Args)]
pub struct Source {
    /// Spec file, or - for standard input
    #[arg(value_name = "SPEC.toml")]
    pub spec: PathBuf,
}

/// A spec, and where the result goes.
#[derive(Debug, Args)]
pub struct Run {
    #[command(flatten)]
    pub source: Source,

    /// Form of the result
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,

    /// Write the result into this folder instead of to standard output
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Form of a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Tables in SI and US customary units
    Text,
    /// SI, with the unit in every key
    Json,
}

/// Options of `modes`.
#[derive(Debug, Args)]
pub struct Modes {
    #[command(flatten)]
    pub run: Run,

    /// Speeds at which to list the damping, such as "60 mph" or "200 km/h" (default: every 10 %
    /// of twice the operating speed)
    #[arg(long, value_name = "SPEED", num_args = 1..)]
    pub speeds: Vec<String>,
}

/// Options of `curve`.
#[derive(Debug, Args)]
pub struct Curve {
    #[command(flatten)]
    pub run: Run,

    /// Degree of curve (default: the tightest without flange contact or slip)
    #[arg(long, value_name = "DEGREES")]
    pub degree: Option<f64>,

    /// Cant deficiency, as an angle ("3 deg") or a height over 56 in ("3 in")
    #[arg(
        long,
        value_name = "ANGLE|HEIGHT",
        default_value = "0 deg",
        allow_hyphen_values = true
    )]
    pub cant_deficiency: String,
}

/// Options of `psd`.
#[derive(Debug, Args)]
pub struct Psd {
    #[command(flatten)]
    pub run: Run,

    /// Frequencies, equally spaced on a logarithmic axis over the spec's band
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub points: u32,

    /// Write CSV, one row per frequency
    #[arg(long, conflicts_with = "format")]
    pub csv: bool,
}

/// Options of `check`.
#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    pub source: Source,

    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// Options of `init`.
#[derive(Debug, Args)]
pub struct Init {
    /// File to write, or - for standard output
    #[arg(value_name = "SPEC.toml", default_value = "spec.toml")]
    pub spec: PathBuf,
}
