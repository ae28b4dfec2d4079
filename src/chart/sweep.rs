//! Lateral rides over one quantity, which several charts share.

use super::{
    performance::lateral_ride,
    workbook::{CONICITY_RANGE, Workbook},
};
use crate::{evaluate::ride::LateralRide, parameter::Parameter, plot::Scale, wheel_rail::PROFILES};

/// Lateral rides over the values of something.
pub struct Sweep {
    /// Values, SI.
    pub values: Vec<f64>,
    /// Rides; `None`: unstable at the operating speed.
    pub rides: Vec<Option<LateralRide>>,
}

impl Sweep {
    /// Points of a curve: the value, and what is taken from the ride. Not a number where there is
    /// no ride.
    pub fn points(&self, of: impl Fn(&LateralRide) -> f64) -> Vec<[f64; 2]> {
        let ride = |ride: &Option<LateralRide>| ride.as_ref().map_or(f64::NAN, &of);
        self.values
            .iter()
            .zip(&self.rides)
            .map(|(value, r)| [*value, ride(r)])
            .collect()
    }

    /// Ranges of the values without a ride.
    pub fn unstable(&self) -> Vec<[f64; 2]> {
        let last = self.rides.len().saturating_sub(1);
        let without = |k: usize| self.rides.get(k).is_some_and(Option::is_none);
        // The end of stability lies somewhere between two values.
        let between = |a: usize, b: usize| f64::midpoint(self.values[a], self.values[b]);
        let starts = (0..self.rides.len()).filter(|k| without(*k) && (*k == 0 || !without(k - 1)));
        starts
            .map(|k| {
                let end = (k..last).find(|k| !without(k + 1)).unwrap_or(last);
                [
                    between(k.saturating_sub(1), k),
                    between(end, (end + 1).min(last)),
                ]
            })
            .collect()
    }
}

/// Values in a sweep.
const SWEEP: usize = 121;
/// Values in each of the sweeps over the speed.
const SPEEDS: usize = 121;

impl Workbook<'_> {
    /// Lateral rides at values of a parameter.
    fn sweep(&self, parameter: Parameter, values: Vec<f64>) -> Sweep {
        let rides = self.each(&values, |v| lateral_ride(&self.with(&[(parameter, *v)])));
        Sweep { values, rides }
    }

    /// Lateral rides over the conicity.
    pub fn over_conicity(&self) -> &Sweep {
        self.over_conicity.get_or_init(|| {
            let values = Scale::Linear.spread(CONICITY_RANGE, SWEEP);
            self.sweep(Parameter::CONICITY, values)
        })
    }

    /// Lateral rides over the primary bending stiffness.
    pub fn over_bending(&self) -> &Sweep {
        self.over_bending.get_or_init(|| {
            let [axis, _] = self.stiffness_axes();
            let values = axis.scale.spread(axis.range, SWEEP);
            self.sweep(Parameter::PRIMARY_BENDING_STIFFNESS, values)
        })
    }

    /// Lateral rides over the primary lateral stiffness.
    pub fn over_lateral(&self) -> &Sweep {
        self.over_lateral.get_or_init(|| {
            let [_, axis] = self.stiffness_axes();
            let values = axis.scale.spread(axis.range, SWEEP);
            self.sweep(Parameter::PRIMARY_LATERAL_STIFFNESS, values)
        })
    }

    /// Lateral rides over the speed, for the conicities of Table 4.1.1.
    pub fn over_speed(&self) -> &[(f64, Sweep)] {
        self.over_speed.get_or_init(|| {
            let range = self.speed_axis().range;
            PROFILES
                .into_iter()
                .map(|conicity| {
                    let values = Scale::Linear.spread(range, SPEEDS);
                    let rides = self.each(&values, |v| {
                        let mut case = self.with(&[(Parameter::CONICITY, conicity)]);
                        case.service.speed = *v;
                        lateral_ride(&case)
                    });
                    (conicity, Sweep { values, rides })
                })
                .collect()
        })
    }
}
