//! Reliability of the global search: how often it comes to the best known design of each of the problems
//! in `problems/`, from twenty seeds.
//!
//! ```sh
//! cargo bench --bench reliability                        # the table, in Markdown
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
    /// Looks for the best designs by other methods, and takes them over into best.json.
    #[arg(long)]
    confirm: bool,
    /// Reads designs of one problem from standard input and answers with their values.
    #[arg(long)]
    serve: bool,
    /// Lists the problems.
    #[arg(long)]
    list: bool,
    /// Given by cargo.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> std::io::Result<()> {
    let options = Options::parse();
    let problems = Problem::all(&options.names);
    if options.serve {
        let exact = problems.iter().find(|p| options.names.contains(&p.name));
        return serve::serve(exact.expect("the name of a problem"));
    }
    let mut known = best::read();
    let mut all = Vec::new();
    for problem in &problems {
        if options.list {
            println!("{}: {}", problem.name, problem.origin);
        } else if options.confirm {
            confirm::confirm(problem, &mut known);
            best::write(&known);
        } else {
            let runs = runs::run(problem, options.seeds, &mut known);
            eprint!(
                "{}",
                runs::table(std::slice::from_ref(&runs))
                    .lines()
                    .nth(2)
                    .unwrap_or_default()
            );
            eprintln!();
            all.push(runs);
        }
    }
    if all.is_empty() {
        return Ok(());
    }
    best::write(&known);
    print!("{}", runs::table(&all));
    match &options.json {
        Some(file) => fs::write(file, serde_json::to_string_pretty(&all)?),
        None => Ok(()),
    }
}
