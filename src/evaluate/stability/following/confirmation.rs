//! Confirmation of the followed modes by the mode count.

use nalgebra::Complex;

use super::{
    followed_modes::{FollowedModes, WalkEnd, take_nearest, worth_following},
    modes_at_speed::ModesAtSpeed,
    search::EventSearch,
};
use crate::numerics::{
    Eigenvalue, PAIR_CONVERGED, Poles, cubic::Between, damping_ratio, elimination::LANES,
    modes_below, size,
};

/// Damping ratio below which all modes at the end of a complete walk are known.
pub const COMPLETE_BELOW: f64 = 0.05;
/// Range of damping ratios in which the ray of the mode count is laid.
const COUNT_RAYS: [f64; 2] = [COMPLETE_BELOW, 0.15];
/// Relative distance below which an eigenvalue of a spectrum is that of a followed mode.
const SAME_EIGENVALUE: f64 = 1e-5;

impl FollowedModes<'_> {
    /// All modes at the end of a walk with damping ratios below [`COMPLETE_BELOW`], confirmed by the mode
    /// count. Modes that the walk did not follow are followed back to the start for their events.
    pub fn complete(
        &mut self,
        walked: WalkEnd,
        search: &mut EventSearch,
    ) -> Option<Vec<Eigenvalue>> {
        let speed = walked.0.speed();
        let followed = walked.0.followed;
        let mut modes = self.converged(walked.0);
        if !self.are_all(&modes, speed) {
            let unfollowed = self.unfollowed(&modes, speed)?;
            modes.extend(self.converged(unfollowed.clone()));
            if !self.are_all(&modes, speed) {
                return None;
            }
            let back = self.start.speed();
            let mut back = self.follow(unfollowed, back, search, |_, _| false)?;
            let lanes_used = back.lanes_used();
            if lanes_used > 0 {
                self.refiner
                    .converge(&mut back.pairs, lanes_used, PAIR_CONVERGED);
            }
            // A mode that returns to one that went all the way was confused with it.
            let is_own = |l: usize| {
                let mut own = self.start.lanes().filter(|o| followed[*o]);
                own.any(|o| ModesAtSpeed::is_same_mode((&self.start, o), (&back, l)))
            };
            if back.lanes().any(is_own) {
                return None;
            }
        }
        Some(modes)
    }

    /// Eigenvalues refined to convergence.
    fn converged(&mut self, mut state: ModesAtSpeed) -> Vec<Eigenvalue> {
        let lanes_used = state.lanes_used();
        if lanes_used > 0 {
            self.refiner
                .converge(&mut state.pairs, lanes_used, PAIR_CONVERGED);
        }
        state.lanes().map(|l| state.eigenvalue(l)).collect()
    }

    /// Modes at a speed besides the `known` ones. `None` if a lightly damped known one is not in the
    /// spectrum.
    fn unfollowed(&mut self, known: &[Eigenvalue], speed: f64) -> Option<ModesAtSpeed> {
        let poles = Poles::at(&self.model.forced, speed).ok()?;
        let mut values = worth_following(&poles);
        for known in known {
            let taken = take_nearest(&mut values, known.s, SAME_EIGENVALUE * size(known.s));
            if taken.is_none() && damping_ratio(known.s) < COUNT_RAYS[1] {
                return None;
            }
        }
        ModesAtSpeed::new(&mut self.refiner, speed, values)
    }

    /// True if no mode grows at a speed, m/s, just below the onset of a mode, whose eigenvalue there is
    /// `known`: by the mode count. `None` if the count is inconclusive.
    pub fn stable_at(&mut self, speed: f64, known: Complex<f64>) -> Option<bool> {
        let modes = self.modes_near(speed, known);
        let counted = modes_below(&mut self.refiner, speed, 0.0, &modes);
        counted.map(|counted| self.agrees(counted, 0))
    }

    /// Eigenvalues at a speed in a step with an event: of the event's mode, `one`, and of the others.
    fn modes_near(&mut self, speed: f64, one: Complex<f64>) -> Vec<Complex<f64>> {
        let within = |[low, high]: &[Eigenvalue; 2]| low.speed <= speed && speed <= high.speed;
        let step = self
            .steps_with_events
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
            let is_new = |known: &Complex<f64>| size(*known - s) > SAME_EIGENVALUE * size(s);
            if s.is_finite() && s.im > 0.0 && modes.iter().all(is_new) {
                modes.push(s);
            }
        }
        modes
    }

    /// True if `modes` are all lightly damped modes at a speed, by the mode count.
    fn are_all(&mut self, modes: &[Eigenvalue], speed: f64) -> bool {
        let values: Vec<Complex<f64>> = modes.iter().map(|known| known.s).collect();
        let mut ratios: Vec<f64> = values.iter().map(|s| damping_ratio(*s)).collect();
        ratios.push(COUNT_RAYS[0]);
        ratios.push(COUNT_RAYS[1]);
        ratios.retain(|z| (COUNT_RAYS[0]..=COUNT_RAYS[1]).contains(z));
        ratios.sort_by(f64::total_cmp);
        // The ray through the middle of the widest gap is far from every known mode.
        let gap = ratios
            .windows(2)
            .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let zeta = gap.map_or(COUNT_RAYS[0], |gap| f64::midpoint(gap[0], gap[1]));
        let expected = values.iter().filter(|s| damping_ratio(**s) < zeta).count();
        let counted = modes_below(&mut self.refiner, speed, zeta, &values);
        counted.is_some_and(|counted| self.agrees(counted, expected))
    }

    /// True if a count is that of some oscillations and the growing real eigenvalues, which count half.
    fn agrees(&self, counted: f64, oscillating: usize) -> bool {
        (counted - 0.5 * self.growing as f64 - oscillating as f64).abs() < 0.1
    }
}
