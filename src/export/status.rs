//! Statuses of results: a code for programs, words for people.

use crate::{
    design::{
        margin::{Margin, Verdict},
        outcome::DesignResult,
        pareto::{Front, FrontPoint},
    },
    optimize::{local::Status, problem::Failure},
};

/// Code of a failure, in kebab case.
pub fn failure_code(failure: Failure) -> String {
    match serde_json::to_value(failure) {
        Ok(serde_json::Value::String(code)) => code,
        _ => String::new(),
    }
}

/// Code of how a search ended.
pub fn code(status: Status) -> String {
    match status {
        Status::Optimal => "optimal".into(),
        Status::BestFound => "best-found".into(),
        Status::Stalled => "not-converged".into(),
        Status::Infeasible => "infeasible".into(),
        Status::BudgetSpent | Status::Interrupted => "ended-early".into(),
        Status::Failed(failure) => failure_code(failure),
    }
}

/// How a search ended, in words.
pub(crate) fn words(status: Status) -> String {
    match status {
        Status::Optimal => "optimal".into(),
        Status::BestFound => "best found, other optima not ruled out".into(),
        Status::Stalled => "feasible, but not converged to an optimum".into(),
        Status::Infeasible => {
            "demands out of reach: best among the designs of least violation".into()
        }
        Status::BudgetSpent => "the budget of evaluations was spent: best so far".into(),
        Status::Interrupted => "interrupted: best so far".into(),
        Status::Failed(failure) => {
            format!("no design within the bounds could be evaluated ({failure}): left as given")
        }
    }
}

/// Code of a front: whether it ended early, then whether it has points, then whether all of them are
/// optimal.
pub fn of_front(front: &Front) -> String {
    let is_optimal = |point: &FrontPoint| point.explained.status == Status::Optimal;
    match front.failure {
        _ if front.stopped.is_some() => "ended-early".into(),
        Some(failure) => failure_code(failure),
        None if front.points.is_empty() => "infeasible".into(),
        None if front.points.iter().all(is_optimal) => "optimal".into(),
        None => "not-converged".into(),
    }
}

/// Code of a whole run: whether it ended early, then whether all demands are met, then how its
/// searches ended.
pub fn of_run(result: &DesignResult) -> String {
    if result.stopped.is_some() {
        return "ended-early".into();
    }
    if let Some(failure) = result.failure() {
        return failure_code(failure);
    }
    let assessed = |margin: &&Margin| margin.verdict() == Verdict::NotMet;
    if !result.met() {
        return match result.unmet().find(assessed) {
            Some(_) => "infeasible".into(),
            None => "not-assessed".into(),
        };
    }
    let delivered = result.delivered_stages().map(|s| s.explained.status);
    let worse = delivered.filter(|status| *status != Status::Optimal).last();
    code(worse.unwrap_or(Status::Optimal))
}
