//! The design delivered: within a small loss of the optimum, the one nearest to the design as given, or
//! the softest.
//!
//! An optimum is often flat: a stiffness ends at its bound for less than anybody can measure. The design
//! delivered gives up that little for a change that an engineer sees a reason for.

use super::freedom::{Loss, Neighbourhood};
use crate::{
    case::Case,
    optimize::{
        archive::{Archive, Stop},
        problem::{Problem, Scale},
        within::{Aim, Near},
    },
    parameter::Parameter,
    spec::{DesignSpace, Prefer},
    units::Quantity,
};

/// A design within a small loss of the optimum.
#[derive(Debug, Clone)]
pub struct Nearby {
    /// The design.
    pub case: Case,
    /// Loss of each goal.
    pub losses: Vec<Loss>,
}

/// The preferred design within the loss that the design space allows. `None` where that is the optimum
/// itself: asked for, or no other was found.
///
/// # Errors
///
/// [`Stop`] if the run is at its end.
pub fn preferred(
    around: &Neighbourhood,
    space: &DesignSpace,
    given: &Case,
    archive: &Archive,
) -> Result<Option<Nearby>, Stop> {
    let goals = around.goals(space.deliver_within);
    let near = Near {
        problem: around.study(),
        goals: &goals,
        archive,
    };
    let x = match space.prefer {
        Prefer::Optimum => return Ok(None),
        Prefer::AsGiven => nearest(around, &near, given)?,
        Prefer::Softest => near
            .best(&softness(around), around.optimum(), &[])?
            .map(|reached| reached.x),
    };
    let nearby = x.and_then(|x| {
        let case = with_bits_of(given, around.study().design(&x));
        let losses = around.losses(&case)?;
        Some(Nearby { case, losses })
    });
    // A loss is allowed up to rounding.
    let most = space.deliver_within * (1.0 + 1e-6);
    Ok(nearby.filter(|nearby| nearby.losses.iter().all(|loss| loss.share <= most)))
}

/// Scaled coordinates of the design nearest to the given one. Variables are set to the given value one
/// after another, the nearest first, as long as the others can compensate; the rest are nearest in the
/// sum of squares.
fn nearest(around: &Neighbourhood, near: &Near, given: &Case) -> Result<Option<Vec<f64>>, Stop> {
    let study = around.study();
    let n = around.optimum().len();
    let mut goal = study.coordinates(given);
    let count = goal.len();
    // The epigraph speed has no value as given.
    goal.extend_from_slice(&around.optimum()[count..]);
    let aim = Aim {
        slopes: vec![0.0; n],
        weights: (0..n).map(|i| f64::from(u8::from(i < count))).collect(),
        centre: goal.clone(),
    };
    let Some(first) = near.best(&aim, around.optimum(), &[])? else {
        return Ok(None);
    };
    let mut x = first.x;
    let mut pinned: Vec<usize> = Vec::new();
    let mut open: Vec<usize> = (0..count).collect();
    while let Some(k) = closest(&open, &x, &goal) {
        let i = open.remove(k);
        let mut moved = x.clone();
        moved[i] = goal[i];
        let mut trial = pinned.clone();
        trial.push(i);
        if near.holds(&moved)? {
            x = moved;
        } else if let Some(found) = near.best(&aim, &moved, &trial)? {
            x = found.x;
        } else {
            continue;
        }
        pinned = trial;
    }
    Ok(Some(x))
}

/// Position in `open` of the coordinate that is closest to its goal; of equals the first.
fn closest(open: &[usize], x: &[f64], goal: &[f64]) -> Option<usize> {
    let off = |k: &usize| (x[open[*k]] - goal[open[*k]]).abs();
    (0..open.len()).min_by(|a, b| off(a).total_cmp(&off(b)).then(a.cmp(b)))
}

/// Price of a squared move of a variable that is no stiffness away from the optimum: over its whole range
/// it weighs as much as 0.05 % of stiffness.
const STAYS: f64 = 1e-3;

/// Σ ln K over the variables that set a stiffness, on a linear scale their share of the upper bound; the
/// other variables are drawn to the optimum.
fn softness(around: &Neighbourhood) -> Aim {
    let study = around.study();
    let mut aim = Aim {
        slopes: vec![0.0; around.optimum().len()],
        weights: vec![0.0; around.optimum().len()],
        centre: around.optimum().to_vec(),
    };
    let pairs = study.parameters().iter().zip(study.variables());
    for (i, (parameter, variable)) in pairs.enumerate() {
        let [low, high] = variable.bounds;
        let range = match variable.scale {
            Scale::Logarithmic => (high / low).ln(),
            Scale::Linear => (high - low) / high,
        };
        match power_of_stiffness(*parameter) {
            Some(power) => aim.slopes[i] = power * range,
            None => aim.weights[i] = STAYS,
        }
    }
    aim
}

/// The power of a parameter that a stiffness is proportional to; `None` if it sets no stiffness.
fn power_of_stiffness(parameter: Parameter) -> Option<f64> {
    let is_stiffness = |quantity| {
        matches!(
            quantity,
            Quantity::Stiffness | Quantity::RotationalStiffness
        )
    };
    match parameter.quantity() {
        own if is_stiffness(own) => Some(1.0),
        // (4.6-8, 14); K_pz with K_sz beside it, (3.5-9), nearly so.
        Quantity::Frequency => Some(2.0),
        _ => None,
    }
}

/// A case in which every constant that is as given but for rounding has the bits as given.
fn with_bits_of(given: &Case, mut case: Case) -> Case {
    /// Rounding of a constant by the conversion to a scaled coordinate and back.
    const CONSTANT_ROUNDING: f64 = 1e-12;
    for constant in Parameter::plain() {
        let key = constant.key_of_constant();
        let (Some(own), Some(kept)) = (key.get(&case), key.get(given)) else {
            continue;
        };
        if (own - kept).abs() <= CONSTANT_ROUNDING * kept.abs() {
            constant.set(&mut case, kept);
        }
    }
    case
}
