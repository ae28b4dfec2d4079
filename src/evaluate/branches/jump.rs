//! Over a place where modes cannot be told apart, by the spectrum beyond it.

use nalgebra::Complex;

use super::{
    events::find,
    state::{STRONG, State},
    track::{Branches, Search, take_nearest, worth_following},
};
use crate::{
    dynamics::{Poles, elimination::LANES},
    evaluate::mode::damping_ratio,
};

/// Widths of a jump that are tried, in ln V.
const WIDTHS: [f64; 3] = [0.03, 0.06, 0.12];
/// A mode goes on in that nearest to where it was expected if it is nearer by this factor than to
/// any other.
const CLEAR: f64 = 0.25;

impl Branches<'_> {
    /// The modes beyond a place at which two come too close, where eigenvalues move as the square
    /// root of the speed and cannot be interpolated. Those of which it is not clear which is which
    /// must be damped by more than the search asks for on both sides, or the answer is `None`.
    pub(super) fn jump(&mut self, now: &State, target: f64, search: &mut Search) -> Option<State> {
        let way = (target / now.speed()).ln();
        for width in WIDTHS.into_iter().filter(|width| *width < way.abs()) {
            let speed = now.speed() * width.copysign(way).exp();
            let poles = Poles::at(&self.model.forced.system, speed).ok()?;
            let (values, clear) = matched(now, speed, worth_following(&poles));
            let Some(next) = State::of(&mut self.refiner, speed, values) else {
                continue;
            };
            let uncertain = |state: &State, l: usize| {
                state.alive[l] && !clear[l] && damping_ratio(state.known(l).s) < search.clear_of
            };
            if (0..LANES).any(|l| uncertain(now, l) || uncertain(&next, l)) {
                return None;
            }
            let mut before = now.clone();
            before.bury(|_, l| !clear[l]);
            find(&mut self.refiner, &before, &next, search)?;
            return Some(next);
        }
        None
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
        let known = now.known(l);
        let expected = known.expected((speed / known.speed).ln(), None);
        // A strongly damped one may have left the sector that is followed.
        let Some(s) = take_nearest(&mut values, expected, STRONG * expected.norm()) else {
            continue;
        };
        let apart = |s: &Complex<f64>| (s - expected).norm();
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
