//! Ride on irregular track: RMS accelerations, strokes and comfort (3.2.1, 3.3.4).

use super::{
    integration::{Integrals, integrate},
    response::Response,
};
use crate::{
    case::Case,
    comfort::{iso_boundary, sperling, third_octave, weighting},
    dynamics::{ForcedModel, LateralModel, VerticalModel, lateral, vertical},
};

/// Accuracy of mean squares: estimated error over value. Halved, RMS values change by less than
/// 1e-6.
const TOLERANCE: f64 = 1e-6;

/// What one passenger point feels in one direction.
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
}

/// Lateral ride of a stable vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct LateralRide {
    /// c.g., front, rear.
    pub passengers: [PassengerRide; 3],
    /// RMS roll acceleration of the carbody, rad/s².
    pub roll_acceleration: f64,
    /// RMS secondary lateral stroke, leading and trailing truck, m.
    pub secondary_stroke: [f64; 2],
    /// RMS primary lateral stroke, wheelsets 1–4, m.
    pub primary_stroke: [f64; 4],
    /// RMS primary longitudinal stroke, wheelsets 1–4, m.
    pub longitudinal_stroke: [f64; 4],
    /// RMS wheelset excursion, wheelsets 1–4, m.
    pub excursion: [f64; 4],
    /// Whether every integral met its tolerance.
    pub converged: bool,
}

/// Vertical ride.
#[derive(Debug, Clone, PartialEq)]
pub struct VerticalRide {
    /// c.g., front, rear.
    pub passengers: [PassengerRide; 3],
    /// RMS roll acceleration of the carbody, rad/s².
    pub roll_acceleration: f64,
    /// RMS secondary vertical stroke, leading and trailing truck, m.
    pub secondary_stroke: [f64; 2],
    /// RMS primary vertical stroke, wheelsets 1–4, m.
    pub primary_stroke: [f64; 4],
    /// RMS change of wheel load, wheelsets 1–4, N.
    pub wheel_load: [f64; 4],
    /// Whether every integral met its tolerance.
    pub converged: bool,
}

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

/// Averages of the report: over c.g., front and rear, or over the two ends; of RMS values.
pub fn average(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Mean squares of all outputs, then of the weighted accelerations (three weights at each of three
/// points), by one-third-octave band.
struct Spectra {
    integrals: Integrals,
    edges: Vec<f64>,
    outputs: usize,
    direction: Direction,
}

impl Spectra {
    fn new(model: &ForcedModel, case: &Case, direction: Direction) -> Self {
        let [low, high] = case.model.frequency_band;
        let edges = third_octave::edges_between(low, high);
        let outputs = model.outputs.len();
        let mut response = Response::new(model, &case.service.track, case.service.speed);
        let integrals = integrate(&edges, outputs + 9, TOLERANCE, |f, values| {
            let (densities, weighted) = values.split_at_mut(outputs);
            response.densities(f, densities);
            let weights = direction.weights(f);
            for point in 0..3 {
                for (k, weight) in weights.iter().enumerate() {
                    weighted[3 * point + k] = densities[point] * weight;
                }
            }
        });
        Self {
            integrals,
            edges,
            outputs,
            direction,
        }
    }

    fn rms(&self, output: usize) -> f64 {
        self.integrals.total(output).sqrt()
    }

    fn rms_array<const N: usize>(&self, outputs: std::ops::Range<usize>) -> [f64; N] {
        std::array::from_fn(|i| self.rms(outputs.start + i))
    }

    fn passengers(&self) -> [PassengerRide; 3] {
        std::array::from_fn(|point| {
            let weighted = |k: usize| self.integrals.total(self.outputs + 3 * point + k);
            PassengerRide {
                acceleration: self.rms(point),
                iso_weighted: weighted(0).sqrt(),
                en_weighted: weighted(1).sqrt(),
                w_z: sperling::w_z(weighted(2)),
                bands: self.bands(point),
            }
        })
    }

    /// The bands that lie wholly within the range of integration.
    fn bands(&self, point: usize) -> Vec<BandRide> {
        self.edges
            .windows(2)
            .enumerate()
            .filter_map(|(b, edges)| {
                let centre = third_octave::centre_of(edges[0], edges[1])?;
                Some(BandRide {
                    centre,
                    acceleration: self.integrals.band(b, point).sqrt(),
                    boundary: self.direction.boundary(centre),
                })
            })
            .collect()
    }
}

impl LateralRide {
    /// Lateral ride of a case. The vehicle must be stable at its speed: an unstable one has no
    /// stationary response.
    pub fn new(model: &LateralModel, case: &Case) -> Self {
        use lateral::output::{
            EXCURSION, LONGITUDINAL_STROKE, PRIMARY_STROKE, ROLL_ACCELERATION, SECONDARY_STROKE,
        };
        let spectra = Spectra::new(&model.forced, case, Direction::Lateral);
        Self {
            passengers: spectra.passengers(),
            roll_acceleration: spectra.rms(ROLL_ACCELERATION),
            secondary_stroke: spectra.rms_array(SECONDARY_STROKE),
            primary_stroke: spectra.rms_array(PRIMARY_STROKE),
            longitudinal_stroke: spectra.rms_array(LONGITUDINAL_STROKE),
            excursion: spectra.rms_array(EXCURSION),
            converged: spectra.integrals.converged,
        }
    }

    /// ACC_L: RMS acceleration averaged over the three points, m/s².
    pub fn average_acceleration(&self) -> f64 {
        average(&self.passengers.each_ref().map(|p| p.acceleration))
    }

    /// ST_L: RMS secondary stroke averaged over the two trucks, m.
    pub fn average_stroke(&self) -> f64 {
        average(&self.secondary_stroke)
    }
}

impl VerticalRide {
    /// Vertical ride of a case.
    pub fn new(model: &VerticalModel, case: &Case) -> Self {
        use vertical::output::{PRIMARY_STROKE, ROLL_ACCELERATION, SECONDARY_STROKE, WHEEL_LOAD};
        let spectra = Spectra::new(&model.forced, case, Direction::Vertical);
        Self {
            passengers: spectra.passengers(),
            roll_acceleration: spectra.rms(ROLL_ACCELERATION),
            secondary_stroke: spectra.rms_array(SECONDARY_STROKE),
            primary_stroke: spectra.rms_array(PRIMARY_STROKE),
            wheel_load: spectra.rms_array(WHEEL_LOAD),
            converged: spectra.integrals.converged,
        }
    }

    /// ACC_v: RMS acceleration averaged over the three points, m/s².
    pub fn average_acceleration(&self) -> f64 {
        average(&self.passengers.each_ref().map(|p| p.acceleration))
    }

    /// ST_v: RMS secondary stroke averaged over the two trucks, m.
    pub fn average_stroke(&self) -> f64 {
        average(&self.secondary_stroke)
    }
}
