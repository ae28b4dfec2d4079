//! Equilibrium in the curve for every state of the secondary yaw elements.
//!
//! The torque of an element follows K_sψ × relative yaw up to T_sψ and stays there beyond
//! (Figure 3.4.9). The stretch ψ_c − ψ_t ± l_s/R decides: stuck while |K_sψ stretch| ≤ T_sψ.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::{CurvingModel, Side};
use crate::dynamics::{Row, lateral};

/// State of the secondary yaw element of a truck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Breakaway {
    /// Elastic, below the breakaway torque.
    Stuck,
    /// Slipping at +T_sψ.
    SlippingPositive,
    /// Slipping at −T_sψ.
    SlippingNegative,
}

/// Why there is no steady-state solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum CurvingError {
    /// The stiffness matrix is singular: something moves freely.
    #[error("the steady-state curving equations are singular")]
    Singular,
    /// No state of the yaw elements is consistent on part of the curvature range.
    #[error("no consistent breakaway state of the secondary yaw elements was found")]
    NoConsistentState,
    /// The load transfer takes all of the static load of the wheels on one side: ΔN ≥ N.
    #[error("the {0} wheels lift: the load transfer exceeds their static load")]
    WheelLifted(Side),
}

/// The equilibrium x = at_zero + (1/R) per_curvature between two curvatures.
#[derive(Debug, Clone)]
pub struct Segment {
    /// Ends of the segment, 1/m.
    pub curvature: [f64; 2],
    /// State of the yaw elements, leading and trailing truck.
    pub breakaway: [Breakaway; 2],
    /// Coordinates extrapolated to zero curvature, m and rad.
    pub at_zero: DVector<f64>,
    /// Change of the coordinates per unit curvature, m² and rad m.
    pub per_curvature: DVector<f64>,
}

impl Segment {
    /// All coordinates at a curvature (1/m), m or rad.
    pub fn displacements(&self, curvature: f64) -> DVector<f64> {
        &self.at_zero + &self.per_curvature * curvature
    }

    /// Coordinate `index` at a curvature (1/m), m or rad.
    pub fn displacement(&self, index: usize, curvature: f64) -> f64 {
        self.at_zero[index] + curvature * self.per_curvature[index]
    }
}

/// Relative gap in curvature below which two segments count as adjoining: the ends of both come
/// from the same condition solved in different states, so they differ by rounding only.
const ADJOINING: f64 = 1e-9;

impl CurvingModel {
    /// All consistent segments from zero curvature to `limit`, without gaps or overlap.
    pub(super) fn solve(&self, limit: f64) -> Result<Vec<Segment>, CurvingError> {
        use Breakaway::{SlippingNegative, SlippingPositive, Stuck};
        let states = [Stuck, SlippingPositive, SlippingNegative];
        let mut found: Vec<Segment> = Vec::new();
        let mut factors: [Option<LU<f64, Dyn, Dyn>>; 4] = [const { None }; 4];
        for leading in states {
            for trailing in states {
                let state = [leading, trailing];
                let matrix = state
                    .iter()
                    .fold(0, |m, &s| 2 * m + usize::from(s == Stuck));
                let lu = factors[matrix].get_or_insert_with(|| self.factor(state));
                let segment = self.equilibrium(lu, state, limit)?;
                if segment.curvature[0] <= segment.curvature[1] {
                    found.push(segment);
                }
            }
        }
        // Where the response is stable the states follow one another; take the one that reaches
        // furthest from where the last one ended.
        let mut segments: Vec<Segment> = Vec::new();
        let mut reached = 0.0;
        while reached < limit {
            let slack = ADJOINING * limit;
            let next = found
                .iter()
                .filter(|s| s.curvature[0] <= reached + slack && s.curvature[1] > reached + slack)
                .max_by(|a, b| a.curvature[1].total_cmp(&b.curvature[1]))
                .ok_or(CurvingError::NoConsistentState)?;
            let mut segment = next.clone();
            segment.curvature[0] = reached;
            if segment.curvature[1] > limit - slack {
                segment.curvature[1] = limit;
            }
            reached = segment.curvature[1];
            segments.push(segment);
        }
        Ok(segments)
    }

    /// Index pairs of the yaw stretch ψ_c − ψ_t of truck `j`.
    fn yaw_indices(&self, j: usize) -> (usize, usize) {
        (self.q.len() - 2, 10 + j)
    }

    /// l_s/R per unit curvature, upper sign for the leading truck.
    fn yaw_offset(&self, j: usize) -> f64 {
        let l_s = self.vehicle.carbody.half_truck_spacing;
        if j == 0 { l_s } else { -l_s }
    }

    fn factor(&self, state: [Breakaway; 2]) -> LU<f64, Dyn, Dyn> {
        self.stiffness_in(state).lu()
    }

    /// Stiffness with the yaw elements in some state, 15 × 15.
    pub(crate) fn stiffness_in(&self, state: [Breakaway; 2]) -> DMatrix<f64> {
        let k = self.vehicle.suspension.secondary.yaw_stiffness;
        let mut stiffness = self.stiffness.clone();
        for (j, state) in state.into_iter().enumerate() {
            if state == Breakaway::Stuck {
                let (c, t) = self.yaw_indices(j);
                stiffness[(c, c)] += k;
                stiffness[(t, t)] += k;
                stiffness[(c, t)] -= k;
                stiffness[(t, c)] -= k;
            }
        }
        stiffness
    }

    /// Loads with the yaw elements in some state: at zero curvature, and per unit curvature.
    pub(crate) fn loads_in(&self, state: [Breakaway; 2]) -> [DVector<f64>; 2] {
        let secondary = &self.vehicle.suspension.secondary;
        let (k, torque) = (secondary.yaw_stiffness, secondary.yaw_breakaway_torque);
        let (mut load, mut slope) = (self.load.clone(), self.load_per_curvature.clone());
        for (j, state) in state.into_iter().enumerate() {
            let (c, t) = self.yaw_indices(j);
            let constant = match state {
                Breakaway::Stuck => 0.0,
                Breakaway::SlippingPositive => torque,
                Breakaway::SlippingNegative => -torque,
            };
            load[c] -= constant;
            load[t] += constant;
            if state == Breakaway::Stuck {
                slope[c] -= k * self.yaw_offset(j);
                slope[t] += k * self.yaw_offset(j);
            }
        }
        [load, slope]
    }

    /// The equilibrium in one state, over the curvatures where that state is consistent (an empty
    /// interval where it is not).
    fn equilibrium(
        &self,
        lu: &LU<f64, Dyn, Dyn>,
        state: [Breakaway; 2],
        limit: f64,
    ) -> Result<Segment, CurvingError> {
        let secondary = &self.vehicle.suspension.secondary;
        let (k, torque) = (secondary.yaw_stiffness, secondary.yaw_breakaway_torque);
        let [load, slope] = self.loads_in(state);
        let at_zero = lu.solve(&load).ok_or(CurvingError::Singular)?;
        let per_curvature = lu.solve(&slope).ok_or(CurvingError::Singular)?;
        if !at_zero.iter().chain(&per_curvature).all(|x| x.is_finite()) {
            return Err(CurvingError::Singular);
        }
        let mut curvature = [0.0, limit];
        for (j, state) in state.into_iter().enumerate() {
            let (c, t) = self.yaw_indices(j);
            let elastic = [
                k * (at_zero[c] - at_zero[t]),
                k * (per_curvature[c] - per_curvature[t] + self.yaw_offset(j)),
            ];
            // Each condition reads value + slope·κ ≥ 0.
            let conditions: &[[f64; 2]] = match state {
                Breakaway::Stuck => &[
                    [torque - elastic[0], -elastic[1]],
                    [torque + elastic[0], elastic[1]],
                ],
                Breakaway::SlippingPositive => &[[elastic[0] - torque, elastic[1]]],
                Breakaway::SlippingNegative => &[[-elastic[0] - torque, -elastic[1]]],
            };
            for &[value, slope] in conditions {
                restrict(&mut curvature, value, slope);
            }
        }
        Ok(Segment {
            curvature,
            breakaway: state,
            at_zero,
            per_curvature,
        })
    }

    /// Primary lateral stroke of wheelset `i` at a curvature, m.
    pub fn primary_lateral_stroke(&self, curvature: f64, i: usize) -> f64 {
        let rows = self.rows();
        let b = self.vehicle.truck.half_wheelbase;
        self.at(&rows.primary_lateral_stretch(i), curvature) + curvature * b * b / 2.0
    }

    /// Primary longitudinal stroke of wheelset `i` at a curvature, m: d_p (ψ_t − ψ_w ± b/R).
    pub fn primary_longitudinal_stroke(&self, curvature: f64, i: usize) -> f64 {
        let truck = &self.vehicle.truck;
        let b = truck.half_wheelbase;
        let offset = if i.is_multiple_of(2) { b } else { -b };
        let yaw = self.at(&(self.q.psi_t(i / 2) - self.q.psi_w(i)), curvature);
        truck.half_primary_spacing * (yaw + curvature * offset)
    }

    /// Secondary lateral stroke of truck `j` at a curvature, m.
    pub fn secondary_lateral_stroke(&self, curvature: f64, j: usize) -> f64 {
        let x = self.segment_at(curvature).displacements(curvature);
        self.secondary_lateral_stretch(&x, curvature, j)
    }

    /// Secondary lateral stretch of truck `j`, m: linear in the coordinates, m and rad, and the
    /// curvature, 1/m.
    pub(crate) fn secondary_lateral_stretch(
        &self,
        x: &DVector<f64>,
        curvature: f64,
        j: usize,
    ) -> f64 {
        let l_s = self.vehicle.carbody.half_truck_spacing;
        let row = self.rows().secondary_lateral_stretch(j);
        let terms = row.terms().iter().filter(|(i, _)| *i < self.q.len());
        let stretch: f64 = terms.map(|&(i, c)| c * x[i]).sum();
        stretch + curvature * l_s * l_s / 2.0
    }

    fn rows(&self) -> lateral::Builder<'_> {
        lateral::Builder::on_rails(&self.vehicle, self.contact[0])
    }

    /// Value of a row over [q, u] with u = 0 (smooth track).
    fn at(&self, row: &Row, curvature: f64) -> f64 {
        let segment = self.segment_at(curvature);
        row.terms()
            .iter()
            .filter(|(i, _)| *i < self.q.len())
            .map(|&(i, c)| c * segment.displacement(i, curvature))
            .sum()
    }

    /// Torque that the yaw element of truck `j` puts on the truck at a curvature, N m, and its
    /// stretch, rad.
    pub fn secondary_yaw(&self, curvature: f64, j: usize) -> (f64, f64) {
        let segment = self.segment_at(curvature);
        let (c, t) = self.yaw_indices(j);
        let stretch = segment.displacement(c, curvature) - segment.displacement(t, curvature)
            + curvature * self.yaw_offset(j);
        let secondary = &self.vehicle.suspension.secondary;
        let torque = match segment.breakaway[j] {
            Breakaway::Stuck => secondary.yaw_stiffness * stretch,
            Breakaway::SlippingPositive => secondary.yaw_breakaway_torque,
            Breakaway::SlippingNegative => -secondary.yaw_breakaway_torque,
        };
        (torque, stretch)
    }
}

/// Restricts an interval to where value + slope·x ≥ 0.
fn restrict(interval: &mut [f64; 2], value: f64, slope: f64) {
    if slope > 0.0 {
        interval[0] = interval[0].max(-value / slope);
    } else if slope < 0.0 {
        interval[1] = interval[1].min(value / -slope);
    } else if value < 0.0 {
        interval[1] = f64::NEG_INFINITY;
    }
}
