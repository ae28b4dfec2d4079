//! Equilibrium in the curve for every state of the secondary yaw elements.
//!
//! The torque of an element follows K_sψ × relative yaw up to T_sψ and stays there beyond
//! (Figure 3.4.9). The stretch ψ_c − ψ_t ± l_s/R decides: stuck while |K_sψ stretch| ≤ T_sψ.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::{CurvingModel, Side, form};
use crate::dynamics::{
    element::{Element, Name},
    suspension::{PRIMARY_YAW, SECONDARY_YAW},
};

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

    /// The yaw element of truck `j` with its stretch per unit of curvature, and its breakaway torque, N m.
    fn yaw_element(&self, j: usize) -> (&Element, f64, f64) {
        let (element, offset) = self.element(Name::of_truck(SECONDARY_YAW, j));
        (element, offset, element.breakaway.unwrap_or(f64::INFINITY))
    }

    fn factor(&self, state: [Breakaway; 2]) -> LU<f64, Dyn, Dyn> {
        self.stiffness_in(state).lu()
    }

    /// Stiffness with the yaw elements in some state, 15 × 15.
    pub(crate) fn stiffness_in(&self, state: [Breakaway; 2]) -> DMatrix<f64> {
        let mut stiffness = self.stiffness.clone();
        for (j, state) in state.into_iter().enumerate() {
            if state == Breakaway::Stuck {
                let (element, ..) = self.yaw_element(j);
                let k = element.law.steady_stiffness();
                for &(i, row) in element.row.terms() {
                    for &(j, stretch) in element.stretch.terms() {
                        stiffness[(i, j)] += k * row * stretch;
                    }
                }
            }
        }
        stiffness
    }

    /// Loads with the yaw elements in some state: at zero curvature, and per unit curvature.
    pub(crate) fn loads_in(&self, state: [Breakaway; 2]) -> [DVector<f64>; 2] {
        let (mut load, mut slope) = (self.load.clone(), self.load_per_curvature.clone());
        for (j, state) in state.into_iter().enumerate() {
            let (element, offset, torque) = self.yaw_element(j);
            let k = element.law.steady_stiffness();
            for &(i, row) in element.row.terms() {
                match state {
                    Breakaway::Stuck => slope[i] -= row * k * offset,
                    Breakaway::SlippingPositive => load[i] -= row * torque,
                    Breakaway::SlippingNegative => load[i] += row * torque,
                }
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
        let [load, slope] = self.loads_in(state);
        let at_zero = lu.solve(&load).ok_or(CurvingError::Singular)?;
        let per_curvature = lu.solve(&slope).ok_or(CurvingError::Singular)?;
        if !at_zero.iter().chain(&per_curvature).all(|x| x.is_finite()) {
            return Err(CurvingError::Singular);
        }
        let mut curvature = [0.0, limit];
        for (j, state) in state.into_iter().enumerate() {
            let (element, offset, torque) = self.yaw_element(j);
            let k = element.law.steady_stiffness();
            let stretch = |x: &DVector<f64>| form(&element.stretch, x.len(), |i| x[i]);
            let elastic = [
                k * stretch(&at_zero),
                k * (stretch(&per_curvature) + offset),
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

    /// Stretch of an element at a curvature, 1/m, m or rad.
    pub fn stretch_at(&self, name: Name, curvature: f64) -> f64 {
        let segment = self.segment_at(curvature);
        let (element, offset) = self.element(name);
        let displacement = |i| segment.displacement(i, curvature);
        form(&element.stretch, self.load.len(), displacement) + curvature * offset
    }

    /// Primary longitudinal stroke of wheelset `i` at a curvature, m: d_p (ψ_t − ψ_w ± b/R).
    pub fn primary_longitudinal_stroke(&self, curvature: f64, i: usize) -> f64 {
        let d_p = self.vehicle.truck_at(i / 2).half_primary_spacing;
        d_p * self.stretch_at(Name::of_wheelset(PRIMARY_YAW, i), curvature)
    }

    /// Torque that the yaw element of truck `j` puts on the truck at a curvature, N m, and its
    /// stretch, rad.
    pub fn secondary_yaw(&self, curvature: f64, j: usize) -> (f64, f64) {
        let stretch = self.stretch_at(Name::of_truck(SECONDARY_YAW, j), curvature);
        let (element, _, torque) = self.yaw_element(j);
        let torque = match self.segment_at(curvature).breakaway[j] {
            Breakaway::Stuck => element.law.steady_stiffness() * stretch,
            Breakaway::SlippingPositive => torque,
            Breakaway::SlippingNegative => -torque,
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
