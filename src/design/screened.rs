//! Studies of many conditions: searched in the conditions that matter, judged in all.
//!
//! ```math
//! minimise max_{s ∈ S} f(x, s)   subject to   c(x, s) ≤ 0 for all s ∈ S
//! ```
//!
//! S are the conditions. Few of them hold a design back, whatever their number. The study is solved for
//! a few *working* conditions W ⊂ S, and the solution is evaluated in all of S. Conditions that violate a
//! demand there, or in which an objective is worse than in all of W, join W, the worst of each index at a
//! time, until none is left: the outer approximation of Blankenship and Falk (*Infinitely constrained
//! optimization problems*, Journal of Optimization Theory and Applications 19, 1976). Each solution for W is
//! a lower bound of that for S, so that the last one, which is worst in W, is that for S.
//!
//! From there the study is searched once more, locally and in all conditions: the design delivered, its
//! status and its certificate belong to the whole study. Where demands are out of reach, the largest
//! violation is minimised over all conditions, the following ones over the working conditions.

use super::{compromise::also_missed, missed::Missed, search::Searched, study::Study};
use crate::{
    index::Index,
    optimize::{
        archive::{Archive, Stop},
        local::NARROW,
        problem::{Detail, FEASIBLE, Piece, Problem, Values, largest},
        solve::{Effort, NoDesign, Start, halton},
    },
};

/// Largest number of conditions for which a study is searched in all of them at once.
pub const MANY: usize = 8;
/// Limit on the rounds; then the study is searched in all conditions.
const MAX_ROUNDS: usize = 20;
/// Number of designs spread over the box by which the first working conditions are chosen.
const SPREAD: usize = 4;
/// Least excess over the working conditions with which a condition joins: the last search, in all
/// conditions, removes smaller ones.
const WORSE: f64 = FEASIBLE;
/// Number of conditions without a result that join at a time: none of them is known to be worse.
const FAILING: usize = 3;

/// Result of the search in working conditions.
pub(super) enum Screened {
    /// There are few conditions, or the rounds did not converge: all are to be searched at once.
    All,
    /// No design was found for the working conditions.
    None,
    /// The run ended before the rounds converged: the last solution for some of the conditions.
    Ended(Searched),
    /// The rounds converged.
    Settled(Settled),
}

/// A solution for the working conditions that is valid in all conditions.
pub(super) struct Settled {
    /// The solution, with the effort of all rounds.
    pub found: Searched,
    /// The numbers that its terms have in the whole study.
    pub terms: Vec<usize>,
    /// Start of the search in all conditions.
    pub near: Start,
}

/// Solves a study by `solve` for its working conditions, where it has many.
///
/// # Errors
///
/// As `solve`.
pub(super) fn screened(
    study: &Study,
    start: &Start,
    archive: &Archive,
    solve: impl Fn(&Study, &Start) -> Result<Option<Searched>, NoDesign>,
) -> Result<Screened, NoDesign> {
    let asked = study.conditions_asked();
    if asked.len() <= MANY {
        return Ok(Screened::All);
    }
    let mut working = Working::new(study, &asked, start, archive)?;
    let mut from = start.clone();
    let mut effort = Effort::default();
    let mut last: Option<Searched> = None;
    for _ in 0..MAX_ROUNDS {
        let mut found = match solve(&working.study(), &from) {
            Ok(Some(found)) => found,
            // No design for some conditions, none for all.
            Ok(None) => return Ok(Screened::None),
            // The search in all conditions says why.
            Err(NoDesign::Failed(_)) => break,
            Err(NoDesign::Stopped(stop)) => return ended(last, stop),
        };
        if archive.stopped().is_some() {
            return Ok(Screened::Ended(found));
        }
        let x = found.solved.point.x[..study.parameters().len()].to_vec();
        let joining = match working.joining(&x, archive) {
            Ok(Some(joining)) => joining,
            Ok(None) => break,
            Err(stop) => return ended(Some(found), stop),
        };
        if joining.is_empty() {
            found.solved.effort.add(&effort);
            let near = Start {
                everywhere: None,
                designs: vec![x],
                radius: NARROW,
            };
            return Ok(Screened::Settled(Settled {
                found,
                terms: working.terms(),
                near,
            }));
        }
        effort.add(&found.solved.effort);
        working.conditions.extend(joining);
        from = start.clone().with(vec![x]);
        last = Some(found);
    }
    Ok(Screened::All)
}

/// The last solution for working conditions as that of a run that has ended.
fn ended(last: Option<Searched>, stop: Stop) -> Result<Screened, NoDesign> {
    let mut last = last.ok_or(NoDesign::Stopped(stop))?;
    last.solved.status = stop.into();
    Ok(Screened::Ended(last))
}

impl Settled {
    /// Result of a local search in all conditions, with the effort of the rounds; if the run ended before
    /// that search, the solution for the working conditions.
    ///
    /// # Errors
    ///
    /// [`NoDesign`] if that search could evaluate no design.
    pub fn finish(self, whole: Result<Searched, NoDesign>) -> Result<Searched, NoDesign> {
        match whole {
            Ok(mut whole) => {
                whole.solved.effort.add(&self.found.solved.effort);
                whole.solved.followed_from(&self.found.solved);
                Ok(whole)
            }
            Err(NoDesign::Stopped(stop)) => {
                let mut found = self.found;
                found.solved.status = stop.into();
                Ok(found)
            }
            Err(failed) => Err(failed),
        }
    }

    /// Demands of the whole study that are missed.
    pub fn missed(&self, study: &Study) -> Vec<Missed> {
        let own = self.found.missed.iter().map(|missed| Missed {
            term: self.terms[missed.term],
            ..missed.clone()
        });
        let mut missed: Vec<Missed> = own.collect();
        missed.extend(also_missed(study, &missed, &self.near.designs[0]));
        missed
    }
}

/// The conditions for which a study is solved.
struct Working<'a> {
    study: &'a Study,
    conditions: Vec<usize>,
}

impl<'a> Working<'a> {
    /// The first of the conditions `asked` (the nominal one, if it has demands), and the worst conditions at
    /// the starts and, for a global search, at some other designs.
    fn new(
        study: &'a Study,
        asked: &[usize],
        start: &Start,
        archive: &Archive,
    ) -> Result<Self, Stop> {
        let n = study.variables().len();
        let others = if start.everywhere.is_some() {
            SPREAD
        } else {
            0
        };
        let spread = (1..=others).map(|i| halton(i, n));
        let designs: Vec<Vec<f64>> = start.designs.iter().cloned().chain(spread).collect();
        let mut working = Self {
            study,
            conditions: asked[..1].to_vec(),
        };
        // A design without a result in some condition tells no worst.
        let measured = archive.measure(study, &designs, Detail::Values)?;
        for pieces in measured.into_iter().flatten() {
            let worst = working.worse(&study.judge(&pieces), |_, _| f64::NEG_INFINITY);
            working.conditions.extend(worst);
        }
        Ok(working)
    }

    fn contains(&self, condition: usize) -> bool {
        self.conditions.contains(&condition)
    }

    fn is_working(&self, piece: &Piece) -> bool {
        self.contains(self.study.terms()[self.study.term_of(piece.index)].condition)
    }

    /// Numbers of the terms in the working conditions.
    fn terms(&self) -> Vec<usize> {
        let terms = self.study.terms().iter().enumerate();
        terms
            .filter(|(_, term)| self.contains(term.condition))
            .map(|(i, _)| i)
            .collect()
    }

    /// The study in the working conditions.
    fn study(&self) -> Study {
        let study = self.study;
        study.with_roles(|_, term| self.contains(term.condition).then_some(term.role))
    }

    /// Conditions to join after a solution; empty if it is valid in all. `None` if a working condition has
    /// no result: a term without a value anywhere was left out.
    fn joining(&self, x: &[f64], archive: &Archive) -> Result<Option<Vec<usize>>, Stop> {
        let measured = archive.measure(self.study, &[x.to_vec()], Detail::Values)?;
        let Some(Ok(pieces)) = measured.into_iter().next() else {
            let failing = self.study.failing(x);
            if failing.is_empty() || failing.iter().any(|condition| self.contains(*condition)) {
                return Ok(None);
            }
            let step = failing.len().div_ceil(FAILING);
            return Ok(Some(failing.into_iter().step_by(step).collect()));
        };
        let own = |pieces: &[Piece]| {
            let own = pieces.iter().filter(|piece| self.is_working(piece));
            largest(&own.cloned().collect::<Vec<_>>())
        };
        let values = self.study.judge(&pieces);
        // Where demands are out of reach, a condition joins only with a larger violation.
        let violated = own(&values.constraints).max(FEASIBLE);
        Ok(Some(self.worse(&values, |group, pieces| match group {
            Some(_) => own(pieces) + WORSE,
            None => violated + WORSE,
        })))
    }

    /// The worst condition beside the working ones of each index in each role, as far as it is worse than a
    /// bar: that of an objective by number, or of the constraints.
    fn worse(&self, values: &Values, bar: impl Fn(Option<usize>, &[Piece]) -> f64) -> Vec<usize> {
        let mut worst: Vec<(Option<usize>, Index, f64, usize)> = Vec::new();
        let groups = values.objectives.iter().enumerate();
        let groups = groups.map(|(group, pieces)| (Some(group), pieces));
        for (group, pieces) in groups.chain([(None, &values.constraints)]) {
            let bar = bar(group, pieces);
            let open = pieces.iter().filter(|piece| !self.is_working(piece));
            for piece in open.filter(|piece| piece.value > bar) {
                let term = &self.study.terms()[self.study.term_of(piece.index)];
                let known = worst
                    .iter_mut()
                    .find(|(g, index, ..)| *g == group && *index == term.index);
                match known {
                    Some((.., value, condition)) if piece.value > *value => {
                        (*value, *condition) = (piece.value, term.condition);
                    }
                    Some(_) => {}
                    None => worst.push((group, term.index, piece.value, term.condition)),
                }
            }
        }
        let mut conditions: Vec<usize> = worst.into_iter().map(|(.., c)| c).collect();
        conditions.sort_unstable();
        conditions.dedup();
        conditions
    }
}
