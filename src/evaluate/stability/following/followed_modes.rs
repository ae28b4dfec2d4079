//! Modes followed from speed to speed by extrapolation and refinement.

use nalgebra::Complex;

use super::{
    events::{Event, find_events},
    modes_at_speed::{ModesAtSpeed, STRONGLY_DAMPED},
    search::EventSearch,
};
use crate::{
    dynamics::LateralModel,
    numerics::{Eigenpairs, Eigenvalue, Poles, Refiner, damping_ratio, elimination::LANES, size},
};

/// Largest |ζ| of a mode that is followed; beyond it, pairs are close to becoming two real eigenvalues.
const LARGEST_FOLLOWED: f64 = 0.6;
/// First step in ln V.
const FIRST_STEP: f64 = 0.2;
/// Longest step in ln V.
const LONGEST_STEP: f64 = 0.8;
/// Shortest step in ln V: a mode that it cannot follow is lost.
const SHORTEST_STEP: f64 = 5e-3;
/// Factor on a step that is repeated.
const STEP_REDUCTION: f64 = 0.3;
/// Relative change of s that ends the refinement within a step: the error left is its third power.
const STEP_TOLERANCE: f64 = 2e-2;

/// Lightly damped modes of a lateral model, followed over the speed.
pub struct FollowedModes<'m> {
    pub(super) model: &'m LateralModel,
    pub(super) refiner: Refiner<'m>,
    pub(super) start: ModesAtSpeed,
    /// Work space for the modes at the next speed.
    spare: Option<ModesAtSpeed>,
    /// Modes at both ends of each step with an event.
    pub(super) steps_with_events: Vec<[Option<[Eigenvalue; 2]>; LANES]>,
    /// Number of growing real eigenvalues, none or one: the same at every speed, by the sign of det K.
    pub(super) growing: usize,
    /// True if one grows by more than rounding.
    diverges: bool,
}

/// Modes at the start of the walks, a search, and all modes at the lowest speed.
pub type Descent<'m> = (FollowedModes<'m>, EventSearch, Vec<Eigenvalue>);

/// Modes at the end of a walk.
pub struct WalkEnd(pub(super) ModesAtSpeed);

impl<'m> FollowedModes<'m> {
    /// Modes from the poles at any speed, to be followed within a range of speeds, m/s. `None` if two
    /// modes cannot be distinguished.
    pub fn within(range: [f64; 2], model: &'m LateralModel, poles: &Poles) -> Option<Self> {
        let mut refiner = Refiner::new(model.forced.stiffness());
        let growing = poles.values.iter().filter(|s| s.im == 0.0 && s.re >= 0.0);
        let growing = growing.count();
        let mut modes = Self {
            growing,
            diverges: growing > 0 && poles.diverge(),
            start: ModesAtSpeed::new(&mut refiner, poles.speed, worth_following(poles))?,
            spare: None,
            steps_with_events: Vec::new(),
            model,
            refiner,
        };
        let inside = poles.speed.clamp(range[0], range[1]);
        let start = modes.start.clone();
        modes.start = modes.follow(start, inside, &mut EventSearch::idle(), |_, _| false)?;
        (modes.growing <= 1).then_some(modes)
    }

    /// Follows the modes from the poles at any speed to the lowest speed of a range, m/s, adding events to
    /// a search. Returns the modes at the start, the search, and all modes at the lowest speed.
    pub fn to_lowest_speed(
        range: [f64; 2],
        model: &'m LateralModel,
        poles: &Poles,
        mut search: EventSearch,
    ) -> Option<Descent<'m>> {
        let mut modes = Self::within(range, model, poles)?;
        let bottom = modes.walk(range[0], &mut search, |_, _| false)?;
        let bottom = modes.complete(bottom, &mut search)?;
        Some((modes, search, bottom))
    }

    /// True if a real eigenvalue grows; it then does at every speed.
    pub fn diverges(&self) -> bool {
        self.diverges
    }

    /// Speed from which walks start, m/s.
    pub fn start_speed(&self) -> f64 {
        self.start.speed()
    }

    /// Follows the modes from the start to `target`, m/s. The walk ends early after a step at which
    /// `enough` holds for events and speed. `None` if a mode is lost.
    pub fn walk(
        &mut self,
        target: f64,
        search: &mut EventSearch,
        enough: impl Fn(&[Event], f64) -> bool,
    ) -> Option<WalkEnd> {
        let start = self.start.clone();
        self.follow(start, target, search, enough).map(WalkEnd)
    }

    /// Steps from `start` to `target`, m/s, with an adaptive step, adding events to the search.
    pub(super) fn follow(
        &mut self,
        start: ModesAtSpeed,
        target: f64,
        search: &mut EventSearch,
        enough: impl Fn(&[Event], f64) -> bool,
    ) -> Option<ModesAtSpeed> {
        let mut now = start;
        let mut last: Option<ModesAtSpeed> = None;
        let mut length = FIRST_STEP;
        while now.speed().to_bits() != target.to_bits() {
            if now.lanes_used() == 0 {
                now.pairs.speed = [target; LANES];
                break;
            }
            let rest = (target / now.speed()).ln();
            // Equal steps over the remaining distance.
            let step = length.min(rest.abs() / (rest.abs() / length).ceil());
            let to = if step < rest.abs() {
                now.speed() * step.copysign(rest).exp()
            } else {
                target
            };
            let space = self.spare.take().unwrap_or_else(|| now.clone());
            let (next, deviation) = self.advance(last.as_ref(), &now, space, to, search.deviation);
            // The error of the extrapolation grows with the third power of the step.
            length = step * (0.9 / deviation.cbrt()).clamp(STEP_REDUCTION, 2.0);
            length = length.min(LONGEST_STEP);
            if deviation <= 1.0 {
                let events = search.events.len();
                if find_events(&mut self.refiner, &now, &next, search).is_none() {
                    // A shorter step distinguishes modes that are close to each other.
                    search.events.truncate(events);
                    self.spare = Some(next);
                    length = STEP_REDUCTION * step;
                    if length < SHORTEST_STEP {
                        return None;
                    }
                    continue;
                }
                if search.events.len() > events {
                    let modes = std::array::from_fn(|l| ModesAtSpeed::from_to(&now, &next, l));
                    self.steps_with_events.push(modes);
                }
                self.spare = last.replace(std::mem::replace(&mut now, next));
            } else {
                self.spare = Some(next);
                if length >= SHORTEST_STEP {
                    continue;
                }
                now = self.jump(&now, target, search)?;
                last = None;
                length = FIRST_STEP;
            }
            if enough(&search.events, now.speed()) {
                break;
            }
        }
        Some(now)
    }

    /// Modes at another speed, in the space of `next`, and their largest deviation from the
    /// extrapolation over the deviation allowed: infinite if a mode is lost.
    fn advance(
        &mut self,
        last: Option<&ModesAtSpeed>,
        now: &ModesAtSpeed,
        mut next: ModesAtSpeed,
        speed: f64,
        [share, least]: [f64; 2],
    ) -> (ModesAtSpeed, f64) {
        next.copy_from(now);
        let h = (speed / now.speed()).ln();
        for l in now.lanes() {
            let known = now.eigenvalue(l);
            let before = last
                .filter(|last| last.followed[l])
                .map(|last| last.eigenvalue(l));
            let s = known.expected(h, before.as_ref());
            (next.pairs.s.re[l], next.pairs.s.im[l]) = (s.re, s.im);
        }
        next.pairs.speed = [speed; LANES];
        // A lightly damped mode does not become strongly damped in a single step.
        let was_strong = |l: usize| damping_ratio(now.eigenvalue(l).s).abs() > STRONGLY_DAMPED;
        let leaves = |state: &ModesAtSpeed| {
            let mut lanes = state.lanes();
            lanes.any(|l| is_out_of_scope(state.eigenvalue(l).s) && !was_strong(l))
        };
        if leaves(&next) {
            return (next, f64::INFINITY);
        }
        next.drop_modes(|state, l| is_out_of_scope(state.eigenvalue(l).s));
        let expected = next.pairs.s;
        self.refiner
            .converge(&mut next.pairs, now.lanes_used(), STEP_TOLERANCE);
        // The shape identifies a mode from speed to speed.
        let kept = |state: &ModesAtSpeed, l: usize| {
            let converged = state.pairs.change[l] < STEP_TOLERANCE;
            converged && Eigenpairs::similar_shape((&now.pairs, l), (&state.pairs, l))
        };
        if leaves(&next) {
            return (next, f64::INFINITY);
        }
        next.drop_modes(|state, l| {
            let lost = || !kept(state, l) || state.duplicates_another(l);
            is_out_of_scope(state.eigenvalue(l).s) || was_strong(l) && lost()
        });
        let fine = next
            .lanes()
            .all(|l| kept(&next, l) && !next.duplicates_another(l));
        let deviation = next.lanes().map(|l| {
            let s = next.eigenvalue(l).s;
            let allowed = (share * damping_ratio(s).abs()).max(least);
            size(s - expected.lane(l)) / (allowed * size(s))
        });
        let deviation = deviation.fold(0.0, f64::max);
        (next, if fine { deviation } else { f64::INFINITY })
    }
}

/// Oscillatory eigenvalues that are not too strongly damped to be followed.
pub(super) fn worth_following(poles: &Poles) -> Vec<Complex<f64>> {
    let oscillatory = poles.oscillatory();
    oscillatory
        .filter(|s| damping_ratio(*s).abs() < LARGEST_FOLLOWED)
        .collect()
}

/// Removes the eigenvalue nearest to `to`, if it is nearer than `within`.
pub(super) fn take_nearest(
    values: &mut Vec<Complex<f64>>,
    to: Complex<f64>,
    within: f64,
) -> Option<Complex<f64>> {
    let apart = |i: usize| size(values[i] - to);
    let nearest = (0..values.len()).min_by(|&a, &b| apart(a).total_cmp(&apart(b)));
    let nearest = nearest.filter(|&i| apart(i) < within)?;
    Some(values.swap_remove(nearest))
}

/// True for an eigenvalue too strongly damped to be followed, or real.
fn is_out_of_scope(s: Complex<f64>) -> bool {
    damping_ratio(s).abs() > LARGEST_FOLLOWED || s.im <= 0.0
}
