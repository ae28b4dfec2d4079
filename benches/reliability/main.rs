//! Reliability of the global search: how often it comes to the best known design of each of the problems
//! in `problems/`, from twenty seeds.
//!
//! ```sh
//! cargo bench --bench reliability                        # the table, in Markdown
//! cargo bench --bench reliability -- --into FILE.md      # the same, and into a page
//! cargo bench --bench reliability -- --seeds 2 A6        # two seeds, problems whose name contains A6
//! cargo bench --bench reliability -- --json runs.json    # every run
//! cargo bench --bench reliability -- --confirm           # best.json by other methods, in an hour
//! cargo bench --bench reliability -- --serve A6          # evaluations for other programs' methods
//! cargo bench --bench reliability -- --list              # the problems and where they come from
//! ```
//!
//! [`problem`] says what a design is worth, whatever the search reports of it; [`best`] keeps the best
//! known designs, which [`confirm`] looks for by [`evolution`] strategies; [`runs`] runs the search and
//! writes the table. Designs that are better than the best known take their place in `best.json`.

mod best;
mod confirm;
mod evolution;
mod problem;
mod runs;
mod serve;

use std::fs;

use clap::Parser;
use problem::Problem;

/// Between these the table stands in a page.
const MARKS: [&str; 2] = ["<!-- reliability -->\n", "<!-- end of reliability -->"];

/// How often the search comes to the best known design.
#[derive(Parser)]
struct Options {
    /// Problems whose name contains one of these; all if none is given.
    names: Vec<String>,
    /// Seeds, from 1 up.
    #[arg(long, default_value_t = 20)]
    seeds: u64,
    /// File for every run, as JSON.
    #[arg(long)]
    json: Option<String>,
    /// A page in Markdown that takes the table between its marks, see [`MARKS`].
    #[arg(long, value_name = "FILE")]
    into: Option<String>,
    /// Looks for the best designs by other methods, and takes them over into best.json.
    #[arg(long)]
    confirm: bool,
    /// Starts of the other methods, in times of those that they usually take.
    #[arg(long, default_value_t = 1)]
    times: usize,
    /// A problem: reads designs of it from standard input and answers with their values.
    #[arg(long, value_name = "NAME")]
    serve: Option<String>,
    /// Lists the problems.
    #[arg(long)]
    list: bool,
    /// Given by cargo.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> std::io::Result<()> {
    let options = Options::parse();
    if let Some(name) = &options.serve {
        let problems = Problem::all(std::slice::from_ref(name));
        let problem = problems.iter().find(|problem| problem.name == *name);
        return serve::serve(problem.expect("the name of a problem"));
    }
    let problems = Problem::all(&options.names);
    let before = best::read();
    let mut known = before.clone();
    let mut all = Vec::new();
    for problem in &problems {
        if options.list {
            println!("{}: {}", problem.name, problem.origin);
        } else if options.confirm {
            confirm::confirm(problem, &mut known, options.times);
            best::write(&known);
        } else {
            let runs = runs::run(problem, options.seeds, &mut known);
            let table = runs::table(std::slice::from_ref(&runs));
            eprintln!("{}", table.lines().nth(2).unwrap_or_default());
            all.push(runs);
        }
    }
    if all.is_empty() {
        return Ok(());
    }
    if known != before {
        best::write(&known);
    }
    let table = runs::table(&all);
    print!("{table}");
    if let Some(file) = &options.json {
        fs::write(file, serde_json::to_string_pretty(&all)?)?;
    }
    match &options.into {
        Some(file) => fs::write(file, between_marks(&fs::read_to_string(file)?, &table)),
        None => Ok(()),
    }
}

/// A page with another table between its marks.
fn between_marks(page: &str, table: &str) -> String {
    let [first, last] = MARKS;
    let (head, rest) = page.split_once(first).expect("the first mark in the page");
    let (_, tail) = rest.split_once(last).expect("the last mark in the page");
    format!("{head}{first}\n{table}\n{last}{tail}")
}
