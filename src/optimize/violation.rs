//! Least violation of constraints that cannot all be met.

use super::{
    archive::{Archive, Measured},
    evaluations::Evaluations,
    local::{self, Found, Status},
    problem::{Detail, Failure, Key, Piece, Point, Problem, Values, Variable},
};

/// Relaxation of a problem: its largest constraint is the objective.
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

/// Local search for the least of the largest violation, from a design. The certificate is that of the
/// relaxation: its objective multipliers name the conflicting constraints.
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
        // The relaxation found a feasible design: the search goes on from there.
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
