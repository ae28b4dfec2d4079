//! Critical speed and damping.

use super::{Lateral, Measured, Wanted};
use crate::{
    case::Case,
    dynamics::{ForcedTangent, LateralModel},
    evaluate::{
        gradients::modes,
        modes::{KinematicBand, KinematicMode, LateralModes, Mode},
        stability::{DampingMinimum, DampingRange, Place, Stability},
    },
    index::Index,
    numerics::damping_ratio_change,
    optimize::problem::{Failure, Piece},
};

/// Multiple of the lowest critical speed up to which others may become the lowest.
const NEARBY: f64 = 1.5;
/// Share of the speed up to which damping is looked at where the range begins at the latest.
const START: f64 = 0.5;

impl Lateral<'_> {
    pub(super) fn stability(&self, wanted: Wanted) -> Measured {
        match wanted {
            Wanted::DampingTo { speed, below } => self.damping_to(speed, below),
            Wanted::Index(Index::CriticalSpeed) => self.onsets(),
            Wanted::Index(Index::LeastDampingRatioToSpeed) => {
                let mut pieces = self.damping_to(self.case.service.speed, f64::INFINITY)?;
                // The operating speed is given.
                for gradient in pieces
                    .iter_mut()
                    .filter_map(|piece| piece.gradient.as_mut())
                {
                    gradient.pop();
                }
                Ok(pieces)
            }
            Wanted::Index(Index::KinematicDampingRatio) => self.kinematic_damping(),
            Wanted::Index(_) => self.damping_at_speed(),
        }
    }

    /// Least damping ratios between the start of the range and a speed; behind the constants their
    /// gradients have the slope over that speed.
    fn damping_to(&self, speed: f64, below: f64) -> Measured {
        let lowest = self.case.model.speed_range[0];
        let start = lowest.min(START * speed);
        let range = DampingRange::new(&self.model, &self.poles, [start, speed], below)
            .map_err(|_| Failure::Eigenvalues)?;
        if range.diverges {
            return Err(Failure::Diverges);
        }
        if range.minima.is_empty() {
            return Err(Failure::NoMode);
        }
        let pieces = range.minima.iter().map(|minimum| {
            // How the speed of the minimum goes with the speed asked for: inside the range not at
            // all to first order.
            let moves = match minimum.place {
                Place::Top => 1.0,
                Place::Bottom if start < lowest => START,
                _ => 0.0,
            };
            let gradient = || minimum_gradient(&self.model, &self.tangents, minimum, moves);
            Piece {
                value: minimum.damping_ratio,
                index: match minimum.place {
                    Place::Top => 0,
                    Place::Inside => 1,
                    Place::Bottom => 2,
                },
                label: minimum.frequency.ln(),
                gradient: self.graded.then(gradient).flatten(),
            }
        });
        Ok(pieces.collect())
    }

    /// Damping ratios of a truck's motions under a carbody at rest.
    fn kinematic_damping(&self) -> Measured {
        if self.poles.diverge() {
            return Err(Failure::Diverges);
        }
        let speed = self.case.service.speed;
        let mode =
            KinematicMode::new(&self.model, self.case, speed).map_err(|_| Failure::Eigenvalues)?;
        let mode = mode.ok_or(Failure::Diverges)?;
        if mode.damping_ratio >= 1.0 {
            return Ok(vec![Piece {
                gradient: self.graded.then(|| vec![0.0; self.tangents.len()]),
                ..Piece::single(0, 1.0)
            }]);
        }
        let gradients = if self.graded {
            let band = self.slopes_of_band(speed);
            mode.derivatives(&self.model, &self.tangents, &band, speed)
        } else {
            None
        };
        let motions = mode.motions.iter().enumerate();
        let pieces = motions
            .filter(|(_, motion)| motion.oscillates())
            .map(|(k, motion)| Piece {
                value: motion.damping_ratio(),
                index: 0,
                label: motion.frequency().ln(),
                gradient: gradients.as_ref().map(|of| of[k].clone()),
            });
        Ok(pieces.collect())
    }

    /// Derivatives by each constant of the logarithm of the frequencies of kinematic motion, whose
    /// squares are linear in the conicity.
    fn slopes_of_band(&self, speed: f64) -> Vec<f64> {
        let square = |case: &Case| KinematicBand::new(case, speed).low.powi(2);
        let own = square(self.case);
        let slopes = self.constants.map(|c| c.slopes(own, square));
        let slopes = slopes.unwrap_or_default().into_iter();
        slopes.map(|slope| slope / (2.0 * own)).collect()
    }

    /// Damping ratios of all modes at the operating speed.
    fn damping_at_speed(&self) -> Measured {
        if self.poles.diverge() {
            return Err(Failure::Diverges);
        }
        let modes = LateralModes::of_vehicle(&self.model, self.case, &self.poles)
            .map_err(|_| Failure::Eigenvalues)?;
        let system = &self.model.forced.system;
        let gradient = |mode: &Mode| -> Vec<f64> {
            let speed = self.case.service.speed;
            let changes = modes::by_constants(system, &self.tangents, speed, mode);
            let of = |change| damping_ratio_change(mode.eigenvalue, change);
            changes.into_iter().map(of).collect()
        };
        let wanted = modes.oscillatory.iter();
        let pieces: Vec<Piece> = wanted
            .map(|m| Piece {
                value: m.damping_ratio,
                index: 0,
                label: m.frequency.ln(),
                gradient: self.graded.then(|| gradient(&m.mode)),
            })
            .collect();
        if pieces.is_empty() {
            return Err(Failure::NoMode);
        }
        Ok(pieces)
    }

    /// Speeds at which modes lose their damping; the end of the range where none does.
    fn onsets(&self) -> Measured {
        let range = self.case.model.speed_range;
        // Onsets far above the lowest cannot matter near this design.
        let stability = Stability::new(&self.model, &self.poles, range, NEARBY);
        let stability = stability.map_err(|_| Failure::Eigenvalues)?;
        if stability.divergence.is_some() {
            return Err(Failure::Diverges);
        }
        if stability.unstable_at_start || stability.onsets.is_empty() {
            let bound = stability.critical_speed().unwrap_or(range[1]);
            return Ok(vec![Piece {
                gradient: self.graded.then(|| vec![0.0; self.tangents.len()]),
                ..Piece::single(0, bound)
            }]);
        }
        let system = &self.model.forced.system;
        let lowest = stability.onsets[0].speed;
        let near = stability
            .onsets
            .iter()
            .filter(|onset| onset.speed < NEARBY * lowest);
        Ok(near
            .map(|onset| Piece {
                value: onset.speed,
                index: 1,
                label: onset.frequency.ln(),
                gradient: self
                    .graded
                    .then(|| modes::critical_speed(system, &self.tangents, onset)),
            })
            .collect())
    }
}

/// Gradient of a least damping ratio whose speed goes with the one asked for as `moves` says. `None`
/// if its vectors cannot be had.
fn minimum_gradient(
    model: &LateralModel,
    tangents: &[ForcedTangent],
    minimum: &DampingMinimum,
    moves: f64,
) -> Option<Vec<f64>> {
    let (system, speed) = (&model.forced.system, minimum.speed);
    let mode = Mode::at(system, &system.damping_at(speed), minimum.eigenvalue())?;
    let mut changes = modes::by_constants(system, tangents, speed, &mode);
    changes.push(moves * modes::by_speed(system, speed, &mode));
    let of = |change| damping_ratio_change(mode.eigenvalue, change);
    Some(changes.into_iter().map(of).collect())
}
