//! The two ride–stroke trade-offs (4.3, 4.4): secondary stiffness and damping, lateral or vertical.
//!
//! The variables are the carbody's uncoupled natural frequency and damping ratio (4.6-8, 9, 14,
//! 15), in which the optimum is nearly the same for every carbody.

use super::{
    problem::{Failure, Piece, Problem, Scale, Values, Variable},
    stability_curving::stable_at_speed,
};
use crate::{
    case::Case,
    closed_form::natural_frequencies::{
        primary_vertical_stiffness, secondary_damping, secondary_damping_ratio,
        secondary_frequency, secondary_stiffness,
    },
    dynamics::{LateralModel, VerticalModel},
    evaluate::ride::{LateralRide, VerticalRide},
    units::Quantity,
};

/// Standard deviations that must fit between the stops (3.3.4).
pub const PEAK: f64 = 3.0;

/// Lateral or vertical trade-off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// K_sy, C_sy.
    Lateral,
    /// K_sz, C_sz.
    Vertical,
}

/// What is asked of the ride.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// The least average RMS acceleration within the limits.
    Acceleration,
    /// The least secondary stroke within the limits and this average RMS acceleration, m/s².
    Stroke {
        /// m/s².
        acceleration: f64,
    },
}

/// Peak motions that must not be exceeded by three standard deviations, m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Secondary stroke at either truck.
    pub secondary_stroke: Option<f64>,
    /// Primary lateral stroke at any wheelset (lateral only).
    pub primary_stroke: Option<f64>,
    /// Wheelset excursion at any wheelset (lateral only).
    pub excursion: Option<f64>,
}

/// The problem for a case.
#[derive(Debug, Clone)]
pub struct Ride {
    /// Which trade-off.
    pub direction: Direction,
    case: Case,
    goal: Goal,
    limits: Limits,
    /// Truck bounce frequency that sets K_pz (the 10 Hz rule of 4.3), Hz.
    primary_frequency: Option<f64>,
    /// Bounds of f_n and ξ; `None`: as in the case.
    bounds: [Option<[f64; 2]>; 2],
    variables: Vec<Variable>,
}

impl Ride {
    /// The problem of reaching `goal` with frequency and damping ratio open between `bounds`.
    pub fn new(
        direction: Direction,
        case: &Case,
        goal: Goal,
        limits: Limits,
        bounds: [Option<[f64; 2]>; 2],
        primary_frequency: Option<f64>,
    ) -> Self {
        let (frequency, damping) = match direction {
            Direction::Lateral => ("lateral natural frequency", "lateral damping ratio"),
            Direction::Vertical => ("vertical natural frequency", "vertical damping ratio"),
        };
        let variable = |name, symbol, quantity, bounds: Option<[f64; 2]>| {
            bounds.map(|bounds| Variable {
                name,
                symbol,
                quantity,
                bounds,
                scale: Scale::Logarithmic,
            })
        };
        let variables = [
            variable(frequency, "f_n", Quantity::Frequency, bounds[0]),
            variable(damping, "ξ", Quantity::Dimensionless, bounds[1]),
        ];
        Self {
            direction,
            case: case.clone(),
            goal,
            limits,
            primary_frequency,
            bounds,
            variables: variables.into_iter().flatten().collect(),
        }
    }

    /// (f_n, ξ) of a case.
    fn current(&self, case: &Case) -> [f64; 2] {
        let (secondary, mass) = (
            &case.vehicle.suspension.secondary,
            case.vehicle.carbody.mass,
        );
        let (k, c) = match self.direction {
            Direction::Lateral => (secondary.lateral_stiffness, secondary.lateral_damping),
            Direction::Vertical => (secondary.vertical_stiffness, secondary.vertical_damping),
        };
        [
            secondary_frequency(mass, k),
            secondary_damping_ratio(mass, k, c),
        ]
    }

    /// The case with the design at scaled coordinates `x`.
    pub fn design(&self, x: &[f64]) -> Case {
        let mut case = self.case.clone();
        let mut values = self.variables.iter().zip(x).map(|(v, &x)| v.value(x));
        let mut wanted = self.current(&case);
        for (value, bounds) in wanted.iter_mut().zip(self.bounds) {
            if let Some(open) = bounds.and_then(|_| values.next()) {
                *value = open;
            }
        }
        let mass = case.vehicle.carbody.mass;
        let k = secondary_stiffness(mass, wanted[0]);
        let c = secondary_damping(mass, k, wanted[1]);
        let suspension = &mut case.vehicle.suspension;
        match self.direction {
            Direction::Lateral => {
                suspension.secondary.lateral_stiffness = k;
                suspension.secondary.lateral_damping = c;
            }
            Direction::Vertical => {
                suspension.secondary.vertical_stiffness = k;
                suspension.secondary.vertical_damping = c;
                if let Some(frequency) = self.primary_frequency {
                    suspension.primary.vertical_stiffness =
                        primary_vertical_stiffness(case.vehicle.truck.mass, k, frequency);
                }
            }
        }
        case
    }

    /// Scaled coordinates of the design of a case.
    pub fn coordinates(&self, case: &Case) -> Vec<f64> {
        let open = self.current(case).into_iter().zip(self.bounds);
        let open = open.filter_map(|(value, bounds)| bounds.map(|_| value));
        self.variables
            .iter()
            .zip(open)
            .map(|(v, value)| v.coordinate(value))
            .collect()
    }
}

impl Problem for Ride {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn goal(&self) -> String {
        match self.goal {
            Goal::Acceleration => "least average RMS acceleration within the limits",
            Goal::Stroke { .. } => "least secondary stroke with the required acceleration",
        }
        .into()
    }

    fn piece_name(&self, index: usize) -> String {
        let names: [&[&str]; 3] = [
            &[
                "secondary stroke, leading truck",
                "secondary stroke, trailing truck",
            ],
            &[
                "primary stroke, wheelset 1",
                "primary stroke, wheelset 2",
                "primary stroke, wheelset 3",
                "primary stroke, wheelset 4",
            ],
            &[
                "excursion, wheelset 1",
                "excursion, wheelset 2",
                "excursion, wheelset 3",
                "excursion, wheelset 4",
            ],
        ];
        let limits = [
            self.limits.secondary_stroke,
            self.limits.primary_stroke,
            self.limits.excursion,
        ];
        names
            .into_iter()
            .zip(limits)
            .filter(|(_, limit)| limit.is_some())
            .flat_map(|(names, _)| names)
            .nth(index)
            .map_or_else(|| "acceleration".into(), ToString::to_string)
    }

    fn evaluate(&self, x: &[f64]) -> Result<Values, Failure> {
        let case = self.design(x);
        let (acceleration, secondary, primary, excursion, converged) = match self.direction {
            Direction::Lateral => {
                let model = LateralModel::new(&case);
                if !stable_at_speed(&case, &model)? {
                    return Err(Failure::Unstable);
                }
                let ride = LateralRide::new(&model, &case);
                (
                    ride.average_acceleration(),
                    ride.secondary_stroke,
                    ride.primary_stroke,
                    ride.excursion,
                    ride.converged,
                )
            }
            Direction::Vertical => {
                let ride = VerticalRide::new(&VerticalModel::new(&case), &case);
                let acceleration = ride.average_acceleration();
                (
                    acceleration,
                    ride.secondary_stroke,
                    [0.0; 4],
                    [0.0; 4],
                    ride.converged,
                )
            }
        };
        if !converged {
            return Err(Failure::Numerical(
                "the random response did not converge".into(),
            ));
        }
        let mut constraints = Vec::new();
        let mut limit = |values: &[f64], limit: Option<f64>| {
            for value in values {
                let index = constraints.len();
                constraints.extend(limit.map(|l| Piece::single(index, (PEAK * value / l).ln())));
            }
        };
        limit(&secondary, self.limits.secondary_stroke);
        if self.direction == Direction::Lateral {
            limit(&primary, self.limits.primary_stroke);
            limit(&excursion, self.limits.excursion);
        }
        let objective = match self.goal {
            Goal::Acceleration => vec![Piece::single(0, acceleration.ln())],
            Goal::Stroke {
                acceleration: required,
            } => {
                let index = constraints.len();
                constraints.push(Piece::single(index, (acceleration / required).ln()));
                secondary
                    .iter()
                    .enumerate()
                    .map(|(i, stroke)| Piece::single(i, stroke.ln()))
                    .collect()
            }
        };
        Ok(Values {
            objective,
            constraints,
        })
    }
}
