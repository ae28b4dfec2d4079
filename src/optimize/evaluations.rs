//! A problem with the designs that have been evaluated for it.

use std::sync::{Mutex, MutexGuard};

use super::{
    archive::{Archive, Stop},
    problem::{Detail, Failure, Point, Problem, by_position},
};

/// A problem and its evaluated designs, in the order in which they were asked for.
pub struct Evaluations<'a> {
    /// The problem.
    pub problem: &'a dyn Problem,
    archive: &'a Archive<'a>,
    points: Mutex<Vec<Point>>,
}

impl<'a> Evaluations<'a> {
    /// No evaluations yet.
    pub fn new(problem: &'a dyn Problem, archive: &'a Archive<'a>) -> Self {
        Self {
            problem,
            archive,
            points: Mutex::default(),
        }
    }

    /// Evaluates one design.
    ///
    /// # Errors
    ///
    /// [`Stop`] if the run is at its end.
    pub fn at(&self, x: &[f64]) -> Result<Point, Stop> {
        let mut points = self.all(&[x.to_vec()])?;
        Ok(points.remove(0))
    }

    /// Evaluates several designs side by side.
    ///
    /// # Errors
    ///
    /// [`Stop`] if the run is at its end; what was still evaluated counts among the points.
    pub fn all(&self, designs: &[Vec<f64>]) -> Result<Vec<Point>, Stop> {
        self.in_detail(designs, Detail::Values)
    }

    /// As [`Evaluations::all`], with gradients where the problem has them.
    ///
    /// # Errors
    ///
    /// As [`Evaluations::all`].
    pub fn graded(&self, designs: &[Vec<f64>]) -> Result<Vec<Point>, Stop> {
        let detail = if self.problem.has_gradients() {
            Detail::Gradients
        } else {
            Detail::Values
        };
        self.in_detail(designs, detail)
    }

    /// As [`Evaluations::graded`], of one design.
    ///
    /// # Errors
    ///
    /// As [`Evaluations::all`].
    pub fn graded_at(&self, x: &[f64]) -> Result<Point, Stop> {
        let mut points = self.graded(&[x.to_vec()])?;
        Ok(points.remove(0))
    }

    fn in_detail(&self, designs: &[Vec<f64>], detail: Detail) -> Result<Vec<Point>, Stop> {
        let outcome = self.archive.measure(self.problem, designs, detail);
        let point = |x: &Vec<f64>, measured: super::archive::Measured| Point {
            x: x.clone(),
            values: measured.map(|pieces| self.problem.judge(&pieces)),
        };
        let new: Vec<Point> = match &outcome {
            Ok(measured) => designs
                .iter()
                .zip(measured)
                .map(|(x, m)| point(x, m.clone()))
                .collect(),
            Err(_) => designs
                .iter()
                .filter_map(|x| Some(point(x, self.archive.known(&self.problem.key(x))?)))
                .collect(),
        };
        let mut points = self.lock();
        for p in &new {
            match points.iter_mut().find(|known| known.x == p.x) {
                None => points.push(p.clone()),
                Some(known) if detail == Detail::Gradients => *known = p.clone(),
                Some(_) => (),
            }
        }
        drop(points);
        outcome.map(|_| new)
    }

    /// Reason of the latest design without values.
    pub fn last_failure(&self) -> Option<Failure> {
        let points = self.lock();
        points
            .iter()
            .rev()
            .find_map(|p| p.values.as_ref().err().copied())
    }

    /// The best design so far.
    pub fn best(&self) -> Option<Point> {
        let points = self.lock();
        let mut best: Option<&Point> = None;
        for point in points.iter() {
            if best.is_none_or(|b| point.better_than(b)) {
                best = Some(point);
            }
        }
        best.cloned()
    }

    /// Evaluated designs by distance from `centre` in the largest coordinate, the nearest first,
    /// `centre` itself left out.
    pub fn around(&self, centre: &[f64]) -> Vec<(f64, Point)> {
        let points = self.lock();
        let distance = |p: &Point| {
            let pairs = p.x.iter().zip(centre);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let mut around: Vec<(f64, Point)> = points
            .iter()
            .map(|p| (distance(p), p))
            .filter(|(distance, _)| *distance > 0.0)
            .map(|(distance, p)| (distance, p.clone()))
            .collect();
        around.sort_by(|(a, p), (b, q)| a.total_cmp(b).then_with(|| by_position(&p.x, &q.x)));
        around
    }

    /// The best designs by merit at a `penalty` for violations, no two closer than `apart` in any
    /// direction, at most `count`.
    pub fn best_apart(&self, penalty: f64, apart: f64, count: usize) -> Vec<Point> {
        let points = self.lock();
        let mut ranked: Vec<(f64, &Point)> = points
            .iter()
            .filter(|p| p.values.is_ok())
            .map(|p| (p.merit(penalty), p))
            .collect();
        // Ties by position: the order of evaluation must not matter.
        ranked.sort_by(|(a, p), (b, q)| a.total_cmp(b).then_with(|| by_position(&p.x, &q.x)));
        let mut chosen: Vec<Point> = Vec::new();
        for (_, point) in ranked {
            if !chosen.iter().any(|other| near(&other.x, &point.x, apart)) {
                chosen.push(point.clone());
                if chosen.len() == count {
                    break;
                }
            }
        }
        chosen
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Point>> {
        // No code panics while it holds the lock.
        self.points
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// True if two designs are within `apart` of each other in every direction.
pub(super) fn near(a: &[f64], b: &[f64], apart: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < apart)
}
