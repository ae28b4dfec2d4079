//! Jumps over speeds at which two modes meet, by the spectrum beyond them.
//!
//! Where two modes meet, each eigenvalue moves as a square root of the speed. The mean of the two and
//! the squared half-difference are analytic and are interpolated by cubics.

use nalgebra::Complex;

use super::{
    events::{EventKind, find_events},
    followed_modes::{FollowedModes, take_nearest, worth_following},
    modes_at_speed::{ModesAtSpeed, STRONGLY_DAMPED},
    search::EventSearch,
};
use crate::{
    dynamics::ForcedModel,
    numerics::{Eigenvalue, Poles, cubic::Cubic, damping_ratio, elimination::LANES, size},
};

/// Widths of jumps, in ln V, in the order in which they are tried.
const JUMP_WIDTHS: [f64; 3] = [0.03, 0.06, 0.12];
/// Largest ratio of the distances of the nearest and the second nearest eigenvalue from an
/// extrapolation at which a mode is matched with the nearest.
const CLEARLY_NEAREST: f64 = 0.25;

impl FollowedModes<'_> {
    /// Modes beyond a speed at which two meet, towards `target`, m/s. Modes that cannot be matched across
    /// the gap are accepted only if (a) their damping ratio exceeds the search threshold on both sides, or
    /// (b) they are a pair whose interpolated eigenvalues have no event and agree with the spectrum in the
    /// middle. `None` otherwise.
    pub(super) fn jump(
        &mut self,
        now: &ModesAtSpeed,
        target: f64,
        search: &mut EventSearch,
    ) -> Option<ModesAtSpeed> {
        let way = (target / now.speed()).ln();
        for width in JUMP_WIDTHS.into_iter().filter(|width| *width < way.abs()) {
            let speed = now.speed() * width.copysign(way).exp();
            let poles = Poles::at(&self.model.forced, speed).ok()?;
            let (values, mut clear) = matched(now, speed, worth_following(&poles));
            let Some(next) = ModesAtSpeed::of(&mut self.refiner, speed, values) else {
                continue;
            };
            let uncertain = |state: &ModesAtSpeed, l: usize| {
                state.followed[l]
                    && !clear[l]
                    && damping_ratio(state.eigenvalue(l).s) < search.clear_of
            };
            let lanes: Vec<usize> = (0..LANES)
                .filter(|&l| uncertain(now, l) || uncertain(&next, l))
                .collect();
            let mut accepted: Vec<[usize; 2]> = Vec::new();
            for lane in lanes {
                let (other, pair) = MeetingPair::of(now, &next, lane)?;
                if accepted.contains(&[other, lane]) {
                    continue;
                }
                accepted.push([lane, other]);
                if !pair.has_no_event(search) || !pair.agrees_with_spectrum(&self.model.forced) {
                    return None;
                }
                clear[other] = false;
            }
            let mut before = now.clone();
            before.drop_modes(|_, l| !clear[l]);
            find_events(&mut self.refiner, &before, &next, search)?;
            return Some(next);
        }
        None
    }
}

/// Two modes that meet between two speeds: their mean and their squared half-difference.
struct MeetingPair {
    speeds: [f64; 2],
    mean: Cubic,
    square: Cubic,
}

/// Largest relative distance of the interpolated eigenvalues from the spectrum in the middle.
const MIDDLE_ERROR: f64 = 1e-3;
/// Least distance in damping ratio of the interpolated pair from an event.
const EVENT_CLEARANCE: f64 = 3.0 * MIDDLE_ERROR;
/// Largest dip in damping ratio below both ends that counts as rounding.
const DIP_ROUNDING: f64 = 1e-9;
/// Number of intervals at whose ends the interpolation is sampled.
const SAMPLES: usize = 32;

impl MeetingPair {
    /// Pair of the mode in a lane and the mode nearest to it on both sides, with the lane of the latter.
    /// `None` if the nearest is another mode on the other side.
    fn of(before: &ModesAtSpeed, after: &ModesAtSpeed, lane: usize) -> Option<(usize, Self)> {
        let nearest = |state: &ModesAtSpeed| {
            let apart = |l: usize| (state.eigenvalue(l).s - state.eigenvalue(lane).s).norm_sqr();
            let others = state.lanes().filter(|&l| l != lane);
            others.min_by(|&a, &b| apart(a).total_cmp(&apart(b)))
        };
        let other = nearest(before)?;
        if nearest(after) != Some(other) || !before.followed[lane] || !after.followed[lane] {
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
        let pair = Self {
            speeds: [a[0].speed, b[0].speed],
            mean: Cubic::new(mean(a), mean(b)),
            square: Cubic::new(square(a), square(b)),
        };
        Some((other, pair))
    }

    /// Both eigenvalues at a share t of the interval.
    fn at(&self, t: f64) -> [Complex<f64>; 2] {
        let (mean, half) = (self.mean.value(t), self.square.value(t).sqrt());
        [mean + half, mean - half]
    }

    /// True if the interpolated pair has no event of the kind sought between the two speeds.
    fn has_no_event(&self, search: &EventSearch) -> bool {
        let ratios = |k: usize| {
            let mut ratios = self.at(k as f64 / SAMPLES as f64).map(damping_ratio);
            ratios.sort_by(f64::total_cmp);
            ratios
        };
        let all: Vec<[f64; 2]> = (0..=SAMPLES).map(ratios).collect();
        let quiet = |of: usize| {
            let values = all.iter().map(|ratios| ratios[of]);
            let least = values.clone().fold(f64::INFINITY, f64::min);
            let most = values.fold(f64::NEG_INFINITY, f64::max);
            let ends = all[0][of].min(all[SAMPLES][of]);
            match search.kind {
                None => true,
                Some(EventKind::Onset) => least > EVENT_CLEARANCE || most < -EVENT_CLEARANCE,
                Some(EventKind::Minimum) => {
                    least > search.below + EVENT_CLEARANCE || least >= ends - DIP_ROUNDING
                }
            }
        };
        quiet(0) && quiet(1)
    }

    /// True if the spectrum in the middle of the interval has both interpolated eigenvalues.
    fn agrees_with_spectrum(&self, model: &ForcedModel) -> bool {
        let [low, high] = self.speeds;
        let Ok(poles) = Poles::at(model, (low * high).sqrt()) else {
            return false;
        };
        let mut values: Vec<Complex<f64>> = poles.oscillatory().collect();
        let expected = self.at(0.5).into_iter();
        expected
            .map(|s| take_nearest(&mut values, s, MIDDLE_ERROR * size(s)))
            .all(|found| found.is_some())
    }
}

/// Eigenvalues in the lanes of the modes that they continue, and the lanes in which the match is clear.
/// Eigenvalues without a match fill the other lanes, the least damped first.
fn matched(
    now: &ModesAtSpeed,
    speed: f64,
    mut values: Vec<Complex<f64>>,
) -> ([Option<Complex<f64>>; LANES], [bool; LANES]) {
    let (mut lanes, mut clear) = ([None; LANES], [false; LANES]);
    let all = values.clone();
    for l in now.lanes() {
        let known = now.eigenvalue(l);
        let expected = known.expected((speed / known.speed).ln(), None);
        // A strongly damped mode may have left the range of damping that is followed.
        let Some(s) = take_nearest(&mut values, expected, STRONGLY_DAMPED * size(expected)) else {
            continue;
        };
        let apart = |s: &Complex<f64>| size(*s - expected);
        let others = all.iter().filter(|other| **other != s);
        let next = others.map(apart).fold(f64::INFINITY, f64::min);
        clear[l] = apart(&s) < CLEARLY_NEAREST * next;
        lanes[l] = Some(s);
    }
    values.sort_by(|a, b| damping_ratio(*b).total_cmp(&damping_ratio(*a)));
    for lane in lanes.iter_mut().filter(|lane| lane.is_none()) {
        *lane = values.pop();
    }
    (lanes, clear)
}
