//! Least damping ratios on the followed modes.

use nalgebra::Complex;

use super::{COMPLETE_BELOW, EventSearch, FollowedModes, StepSize};
use crate::{
    dynamics::LateralModel,
    evaluate::stability::{DampingMinimum, DampingRange, Place},
    numerics::{Poles, diverge},
};

impl DampingRange {
    /// Minima by following the modes from the poles at any speed; arguments as [`DampingRange::new`].
    /// `None` where two modes cannot be distinguished, and where `below` asks for strongly damped modes
    /// too, which are not followed.
    pub fn by_following(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        below: f64,
    ) -> Option<Self> {
        if below > COMPLETE_BELOW {
            return None;
        }
        StepSize::first_answer(|steps| {
            let search = EventSearch::minima(below, steps);
            let (mut modes, mut search, bottom) =
                FollowedModes::to_lowest_speed(range, model, poles, search)?;
            let top = modes.walk(range[1], &mut search, |_, _| false)?;
            let top = modes.complete(top, &mut search)?;
            let grown: Vec<Complex<f64>> = bottom.iter().map(|known| known.s).collect();
            let diverges = modes.diverges() || diverge(&grown);
            let mut minima = Vec::new();
            for (place, modes) in [(Place::Bottom, bottom), (Place::Top, top)] {
                let mut ends: Vec<DampingMinimum> = modes
                    .iter()
                    .map(|known| DampingMinimum::new(place, known))
                    .collect();
                ends.sort_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio));
                let among = ends.iter().filter(|m| m.damping_ratio < below).count();
                ends.truncate(among.max(1));
                minima.extend(ends);
            }
            let inside = search.events.iter();
            minima.extend(
                inside
                    .map(|event| DampingMinimum::new(Place::Inside, &event.at))
                    .filter(|minimum| minimum.damping_ratio < below),
            );
            Some(Self { minima, diverges })
        })
    }
}
