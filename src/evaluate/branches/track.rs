//! Following modes from speed to speed.

use nalgebra::Complex;

use super::{
    events::{Event, Sought, find},
    pairs::{Pairs, Refiner, SETTLED},
    sector::modes_below,
};
use crate::{
    dynamics::{
        LateralModel, Poles,
        elimination::{LANES, Lanes},
    },
    evaluate::mode::damping_ratio,
};

/// An eigenvalue and its slope at a speed.
#[derive(Debug, Clone, Copy)]
pub struct Known {
    /// V, m/s.
    pub speed: f64,
    /// s, rad/s.
    pub s: Complex<f64>,
    /// ds/d ln V.
    pub slope: Complex<f64>,
}

/// Modes more damped than this are not followed: pairs close to becoming two real roots.
const FOLLOWED: f64 = 0.6;
/// Modes followed at most, the least damped: they fit side by side, and the others rarely matter.
const FEW: usize = LANES;
/// Damping ratio above which a mode is strongly damped.
const STRONG: f64 = 0.2;
/// Ratio of one speed to the next.
const RATIO: f64 = 1.3;
/// Relative change of s that ends the iteration on the way: the step itself leaves its cube.
const LOOSE: f64 = 3e-3;
/// How often a step may be halved.
const HALVINGS: usize = 12;
/// Eigenvalues this close, as a share of their size, may be the same one found twice, and are if
/// their vectors are alike.
const CLOSE: f64 = 1e-2;
/// Damping ratios between which the modes are counted.
const COUNTED: [f64; 2] = [0.05, 0.15];

/// All followed modes at one speed.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub groups: Vec<Pairs>,
    pub alive: Vec<bool>,
}

impl State {
    pub fn known(&self, branch: usize) -> Known {
        let (group, l) = (&self.groups[branch / LANES], branch % LANES);
        Known {
            speed: group.speed[l],
            s: group.s.lane(l),
            slope: group.slope.lane(l),
        }
    }

    fn speed(&self) -> f64 {
        self.groups.first().map_or(0.0, |group| group.speed[0])
    }

    fn living(&self) -> impl Iterator<Item = usize> + '_ {
        let branches = self.alive.iter().enumerate();
        branches.filter(|(_, alive)| **alive).map(|(b, _)| b)
    }

    /// Gives up branches that are no longer worth following; their lanes repeat another's.
    fn bury(&mut self, mut dies: impl FnMut(&Self, usize) -> bool) {
        let dead: Vec<usize> = self.living().filter(|&b| dies(self, b)).collect();
        for &b in &dead {
            self.alive[b] = false;
        }
        self.fill_up();
    }

    fn fill_up(&mut self) {
        let Some(model) = self.living().next() else {
            return;
        };
        let (group, l) = (self.groups[model / LANES].clone(), model % LANES);
        for b in (0..self.alive.len()).filter(|&b| !self.alive[b]) {
            self.groups[b / LANES].take(b % LANES, &group, l);
        }
    }

    /// Whether a branch has come to the mode of one before it: eigenvalues may be close, as those
    /// of the two trucks are, but not the shapes too.
    fn repeats(&self, branch: usize) -> bool {
        let s = self.known(branch).s;
        let lane = |b: usize| (&self.groups[b / LANES], b % LANES);
        let before = self.living().take_while(|&b| b < branch);
        before
            .filter(|&b| (self.known(b).s - s).norm_sqr() < (CLOSE * s.norm()).powi(2))
            .any(|b| Pairs::alike(lane(b), lane(branch)))
    }
}

/// The modes of a lateral model over the speed.
pub struct Branches {
    refiner: Refiner,
    start: State,
}

/// What to look for on the way.
pub struct Search<'f> {
    /// Whether an event is wanted on a branch between two speeds, the lower one first.
    pub wants: &'f dyn Fn(Sought, &Known, &Known) -> bool,
    /// What was found.
    pub events: Vec<Event>,
}

impl Branches {
    /// From the poles at some speed. `None` if they cannot be told apart.
    fn new(model: &LateralModel, poles: &Poles) -> Option<Self> {
        let speed = poles.speed;
        let mut refiner = Refiner::new(&model.forced.system);
        let mut followed: Vec<Complex<f64>> = poles
            .oscillatory()
            .filter(|s| damping_ratio(*s).abs() < FOLLOWED)
            .collect();
        followed.sort_by(|a, b| damping_ratio(*a).total_cmp(&damping_ratio(*b)));
        followed.truncate(FEW);
        let mut state = State {
            groups: Vec::new(),
            alive: vec![true; followed.len()],
        };
        for chunk in followed.chunks(LANES) {
            // A shift off the eigenvalue keeps the factors regular.
            let shift = Complex::new(1.0 + 1e-8, 1e-8);
            let s = Lanes::from_fn(|l| shift * chunk[l.min(chunk.len() - 1)]);
            let mut pairs = Pairs::near(s, [speed; LANES], refiner.order());
            refiner.step(&mut pairs);
            refiner.step(&mut pairs);
            state.groups.push(pairs);
        }
        state.alive.resize(LANES * state.groups.len(), false);
        state.fill_up();
        let lost = |state: &State, b: usize| {
            let apart = state.known(b).s - followed[b];
            apart.norm() > 1e-6 * followed[b].norm() || state.repeats(b)
        };
        state.bury(|state, b| damping_ratio(followed[b]) > STRONG && lost(state, b));
        let fine = state.living().all(|b| !lost(&state, b));
        fine.then_some(Self {
            refiner,
            start: state,
        })
    }

    /// From the poles at some speed, to be followed within a range of speeds, m/s.
    pub fn within(range: [f64; 2], model: &LateralModel, poles: &Poles) -> Option<Self> {
        let mut branches = Self::new(model, poles)?;
        branches.move_to(poles.speed.clamp(range[0], range[1]))?;
        Some(branches)
    }

    /// Moves the start to another speed.
    fn move_to(&mut self, speed: f64) -> Option<()> {
        let nothing = |_, _: &Known, _: &Known| false;
        let mut search = Search {
            wants: &nothing,
            events: Vec::new(),
        };
        self.start = self.follow(speed, &mut search, |_, _| false)?;
        Some(())
    }

    /// Follows the modes from the start to `target`, m/s, and returns them there, or where
    /// `enough` says so of events and speed after a step.
    pub fn walk(
        &mut self,
        target: f64,
        search: &mut Search<'_>,
        enough: impl Fn(&[Event], f64) -> bool,
    ) -> Option<Vec<Known>> {
        let mut end = self.follow(target, search, enough)?;
        for group in &mut end.groups {
            self.refiner.settle(group, LANES, SETTLED);
        }
        if !self.complete(&end) {
            return None;
        }
        Some(end.living().map(|b| end.known(b)).collect())
    }

    fn follow(
        &mut self,
        target: f64,
        search: &mut Search<'_>,
        enough: impl Fn(&[Event], f64) -> bool,
    ) -> Option<State> {
        let mut now = self.start.clone();
        let mut last: Option<State> = None;
        if now.groups.is_empty() {
            return Some(now);
        }
        let steps = ((target / now.speed()).ln().abs() / RATIO.ln())
            .ceil()
            .max(1.0);
        let (from, ratio) = (now.speed(), target / now.speed());
        if (ratio - 1.0).abs() < 1e-12 {
            return Some(now);
        }
        for k in (1..).take_while(|k| f64::from(*k) <= steps) {
            let next = if f64::from(k) >= steps {
                target
            } else {
                from * ratio.powf(f64::from(k) / steps)
            };
            let (mut to, mut halvings) = (next, 0);
            while now.speed().to_bits() != next.to_bits() {
                match self.advance(last.as_ref(), &now, to) {
                    Some(state) => {
                        find(&mut self.refiner, &now, &state, search)?;
                        last = Some(std::mem::replace(&mut now, state));
                        to = next;
                    }
                    None if halvings < HALVINGS => {
                        halvings += 1;
                        to = (to * now.speed()).sqrt();
                    }
                    None => return None,
                }
            }
            if enough(&search.events, now.speed()) {
                break;
            }
        }
        Some(now)
    }

    /// The modes at another speed; `None` if the step is too long.
    fn advance(&mut self, last: Option<&State>, now: &State, speed: f64) -> Option<State> {
        let mut next = now.clone();
        let h = (speed / now.speed()).ln();
        for b in now.living() {
            let known = now.known(b);
            // In ln s: at low speed the kinematic modes go with V itself.
            let rate = known.slope / known.s;
            let bend = last
                .filter(|last| last.alive[b])
                .map_or(Complex::ZERO, |last| {
                    let before = last.known(b);
                    (rate - before.slope / before.s) / (known.speed / before.speed).ln()
                });
            let s = known.s * (rate * h + bend * (h * h / 2.0)).exp();
            let (group, l) = (&mut next.groups[b / LANES], b % LANES);
            (group.s.re[l], group.s.im[l]) = (s.re, s.im);
        }
        for group in &mut next.groups {
            group.speed = [speed; LANES];
        }
        next.bury(|state, b| {
            damping_ratio(state.known(b).s).abs() > FOLLOWED || state.known(b).s.im <= 0.0
        });
        let count = next.living().last().map_or(0, |b| b + 1);
        for (g, group) in next.groups.iter_mut().enumerate() {
            if g * LANES < count {
                self.refiner
                    .settle(group, (count - g * LANES).min(LANES), LOOSE);
            }
        }
        let settled = |state: &State, b: usize| state.groups[b / LANES].change[b % LANES] < LOOSE;
        // Strongly damped modes are let go where they cannot be told apart: they matter only if
        // they turn up among the others later, and then the count tells.
        next.bury(|state, b| {
            let s = state.known(b).s;
            let strongly = damping_ratio(now.known(b).s) > STRONG;
            let lost = || !settled(state, b) || state.repeats(b);
            damping_ratio(s).abs() > FOLLOWED || s.im <= 0.0 || strongly && lost()
        });
        let fine = next.living().all(|b| settled(&next, b) && !next.repeats(b));
        fine.then_some(next)
    }

    /// Whether nothing grows at a speed, m/s, but perhaps a mode close to `known`: looked up
    /// without the modes followed.
    pub fn stable_at(&mut self, speed: f64, known: Complex<f64>) -> bool {
        modes_below(&mut self.refiner, speed, 0.0, &[known]) == Some(0.0)
    }

    /// Whether the followed modes are all that are little damped at their speed.
    fn complete(&mut self, state: &State) -> bool {
        let values: Vec<Complex<f64>> = state.living().map(|b| state.known(b).s).collect();
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
        let counted = modes_below(&mut self.refiner, state.speed(), zeta, &values);
        counted.is_some_and(|counted| (counted - expected as f64).abs() < 0.1)
    }
}
