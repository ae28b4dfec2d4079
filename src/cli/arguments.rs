//! The commands and their options.

use std::path::{Path, PathBuf};

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};

/// Meaning of the exit codes, at the end of every help.
pub const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  a failure: a file that cannot be written, or eigenvalues that cannot be had
  2  a wrong call or an invalid spec
  3  requirements or limits not met or not assessed; the result is the best compromise
  4  ended early, by --budget or Ctrl-C; the result is the best so far, met or not";

/// Early design of rail vehicle suspensions: ride, stability and curving.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100)]
pub struct Arguments {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
}

impl Arguments {
    /// Reads the call; a wrong one ends the program with exit code 2.
    pub fn read() -> Self {
        let command = Self::command()
            .after_help(EXIT_CODES)
            .mut_subcommands(|command| command.after_help(EXIT_CODES));
        let matches = command.get_matches();
        Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
    }
}

/// Commands on a spec.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Choose the suspension that is best within the spec's limits
    Optimize(Optimize),
    /// Trace the front between two or three indices, each point the best that the others allow
    Pareto(Pareto),
    /// Compute every performance index of the design as it stands
    Evaluate(Run),
    /// Find out which parameters and inputs matter to the performance, and which do not
    Sensitivity(Sensitivity),
    /// Evaluate many designs, evenly spread over what the spec leaves open, line by line
    Sweep(Sweep),
    /// Write a page with all results and charts of the design as it stands
    Report(Report),
    /// List the modes of vibration, and damping against speed
    Modes(Modes),
    /// Show the vehicle in a curve, its limits and the performance boundary
    Curve(Curve),
    /// Compute power spectra of accelerations and strokes
    Psd(Psd),
    /// Draw the report's design charts for the vehicle, by figure number or name
    Chart(Chart),
    /// Check a spec and do nothing else
    Check(Check),
    /// Print the JSON schema of a spec, with which editors complete and check it
    Schema,
    /// Write a commented spec to start from
    Init(Init),
}

impl Command {
    /// The spec that it reads; none: it reads none.
    pub fn spec(&self) -> Option<&Path> {
        let source = match self {
            Self::Optimize(call) => &call.run.source,
            Self::Pareto(call) => &call.source,
            Self::Evaluate(call) => &call.source,
            Self::Sensitivity(call) => &call.source,
            Self::Sweep(call) => &call.source,
            Self::Report(call) => &call.source,
            Self::Modes(call) => &call.run.source,
            Self::Curve(call) => &call.run.source,
            Self::Psd(call) => &call.run.source,
            Self::Check(call) => &call.source,
            Self::Chart(call) => return call.spec.as_deref(),
            Self::Schema | Self::Init(_) => return None,
        };
        Some(&source.spec)
    }

    /// The folder in which it keeps a journal; none: it keeps none.
    pub fn journal(&self) -> Option<&Path> {
        match self {
            Self::Optimize(call) => call.run.out.as_deref(),
            Self::Pareto(call) => call.out.as_deref(),
            Self::Sweep(call) => call.out.as_deref(),
            _ => None,
        }
    }
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

/// Options of a long search.
#[derive(Debug, Args)]
pub struct Search {
    /// End after this many full-model evaluations with the best found
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub budget: Option<u64>,

    /// Go on where an earlier run into the same --out folder was interrupted
    #[arg(long, requires = "out")]
    pub resume: bool,

    /// Search until basins not yet seen are at most 1 % of the space, in place of `unseen` in
    /// [design] (default 5 %)
    #[arg(long)]
    pub thorough: bool,
}

/// Options of `optimize`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Optimize {
    #[command(flatten)]
    pub run: Run,

    #[command(flatten)]
    pub search: Search,

    /// Also write a page with all results and charts (HTML)
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
}

/// Options of `report`.
#[derive(Debug, Args)]
pub struct Report {
    #[command(flatten)]
    pub source: Source,

    /// Page to write (HTML), or - for standard output
    #[arg(value_name = "FILE.html")]
    pub page: PathBuf,
}

/// Options of `pareto`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Pareto {
    #[command(flatten)]
    pub source: Source,

    #[command(flatten)]
    pub search: Search,

    /// Form of the result
    #[arg(long, value_enum, default_value_t = TableFormat::Text)]
    pub format: TableFormat,

    /// Write the result into this folder instead of to standard output
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Two or three indices, separated by commas (default: those of [pareto] in the spec, or
    /// critical_speed,degree_curve)
    #[arg(long, value_name = "INDEX,INDEX", value_delimiter = ',')]
    pub indices: Vec<String>,

    /// Points of the front (default: those of [pareto] in the spec, or 20)
    #[arg(long, value_name = "N")]
    pub points: Option<usize>,
}

/// Options of `sensitivity`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Sensitivity {
    #[command(flatten)]
    pub source: Source,

    /// Form of the result
    #[arg(long, value_enum, default_value_t = TableFormat::Text)]
    pub format: TableFormat,

    /// Write the result into this folder instead of to standard output
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// How sensitivity is found
    #[arg(long, value_enum, default_value_t = Method::Morris)]
    pub method: Method,

    /// Trajectories of Morris's method (default: 20) or rows of Sobol's (default: 256; best a
    /// power of two)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=65_536))]
    pub samples: Option<u32>,

    /// Relative range of every input that is no design parameter, either way
    #[arg(long, value_name = "SHARE", default_value_t = 0.1)]
    pub spread: f64,

    /// Indices to look at, separated by commas (default: the report's, and those that the spec
    /// asks for)
    #[arg(long, value_name = "INDEX,…", value_delimiter = ',')]
    pub indices: Vec<String>,
}

/// How sensitivity is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Elementary effects: quick, ranks the factors
    Morris,
    /// Shares of the variance: slower, says how much each explains
    Sobol,
}

/// Options of `sweep`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub struct Sweep {
    #[command(flatten)]
    pub source: Source,

    /// Number of designs
    #[arg(long, value_name = "N", value_parser = designs)]
    pub designs: usize,

    /// Which designs: the same seed gives the same ones (default: that of [design] in the spec)
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,

    /// Indices to evaluate, separated by commas (default: the report's, and those that the spec
    /// asks for)
    #[arg(long, value_name = "INDEX,…", value_delimiter = ',')]
    pub indices: Vec<String>,

    /// Form of the lines
    #[arg(long, value_enum, default_value_t = Lines::Csv)]
    pub format: Lines,

    /// Write the lines into this folder instead of to standard output
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Go on where an earlier run into the same --out folder ended
    #[arg(long, requires = "out")]
    pub resume: bool,
}

/// As many designs as a file of lines is of use for.
fn designs(text: &str) -> Result<usize, String> {
    const MOST: usize = 1_000_000_000;
    let count = text.parse().ok().filter(|n| (1..=MOST).contains(n));
    count.ok_or_else(|| format!("expected a whole number from 1 to {MOST}"))
}

/// Form of results that come line by line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Lines {
    /// SI, with the unit in every column's name
    Csv,
    /// The same as a JSON object a line
    Json,
}

impl std::fmt::Display for Lines {
    /// Name in options and of files.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Csv => "csv",
            Self::Json => "json",
        })
    }
}

/// Form of a result that is a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TableFormat {
    /// An aligned table in SI and US customary units
    Text,
    /// SI, with the unit in every key
    Json,
    /// SI, with the unit in every column's name
    Csv,
    /// As CSV, for data frames; needs a build with `--features parquet`
    Parquet,
}

impl From<Format> for TableFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Text => Self::Text,
            Format::Json => Self::Json,
        }
    }
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
#[command(allow_negative_numbers = true)]
pub struct Curve {
    #[command(flatten)]
    pub run: Run,

    /// Degree of curve (default: that of [service], or the tightest without flange contact or slip)
    #[arg(long, value_name = "DEGREES")]
    pub degree: Option<f64>,

    /// Cant deficiency, as an angle ("3 deg") or a height over 56 in ("3 in") (default: that of
    /// [service], or 0)
    #[arg(long, value_name = "ANGLE|HEIGHT", allow_hyphen_values = true)]
    pub cant_deficiency: Option<String>,
}

/// Options of `psd`.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
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

/// Options of `chart`.
#[derive(Debug, Args)]
pub struct Chart {
    /// Spec file, or - for standard input
    #[arg(value_name = "SPEC.toml", required_unless_present = "list")]
    pub spec: Option<PathBuf>,

    /// Charts by figure number or name
    #[arg(value_name = "NAME", required_unless_present_any = ["all", "list"])]
    pub charts: Vec<String>,

    /// List the charts that there are and do nothing else
    #[arg(long, conflicts_with_all = ["spec", "charts", "all", "files", "out"])]
    pub list: bool,

    /// Draw the whole book
    #[arg(long, conflicts_with = "charts")]
    pub all: bool,

    /// Units that come first, at the left and bottom; the others stand at the right and top
    #[arg(long, value_enum, default_value_t = Units::Us)]
    pub units: Units,

    /// Files for each chart, separated by commas (default: svg,csv in a folder, svg alone)
    #[arg(long, value_enum, value_name = "KIND,…", value_delimiter = ',')]
    pub files: Vec<ChartFile>,

    /// Form of the list of what there is, or of what was written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,

    /// Write into this folder; a single file may go to standard output
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// A system of units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Units {
    /// US customary units, as on the report's charts
    Us,
    /// SI units
    Si,
}

/// A file of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ChartFile {
    /// The drawing
    Svg,
    /// A picture of 288 pixels per inch; needs a build with `--features png`
    Png,
    /// The numbers behind it, SI, a table per panel
    Csv,
    /// The figure with its layout, SI
    Json,
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
