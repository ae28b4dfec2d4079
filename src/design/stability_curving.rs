//! The stability–curving trade-off (4.5): primary stiffnesses and wheel conicity.

use super::{
    outcome::Alternative,
    problem::{Failure, Piece, Problem, Scale, Values, Variable},
    solve::Solved,
};
use crate::{
    case::Case,
    dynamics::LateralModel,
    evaluate::{
        critical_speed::Stability,
        curving::{CurvingLimits, Limit},
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

/// The problem for a case.
#[derive(Debug, Clone)]
pub struct StabilityCurving {
    case: Case,
    goal: Goal,
    open: Open,
    variables: Vec<Variable>,
}

/// Index of the critical speed's pieces; those of the degree curve are 0–11.
const CRITICAL_SPEED: usize = 12;

impl StabilityCurving {
    /// The problem of reaching `goal` with the `open` variables of a case.
    pub fn new(case: &Case, goal: Goal, open: Open) -> Self {
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
        Limit::ALL
            .get(index)
            .map_or_else(|| "critical speed".into(), ToString::to_string)
    }

    fn evaluate(&self, x: &[f64]) -> Result<Values, Failure> {
        let case = self.design(x);
        // −ln of every degree curve and critical speed over what is required of it.
        let curves = |required: f64| -> Result<Vec<Piece>, Failure> {
            let limits = CurvingLimits::new(&case, 0.0)
                .map_err(|error| Failure::Numerical(error.to_string()))?;
            Ok(limits
                .pieces
                .iter()
                .enumerate()
                .map(|(i, degree)| {
                    let degree = degree.unwrap_or(MAX_DEGREE).max(1e-9);
                    Piece::single(i, -(degree / required).ln())
                })
                .collect())
        };
        let speeds = |required: f64| -> Result<Vec<Piece>, Failure> {
            let model = LateralModel::new(&case);
            let stability = Stability::search(&model, case.model.speed_range)
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
            Ok(stability
                .onsets
                .iter()
                .filter(|onset| onset.speed < 1.5 * lowest)
                .map(|onset| piece(onset.speed, onset.frequency.ln()))
                .collect())
        };
        let (mut objective, mut constraints) = (Vec::new(), Vec::new());
        match self.goal {
            Goal::Curving { critical_speed } => {
                objective = curves(1.0)?;
                constraints = speeds(critical_speed)?;
            }
            Goal::Stability { degree } => {
                objective = speeds(100.0)?;
                constraints = curves(degree)?;
            }
            Goal::Both {
                critical_speed,
                degree,
            } => {
                objective.extend(curves(degree)?);
                objective.extend(speeds(critical_speed)?);
            }
        }
        Ok(Values {
            objective,
            constraints,
        })
    }
}
