//! The log of evaluations: counts them, keeps the best.

use std::sync::Mutex;

use rayon::prelude::*;

use super::{
    problem::{Failure, Point, Problem},
    solve::Progress,
};

/// A problem with a log of its evaluations.
pub struct Evaluations<'a> {
    problem: &'a dyn Problem,
    progress: &'a dyn Progress,
    log: Mutex<Log>,
}

#[derive(Default)]
struct Log {
    count: usize,
    failed: usize,
    failure: Option<Failure>,
    best: Option<Point>,
}

impl<'a> Evaluations<'a> {
    /// An empty log.
    pub fn new(problem: &'a dyn Problem, progress: &'a dyn Progress) -> Self {
        Self {
            problem,
            progress,
            log: Mutex::default(),
        }
    }

    /// Number of variables.
    pub fn dimension(&self) -> usize {
        self.problem.variables().len()
    }

    /// Evaluates one design.
    pub fn at(&self, x: &[f64]) -> Point {
        let point = Point {
            x: x.to_vec(),
            values: self.problem.evaluate(x),
        };
        self.progress.evaluated();
        let mut log = self.log.lock().expect("no evaluation panics");
        log.count += 1;
        if let Err(failure) = &point.values {
            log.failed += 1;
            log.failure = Some(failure.clone());
        }
        if log.best.as_ref().is_none_or(|best| point.better_than(best)) {
            log.best = Some(point.clone());
        }
        point
    }

    /// Evaluates several designs side by side.
    pub fn all(&self, designs: &[Vec<f64>]) -> Vec<Point> {
        designs.par_iter().map(|x| self.at(x)).collect()
    }

    /// Number of evaluations so far, and how many of them failed.
    pub fn counts(&self) -> (usize, usize) {
        let log = self.log.lock().expect("no evaluation panics");
        (log.count, log.failed)
    }

    /// Counts evaluations of a derived problem with this one's.
    pub fn add(&self, (count, failed): (usize, usize)) {
        let mut log = self.log.lock().expect("no evaluation panics");
        log.count += count;
        log.failed += failed;
    }

    /// Why a design failed.
    pub fn last_failure(&self) -> Failure {
        let log = self.log.lock().expect("no evaluation panics");
        log.failure
            .clone()
            .unwrap_or_else(|| Failure::Numerical("no design was evaluated".into()))
    }

    /// The best design so far.
    pub fn best(&self) -> Option<Point> {
        self.log.lock().expect("no evaluation panics").best.clone()
    }
}
