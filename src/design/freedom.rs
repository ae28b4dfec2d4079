//! Freedom around an optimum: the range of every variable over which a design keeps all
//! demands and loses little of each objective, the other variables chosen anew.
//!
//! ```math
//! min, max x_i   subject to   Σ_{k ∈ G} max_j f_kj(x) ≤ F_G + a_G,   c_j(x) ≤ 0,   0 ≤ x ≤ 1
//! ```
//!
//! An objective of one index may get worse by a share p of the index: a = w ln(1 + p) for a weight w,
//! a = 3 w p |ζ| for damping ratios. A sum of several may get worse by p itself, as it is a sum of relative
//! changes. Trade-offs in turn are a goal each; all at once is one.

use rayon::prelude::*;

use super::{
    explain::{Objective, objective_of},
    recovery::with_values,
    study::Study,
};
use crate::{
    case::Case,
    index::{Index, Scale, Sense},
    optimize::{
        archive::{Archive, Stop},
        problem::{Problem, Values, largest, onto_bound},
        solve::Start,
        within::{Aim, Goal, Near, Reached},
    },
    parameter::Parameter,
};

/// Scaled distance from an end of a range within which a coordinate is at it.
const AT_BOUND: f64 = 1e-6;
/// Rounding of a scaled coordinate: the ratio of two logarithms.
const COORDINATE_ROUNDING: f64 = 1e-12;
/// Scaled distance within which two ends are the same.
const SAME_END: f64 = 1e-4;

/// An end of the range over which a variable is free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// Value, SI.
    pub value: f64,
    /// Certainty of the end.
    pub kind: EndKind,
}

/// Certainty of an end of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndKind {
    /// The bound of the design space.
    Bound,
    /// A demand or the objective ends the range: the first-order conditions hold.
    Verified,
    /// A design that keeps all demands has this value; the search ended without its first-order
    /// conditions, so the range may reach further.
    AtLeast,
}

/// The range over which a variable is free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Free {
    /// Variable.
    pub parameter: Parameter,
    /// The lower and the upper end.
    pub ends: [End; 2],
}

/// Loss of a goal against the optimum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loss {
    /// Name of the goal: its index, the smaller margin of two, or a sum.
    pub goal: &'static str,
    /// The index, where the goal is a single one.
    pub index: Option<Index>,
    /// Relative loss of the index, or loss of the sum; negative for a gain.
    pub share: f64,
}

/// A goal at the optimum.
#[derive(Debug, Clone)]
struct Target {
    groups: Vec<usize>,
    /// Its sum, scaled.
    merit: f64,
    /// The single index, SI.
    objective: Option<Objective>,
}

impl Target {
    /// Change of the merit per relative change of the index; 1 for a sum.
    fn per_share(&self) -> f64 {
        self.objective
            .map_or(1.0, |o| (o.value / o.per_merit).abs())
    }

    fn is_logarithmic(&self) -> bool {
        self.objective
            .is_some_and(|o| o.index.scale() == Scale::Logarithmic)
    }

    /// The most that the merit may get worse by.
    fn allowance(&self, share: f64) -> f64 {
        let shares = if self.is_logarithmic() {
            share.ln_1p()
        } else {
            share
        };
        shares * self.per_share()
    }

    /// Loss in merit.
    fn loss(&self, merit: f64) -> Loss {
        let shares = (merit - self.merit) / self.per_share();
        let index = self.objective.map(|o| o.index);
        Loss {
            goal: match index {
                Some(index) => index.words(),
                None if self.groups.len() > 1 => "sum of relative changes",
                None => "smaller margin",
            },
            index,
            share: match index.map(Index::sense) {
                Some(Sense::AtLeast) if self.is_logarithmic() => -(-shares).exp_m1(),
                Some(Sense::AtMost) if self.is_logarithmic() => shares.exp_m1(),
                _ => shares,
            },
        }
    }
}

/// The designs around an optimum that keep all demands.
pub struct Neighbourhood {
    /// The epigraph study where the critical speed is an objective: all of its pieces are smooth.
    study: Study,
    /// Scaled coordinates of the optimum in it.
    optimum: Vec<f64>,
    targets: Vec<Target>,
}

impl Neighbourhood {
    /// Designs around that of a case, the solution of a study. Its objectives are one goal `together`, or
    /// each is a goal. `None` if no parameter varies or the design has no performance.
    pub fn new(study: &Study, case: &Case, together: bool) -> Option<Self> {
        if study.parameters().is_empty() {
            return None;
        }
        let mut study = study.without_epigraph();
        let x: Vec<f64> = study
            .coordinates(case)
            .into_iter()
            .map(|x| onto_bound(x, COORDINATE_ROUNDING))
            .collect();
        let values = study.evaluate(&x).or_else(|failure| {
            study = with_values(&study, &Start::near(vec![x.clone()]));
            if study.terms().is_empty() {
                Err(failure)
            } else {
                study.evaluate(&x)
            }
        });
        let values = values.ok()?;
        let targets = targets(&study, &values, together);
        if targets.is_empty() {
            return None;
        }
        let (study, optimum) = match study.with_epigraph() {
            Some(own) => (own, study.epigraph_start(&x).ok()?),
            None => (study, x),
        };
        Some(Self {
            study,
            optimum,
            targets,
        })
    }

    /// The study that its coordinates belong to.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// Scaled coordinates of the optimum.
    pub fn optimum(&self) -> &[f64] {
        &self.optimum
    }

    /// The goals with an allowance: a share of each index, or of a sum of relative changes.
    pub fn goals(&self, share: f64) -> Vec<Goal> {
        let targets = self.targets.iter();
        let goals = targets.map(|target| Goal {
            groups: target.groups.clone(),
            most: target.merit + target.allowance(share),
        });
        goals.collect()
    }

    /// Loss of each goal at a case. `None` if it has no performance.
    pub fn losses(&self, case: &Case) -> Option<Vec<Loss>> {
        let plain = self.study.without_epigraph();
        let values = plain.evaluate(&plain.coordinates(case)).ok()?;
        let losses = self.targets.iter().map(|target| {
            let merit = sum(&values, &target.groups)?;
            Some(target.loss(merit))
        });
        losses.collect()
    }

    /// The range of every variable over which a design loses at most `share` of each goal; designs that
    /// are `known` to keep all demands and that loss lie in it. The variables whose searches a run that
    /// ended early did not come to are left out.
    pub fn ranges(&self, share: f64, known: &[Case], archive: &Archive) -> Vec<Free> {
        let goals = self.goals(share);
        let near = Near {
            problem: &self.study,
            goals: &goals,
            archive,
        };
        let both = |i: usize| Ok([self.end(&near, i, 0.0)?, self.end(&near, i, 1.0)?]);
        let all = 0..self.study.parameters().len();
        let ends: Vec<Result<[Option<Reached>; 2], Stop>> = if archive.has_budget() {
            all.map(both).collect()
        } else {
            all.into_par_iter().map(both).collect()
        };
        let ends: Vec<[Option<Reached>; 2]> = ends.into_iter().map_while(Result::ok).collect();
        let known: Vec<Vec<f64>> = known
            .iter()
            .map(|case| self.study.coordinates(case))
            .collect();
        let reached = ends.iter().flatten().flatten().map(|reached| &reached.x);
        let met: Vec<&Vec<f64>> = reached.chain([&self.optimum]).chain(&known).collect();
        let free = ends.iter().enumerate().map(|(i, ends)| Free {
            parameter: self.study.parameters()[i],
            ends: [0, 1].map(|k| {
                // A design that another search met may lie further out.
                let all = met.iter().map(|x| x[i]);
                let x = if k == 0 {
                    all.fold(1.0, f64::min)
                } else {
                    all.fold(0.0, f64::max)
                };
                let verified = ends[k]
                    .as_ref()
                    .is_some_and(|end| end.is_optimal && (end.x[i] - x).abs() <= SAME_END);
                let bound = if k == 0 { x } else { 1.0 - x };
                End {
                    value: self.study.variables()[i].value(x),
                    kind: match (bound <= AT_BOUND, verified) {
                        (true, _) => EndKind::Bound,
                        (false, true) => EndKind::Verified,
                        (false, false) => EndKind::AtLeast,
                    },
                }
            }),
        });
        free.collect()
    }

    /// The design whose coordinate `i` is nearest to `bound`; `None` where no search improves on the
    /// optimum.
    fn end(&self, near: &Near, i: usize, bound: f64) -> Result<Option<Reached>, Stop> {
        let n = self.optimum.len();
        let is_there = (self.optimum[i] - bound).abs() <= AT_BOUND;
        if is_there {
            return Ok(None);
        }
        let aim = if bound > 0.0 {
            Aim::greatest(i, n)
        } else {
            Aim::least(i, n)
        };
        near.best(&aim, &self.optimum, &[])
    }
}

fn targets(study: &Study, values: &Values, together: bool) -> Vec<Target> {
    let count = values.objectives.len();
    let goals: Vec<Vec<usize>> = match (count, together) {
        (0, _) => Vec::new(),
        (_, true) => vec![(0..count).collect()],
        (_, false) => (0..count).map(|group| vec![group]).collect(),
    };
    let targets = goals.into_iter().filter_map(|groups| {
        let objective = match &groups[..] {
            [group] => objective_of(study, &values.objectives[*group]),
            _ => None,
        };
        Some(Target {
            merit: sum(values, &groups)?,
            objective,
            groups,
        })
    });
    targets.collect()
}

/// Σ of the largest pieces of some groups; `None` if one has none.
fn sum(values: &Values, groups: &[usize]) -> Option<f64> {
    let pieces = groups.iter().map(|group| values.objectives.get(*group));
    let largest = pieces.map(|pieces| pieces.map(|pieces| largest(pieces)));
    largest.sum()
}
