//! What the design procedure hands over.

use super::{
    local::Status,
    problem::{Problem, Variable},
    solve::Solved,
    unmet::Unmet,
};
use crate::{case::Case, evaluate::Evaluation};

/// A trade-off of the procedure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Vertical ride against stroke.
    Vertical,
    /// Stability against curving.
    StabilityCurving,
    /// Lateral ride against stroke.
    Lateral,
}

impl std::fmt::Display for Stage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Vertical => "vertical ride–stroke",
            Self::StabilityCurving => "stability–curving",
            Self::Lateral => "lateral ride–stroke",
        })
    }
}

/// A variable and what was chosen for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// The variable with its bounds.
    pub variable: Variable,
    /// Its value, SI.
    pub value: f64,
    /// Whether it lies on its lower or upper bound.
    pub at_bound: Option<Bound>,
}

/// An end of a variable's range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The lower end.
    Lower,
    /// The upper end.
    Upper,
}

/// What one trade-off gave.
#[derive(Debug, Clone, PartialEq)]
pub struct StageResult {
    /// Which.
    pub stage: Stage,
    /// What was maximised or minimised, subject to what.
    pub goal: String,
    /// What was chosen.
    pub chosen: Vec<Chosen>,
    /// How the search ended.
    pub status: Status,
    /// Residual of the first-order conditions, scaled.
    pub kkt_residual: f64,
    /// Limits that hold the design back.
    pub active: Vec<String>,
    /// Other profiles tried.
    pub alternatives: Vec<Alternative>,
    /// Full-model evaluations, all rounds.
    pub evaluations: usize,
    /// Of which without a result.
    pub failed: usize,
    x: Vec<f64>,
    before: Vec<f64>,
}

/// The best that one of several wheel profiles allows.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternative {
    /// λ.
    pub conicity: f64,
    /// How its search ended.
    pub status: Status,
    /// Critical speed, m/s; `None`: stable over the range searched.
    pub critical_speed: Option<f64>,
    /// Degree curve, degrees.
    pub degree: f64,
    /// K_b, N m/rad.
    pub bending_stiffness: f64,
    /// K_py, N/m.
    pub lateral_stiffness: f64,
}

/// Pieces within this of the largest, or of their limit, count as active: 0.1 %.
const ACTIVE: f64 = 1e-3;

impl StageResult {
    pub(super) fn new(
        stage: Stage,
        problem: &dyn Problem,
        solved: &Solved,
        before: Vec<f64>,
        alternatives: Vec<Alternative>,
    ) -> Self {
        let point = &solved.solution.point;
        let chosen = problem
            .variables()
            .iter()
            .zip(&point.x)
            .map(|(variable, &x)| Chosen {
                variable: variable.clone(),
                value: variable.value(x),
                at_bound: if x <= 0.0 {
                    Some(Bound::Lower)
                } else if x >= 1.0 {
                    Some(Bound::Upper)
                } else {
                    None
                },
            });
        let mut active = Vec::new();
        if let Ok(values) = &point.values {
            let largest = values.objective();
            let objective = values
                .objective
                .iter()
                .filter(|p| values.objective.len() > 1 && p.value > largest - ACTIVE);
            let constraints = values.constraints.iter().filter(|p| p.value > -ACTIVE);
            for piece in objective.chain(constraints) {
                let name = problem.piece_name(piece.index);
                if !active.contains(&name) {
                    active.push(name);
                }
            }
        }
        Self {
            stage,
            goal: problem.goal(),
            chosen: chosen.collect(),
            status: solved.solution.status,
            kkt_residual: solved.solution.kkt_residual,
            active,
            alternatives,
            evaluations: solved.evaluations,
            failed: solved.failed,
            x: point.x.clone(),
            before,
        }
    }

    /// Largest change of a scaled variable, or 1 if the conicity changed between profiles.
    pub(super) fn distance(&self, before: &Case, after: &Case) -> f64 {
        if self.stage == Stage::StabilityCurving
            && !self.alternatives.is_empty()
            && (before.wheel_rail.conicity - after.wheel_rail.conicity).abs() > 0.0
        {
            return 1.0;
        }
        let pairs = self.x.iter().zip(&self.before);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// Replaces stages by those of a later round, adding up the evaluations.
    pub(super) fn merge(stages: &mut Vec<Self>, round: Vec<Self>) {
        for mut later in round {
            if let Some(earlier) = stages.iter_mut().find(|s| s.stage == later.stage) {
                later.evaluations += earlier.evaluations;
                later.failed += earlier.failed;
                if !earlier.alternatives.is_empty() {
                    later.alternatives.append(&mut earlier.alternatives);
                    later
                        .alternatives
                        .sort_by(|a, b| a.conicity.total_cmp(&b.conicity));
                    later
                        .alternatives
                        .dedup_by(|a, b| a.conicity.total_cmp(&b.conicity).is_eq());
                }
                *earlier = later;
            } else {
                stages.push(later);
            }
        }
    }
}

/// A finished design.
#[derive(Debug, Clone)]
pub struct DesignResult {
    /// The case with the designed suspension and profile.
    pub case: Case,
    /// Its performance.
    pub evaluation: Evaluation,
    /// Performance of the case as the spec gave it.
    pub before: Evaluation,
    /// Performance of the design at half the creep coefficients (4.5.4).
    pub half_kalker: Evaluation,
    /// The trade-offs, in the order of the procedure.
    pub stages: Vec<StageResult>,
    /// Rounds of the coupling loop.
    pub rounds: usize,
    /// Whether the last round changed nothing any more.
    pub settled: bool,
    /// What could not be met.
    pub unmet: Vec<Unmet>,
}
