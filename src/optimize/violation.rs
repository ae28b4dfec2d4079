//! What comes closest to meeting constraints that cannot all be met.

use super::{
    archive::{Archive, Measured},
    evaluations::Evaluations,
    local::{self, Found, Status},
    problem::{Detail, Failure, Key, Piece, Point, Problem, Values, Variable},
};

/// The constraints of a problem as its objective: what comes closest to meeting them.
struct Violation<'a>(&'a dyn Problem);

impl Problem for Violation<'_> {
    fn variables(&self) -> &[Variable] {
        self.0.variables()
    }

    fn piece_name(&self, index: usize) -> String {
        self.0.piece_name(index)
    }

    fn key(&self, x: &[f64]) -> Key {
        self.0.key(x)
    }

    fn measure(&self, x: &[f64], detail: Detail) -> Measured {
        self.0.measure(x, detail)
    }

    fn has_gradients(&self) -> bool {
        self.0.has_gradients()
    }

    fn judge(&self, measured: &[Piece]) -> Values {
        Values {
            objectives: vec![self.0.judge(measured).constraints],
            constraints: Vec::new(),
        }
    }
}

/// Reduces the largest violation as far as it goes. The certificate is that of the reduction: its
/// objective multipliers tell which constraints conflict.
pub(super) fn least_violation(problem: &dyn Problem, archive: &Archive, from: Found) -> Found {
    let relaxed = Violation(problem);
    let evaluations = Evaluations::new(&relaxed, archive);
    let Ok(start) = evaluations.at(&from.point.x) else {
        return from;
    };
    let found = local::search(&evaluations, start, local::WIDE, &[]);
    let status = match found.status {
        status @ (Status::BudgetSpent | Status::Interrupted) => status,
        _ => Status::Infeasible,
    };
    let values = archive
        .known(&problem.key(&found.point.x))
        .map(|measured| measured.map(|pieces| problem.judge(&pieces)));
    let point = Point {
        x: found.point.x,
        values: values.unwrap_or(Err(Failure::NotFinite)),
    };
    if point.feasible() {
        // The reduction found what the search had missed: it goes on from there.
        let evaluations = Evaluations::new(problem, archive);
        return local::search(&evaluations, point, local::NARROW, &[]);
    }
    if from.point.better_than(&point) {
        return from;
    }
    Found {
        point,
        status,
        certificate: found.certificate,
    }
}
