//! Evaluating groups of points side by side, in an order that no thread changes.

use std::{
    collections::BTreeMap,
    sync::atomic::{AtomicBool, Ordering},
};

use rayon::prelude::*;

use crate::optimize::{
    archive::{Progress, Silent},
    problem::Failure,
};

/// One output of a function at a point.
pub type Outcome = Result<f64, Failure>;

/// Sensitivity of one output.
#[derive(Debug, Clone, PartialEq)]
pub struct Output<E> {
    /// Mean and standard deviation over the sample; `None` where fewer than two evaluations
    /// succeeded.
    pub moments: Option<[f64; 2]>,
    /// Failed evaluations by kind.
    pub failures: BTreeMap<Failure, usize>,
    /// Effects by factor; `None` where too many evaluations failed.
    pub effects: Vec<Option<E>>,
}

/// Observer and interrupt of a run.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Ends the run when set.
    pub interrupt: Option<&'a AtomicBool>,
    /// Is told of every evaluation.
    pub progress: &'a dyn Progress,
}

impl Default for Watch<'_> {
    /// Nobody watches.
    fn default() -> Self {
        Self {
            interrupt: None,
            progress: &Silent,
        }
    }
}

impl Watch<'_> {
    fn interrupted(&self) -> bool {
        self.interrupt
            .is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}

/// Outputs of one group of points: by point, then by output.
pub(super) type Group = Vec<Vec<Outcome>>;

/// Groups that are started together: an interrupted run loses no more than these.
const BLOCK: usize = 16;

/// Evaluates a function at the points of groups 0 to `groups` − 1. Where the run is interrupted the
/// leading groups that are whole remain: the same that a shorter run would have given.
pub(super) fn evaluate<F>(
    function: &F,
    groups: usize,
    points: impl Fn(usize) -> Vec<Vec<f64>> + Sync,
    watch: &Watch,
) -> Vec<Group>
where
    F: Fn(&[f64]) -> Vec<Outcome> + Sync + ?Sized,
{
    let outcomes = |x: &Vec<f64>| -> Option<Vec<Outcome>> {
        if watch.interrupted() {
            return None;
        }
        let outcomes = function(x).into_iter().map(finite).collect();
        watch.progress.evaluated();
        Some(outcomes)
    };
    let mut done = Vec::with_capacity(groups);
    while done.len() < groups {
        let end = (done.len() + BLOCK).min(groups);
        let block: Vec<Option<Group>> = (done.len()..end)
            .into_par_iter()
            .map(|i| points(i).par_iter().map(outcomes).collect())
            .collect();
        done.extend(block.into_iter().map_while(|group| group));
        if done.len() < end {
            break;
        }
    }
    done
}

/// A number that is none is a failure.
fn finite(outcome: Outcome) -> Outcome {
    outcome.and_then(|value| {
        if value.is_finite() {
            Ok(value)
        } else {
            Err(Failure::NotFinite)
        }
    })
}

/// Failures of one output by kind.
pub(super) fn failures(groups: &[Group], output: usize) -> BTreeMap<Failure, usize> {
    let mut failures = BTreeMap::new();
    for point in groups.iter().flatten() {
        if let Err(failure) = point[output] {
            *failures.entry(failure).or_default() += 1;
        }
    }
    failures
}

/// Mean and standard deviation of values; `None` if there are fewer than two.
pub(super) fn moments(values: impl Iterator<Item = f64> + Clone) -> Option<[f64; 2]> {
    let n = values.clone().count();
    if n < 2 {
        return None;
    }
    let mean = values.clone().sum::<f64>() / n as f64;
    let squares: f64 = values.map(|v| (v - mean).powi(2)).sum();
    Some([mean, (squares / (n - 1) as f64).sqrt()])
}
