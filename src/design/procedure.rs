//! The design procedure: three trade-offs in the order of Figure 4.2.1 with the coupling loop.
//!
//! The vertical trade-off depends on nothing that the others choose, so it comes first and once
//! (its K_sz is part of the lateral model's roll stiffness). Stability–curving and the lateral
//! trade-off then alternate until neither changes anything.

use super::{
    outcome::{Alternative, DesignResult, Stage, StageResult},
    problem::{FEASIBLE, Failure, Problem},
    ride::{self, Direction, Ride},
    solve::{Progress, Solved, Start, solve},
    stability_curving::{self, Goal, Open, StabilityCurving},
    unmet::unmet,
};
use crate::{
    case::Case,
    dynamics::EigenError,
    evaluate::Evaluation,
    spec::{ConicitySpace, DesignSpace, Interval, Limits, Requirements},
};

/// Rounds of the coupling loop.
const ROUNDS: usize = 10;
/// Change of every scaled variable below which a round changed nothing.
const UNCHANGED: f64 = 1e-4;

/// Why there is no design.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// Nothing to choose.
    #[error("nothing is open to design: give bounds in [design]")]
    NothingOpen,
    /// Open stiffnesses without anything to judge them by.
    #[error(
        "the primary suspension or conicity is open, but [requirements] gives neither a \
         critical_speed nor a degree_curve to choose them by"
    )]
    NoRequirement,
    /// No design in the range could be evaluated.
    #[error("{stage}: no design within the bounds could be evaluated: {failure}")]
    NothingEvaluated {
        /// Where.
        stage: Stage,
        /// Why the last of them failed.
        failure: Failure,
    },
    /// The chosen design could not be evaluated.
    #[error(transparent)]
    Eigen(#[from] EigenError),
}

/// Designs the suspension of a case.
///
/// # Errors
///
/// [`DesignError`] where there is nothing to choose or nothing to choose by. Requirements that
/// cannot be met are no error: the result holds the best compromise and says what is not met.
pub fn design(
    case: &Case,
    space: &DesignSpace,
    requirements: &Requirements,
    limits: &Limits,
    progress: &dyn Progress,
) -> Result<DesignResult, DesignError> {
    let procedure = Procedure {
        space,
        requirements,
        limits,
        progress,
    };
    let primary_open = space.primary_bending_stiffness.is_some()
        || space.primary_lateral_stiffness.is_some()
        || space.conicity.is_some();
    let lateral_open = space.secondary_lateral_frequency.is_some()
        || space.secondary_lateral_damping_ratio.is_some();
    let vertical_open = space.secondary_vertical_frequency.is_some()
        || space.secondary_vertical_damping_ratio.is_some();
    if !(primary_open || lateral_open || vertical_open) {
        return Err(DesignError::NothingOpen);
    }
    let mut now = case.clone();
    let mut stages = Vec::new();
    if vertical_open {
        let stage = procedure.ride(Direction::Vertical, &mut now, 0)?;
        stages.push(stage);
    }
    let mut rounds = 0;
    let mut field = None;
    let mut settled = !(primary_open || lateral_open);
    while !settled && rounds < ROUNDS {
        let mut moved: f64 = 0.0;
        let mut round = Vec::new();
        if primary_open {
            let before = now.clone();
            let stage = procedure.stability_curving(&mut now, rounds, &mut field)?;
            moved = moved.max(stage.distance(&before, &now));
            round.push(stage);
        }
        if lateral_open {
            let before = now.clone();
            let stage = procedure.ride(Direction::Lateral, &mut now, rounds)?;
            moved = moved.max(stage.distance(&before, &now));
            round.push(stage);
        }
        rounds += 1;
        settled = moved < UNCHANGED || !(primary_open && lateral_open);
        StageResult::merge(&mut stages, round);
    }
    let evaluation = Evaluation::new(&now)?;
    let mut half = now.clone();
    half.wheel_rail.creep_factor *= 0.5;
    Ok(DesignResult {
        unmet: unmet(&evaluation, requirements, limits),
        half_kalker: Evaluation::new(&half)?,
        before: Evaluation::new(case)?,
        evaluation,
        case: now,
        stages,
        rounds,
        settled,
    })
}

struct Procedure<'a> {
    space: &'a DesignSpace,
    requirements: &'a Requirements,
    limits: &'a Limits,
    progress: &'a dyn Progress,
}

/// The profile at hand first: what it reaches tells early which others have no hope.
fn nearest_first(choices: &[f64], conicity: f64) -> Vec<f64> {
    let mut sorted = choices.to_vec();
    sorted.sort_by(|a, b| (a - conicity).abs().total_cmp(&(b - conicity).abs()));
    sorted
}

fn bounds_of(interval: Option<Interval>) -> Option<[f64; 2]> {
    interval.map(Into::into)
}

impl Procedure<'_> {
    fn ride(
        &self,
        direction: Direction,
        case: &mut Case,
        round: usize,
    ) -> Result<StageResult, DesignError> {
        let (space, limits) = (self.space, self.limits);
        let (stage, bounds, required, limits, frequency) = match direction {
            Direction::Lateral => (
                Stage::Lateral,
                [
                    space.secondary_lateral_frequency,
                    space.secondary_lateral_damping_ratio,
                ],
                self.requirements.lateral_acceleration,
                ride::Limits {
                    secondary_stroke: limits.secondary_lateral_stroke,
                    primary_stroke: limits.primary_lateral_stroke,
                    excursion: limits.wheelset_excursion,
                },
                None,
            ),
            Direction::Vertical => (
                Stage::Vertical,
                [
                    space.secondary_vertical_frequency,
                    space.secondary_vertical_damping_ratio,
                ],
                self.requirements.vertical_acceleration,
                ride::Limits {
                    secondary_stroke: limits.secondary_vertical_stroke,
                    ..ride::Limits::default()
                },
                space.primary_vertical_frequency,
            ),
        };
        // With a limit on the stroke, the least acceleration within it decides whether a required
        // acceleration can be had; without one, the required acceleration allows the least stroke.
        let goal = match (required, limits.secondary_stroke) {
            (Some(acceleration), None) => ride::Goal::Stroke { acceleration },
            _ => ride::Goal::Acceleration,
        };
        self.progress.stage(stage, round);
        let problem = Ride::new(
            direction,
            case,
            goal,
            limits,
            bounds.map(bounds_of),
            frequency,
        );
        let current = problem.coordinates(case);
        let solved = self.solve(stage, &problem, &current, round, f64::INFINITY)?;
        *case = problem.design(&solved.solution.point.x);
        Ok(StageResult::new(
            stage,
            &problem,
            &solved,
            current,
            Vec::new(),
        ))
    }

    fn stability_curving(
        &self,
        case: &mut Case,
        round: usize,
        field: &mut Option<Vec<f64>>,
    ) -> Result<StageResult, DesignError> {
        let goal = match (
            self.requirements.critical_speed,
            self.requirements.degree_curve,
        ) {
            (Some(critical_speed), None) => Goal::Curving { critical_speed },
            (None, Some(degree)) => Goal::Stability { degree },
            (Some(critical_speed), Some(degree)) => Goal::Both {
                critical_speed,
                degree,
            },
            (None, None) => return Err(DesignError::NoRequirement),
        };
        let stage = Stage::StabilityCurving;
        self.progress.stage(stage, round);
        let open = Open {
            bending_stiffness: bounds_of(self.space.primary_bending_stiffness),
            lateral_stiffness: bounds_of(self.space.primary_lateral_stiffness),
            conicity: None,
        };
        let limits = stability_curving::Limits {
            primary_stroke: self.limits.primary_lateral_stroke,
            excursion: self.limits.wheelset_excursion,
        };
        let candidates: Vec<(Case, Open)> = match &self.space.conicity {
            None => vec![(case.clone(), open)],
            Some(ConicitySpace::Interval(range)) => {
                vec![(
                    case.clone(),
                    Open {
                        conicity: bounds_of(Some(*range)),
                        ..open
                    },
                )]
            }
            Some(ConicitySpace::Choices(choices)) => {
                nearest_first(choices, case.wheel_rail.conicity)
                    .iter()
                    .filter(|conicity| field.as_ref().is_none_or(|f| f.contains(conicity)))
                    .map(|&conicity| {
                        let mut case = case.clone();
                        case.wheel_rail.conicity = conicity;
                        (case, open)
                    })
                    .collect()
            }
        };
        let mut best: Option<(StabilityCurving, Solved)> = None;
        let mut alternatives: Vec<Alternative> = Vec::new();
        for (candidate, open) in &candidates {
            let problem = StabilityCurving::new(candidate, goal, limits, *open);
            let solved = {
                // What the best profile so far has reached within its constraints.
                let beat =
                    best.as_ref()
                        .map_or(f64::INFINITY, |(_, b)| match &b.solution.point.values {
                            Ok(values) if values.violation() <= FEASIBLE => values.objective(),
                            _ => f64::INFINITY,
                        });
                self.solve(stage, &problem, &problem.coordinates(case), round, beat)?
            };
            alternatives.push(stability_curving::alternative(&problem, &solved));
            if best
                .as_ref()
                .is_none_or(|(_, b)| solved.solution.point.better_than(&b.solution.point))
            {
                best = Some((problem, solved));
            }
        }
        alternatives.sort_by(|a, b| a.conicity.total_cmp(&b.conicity));
        let Some((problem, solved)) = best else {
            return Err(DesignError::NothingOpen);
        };
        // Later rounds change little: only profiles nearly as good as the best stay in the race.
        field.get_or_insert_with(|| stability_curving::field(&alternatives, goal));
        let current = problem.coordinates(case);
        *case = problem.design(&solved.solution.point.x);
        if candidates.len() < 2 && round == 0 {
            alternatives.clear();
        }
        Ok(StageResult::new(
            stage,
            &problem,
            &solved,
            current,
            alternatives,
        ))
    }

    /// The first round searches everywhere; later ones near what the first found.
    fn solve(
        &self,
        stage: Stage,
        problem: &dyn Problem,
        current: &[f64],
        round: usize,
        beat: f64,
    ) -> Result<Solved, DesignError> {
        let near = [current.to_vec()];
        let start = if round == 0 {
            Start::Everywhere {
                seed: self.space.seed,
                also: &near,
                beat,
            }
        } else {
            Start::Near(current)
        };
        solve(problem, start, self.progress)
            .map_err(|failure| DesignError::NothingEvaluated { stage, failure })
    }
}
