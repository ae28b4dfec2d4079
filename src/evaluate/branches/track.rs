//! Following modes from speed to speed.

use nalgebra::Complex;

use super::{
    events::{Event, find},
    search::Search,
    state::{STRONG, State},
};
use crate::{
    dynamics::LateralModel,
    numerics::{
        Eigenpairs, Eigenvalue, PAIR_CONVERGED, Poles, Refiner, cubic::Between, damping_ratio,
        elimination::LANES, modes_below, size,
    },
};

/// Modes more damped than this are not followed: pairs close to becoming two real roots.
const FOLLOWED: f64 = 0.6;
/// First and longest step, and the shortest before modes count as lost, in ln V.
const FIRST: f64 = 0.2;
const LONGEST: f64 = 0.8;
const SHORTEST: f64 = 5e-3;
/// Share of a step at which it is tried again.
const SHORTENED: f64 = 0.3;
/// Relative change of s that ends the iteration on the way: the step itself leaves its cube.
const LOOSE: f64 = 2e-2;
/// Damping ratio below which all modes at the end of a walk are known for sure.
pub const COMPLETE: f64 = 0.05;
/// Damping ratios between which the modes are counted.
const COUNTED: [f64; 2] = [COMPLETE, 0.15];
/// Relative distance within which an eigenvalue of a spectrum is one that was followed.
const SAME: f64 = 1e-5;

/// The modes of a lateral model over the speed.
pub struct Branches<'m> {
    pub(super) model: &'m LateralModel,
    pub(super) refiner: Refiner<'m>,
    start: State,
    /// Room for the next state.
    spare: Option<State>,
    /// The modes at both ends of each step in which something was found.
    steps: Vec<[Option<[Eigenvalue; 2]>; LANES]>,
    /// Real eigenvalues that grow, none or one: then at every speed, as det K is negative.
    growing: usize,
    /// Whether they do by more than rounding.
    diverges: bool,
}

/// Where a walk has ended.
pub struct Walked(State);

impl<'m> Branches<'m> {
    /// From the poles at some speed, to be followed within a range of speeds, m/s. `None` if they
    /// cannot be told apart.
    pub fn within(range: [f64; 2], model: &'m LateralModel, poles: &Poles) -> Option<Self> {
        let mut refiner = Refiner::new(model.forced.stiffness());
        let growing = poles.values.iter().filter(|s| s.im == 0.0 && s.re >= 0.0);
        let growing = growing.count();
        let mut branches = Self {
            growing,
            diverges: growing > 0 && poles.diverge(),
            start: State::new(&mut refiner, poles.speed, worth_following(poles))?,
            spare: None,
            steps: Vec::new(),
            model,
            refiner,
        };
        let inside = poles.speed.clamp(range[0], range[1]);
        let start = branches.start.clone();
        branches.start = branches.follow(start, inside, &mut Search::idle(), |_, _| false)?;
        (branches.growing <= 1).then_some(branches)
    }

    /// Whether a real eigenvalue grows, at any speed.
    pub fn diverges(&self) -> bool {
        self.diverges
    }

    /// Speed from which the modes are followed, m/s.
    pub fn start_speed(&self) -> f64 {
        self.start.speed()
    }

    /// Follows the modes from the start to `target`, m/s, or to where `enough` says so of events
    /// and speed after a step.
    pub fn walk(
        &mut self,
        target: f64,
        search: &mut Search,
        enough: impl Fn(&[Event], f64) -> bool,
    ) -> Option<Walked> {
        let start = self.start.clone();
        self.follow(start, target, search, enough).map(Walked)
    }

    /// The modes at the end of a walk, made sure that none that is little damped there is missing:
    /// those that were not followed are followed back to the start.
    pub fn complete(&mut self, walked: Walked, search: &mut Search) -> Option<Vec<Eigenvalue>> {
        let speed = walked.0.speed();
        let alive = walked.0.alive;
        let mut modes = self.settled(walked.0);
        if !self.all(&modes, speed) {
            let others = self.others(&modes, speed)?;
            modes.extend(self.settled(others.clone()));
            if !self.all(&modes, speed) {
                return None;
            }
            let back = self.start.speed();
            let mut back = self.follow(others, back, search, |_, _| false)?;
            let used = back.used();
            if used > 0 {
                self.refiner.converge(&mut back.pairs, used, PAIR_CONVERGED);
            }
            // Where one comes back to a mode that went all the way itself, the two were mixed up.
            let is_own = |l: usize| {
                let mut own = self.start.living().filter(|o| alive[*o]);
                own.any(|o| State::same((&self.start, o), (&back, l)))
            };
            if back.living().any(is_own) {
                return None;
            }
        }
        Some(modes)
    }

    fn settled(&mut self, mut state: State) -> Vec<Eigenvalue> {
        let used = state.used();
        if used > 0 {
            self.refiner
                .converge(&mut state.pairs, used, PAIR_CONVERGED);
        }
        state.living().map(|l| state.eigenvalue(l)).collect()
    }

    /// Modes at a speed that are not among some known there.
    fn others(&mut self, known: &[Eigenvalue], speed: f64) -> Option<State> {
        let poles = Poles::at(&self.model.forced, speed).ok()?;
        let mut values = worth_following(&poles);
        for known in known {
            let taken = take_nearest(&mut values, known.s, SAME * size(known.s));
            if taken.is_none() && damping_ratio(known.s) < COUNTED[1] {
                return None;
            }
        }
        State::new(&mut self.refiner, speed, values)
    }

    fn follow(
        &mut self,
        start: State,
        target: f64,
        search: &mut Search,
        enough: impl Fn(&[Event], f64) -> bool,
    ) -> Option<State> {
        let mut now = start;
        let mut last: Option<State> = None;
        let mut length = FIRST;
        while now.speed().to_bits() != target.to_bits() {
            if now.used() == 0 {
                now.pairs.speed = [target; LANES];
                break;
            }
            let rest = (target / now.speed()).ln();
            // Equal steps at the end.
            let step = length.min(rest.abs() / (rest.abs() / length).ceil());
            let to = if step < rest.abs() {
                now.speed() * step.copysign(rest).exp()
            } else {
                target
            };
            let room = self.spare.take().unwrap_or_else(|| now.clone());
            let (next, surprise) = self.advance(last.as_ref(), &now, room, to, search.surprise);
            // The error of the expectation goes with the third power of the step.
            length = step * (0.9 / surprise.cbrt()).clamp(SHORTENED, 2.0);
            length = length.min(LONGEST);
            if surprise <= 1.0 {
                let events = search.events.len();
                if find(&mut self.refiner, &now, &next, search).is_none() {
                    // Closer by, two that are near each other can be told apart.
                    search.events.truncate(events);
                    self.spare = Some(next);
                    length = SHORTENED * step;
                    if length < SHORTEST {
                        return None;
                    }
                    continue;
                }
                if search.events.len() > events {
                    let modes = std::array::from_fn(|l| State::from_to(&now, &next, l));
                    self.steps.push(modes);
                }
                self.spare = last.replace(std::mem::replace(&mut now, next));
            } else {
                self.spare = Some(next);
                if length >= SHORTEST {
                    continue;
                }
                now = self.jump(&now, target, search)?;
                last = None;
                length = FIRST;
            }
            if enough(&search.events, now.speed()) {
                break;
            }
        }
        Some(now)
    }

    /// The modes at another speed, in the room of some state, and how far they were from where they
    /// were expected, relative to what is allowed: infinitely if they are lost.
    fn advance(
        &mut self,
        last: Option<&State>,
        now: &State,
        mut next: State,
        speed: f64,
        [share, least]: [f64; 2],
    ) -> (State, f64) {
        next.copy_from(now);
        let h = (speed / now.speed()).ln();
        for l in now.living() {
            let known = now.eigenvalue(l);
            let before = last
                .filter(|last| last.alive[l])
                .map(|last| last.eigenvalue(l));
            let s = known.expected(h, before.as_ref());
            (next.pairs.s.re[l], next.pairs.s.im[l]) = (s.re, s.im);
        }
        next.pairs.speed = [speed; LANES];
        // What is little damped does not become unworthy in a single step.
        let was_strong = |l: usize| damping_ratio(now.eigenvalue(l).s).abs() > STRONG;
        let leaves = |state: &State| {
            let mut living = state.living();
            living.any(|l| gone(state.eigenvalue(l).s) && !was_strong(l))
        };
        if leaves(&next) {
            return (next, f64::INFINITY);
        }
        next.bury(|state, l| gone(state.eigenvalue(l).s));
        let expected = next.pairs.s;
        self.refiner.converge(&mut next.pairs, now.used(), LOOSE);
        // A mode is itself as long as its vector is.
        let kept = |state: &State, l: usize| {
            let settled = state.pairs.change[l] < LOOSE;
            settled && Eigenpairs::similar_shape((&now.pairs, l), (&state.pairs, l))
        };
        if leaves(&next) {
            return (next, f64::INFINITY);
        }
        next.bury(|state, l| {
            let lost = || !kept(state, l) || state.repeats(l);
            gone(state.eigenvalue(l).s) || was_strong(l) && lost()
        });
        let fine = next.living().all(|l| kept(&next, l) && !next.repeats(l));
        let surprise = next.living().map(|l| {
            let s = next.eigenvalue(l).s;
            let allowed = (share * damping_ratio(s).abs()).max(least);
            size(s - expected.lane(l)) / (allowed * size(s))
        });
        let surprise = surprise.fold(0.0, f64::max);
        (next, if fine { surprise } else { f64::INFINITY })
    }

    /// Whether nothing grows at a speed, m/s, just below the onset of a mode, s = `known`: counted
    /// anew. `None` if the count is inconclusive.
    pub fn stable_at(&mut self, speed: f64, known: Complex<f64>) -> Option<bool> {
        let modes = self.passed(speed, known);
        let counted = modes_below(&mut self.refiner, speed, 0.0, &modes);
        counted.map(|counted| self.agrees(counted, 0))
    }

    /// One mode and the others at a speed near which it was found.
    fn passed(&mut self, speed: f64, one: Complex<f64>) -> Vec<Complex<f64>> {
        let within = |[low, high]: &[Eigenvalue; 2]| low.speed <= speed && speed <= high.speed;
        let step = self
            .steps
            .iter()
            .find(|modes| modes.iter().flatten().any(within));
        let modes = step.into_iter().flatten().enumerate();
        let lanes: Vec<(usize, [Eigenvalue; 2])> =
            modes.filter_map(|(l, ends)| Some((l, (*ends)?))).collect();
        let Some(&first) = lanes.first() else {
            return vec![one];
        };
        let mut pairs = self.start.pairs.clone();
        for l in 0..LANES {
            let own = lanes.iter().copied().find(|(lane, _)| *lane == l);
            let (lane, [low, high]) = own.unwrap_or(first);
            pairs.take(l, &self.start.pairs, lane);
            let s = Between::new(&low, &high).at_speed(speed);
            (pairs.s.re[l], pairs.s.im[l]) = (s.re, s.im);
        }
        pairs.speed = [speed; LANES];
        self.refiner.converge(&mut pairs, LANES, PAIR_CONVERGED);
        let mut modes = vec![one];
        for s in lanes.into_iter().map(|(l, _)| pairs.s.lane(l)) {
            let is_new = |known: &Complex<f64>| size(*known - s) > SAME * size(s);
            if s.is_finite() && s.im > 0.0 && modes.iter().all(is_new) {
                modes.push(s);
            }
        }
        modes
    }

    /// Whether some modes are all that are little damped at a speed.
    fn all(&mut self, modes: &[Eigenvalue], speed: f64) -> bool {
        let values: Vec<Complex<f64>> = modes.iter().map(|known| known.s).collect();
        let mut ratios: Vec<f64> = values.iter().map(|s| damping_ratio(*s)).collect();
        ratios.push(COUNTED[0]);
        ratios.push(COUNTED[1]);
        ratios.retain(|z| (COUNTED[0]..=COUNTED[1]).contains(z));
        ratios.sort_by(f64::total_cmp);
        // In the middle of the widest gap no mode known is near the ray.
        let gap = ratios
            .windows(2)
            .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let zeta = gap.map_or(COUNTED[0], |gap| f64::midpoint(gap[0], gap[1]));
        let expected = values.iter().filter(|s| damping_ratio(**s) < zeta).count();
        let counted = modes_below(&mut self.refiner, speed, zeta, &values);
        counted.is_some_and(|counted| self.agrees(counted, expected))
    }

    /// Whether a count agrees with a number of oscillations: growing real ones count half.
    fn agrees(&self, counted: f64, oscillating: usize) -> bool {
        (counted - 0.5 * self.growing as f64 - oscillating as f64).abs() < 0.1
    }
}

pub(super) fn worth_following(poles: &Poles) -> Vec<Complex<f64>> {
    let oscillatory = poles.oscillatory();
    oscillatory
        .filter(|s| damping_ratio(*s).abs() < FOLLOWED)
        .collect()
}

/// Takes out the eigenvalue nearest to a place, if it is nearer than `within`.
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

/// Whether a mode is no longer worth following.
fn gone(s: Complex<f64>) -> bool {
    damping_ratio(s).abs() > FOLLOWED || s.im <= 0.0
}
