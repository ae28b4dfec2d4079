//! The best compromise where demands cannot all be met: the best objective among the designs of
//! least violation.
//!
//! ```math
//! lex min (v₁, v₂, …, f),   v₁ ≥ v₂ ≥ … the relative violations of the demands
//! ```
//!
//! The largest violation is minimised first. Demands that hold one another at that minimum, by the
//! multipliers of the minimax problem, are relaxed to what they reach; the largest violation of the
//! rest is minimised next, and so on until the rest can be met (the lexicographic minimax of
//! Behringer, *A simplex based algorithm for the lexicographically extended linear maxmin problem*,
//! European Journal of Operational Research 7, 1981). The objective decides among the designs that
//! remain.
//!
//! Forces and strokes in a curve are assessed only where the linear model covers the curve. Where
//! they are asked for, the other demands come first; then the curve is brought as far within the
//! model as they allow. If it is within, the demands on forces and strokes count as the others do, and
//! all are weighed together; if not, they are left out.

use super::{
    epigraph::{EpigraphSolution, solve_with_epigraph},
    missed::{Missed, Reached},
    study::{Rank, Role, Study, Term},
};
use crate::optimize::{
    archive::Archive,
    certificate::{Certificate, HOLDS},
    local::Status,
    problem::{Point, Problem, Values, largest},
    solve::{Effort, NoDesign, Solved, Start},
};

/// The best compromise of a study, from a solution that misses some of its demands: the solution of
/// the study with relaxed bounds, and the demands that are missed.
///
/// # Errors
///
/// [`NoDesign`] if no design could be evaluated.
pub fn compromise(
    study: &Study,
    start: &Start,
    found: &Solved,
    archive: &Archive,
) -> Result<(EpigraphSolution, Vec<Missed>), NoDesign> {
    let n = study.parameters().len();
    let mut descent = Descent {
        study,
        start,
        archive,
        x: found.point.x[..n].to_vec(),
        missed: Vec::new(),
        effort: found.effort.clone(),
    };
    let mut within = true;
    if study
        .demands()
        .any(|i| study.terms()[i].rank() == Rank::Coverage)
    {
        descent.reduce(&[Rank::Plain], &[])?;
        descent.reduce(&[Rank::Coverage], &[Rank::Plain])?;
        let is_outside = |m: &Missed| study.terms()[m.term].implied && !m.met();
        within = !descent.missed.iter().any(is_outside);
    }
    if within {
        // The curve can be covered: forces and strokes in it count as the rest do.
        descent.missed.clear();
        descent.reduce(&[Rank::Plain, Rank::InCurve], &[Rank::Coverage])?;
    }
    let Descent {
        x, missed, effort, ..
    } = descent;
    let mut found = best_beside(study, start, x, missed, archive)?;
    found.0.solved.effort.add(&effort);
    Ok(found)
}

/// The best objective with missed demands relaxed, from the design at `x`, which misses no others; and
/// these demands with the values reached there.
///
/// # Errors
///
/// [`NoDesign`] if no design could be evaluated.
pub fn best_beside(
    study: &Study,
    start: &Start,
    x: Vec<f64>,
    mut missed: Vec<Missed>,
    archive: &Archive,
) -> Result<(EpigraphSolution, Vec<Missed>), NoDesign> {
    let n = study.parameters().len();
    let mut last = best_of_relaxed(&relax(study, &missed), start, x, archive)?;
    for missed in &mut missed {
        let alone = study.with_roles(|i, term| (i == missed.term).then_some(as_objective(term)));
        missed.reached = Reached::new(&alone, &last.solved.point.x[..n]).value(0);
    }
    let unmet = missed.iter().any(|missed| !missed.met());
    let ended = matches!(
        last.solved.status,
        Status::BudgetSpent | Status::Interrupted
    );
    if unmet && !ended {
        last.solved.status = Status::Infeasible;
    }
    Ok((last, missed))
}

/// Demands of a study that are missed at `x` beside known missed ones. They have no share in the
/// conflict and form a group of their own behind the known ones.
pub fn also_missed(study: &Study, known: &[Missed], x: &[f64]) -> Vec<Missed> {
    let group = known.iter().map(|missed| missed.group + 1).max();
    let open = study.with_roles(|i, term| {
        let is_known = known.iter().any(|missed| missed.term == i);
        let is_demand = matches!(term.role, Role::Constraint { .. });
        (is_demand && !is_known).then(|| as_objective(term))
    });
    let others = study
        .demands()
        .filter(|i| known.iter().all(|missed| missed.term != *i));
    let reached = Reached::new(&open, x);
    let all = others.enumerate().map(|(k, term)| {
        let group = group.unwrap_or_default();
        reached.unheld(study, [term, k], group)
    });
    // A shortfall within the tolerance would leave no design either.
    all.filter(|missed| missed.violation() > 0.0).collect()
}

/// The lexicographic minimax on its way.
struct Descent<'a> {
    study: &'a Study,
    start: &'a Start,
    archive: &'a Archive<'a>,
    /// Scaled coordinates of the design that it has come to.
    x: Vec<f64>,
    missed: Vec<Missed>,
    effort: Effort,
}

impl Descent<'_> {
    /// Lexicographic minimax of the violations of the demands of some ranks, the largest first, with the
    /// demands of other ranks as constraints.
    fn reduce(&mut self, ranks: &[Rank], kept: &[Rank]) -> Result<(), NoDesign> {
        let n = self.x.len();
        while self.archive.stopped().is_none() {
            let (open, terms) = open_shortfall(self.study, ranks, kept, &self.missed);
            if terms.is_empty() {
                break;
            }
            let from = self.start.clone().with(vec![self.x.clone()]);
            let closest = solve_with_epigraph(&open, &from, self.archive)?;
            self.effort.add(&closest.solved.effort);
            self.x = closest.solved.point.x[..n].to_vec();
            let held = match &closest.solved.point.values {
                Ok(values) if values.objective() > 0.0 => holding(&closest, values, terms.len()),
                _ => break,
            };
            let group = self.missed.last().map_or(0, |missed| missed.group + 1);
            let reached = Reached::new(&open, &self.x);
            let missed = held.into_iter();
            let missed =
                missed.map(|(k, share)| reached.missed(self.study, [terms[k], k], group, share));
            self.missed.extend(missed);
        }
        Ok(())
    }
}

/// Scaled coordinates of a design that meets all demands of a study, searched from one that does not;
/// `None` if the search finds none.
///
/// # Errors
///
/// [`NoDesign`] if no design could be evaluated.
pub fn feasible(
    study: &Study,
    start: &Start,
    found: &Solved,
    archive: &Archive,
) -> Result<Option<Vec<f64>>, NoDesign> {
    let n = study.parameters().len();
    let from = start.clone().with(vec![found.point.x[..n].to_vec()]);
    let closest = solve_with_epigraph(&shortfall(study), &from, archive)?;
    let x = closest.solved.point.x[..n].to_vec();
    let meets_all = study.evaluate(&x).is_ok_and(|values| values.feasible());
    Ok(meets_all.then_some(x))
}

/// The best objective within relaxed bounds, which the design at `x` keeps.
fn best_of_relaxed(
    relaxed: &Study,
    start: &Start,
    x: Vec<f64>,
    archive: &Archive,
) -> Result<EpigraphSolution, NoDesign> {
    let start = start.clone().plainly().with(vec![x.clone()]);
    let found = solve_with_epigraph(relaxed, &start, archive)?;
    let values = relaxed.evaluate(&x);
    if found.solved.point.feasible() || !values.as_ref().is_ok_and(Values::feasible) {
        return Ok(found);
    }
    // The search has lost the design that it began from.
    Ok(EpigraphSolution {
        study: relaxed.clone(),
        solved: Solved {
            point: Point { x, values },
            status: Status::Stalled,
            certificate: None,
            ..found.solved
        },
    })
}

/// The demands of a study as its objective: the largest relative shortfall.
pub fn shortfall(study: &Study) -> Study {
    study.with_roles(|_, term| match term.role {
        Role::Objective { .. } => None,
        Role::Constraint { .. } => Some(as_objective(term)),
    })
}

/// The role of a demand whose shortfall is to be as small as can be.
fn as_objective(term: &Term) -> Role {
    match term.role {
        Role::Constraint { bound } => Role::Objective {
            group: 0,
            weight: 1.0,
            origin: bound,
        },
        objective @ Role::Objective { .. } => objective,
    }
}

/// Study with the demands of some ranks that are not yet missed as the objective, and the demands of
/// other ranks, and missed ones with relaxed bounds, as constraints; with the numbers, in the original
/// study, of the objective's terms, which come first.
fn open_shortfall(
    study: &Study,
    ranks: &[Rank],
    kept: &[Rank],
    missed: &[Missed],
) -> (Study, Vec<usize>) {
    let known = |i: usize| missed.iter().find(|m| m.term == i);
    let is_open = |i: &usize| {
        let term = &study.terms()[*i];
        ranks.contains(&term.rank()) && known(*i).is_none() && !is_void(study, term, missed)
    };
    let terms: Vec<usize> = study.demands().filter(is_open).collect();
    let open = study.with_roles(|i, term| terms.contains(&i).then(|| as_objective(term)));
    let bounds = study.with_roles(|i, term| match known(i) {
        _ if matches!(term.role, Role::Objective { .. }) => None,
        Some(missed) => relaxed_role(missed),
        None => kept.contains(&term.rank()).then_some(term.role),
    });
    (open.and_terms_of(&bounds), terms)
}

/// True if the model does not cover a term: it is a force or stroke in a curve that is not brought
/// within the model.
fn is_void(study: &Study, term: &Term, missed: &[Missed]) -> bool {
    let is_outside = |m: &Missed| {
        let other = &study.terms()[m.term];
        other.implied && other.condition == term.condition && !m.met()
    };
    term.index.is_in_service_curve() && missed.iter().any(is_outside)
}

/// The study with the bounds of missed demands relaxed to the values reached. Terms that the model does
/// not cover, and missed demands without a value, are left out.
fn relax(study: &Study, missed: &[Missed]) -> Study {
    study.with_roles(|i, term| match missed.iter().find(|m| m.term == i) {
        _ if is_void(study, term, missed) => None,
        Some(missed) => relaxed_role(missed),
        None => Some(term.role),
    })
}

fn relaxed_role(missed: &Missed) -> Option<Role> {
    let bound = missed.relaxed_bound()?;
    Some(Role::Constraint { bound })
}

/// Objective terms, by number, that hold one another at the least shortfall, with their shares.
fn holding(closest: &EpigraphSolution, values: &Values, terms: usize) -> Vec<(usize, f64)> {
    /// Without multipliers, as where no variable is left: shortfalls within this of the largest.
    const NEAR: f64 = 1e-3;
    let certificate = closest.solved.certificate.as_ref();
    let certificate = certificate.filter(|certificate| {
        !closest.study.parameters().is_empty() && certificate.is_of(&closest.solved.point)
    });
    let mut shares = vec![0.0; terms];
    for (group, pieces) in values.objectives.iter().enumerate() {
        let worst = largest(pieces);
        for (k, piece) in pieces.iter().enumerate() {
            let share = match certificate {
                Some(certificate) => certificate.objective_multipliers[group][k],
                None => f64::from(u8::from(piece.value > worst - NEAR)),
            };
            shares[closest.study.term_of(piece.index)] += share;
        }
    }
    if let Some(certificate) = certificate {
        share_epigraph_speed(&closest.study, values, certificate, &mut shares);
    }
    let total: f64 = shares.iter().filter(|share| **share > HOLDS).sum();
    let numbered = shares.into_iter().enumerate();
    numbered
        .filter(|(_, share)| *share > HOLDS)
        .map(|(k, share)| (k, share / total))
        .collect()
}

/// Distributes the share of the epigraph speed, one variable for all conditions, over the conditions whose
/// damping limits it.
fn share_epigraph_speed(
    study: &Study,
    values: &Values,
    certificate: &Certificate,
    shares: &mut [f64],
) {
    let epigraph: Vec<usize> = (0..shares.len())
        .filter(|k| study.is_epigraph_term(*k))
        .collect();
    let speed: f64 = epigraph.iter().map(|k| shares[*k]).sum();
    let mut held = vec![0.0; shares.len()];
    let constraints = values.constraints.iter();
    for (piece, multiplier) in constraints.zip(&certificate.constraint_multipliers) {
        if let Some(held) = held.get_mut(study.term_of(piece.index)) {
            *held += multiplier;
        }
    }
    let total: f64 = epigraph.iter().map(|k| held[*k]).sum();
    if total > 0.0 {
        for k in epigraph {
            shares[k] = speed * held[k] / total;
        }
    }
}
