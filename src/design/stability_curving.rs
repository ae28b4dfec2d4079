//! The stability–curving trade-off (4.5): primary stiffnesses and wheel conicity.

use super::{
    outcome::Alternative,
    problem::{Failure, Piece, Problem, Scale, Values, Variable},
    ride::PEAK,
    solve::Solved,
};
use crate::{
    case::Case,
    dynamics::{LateralModel, eigenvalues},
    evaluate::{
        critical_speed::Stability,
        curving::{CurvingLimits, Limit},
        ride::LateralRide,
    },
    track::MAX_DEGREE,
    units::Quantity,
};

/// What is asked of stability and curving.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// The highest degree curve with at least this critical speed, m/s.
    Curving {
        /// m/s.
        critical_speed: f64,
    },
    /// The highest critical speed with at least this degree curve, degrees.
    Stability {
        /// Degrees.
        degree: f64,
    },
    /// The largest smaller margin over both.
    Both {
        /// m/s.
        critical_speed: f64,
        /// Degrees.
        degree: f64,
    },
}

/// The variables of the trade-off, with their bounds where open.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Open {
    /// K_b, N m/rad.
    pub bending_stiffness: Option<[f64; 2]>,
    /// K_py, N/m.
    pub lateral_stiffness: Option<[f64; 2]>,
    /// λ.
    pub conicity: Option<[f64; 2]>,
}

/// Peak motions at the operating speed that the primary suspension and wheelsets must keep within,
/// by three standard deviations, m (steps 6–8 of Table 4.6.1).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Primary lateral stroke at any wheelset.
    pub primary_stroke: Option<f64>,
    /// Wheelset excursion at any wheelset.
    pub excursion: Option<f64>,
}

/// The problem for a case.
#[derive(Debug, Clone)]
pub struct StabilityCurving {
    case: Case,
    goal: Goal,
    limits: Limits,
    open: Open,
    variables: Vec<Variable>,
}

/// Index of the critical speed's pieces; those of the degree curve are 0–11.
const CRITICAL_SPEED: usize = 12;
/// A critical speed this far (ln) below the required one decides without the motions.
const FAR_OFF: f64 = 0.2;
/// First index of the primary strokes' pieces, then of the excursions'.
const PRIMARY_STROKE: usize = 13;
const EXCURSION: usize = 17;

impl StabilityCurving {
    /// The problem of reaching `goal` with the `open` variables of a case.
    pub fn new(case: &Case, goal: Goal, limits: Limits, open: Open) -> Self {
        let variable = |name, symbol, quantity, bounds: Option<[f64; 2]>, scale| {
            bounds.map(|bounds| Variable {
                name,
                symbol,
                quantity,
                bounds,
                scale,
            })
        };
        let log = Scale::Logarithmic;
        let variables = [
            variable(
                "primary bending stiffness",
                "K_b",
                Quantity::RotationalStiffness,
                open.bending_stiffness,
                log,
            ),
            variable(
                "primary lateral stiffness",
                "K_py",
                Quantity::Stiffness,
                open.lateral_stiffness,
                log,
            ),
            variable(
                "wheel conicity",
                "λ",
                Quantity::Dimensionless,
                open.conicity,
                Scale::Linear,
            ),
        ];
        Self {
            case: case.clone(),
            goal,
            limits,
            open,
            variables: variables.into_iter().flatten().collect(),
        }
    }

    /// The case with the design at scaled coordinates `x`.
    pub fn design(&self, x: &[f64]) -> Case {
        let mut case = self.case.clone();
        let mut values = self.variables.iter().zip(x).map(|(v, &x)| v.value(x));
        let mut next = |open: Option<[f64; 2]>| open.and_then(|_| values.next());
        if let Some(k_b) = next(self.open.bending_stiffness) {
            case.vehicle.set_bending_stiffness(k_b);
        }
        if let Some(k_py) = next(self.open.lateral_stiffness) {
            case.vehicle.suspension.primary.lateral_stiffness = k_py;
        }
        if let Some(conicity) = next(self.open.conicity) {
            case.wheel_rail.conicity = conicity;
        }
        case
    }

    /// Scaled coordinates of the design as it stands.
    pub fn coordinates(&self, case: &Case) -> Vec<f64> {
        let current = [
            self.open
                .bending_stiffness
                .map(|_| case.vehicle.bending_stiffness()),
            self.open
                .lateral_stiffness
                .map(|_| case.vehicle.suspension.primary.lateral_stiffness),
            self.open.conicity.map(|_| case.wheel_rail.conicity),
        ];
        let current = current.into_iter().flatten();
        self.variables
            .iter()
            .zip(current)
            .map(|(v, value)| v.coordinate(value))
            .collect()
    }
}

/// What the profile of a solved problem allows.
pub(super) fn alternative(problem: &StabilityCurving, solved: &Solved) -> Alternative {
    let case = problem.design(&solved.solution.point.x);
    let stability = Stability::search(&LateralModel::new(&case), case.model.speed_range);
    Alternative {
        conicity: case.wheel_rail.conicity,
        status: solved.solution.status,
        critical_speed: stability.ok().and_then(|s| s.critical_speed()),
        degree: CurvingLimits::new(&case, 0.0).map_or(0.0, |limits| limits.degree()),
        bending_stiffness: case.vehicle.bending_stiffness(),
        lateral_stiffness: case.vehicle.suspension.primary.lateral_stiffness,
    }
}

/// Share of the best result down to which a profile may still win in a later round.
const RACE: f64 = 0.95;

/// The conicities that may still win.
pub(super) fn field(alternatives: &[Alternative], goal: Goal) -> Vec<f64> {
    let merit = |a: &Alternative| {
        let speed = a.critical_speed.unwrap_or(f64::MAX);
        match goal {
            Goal::Curving { critical_speed } => a.degree * (speed / critical_speed).min(1.0),
            Goal::Stability { degree } => speed * (a.degree / degree).min(1.0),
            Goal::Both {
                critical_speed,
                degree,
            } => (speed / critical_speed).min(a.degree / degree),
        }
    };
    let best = alternatives.iter().map(merit).fold(0.0, f64::max);
    let near = alternatives.iter().filter(|a| merit(a) >= RACE * best);
    near.map(|a| a.conicity).collect()
}

impl Problem for StabilityCurving {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn goal(&self) -> String {
        match self.goal {
            Goal::Curving { .. } => "highest degree curve with the required critical speed",
            Goal::Stability { .. } => "highest critical speed with the required degree curve",
            Goal::Both { .. } => "largest smaller margin of critical speed and degree curve",
        }
        .into()
    }

    fn piece_name(&self, index: usize) -> String {
        match index {
            CRITICAL_SPEED => "critical speed".into(),
            EXCURSION.. => format!("excursion, wheelset {}", index - EXCURSION + 1),
            PRIMARY_STROKE.. => format!("primary stroke, wheelset {}", index - PRIMARY_STROKE + 1),
            _ => Limit::ALL[index].to_string(),
        }
    }

    fn evaluate(&self, x: &[f64]) -> Result<Values, Failure> {
        let case = self.design(x);
        let model = LateralModel::new(&case);
        let (mut objective, mut constraints) = (Vec::new(), Vec::new());
        match self.goal {
            Goal::Curving { critical_speed } => {
                objective = curves(&case, 1.0)?;
                constraints = speeds(&case, &model, critical_speed)?;
            }
            Goal::Stability { degree } => {
                objective = speeds(&case, &model, 100.0)?;
                constraints = curves(&case, degree)?;
            }
            Goal::Both {
                critical_speed,
                degree,
            } => {
                objective.extend(curves(&case, degree)?);
                objective.extend(speeds(&case, &model, critical_speed)?);
            }
        }
        let far_off = constraints
            .iter()
            .any(|c| c.index == CRITICAL_SPEED && c.value > FAR_OFF);
        if self.limits != Limits::default() && !far_off {
            constraints.extend(self.motions(&case, &model)?);
        }
        Ok(Values {
            objective,
            constraints,
        })
    }
}

impl StabilityCurving {
    /// ln of three standard deviations of the limited motions over their limits.
    fn motions(&self, case: &Case, model: &LateralModel) -> Result<Vec<Piece>, Failure> {
        if !stable_at_speed(case, model)? {
            return Err(Failure::Unstable);
        }
        let ride = LateralRide::new(model, case);
        let pieces = |first: usize, rms: [f64; 4], limit: Option<f64>| {
            let value = move |i: usize| limit.map(|l| (PEAK * rms[i] / l).ln());
            (0..4).filter_map(move |i| Some(Piece::single(first + i, value(i)?)))
        };
        let strokes = pieces(
            PRIMARY_STROKE,
            ride.primary_stroke,
            self.limits.primary_stroke,
        );
        let excursions = pieces(EXCURSION, ride.excursion, self.limits.excursion);
        Ok(strokes.chain(excursions).collect())
    }
}

/// Whether a stationary response exists at the operating speed.
pub(super) fn stable_at_speed(case: &Case, model: &LateralModel) -> Result<bool, Failure> {
    let values = eigenvalues(model.forced.system.state_matrix(case.service.speed))
        .map_err(|error| Failure::Numerical(error.to_string()))?;
    Ok(values.iter().all(|s| s.re < 0.0))
}

/// −ln of the degree curve of every limit over what is required, degrees.
fn curves(case: &Case, required: f64) -> Result<Vec<Piece>, Failure> {
    let limits =
        CurvingLimits::new(case, 0.0).map_err(|error| Failure::Numerical(error.to_string()))?;
    let piece = |(i, degree): (usize, &Option<f64>)| {
        let degree = degree.unwrap_or(MAX_DEGREE).max(1e-9);
        Piece::single(i, -(degree / required).ln())
    };
    Ok(limits.pieces.iter().enumerate().map(piece).collect())
}

/// −ln of the speeds at which modes lose their damping over what is required, m/s.
fn speeds(case: &Case, model: &LateralModel, required: f64) -> Result<Vec<Piece>, Failure> {
    let stability = Stability::search(model, case.model.speed_range)
        .map_err(|error| Failure::Numerical(error.to_string()))?;
    let piece = |speed: f64, label: f64| Piece {
        value: -(speed / required).ln(),
        index: CRITICAL_SPEED,
        label,
    };
    if stability.unstable_at_start || stability.onsets.is_empty() {
        let bound = stability.critical_speed().unwrap_or(stability.range[1]);
        return Ok(vec![piece(bound, f64::NAN)]);
    }
    // Onsets far above the lowest cannot matter near this design.
    let lowest = stability.onsets[0].speed;
    let near = stability
        .onsets
        .iter()
        .filter(|onset| onset.speed < 1.5 * lowest);
    Ok(near
        .map(|onset| piece(onset.speed, onset.frequency.ln()))
        .collect())
}
