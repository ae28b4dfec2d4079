//! The optimiser on standard constrained test problems whose optima are known.

mod adapter;
mod many_variables;
mod minimax;
mod own;
mod several_variables;
mod two_variables;

use std::fmt::Write;

use adapter::{Run, Standard, Start, Status, solve_from};

/// Relative error of f allowed, of 1 + |f*|: a first-order residual r costs about r² over twice
/// the curvature, so that 1e-4, which counts as optimal, costs no more where curvatures exceed
/// 5e-4.
const ABOVE: f64 = 1e-5;
/// By how much f may fall short of f*: what a violation of [`FEASIBLE`] buys at the greatest sum
/// of multipliers, 30 (HS 19), besides.
const BELOW: f64 = 4e-5;
/// Constraints are shares of what is allowed; a millionth of that is the project's own tolerance.
const FEASIBLE: f64 = 1e-6;
/// Error allowed of the least violation of a problem that cannot be solved: as of an objective.
const LEAST: f64 = 1e-5;
/// Distance from the known solution, in ranges of the variables. Points within the tolerances
/// above lie up to 6e-3 away (HS 100).
const NEAR: f64 = 1e-2;

fn all() -> impl Iterator<Item = &'static Standard> {
    two_variables::PROBLEMS
        .iter()
        .chain(several_variables::PROBLEMS)
        .chain(many_variables::PROBLEMS)
        .chain(minimax::PROBLEMS)
        .chain(own::PROBLEMS)
}

/// What is wrong with a run, if anything.
fn fault(problem: &Standard, start: Start, run: &Run) -> Option<String> {
    let mut faults = Vec::new();
    let error = relative_error(problem, run);
    let mut local = false;
    if problem.least_violation > 0.0 {
        if run.status != Status::Infeasible {
            faults.push(format!("called {:?} but is infeasible", run.status));
        }
        if (run.violation - problem.least_violation).abs() > LEAST {
            faults.push(format!("violation {:e}", run.violation));
        }
    } else {
        // With many local optima none can be ruled out.
        let is_found = start == Start::Anywhere && run.status == Status::BestFound;
        if run.status != Status::Optimal && !is_found {
            faults.push(format!("ended {:?}", run.status));
        }
        if run.violation > FEASIBLE {
            faults.push(format!("violation {:.1e}", run.violation));
        }
        local = (start == Start::Published || problem.hidden)
            && problem.local_optima.iter().any(|f| {
                let error = (run.f - f) / (1.0 + f.abs());
                (-BELOW..=ABOVE).contains(&error)
            });
        if !(-BELOW..=ABOVE).contains(&error) && !local {
            faults.push(format!("f = {} for {}", run.f, problem.optimum));
        }
    }
    if let Some(solution) = problem.solution
        && !local
    {
        let distance = problem.distance(&run.x, solution);
        if distance > NEAR {
            faults.push(format!("{distance:.1e} ranges from the solution"));
        }
    }
    (!faults.is_empty()).then(|| faults.join(", "))
}

fn relative_error(problem: &Standard, run: &Run) -> f64 {
    (run.f - problem.optimum) / (1.0 + problem.optimum.abs())
}

/// Solves every problem from one kind of start, prints a table and demands that all are solved.
fn solve_all(title: &str, start: Start, gradients: bool) {
    let mut table = format!(
        "{title}\n{:<26}{:>3}{:>4}{:>7}{:>10}{:>10}{:>10}  {:<11}\n",
        "problem", "n", "c", "eval.", "error f", "violation", "residual", "status"
    );
    let mut unsolved = Vec::new();
    for problem in all() {
        let (n, c) = problem.size();
        let _ = write!(table, "{:<26}{n:>3}{c:>4}", problem.name);
        let fault = match solve_from(problem, start, gradients) {
            Ok(run) => {
                let fault = fault(problem, start, &run);
                let _ = write!(
                    table,
                    "{:>7}{:>10.1e}{:>10.1e}{:>10.1e}  {:<11}",
                    run.evaluations,
                    relative_error(problem, &run),
                    run.violation,
                    run.kkt_residual,
                    format!("{:?}", run.status),
                );
                fault
            }
            Err(failure) => Some(failure),
        };
        if let Some(fault) = fault {
            let _ = write!(table, "  {fault}");
            unsolved.push(format!("{} ({}): {fault}", problem.name, problem.source));
        }
        table.push('\n');
    }
    println!("{table}");
    assert!(
        unsolved.is_empty(),
        "{title}, {} unsolved:\n{}",
        unsolved.len(),
        unsolved.join("\n")
    );
}

#[test]
fn from_the_published_starts() {
    solve_all("From the published starts", Start::Published, false);
}

#[test]
fn from_the_published_starts_with_gradients() {
    solve_all(
        "From the published starts, with gradients",
        Start::Published,
        true,
    );
}

#[test]
fn from_anywhere() {
    solve_all("From anywhere", Start::Anywhere, false);
}

#[test]
fn from_anywhere_with_gradients() {
    solve_all("From anywhere, with gradients", Start::Anywhere, true);
}

/// Every x* lies within the bounds, satisfies the constraints and has f* as its value.
#[test]
fn the_tables_are_consistent() {
    for problem in all() {
        let name = problem.name;
        let n = problem.bounds.len();
        assert_eq!(problem.start.len(), n, "{name}");
        let Some(x) = problem.solution else { continue };
        let within = |(x, [low, high]): (&f64, &[f64; 2])| low <= x && x <= high;
        assert!(
            x.len() == n && x.iter().zip(problem.bounds).all(within),
            "{name}"
        );
        // Solutions are given to nine decimals.
        let error = problem.f(x) - problem.optimum;
        assert!(
            error.abs() < 1e-7 * (1.0 + problem.optimum.abs()),
            "{name}: {error:e}"
        );
        let excess = problem.violation(x) - problem.least_violation;
        assert!(excess.abs() < 1e-7, "{name}: {excess:e}");
        assert!(!(problem.fails)(x), "{name}");
    }
}
