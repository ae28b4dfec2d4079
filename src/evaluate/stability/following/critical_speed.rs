//! Onsets of instability on the followed modes.

use super::{Descent, Event, EventSearch, FollowedModes, StepSize};
use crate::{
    dynamics::LateralModel,
    evaluate::stability::{Crossing, Stability},
    numerics::Poles,
};

/// Relative distances below the lowest onset's speed at which the mode count must find no growing mode;
/// the first at which the count is conclusive decides.
const CONFIRMED_BELOW: [f64; 2] = [1e-5, 1e-4];

impl Stability {
    /// Onsets by following the modes from the poles at any speed; arguments as [`Stability::new`].
    /// `None` where two modes cannot be distinguished.
    pub fn by_following(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        reach: f64,
    ) -> Option<Self> {
        StepSize::first_answer(|steps| {
            let search = EventSearch::onsets(steps);
            let down = FollowedModes::to_lowest_speed(range, model, poles, search)?;
            Self::upwards(model, range, reach, down)
        })
    }

    /// Completes the search from the start upwards, after that to the lowest speed.
    fn upwards(
        model: &LateralModel,
        [low, high]: [f64; 2],
        reach: f64,
        (mut modes, mut search, bottom): Descent<'_>,
    ) -> Option<Self> {
        let enough = |events: &[Event], speed: f64| {
            let speeds = events.iter().map(|event| event.at.speed);
            speed > reach * speeds.fold(f64::INFINITY, f64::min)
        };
        let unstable_at_start = bottom.iter().any(|known| known.s.re >= 0.0);
        let mut confirmed = unstable_at_start;
        if !enough(&search.events, modes.start_speed()) {
            let top = modes.walk(high, &mut search, enough)?;
            // Confirmed just below the lowest onset, if there is one; at the top otherwise.
            confirmed |= stable_below_lowest(&mut modes, &search.events);
            if !confirmed {
                modes.complete(top, &mut search)?;
                confirmed = search.events.is_empty();
            }
        }
        if !confirmed && !stable_below_lowest(&mut modes, &search.events) {
            return None;
        }
        let mut events = search.events;
        events.sort_by(|a, b| a.at.speed.total_cmp(&b.at.speed));
        let mut onsets = Vec::with_capacity(events.len());
        for event in events {
            onsets.push(Crossing::new(model, event.at.speed, event.mode?));
        }
        // Nearly equal real eigenvalues may come out as a pair.
        let as_good_as_real = || Poles::at(&model.forced, low).is_ok_and(|poles| poles.diverge());
        let diverges = modes.diverges() || unstable_at_start && as_good_as_real();
        Some(Self {
            range: [low, high],
            onsets,
            unstable_at_start,
            divergence: diverges.then_some(low),
        })
    }
}

/// True if no mode grows just below the lowest of some onsets; false without onsets.
fn stable_below_lowest(modes: &mut FollowedModes<'_>, onsets: &[Event]) -> bool {
    let lowest = onsets
        .iter()
        .map(|event| &event.at)
        .min_by(|a, b| a.speed.total_cmp(&b.speed));
    lowest.is_some_and(|at| {
        let stable =
            |below: f64| modes.stable_at(at.speed * (1.0 - below), at.s - at.slope * below);
        CONFIRMED_BELOW
            .into_iter()
            .find_map(stable)
            .unwrap_or(false)
    })
}
