//! Indices of many cases, some of which have a model in common.
//!
//! Two cases with the same lateral model have the same lateral indices, two with the same vertical model
//! the same vertical ones: they are measured once. Models are identified by digests of all their
//! numbers.

use std::{
    collections::HashMap,
    sync::{Mutex, MutexGuard, PoisonError},
};

use super::{Measured, Wanted, measure_each};
use crate::{
    case::{Case, Model, Service},
    dynamics::{Digest, LateralModel, VerticalModel},
    evaluate::modes::KinematicBand,
    index::{Behaviour, Index},
};

/// Results kept of each model; with more of them all are forgotten.
const KEPT: usize = 1 << 14;

/// Results by the digest of a model.
type Kept = Mutex<HashMap<Digest, Vec<Measured>>>;

/// Indices of the cases of one service, measured once for each model.
pub struct Shared {
    service: Service,
    model: Model,
    wanted: Vec<Wanted>,
    /// Positions, among the wanted indices, of a model's indices, and their results.
    lateral: (Vec<usize>, Kept),
    vertical: (Vec<usize>, Kept),
    /// Places of the others, which are measured anew for every case.
    others: Vec<usize>,
}

impl Shared {
    /// For the wanted indices of cases with the service and the modelling choices of one.
    pub fn new(case: &Case, wanted: &[Wanted]) -> Self {
        let places = |of: fn(Wanted) -> bool| -> Vec<usize> {
            let wanted = wanted.iter().enumerate();
            wanted.filter(|(_, w)| of(**w)).map(|(i, _)| i).collect()
        };
        Self {
            service: case.service.clone(),
            model: case.model,
            wanted: wanted.to_vec(),
            lateral: (places(is_lateral), Mutex::default()),
            vertical: (places(is_vertical), Mutex::default()),
            others: places(|wanted| !is_lateral(wanted) && !is_vertical(wanted)),
        }
    }

    /// As [`measure_each`], to the bit.
    pub fn measure_each(&self, case: &Case) -> Vec<Measured> {
        if case.service != self.service || case.model != self.model {
            return measure_each(case, &self.wanted);
        }
        let mut measured: Vec<(usize, Measured)> = Vec::with_capacity(self.wanted.len());
        let mut add = |places: &[usize], results: Vec<Measured>| {
            measured.extend(places.iter().copied().zip(results));
        };
        let (lateral, kept) = &self.lateral;
        if !lateral.is_empty() {
            add(
                lateral,
                self.of_model(kept, lateral, case, lateral_digest(case)),
            );
        }
        let (vertical, kept) = &self.vertical;
        if !vertical.is_empty() {
            add(
                vertical,
                self.of_model(kept, vertical, case, vertical_digest(case)),
            );
        }
        add(&self.others, measure_each(case, &self.chosen(&self.others)));
        measured.sort_by_key(|(place, _)| *place);
        measured.into_iter().map(|(_, measured)| measured).collect()
    }

    fn of_model(
        &self,
        kept: &Kept,
        places: &[usize],
        case: &Case,
        digest: Digest,
    ) -> Vec<Measured> {
        if let Some(known) = lock(kept).get(&digest) {
            return known.clone();
        }
        let measured = measure_each(case, &self.chosen(places));
        let mut kept = lock(kept);
        if kept.len() >= KEPT {
            kept.clear();
        }
        kept.insert(digest, measured.clone());
        measured
    }

    fn chosen(&self, places: &[usize]) -> Vec<Wanted> {
        places.iter().map(|place| self.wanted[*place]).collect()
    }
}

/// True if the lateral model, with the band of kinematic motion, decides it.
fn is_lateral(wanted: Wanted) -> bool {
    let in_curve = matches!(wanted, Wanted::Index(Index::SecondaryLateralStrokeInCurve));
    wanted.is_of_lateral_model() && !in_curve
}

/// True if the vertical model, with the static wheel load, decides it.
fn is_vertical(wanted: Wanted) -> bool {
    matches!(wanted, Wanted::Index(index) if index.behaviour() == Behaviour::VerticalRide)
}

fn lateral_digest(case: &Case) -> Digest {
    let band = KinematicBand::new(case, case.service.speed);
    let model = LateralModel::new(case);
    model.forced.digest(&[band.low, band.high])
}

fn vertical_digest(case: &Case) -> Digest {
    let model = VerticalModel::new(case);
    model.forced.digest(&[case.vehicle.wheel_load()])
}

fn lock(kept: &Kept) -> MutexGuard<'_, HashMap<Digest, Vec<Measured>>> {
    // No code panics while it holds the lock.
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{design::sensitivity::Factors, spec::DesignSpace};

    /// Every input moved alone, and then some of them again: shared or not, the results are the same bits.
    #[test]
    fn shared_models_give_the_same_bits() {
        let mut case = Case::prototype();
        case.service.curve = Some(1.0_f64.to_radians());
        for roll in [
            crate::case::TruckRoll::Prescribed,
            crate::case::TruckRoll::Dynamic,
        ] {
            case.model.truck_roll = roll;
            let wanted: Vec<Wanted> = Index::ALL.into_iter().map(Wanted::Index).collect();
            let shared = Shared::new(&case, &wanted);
            let factors = Factors::new(&case, &DesignSpace::default(), 0.1);
            let count = factors.list().len();
            for moved in (0..count).chain([0, count / 2, count - 1]) {
                let mut x = vec![0.5; count];
                x[moved] = 0.9;
                let case = factors.case(&x);
                assert_eq!(
                    shared.measure_each(&case),
                    measure_each(&case, &wanted),
                    "{}",
                    factors.list()[moved].path
                );
            }
            // Not every input is part of both models.
            for (_, kept) in [&shared.lateral, &shared.vertical] {
                assert!(lock(kept).len() < count - 5);
            }
        }
    }
}
