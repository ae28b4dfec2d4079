//! The log of evaluations: counts them, keeps the best.

use std::{cmp::Ordering, sync::Mutex};

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
    /// Every design evaluated, in no particular order.
    points: Vec<Point>,
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
        log.points.push(point.clone());
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
        let log = self.log.lock().expect("no evaluation panics");
        let better = |a: &&Point, b: &&Point| {
            if a.better_than(b) {
                Ordering::Less
            } else {
                Ordering::Greater
            }
        };
        log.points.iter().min_by(better).cloned()
    }

    /// The best designs by merit at a `penalty` for violations, no two closer than `apart` in any
    /// direction, at most `count`.
    pub fn best_apart(&self, penalty: f64, apart: f64, count: usize) -> Vec<Point> {
        let log = self.log.lock().expect("no evaluation panics");
        let mut ranked: Vec<(f64, &Point)> = log
            .points
            .iter()
            .filter(|p| p.values.is_ok())
            .map(|p| (p.merit(penalty), p))
            .collect();
        // Ties by position: the order of evaluation must not matter.
        ranked.sort_by(|(a, p), (b, q)| {
            a.total_cmp(b).then_with(|| {
                let pairs = p.x.iter().zip(&q.x);
                pairs
                    .map(|(x, y)| x.total_cmp(y))
                    .find(|o| o.is_ne())
                    .unwrap_or(Ordering::Equal)
            })
        });
        let mut chosen: Vec<Point> = Vec::new();
        for (_, point) in ranked {
            let near = |other: &Point| {
                other
                    .x
                    .iter()
                    .zip(&point.x)
                    .all(|(a, b)| (a - b).abs() < apart)
            };
            if !chosen.iter().any(near) {
                chosen.push(point.clone());
                if chosen.len() == count {
                    break;
                }
            }
        }
        chosen
    }
}
