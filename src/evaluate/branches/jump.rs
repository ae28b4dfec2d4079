//! Over a place where modes cannot be told apart, by the spectrum beyond it.
//!
//! Where two modes meet, each goes as a square root of the speed, but their mean and the square of
//! half their difference are analytic, and can be interpolated.

use nalgebra::Complex;

use super::{
    events::{Sought, find},
    search::Search,
    state::{STRONG, State},
    track::{Branches, take_nearest, worth_following},
};
use crate::{
    dynamics::ForcedModel,
    numerics::{Eigenvalue, Poles, cubic::Cubic, damping_ratio, elimination::LANES, size},
};

/// Widths of a jump that are tried, in ln V.
const WIDTHS: [f64; 3] = [0.03, 0.06, 0.12];
/// A mode goes on in that nearest to where it was expected if it is nearer by this factor than to
/// any other.
const CLEAR: f64 = 0.25;

impl Branches<'_> {
    /// The modes beyond a place at which two come too close, where eigenvalues move as the square
    /// root of the speed. Those of which it is not clear which is which must be damped by more than the
    /// search asks for on both sides, or be two that have nothing of what is sought between them.
    pub(super) fn jump(&mut self, now: &State, target: f64, search: &mut Search) -> Option<State> {
        let way = (target / now.speed()).ln();
        for width in WIDTHS.into_iter().filter(|width| *width < way.abs()) {
            let speed = now.speed() * width.copysign(way).exp();
            let poles = Poles::at(&self.model.forced, speed).ok()?;
            let (values, mut clear) = matched(now, speed, worth_following(&poles));
            let Some(next) = State::of(&mut self.refiner, speed, values) else {
                continue;
            };
            let uncertain = |state: &State, l: usize| {
                state.alive[l]
                    && !clear[l]
                    && damping_ratio(state.eigenvalue(l).s) < search.clear_of
            };
            let lanes: Vec<usize> = (0..LANES)
                .filter(|&l| uncertain(now, l) || uncertain(&next, l))
                .collect();
            let mut settled: Vec<[usize; 2]> = Vec::new();
            for lane in lanes {
                let (other, twins) = Twins::of(now, &next, lane)?;
                if settled.contains(&[other, lane]) {
                    continue;
                }
                settled.push([lane, other]);
                if !twins.are_quiet(search) || !twins.hold(&self.model.forced) {
                    return None;
                }
                clear[other] = false;
            }
            let mut before = now.clone();
            before.bury(|_, l| !clear[l]);
            find(&mut self.refiner, &before, &next, search)?;
            return Some(next);
        }
        None
    }
}

/// Two modes that meet between two speeds, as mean and square of half their difference.
struct Twins {
    speeds: [f64; 2],
    mean: Cubic,
    square: Cubic,
}

/// Damping ratio within which the interpolation must agree with the spectrum in the middle, and by
/// which what is sought must be missed.
const ERROR: f64 = 1e-3;
const MISSED: f64 = 3.0 * ERROR;
/// A dip below both ends by less than this is none.
const ROUNDING: f64 = 1e-9;
/// Places looked at in between.
const PLACES: usize = 32;

impl Twins {
    /// The mode in a lane and that nearest to it, in the same lane on both sides.
    fn of(before: &State, after: &State, lane: usize) -> Option<(usize, Self)> {
        let nearest = |state: &State| {
            let apart = |l: usize| (state.eigenvalue(l).s - state.eigenvalue(lane).s).norm_sqr();
            let others = state.living().filter(|&l| l != lane);
            others.min_by(|&a, &b| apart(a).total_cmp(&apart(b)))
        };
        let other = nearest(before)?;
        if nearest(after) != Some(other) || !before.alive[lane] || !after.alive[lane] {
            return None;
        }
        let [a, b] = [before, after].map(|state| [state.eigenvalue(lane), state.eigenvalue(other)]);
        let h = (b[0].speed / a[0].speed).ln();
        let mean = |pair: [Eigenvalue; 2]| {
            let [one, two] = pair;
            [(one.s + two.s) / 2.0, (one.slope + two.slope) * (h / 2.0)]
        };
        let square = |pair: [Eigenvalue; 2]| {
            let [one, two] = pair;
            let half = (one.s - two.s) / 2.0;
            [half * half, half * (one.slope - two.slope) * h]
        };
        let twins = Self {
            speeds: [a[0].speed, b[0].speed],
            mean: Cubic::new(mean(a), mean(b)),
            square: Cubic::new(square(a), square(b)),
        };
        Some((other, twins))
    }

    /// Both at a share t of the way.
    fn at(&self, t: f64) -> [Complex<f64>; 2] {
        let (mean, half) = (self.mean.value(t), self.square.value(t).sqrt());
        [mean + half, mean - half]
    }

    /// Whether nothing that is sought lies between the two speeds.
    fn are_quiet(&self, search: &Search) -> bool {
        let ratios = |k: usize| {
            let mut ratios = self.at(k as f64 / PLACES as f64).map(damping_ratio);
            ratios.sort_by(f64::total_cmp);
            ratios
        };
        let all: Vec<[f64; 2]> = (0..=PLACES).map(ratios).collect();
        let quiet = |of: usize| {
            let values = all.iter().map(|ratios| ratios[of]);
            let least = values.clone().fold(f64::INFINITY, f64::min);
            let most = values.fold(f64::NEG_INFINITY, f64::max);
            let ends = all[0][of].min(all[PLACES][of]);
            match search.sought {
                None => true,
                Some(Sought::Onset) => least > MISSED || most < -MISSED,
                Some(Sought::Minimum) => least > search.below + MISSED || least >= ends - ROUNDING,
            }
        };
        quiet(0) && quiet(1)
    }

    /// Whether the spectrum in the middle has them where they are expected.
    fn hold(&self, model: &ForcedModel) -> bool {
        let [low, high] = self.speeds;
        let Ok(poles) = Poles::at(model, (low * high).sqrt()) else {
            return false;
        };
        let mut values: Vec<Complex<f64>> = poles.oscillatory().collect();
        let expected = self.at(0.5).into_iter();
        expected
            .map(|s| take_nearest(&mut values, s, ERROR * size(s)))
            .all(|found| found.is_some())
    }
}

/// Eigenvalues in the lanes of the modes that they continue, those that continue none in the lanes
/// left, the least damped first; and in which lanes it is clear that they do.
fn matched(
    now: &State,
    speed: f64,
    mut values: Vec<Complex<f64>>,
) -> ([Option<Complex<f64>>; LANES], [bool; LANES]) {
    let (mut lanes, mut clear) = ([None; LANES], [false; LANES]);
    let all = values.clone();
    for l in now.living() {
        let known = now.eigenvalue(l);
        let expected = known.expected((speed / known.speed).ln(), None);
        // A strongly damped one may have left the sector that is followed.
        let Some(s) = take_nearest(&mut values, expected, STRONG * size(expected)) else {
            continue;
        };
        let apart = |s: &Complex<f64>| size(*s - expected);
        let others = all.iter().filter(|other| **other != s);
        let next = others.map(apart).fold(f64::INFINITY, f64::min);
        clear[l] = apart(&s) < CLEAR * next;
        lanes[l] = Some(s);
    }
    values.sort_by(|a, b| damping_ratio(*b).total_cmp(&damping_ratio(*a)));
    for lane in lanes.iter_mut().filter(|lane| lane.is_none()) {
        *lane = values.pop();
    }
    (lanes, clear)
}
