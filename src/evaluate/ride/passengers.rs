//! Comfort of passengers: weighted accelerations and one-third-octave bands (3.3.4).

use super::{
    panels::response_panels,
    response::Response,
    rms::{NoRide, mean_squares, rms_change, stationary},
};
use crate::{
    case::Case,
    comfort::{iso_boundary, sperling, third_octave, weighting},
    dynamics::{ForcedModel, ForcedTangent, LateralModel, VerticalModel},
    numerics::{Poles, panels::divided, quadrature::Integrals},
};

/// Comfort measures of one passenger point in one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct PassengerRide {
    /// RMS acceleration, m/s².
    pub acceleration: f64,
    /// Frequency-weighted RMS after ISO 2631-1 (W_d lateral, W_k vertical), m/s².
    pub iso_weighted: f64,
    /// Frequency-weighted RMS after EN 12299 (W_d lateral, W_b vertical), m/s².
    pub en_weighted: f64,
    /// Sperling's W_z.
    pub w_z: f64,
    /// RMS acceleration by one-third-octave band.
    pub bands: Vec<BandRide>,
}

/// RMS acceleration in a one-third-octave band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandRide {
    /// Exact band centre, Hz.
    pub centre: f64,
    /// RMS acceleration, m/s².
    pub acceleration: f64,
    /// ISO 2631 one-hour reduced comfort boundary, m/s²; none below 1 Hz.
    pub boundary: Option<f64>,
}

impl PassengerRide {
    /// Largest ratio of a band's RMS acceleration to the ISO boundary, with its centre in Hz.
    pub fn boundary_ratio(&self) -> Option<(f64, f64)> {
        self.bands
            .iter()
            .filter_map(|band| Some((band.acceleration / band.boundary?, band.centre)))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// At c.g., front and rear, laterally.
    ///
    /// # Errors
    ///
    /// [`NoRide`] where there is none.
    pub fn lateral(model: &LateralModel, case: &Case, poles: &Poles) -> Result<[Self; 3], NoRide> {
        Self::lateral_with_derivatives(model, case, poles, &[]).map(|(passengers, _)| passengers)
    }

    /// As [`PassengerRide::lateral`], with the derivatives of the band accelerations by design
    /// constants.
    ///
    /// # Errors
    ///
    /// [`NoRide`] where there is none.
    pub fn lateral_with_derivatives(
        model: &LateralModel,
        case: &Case,
        poles: &Poles,
        tangents: &[ForcedTangent],
    ) -> Result<([Self; 3], BandDerivatives), NoRide> {
        let spectra = Spectra::new(&model.forced, case, poles, tangents, Direction::Lateral)?;
        Ok(spectra.passengers(tangents.len()))
    }

    /// At c.g., front and rear, vertically.
    ///
    /// # Errors
    ///
    /// [`NoRide`] where there is none.
    pub fn vertical(
        model: &VerticalModel,
        case: &Case,
        poles: &Poles,
    ) -> Result<[Self; 3], NoRide> {
        Self::vertical_with_derivatives(model, case, poles, &[]).map(|(passengers, _)| passengers)
    }

    /// As [`PassengerRide::vertical`], with the derivatives of the band accelerations by design
    /// constants.
    ///
    /// # Errors
    ///
    /// [`NoRide`] where there is none.
    pub fn vertical_with_derivatives(
        model: &VerticalModel,
        case: &Case,
        poles: &Poles,
        tangents: &[ForcedTangent],
    ) -> Result<([Self; 3], BandDerivatives), NoRide> {
        let spectra = Spectra::new(&model.forced, case, poles, tangents, Direction::Vertical)?;
        Ok(spectra.passengers(tangents.len()))
    }
}

/// Derivatives of the RMS accelerations in the bands at three points, by each constant.
pub type BandDerivatives = Vec<[Vec<f64>; 3]>;

/// Direction of the acceleration, which decides the comfort measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Direction {
    Lateral,
    Vertical,
}

impl Direction {
    /// Squared weights on the acceleration spectrum: ISO 2631-1, EN 12299, Sperling.
    fn weights(self, f: f64) -> [f64; 3] {
        let [iso, en, sperling] = match self {
            Self::Lateral => [
                weighting::w_d(f),
                weighting::w_d(f),
                sperling::horizontal(f),
            ],
            Self::Vertical => [weighting::w_k(f), weighting::w_b(f), sperling::vertical(f)],
        };
        [iso * iso, en * en, sperling * sperling]
    }

    fn boundary(self, f: f64) -> Option<f64> {
        match self {
            Self::Lateral => iso_boundary::lateral(f),
            Self::Vertical => iso_boundary::vertical(f),
        }
    }
}

/// Mean squares of the three accelerations, unweighted and with three weights, between the edges of the
/// one-third-octave bands and of the panels.
struct Spectra {
    integrals: Integrals,
    edges: Vec<f64>,
    bands: Vec<f64>,
    direction: Direction,
}

impl Spectra {
    fn new(
        model: &ForcedModel,
        case: &Case,
        poles: &Poles,
        tangents: &[ForcedTangent],
        direction: Direction,
    ) -> Result<Self, NoRide> {
        stationary(model, poles)?;
        let [low, high] = case.model.frequency_band;
        let bands = third_octave::edges_between(low, high);
        let edges = divided(response_panels(model, case, poles), &bands);
        let accelerations = Response::of(model, &case.service.track, case.service.speed, 0..3);
        let accelerations = accelerations.with_tangents(tangents);
        let integrals = mean_squares(accelerations, case, poles, &edges, 9, |f, values| {
            let (densities, weighted) = values.split_at_mut(3);
            let weights = f.map(|f| direction.weights(f));
            for point in 0..3 {
                for k in 0..3 {
                    for (l, weights) in weights.iter().enumerate() {
                        weighted[3 * point + k][l] = densities[point][l] * weights[k];
                    }
                }
            }
        })?;
        Ok(Self {
            integrals,
            edges,
            bands,
            direction,
        })
    }

    fn passengers(&self, constants: usize) -> ([PassengerRide; 3], BandDerivatives) {
        let passengers: [PassengerRide; 3] = std::array::from_fn(|point| {
            let weighted = |k: usize| self.integrals.total(3 + 3 * point + k);
            PassengerRide {
                acceleration: self.integrals.total(point).sqrt(),
                iso_weighted: weighted(0).sqrt(),
                en_weighted: weighted(1).sqrt(),
                w_z: sperling::w_z(weighted(2)),
                bands: self.bands(point),
            }
        });
        let by = |constant: usize| {
            std::array::from_fn(|point| {
                let bands = self.in_bands(12 + 3 * constant + point);
                let rms = passengers[point].bands.iter().map(|band| band.acceleration);
                let slope = |(square, rms): (f64, f64)| rms_change(rms, square);
                bands
                    .map(|(_, square)| square)
                    .zip(rms)
                    .map(slope)
                    .collect()
            })
        };
        let derivatives = (0..constants).map(by).collect();
        (passengers, derivatives)
    }

    /// Centres of the bands that lie wholly within the range of integration, and the integrals of a
    /// function over them.
    fn in_bands(&self, function: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.bands.windows(2).filter_map(move |ends| {
            let ends = [ends[0], ends[1]];
            let centre = third_octave::centre_of(ends[0], ends[1])?;
            Some((centre, self.integrals.between(&self.edges, ends, function)))
        })
    }

    fn bands(&self, point: usize) -> Vec<BandRide> {
        self.in_bands(point)
            .map(|(centre, square)| BandRide {
                centre,
                acceleration: square.sqrt(),
                boundary: self.direction.boundary(centre),
            })
            .collect()
    }
}
