//! Ride and strokes.

use super::{BANDS, Lateral, Measured, Vertical, curving::Curve, no_ride, pieces};
use crate::{
    case::Case,
    evaluate::{
        gradients::Constants,
        limits::PEAK,
        ride::{LateralRide, PassengerRide, VerticalRide, average},
        stroke_in_curve::taken,
    },
    index::Index,
    optimize::problem::{Failure, Piece},
};

/// A ride and its derivatives by each constant.
pub(super) type Graded<T> = (T, Vec<T>);

/// Pieces of a linear function of a ride, which serves for values and derivatives.
fn made_of<T>(
    (ride, derivatives): &Graded<T>,
    graded: bool,
    of: impl Fn(&T) -> Vec<f64>,
) -> Vec<Piece> {
    let by: Option<Vec<Vec<f64>>> = graded.then(|| derivatives.iter().map(&of).collect());
    pieces(&of(ride), by.as_deref())
}

fn peaks(rms: &[f64]) -> Vec<f64> {
    rms.iter().map(|value| PEAK * value).collect()
}

impl Lateral<'_> {
    /// An index of the ride, which is computed when first asked for.
    pub(super) fn ride(&self, index: Index, ride: &mut Option<Graded<LateralRide>>) -> Measured {
        let Self {
            case,
            model,
            poles,
            tangents,
            graded,
            ..
        } = self;
        if index == Index::LateralIsoRatio {
            let passengers = PassengerRide::lateral_with_derivatives(model, case, poles, tangents);
            return passengers
                .map(|(now, by)| iso_ratios(&now, graded.then_some(&by)))
                .map_err(no_ride);
        }
        if ride.is_none() {
            let found = LateralRide::with_derivatives(model, case, poles, tangents);
            *ride = Some(found.map_err(no_ride)?);
        }
        let ride = ride.as_ref().ok_or(Failure::Integration)?;
        if index == Index::SecondaryLateralStrokeInCurve {
            return self.strokes_in_curve(ride);
        }
        Ok(made_of(ride, *graded, |ride| match index {
            Index::LateralAcceleration => vec![average(&ride.acceleration)],
            Index::SecondaryLateralStroke => peaks(&ride.secondary_stroke),
            Index::PrimaryLateralStroke => peaks(&ride.primary_stroke),
            Index::PrimaryLongitudinalStroke => peaks(&ride.longitudinal_stroke),
            _ => peaks(&ride.excursion),
        }))
    }
}

impl Lateral<'_> {
    /// Secondary lateral strokes in the curve that the service gives; none without one.
    fn strokes_in_curve(&self, (ride, by): &Graded<LateralRide>) -> Measured {
        let Some(angle) = self.case.service.curve else {
            return Ok(Vec::new());
        };
        let by_constants = self.constants.map(|c| (c, vec![0.0; c.len()]));
        let curve = Curve::new(self.case, angle.to_degrees(), by_constants)?;
        let piece = |j: usize| {
            let stroke = curve.secondary_stroke(j);
            let change = |(ride, change): (&LateralRide, f64)| {
                stroke.signum() * change + PEAK * ride.secondary_stroke[j]
            };
            let changes = curve.secondary_stroke_changes(j);
            Piece {
                gradient: changes.map(|changes| by.iter().zip(changes).map(change).collect()),
                ..Piece::single(j, taken(stroke, ride.secondary_stroke[j]))
            }
        };
        Ok((0..2).map(piece).collect())
    }
}

impl Vertical<'_> {
    pub(super) fn ride(&mut self, index: Index) -> Measured {
        self.model()?;
        let (case, graded) = (self.case, self.constants.is_some());
        if index == Index::VerticalIsoRatio {
            let (model, poles, tangents) = self.model()?;
            let passengers = PassengerRide::vertical_with_derivatives(model, case, poles, tangents);
            return passengers
                .map(|(now, by)| iso_ratios(&now, graded.then_some(&by)))
                .map_err(no_ride);
        }
        if self.ride.is_none() {
            let (model, poles, tangents) = self.model()?;
            let ride = VerticalRide::with_derivatives(model, case, poles, tangents);
            self.ride = Some(ride.map_err(no_ride)?);
        }
        let ride = self.ride.as_ref().ok_or(Failure::Integration)?;
        let mut made = made_of(ride, graded, |ride| match index {
            Index::VerticalAcceleration => vec![average(&ride.acceleration)],
            Index::SecondaryVerticalStroke => peaks(&ride.secondary_stroke),
            Index::PrimaryVerticalStroke => peaks(&ride.primary_stroke),
            _ => peaks(&ride.wheel_load),
        });
        if index == Index::WheelLoadVariation {
            over_static_load(&mut made, case, self.constants);
        }
        Ok(made)
    }
}

/// Divides dynamic loads of wheels, wheelsets 1–4, by the static ones, and their gradients accordingly.
fn over_static_load(pieces: &mut [Piece], case: &Case, constants: Option<&Constants>) {
    for piece in pieces {
        let of = |case: &Case| case.vehicle.axle_load_of(piece.index / 2) / 2.0;
        let load = of(case);
        piece.value /= load;
        if let (Some(gradient), Some(constants)) = (&mut piece.gradient, constants) {
            for (slope, of_load) in gradient.iter_mut().zip(constants.slopes(load, of)) {
                *slope = (*slope - piece.value * of_load) / load;
            }
        }
    }
}

/// Ratios of band accelerations to the ISO boundary; `by` has the derivatives of the accelerations by
/// each constant, point by point and band by band.
fn iso_ratios(passengers: &[PassengerRide; 3], by: Option<&Vec<[Vec<f64>; 3]>>) -> Vec<Piece> {
    let mut ratios = Vec::new();
    for (point, passenger) in passengers.iter().enumerate() {
        for (band, ride) in passenger.bands.iter().enumerate() {
            if let Some(boundary) = ride.boundary {
                let slopes = by.map(|by| by.iter().map(|d| d[point][band] / boundary).collect());
                ratios.push(Piece {
                    gradient: slopes,
                    ..Piece::single(BANDS * point + band, ride.acceleration / boundary)
                });
            }
        }
    }
    ratios
}
