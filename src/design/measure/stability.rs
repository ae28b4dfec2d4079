//! Critical speed and damping.

use super::Models;
use crate::{
    dynamics::{ForcedTangent, LateralModel},
    evaluate::{
        critical_speed::Stability,
        damping_range::{DampingMinimum, DampingRange, Place},
        gradients::modes,
        lateral_modes::{LateralModes, LateralShape},
        mode::Mode,
    },
    index::Index,
    optimize::problem::{Failure, Piece},
};

/// Multiple of the lowest critical speed up to which others may become the lowest.
const NEARBY: f64 = 1.5;
/// Share of the speed up to which damping is looked at where the range begins at the latest.
const START: f64 = 0.5;

impl Models<'_> {
    /// Least damping ratios between the start of the range and a speed; behind the constants their
    /// gradients have the slope over that speed.
    pub(super) fn damping_to(&mut self, speed: f64, below: f64) -> Result<Vec<Piece>, Failure> {
        let lowest = self.case.model.speed_range[0];
        let graded = self.constants.is_some();
        let (model, tangents, poles) = self.with_tangents()?;
        let start = lowest.min(START * speed);
        let range = DampingRange::new(model, poles, [start, speed], below)
            .map_err(|_| Failure::Eigenvalues)?;
        if range.diverges {
            return Err(Failure::Diverging);
        }
        if range.minima.is_empty() {
            return Err(Failure::NoMode);
        }
        let pieces = range.minima.iter().map(|minimum| Piece {
            value: minimum.damping_ratio,
            index: match minimum.place {
                Place::Top => 0,
                Place::Inside => 1,
                Place::Bottom => 2,
            },
            label: minimum.frequency.ln(),
            gradient: graded
                .then(|| {
                    // How the speed of the minimum goes with the speed asked for: inside the range
                    // not at all to first order.
                    let moves = match minimum.place {
                        Place::Top => 1.0,
                        Place::Bottom if start < lowest => START,
                        _ => 0.0,
                    };
                    minimum_gradient(model, tangents, minimum, moves)
                })
                .flatten(),
        });
        Ok(pieces.collect())
    }

    pub(super) fn stability(&mut self, index: Index) -> Result<Vec<Piece>, Failure> {
        let speed = self.case.service.speed;
        match index {
            Index::CriticalSpeed => self.onsets(),
            Index::LeastDampingRatioToSpeed => {
                let mut pieces = self.damping_to(speed, f64::INFINITY)?;
                // The operating speed is given.
                for piece in &mut pieces {
                    if let Some(gradient) = &mut piece.gradient {
                        gradient.pop();
                    }
                }
                Ok(pieces)
            }
            _ => self.damping_at_speed(index == Index::KinematicDampingRatio),
        }
    }

    fn damping_at_speed(&mut self, kinematic_only: bool) -> Result<Vec<Piece>, Failure> {
        let (case, graded) = (self.case, self.constants.is_some());
        if self.modes.is_none() {
            let (model, poles) = self.with_poles()?;
            let modes = LateralModes::new(model, case, poles).map_err(|_| Failure::Eigenvalues)?;
            self.modes = Some(modes);
        }
        let modes = self.modes.take().ok_or(Failure::Eigenvalues)?;
        let (model, tangents, _) = self.with_tangents()?;
        let system = &model.forced.system;
        let wanted = modes.oscillatory.iter();
        let pieces: Vec<Piece> = wanted
            .filter(|m| !kinematic_only || m.shape == LateralShape::Kinematic)
            .map(|m| Piece {
                value: m.damping_ratio,
                index: 0,
                label: m.frequency.ln(),
                gradient: graded.then(|| {
                    let changes =
                        modes::by_constants(system, tangents, case.service.speed, &m.mode);
                    let of = |change| modes::damping_ratio(m.mode.eigenvalue, change);
                    changes.into_iter().map(of).collect()
                }),
            })
            .collect();
        self.modes = Some(modes);
        if pieces.is_empty() {
            return Err(Failure::NoMode);
        }
        Ok(pieces)
    }

    /// Speeds at which modes lose their damping; the end of the range where none does.
    fn onsets(&mut self) -> Result<Vec<Piece>, Failure> {
        let range = self.case.model.speed_range;
        let graded = self.constants.is_some();
        let (model, tangents, poles) = self.with_tangents()?;
        // Onsets far above the lowest cannot matter near this design.
        let stability = Stability::new(model, poles, range, NEARBY);
        let stability = stability.map_err(|_| Failure::Eigenvalues)?;
        if stability.divergence.is_some() {
            return Err(Failure::Diverging);
        }
        if stability.unstable_at_start || stability.onsets.is_empty() {
            let bound = stability.critical_speed().unwrap_or(range[1]);
            let gradient = graded.then(|| vec![0.0; tangents.len()]);
            return Ok(vec![Piece {
                gradient,
                ..Piece::single(0, bound)
            }]);
        }
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
                gradient: graded
                    .then(|| modes::critical_speed(&model.forced.system, tangents, onset)),
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
    let of = |change| modes::damping_ratio(mode.eigenvalue, change);
    Some(changes.into_iter().map(of).collect())
}
