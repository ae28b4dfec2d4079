//! The search on random vehicles with random demands, each result checked against a grid or against
//! random designs over the whole box.

use std::fmt::Write;

use crate::support::random_vehicle;
use bogie::{
    case::Case,
    design::{
        compromise::shortfall,
        margin::{margins, value},
        search,
        study::{Role, Rule, Study},
    },
    index::{Demands, Index, Sense},
    optimize::{
        archive::{Archive, Silent},
        local::{KKT_TOLERANCE, Status},
        problem::Problem,
        solve::{Solved, Start},
    },
    parameter::Parameter,
    spec::Interval,
};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// A hundredth of a per cent of speed, curve, acceleration or stroke: what a stall or a flat optimum
/// may cost; a missed basin costs more.
const TOLERANCE: f64 = 1e-4;

/// A design problem with what it is, and its demands.
struct Random {
    what: String,
    study: Study,
    demands: Demands,
}

impl Random {
    fn new(seed: u64, kind: &str, study: Study) -> Self {
        Self {
            what: format!("seed {seed}: {kind}"),
            study,
            demands: Demands::default(),
        }
    }

    fn vary(mut self, rng: &mut ChaCha8Rng, case: &Case, parameter: Parameter) -> Self {
        let bounds = match parameter {
            Parameter::CONICITY => [0.03, 0.25],
            Parameter::SECONDARY_LATERAL_FREQUENCY | Parameter::SECONDARY_VERTICAL_FREQUENCY => {
                [0.5, 2.0]
            }
            Parameter::SECONDARY_LATERAL_DAMPING_RATIO
            | Parameter::SECONDARY_VERTICAL_DAMPING_RATIO => [0.08, 0.8],
            _ => {
                let own = parameter.get(case);
                [
                    own / rng.random_range(3.0..15.0),
                    own * rng.random_range(3.0..15.0),
                ]
            }
        };
        self.study = self.study.vary(parameter, Interval::from(bounds));
        self
    }

    /// Demands an index up to 40 % better or worse than the vehicle has it as it is; damping ratios
    /// around what passenger trucks have.
    fn demand(mut self, rng: &mut ChaCha8Rng, case: &Case, index: Index) -> Self {
        let bound = match index {
            Index::LeastDampingRatio => Ok(rng.random_range(0.0..0.08)),
            _ => value(case, index).map(|v| v * rng.random_range(0.6..1.4)),
        };
        if let Ok(bound) = bound {
            let sign = match index.sense() {
                Sense::AtLeast => '≥',
                Sense::AtMost => '≤',
            };
            let _ = write!(self.what, ", {} {sign} {bound:.4}", index.name());
            self.study = self.study.demand(0, index, bound);
            self.demands.set(index, bound);
        }
        self
    }

    fn optimise(mut self, group: usize, index: Index) -> Self {
        let _ = write!(self.what, ", best {}", index.name());
        self.study = self.study.optimise(0, index, group, 1.0);
        self
    }
}

/// A vehicle at a speed well below the one at which it hunts, so that it has a lateral ride.
fn vehicle(rng: &mut ChaCha8Rng) -> Case {
    loop {
        let mut case = random_vehicle(rng, 1.5);
        if let Ok(critical) = value(&case, Index::CriticalSpeed)
            && critical > 15.0
        {
            case.service.speed = (critical * rng.random_range(0.4..0.8)).min(90.0);
            return case;
        }
    }
}

/// Problems in two variables by kind.
fn in_two_variables(seed: u64) -> Random {
    use Index::{
        CriticalSpeed, DegreeCurve, LateralAcceleration, LeastDampingRatio, PrimaryLateralStroke,
        SecondaryLateralStroke, SecondaryVerticalStroke, VerticalAcceleration, WheelsetExcursion,
    };
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let rng = &mut rng;
    let case = &vehicle(rng);
    let second = rng.random_bool(0.5);
    let of = |kind: &str| Random::new(seed, kind, Study::new(case, &[]));
    // The report's trade-off of stability and curving, either way round.
    let stability = |problem: Random, rng: &mut ChaCha8Rng| {
        let [best, kept] = if second {
            [CriticalSpeed, DegreeCurve]
        } else {
            [DegreeCurve, CriticalSpeed]
        };
        problem.optimise(0, best).demand(rng, case, kept)
    };
    let ride = |problem: Random, rng: &mut ChaCha8Rng, [best, kept]: [Index; 2]| {
        let [best, kept] = if second { [kept, best] } else { [best, kept] };
        problem.optimise(0, best).demand(rng, case, kept)
    };
    let lateral = [LateralAcceleration, SecondaryLateralStroke];
    match seed % 8 {
        0 => {
            let problem = of("K_b, K_py")
                .vary(rng, case, Parameter::PRIMARY_BENDING_STIFFNESS)
                .vary(rng, case, Parameter::PRIMARY_LATERAL_STIFFNESS);
            stability(problem, rng)
        }
        1 => {
            let problem = of("f_n, ξ lateral")
                .vary(rng, case, Parameter::SECONDARY_LATERAL_FREQUENCY)
                .vary(rng, case, Parameter::SECONDARY_LATERAL_DAMPING_RATIO);
            ride(problem, rng, lateral)
        }
        2 => {
            let problem = of("f_n, ξ vertical")
                .vary(rng, case, Parameter::SECONDARY_VERTICAL_FREQUENCY)
                .vary(rng, case, Parameter::SECONDARY_VERTICAL_DAMPING_RATIO);
            ride(
                problem,
                rng,
                [VerticalAcceleration, SecondaryVerticalStroke],
            )
        }
        3 => {
            let problem = of("K_sψ, T_sψ")
                .vary(rng, case, Parameter::SECONDARY_YAW_STIFFNESS)
                .vary(rng, case, Parameter::SECONDARY_YAW_BREAKAWAY_TORQUE);
            stability(problem, rng)
        }
        4 => {
            let problem = of("λ, K_b").vary(rng, case, Parameter::CONICITY).vary(
                rng,
                case,
                Parameter::PRIMARY_BENDING_STIFFNESS,
            );
            stability(problem, rng)
        }
        5 => {
            let problem = of("K_sy, C_sy")
                .vary(rng, case, Parameter::SECONDARY_LATERAL_STIFFNESS)
                .vary(rng, case, Parameter::SECONDARY_LATERAL_DAMPING);
            ride(problem, rng, lateral).demand(rng, case, LeastDampingRatio)
        }
        6 => {
            let mut problem = of("K_py, K_sy, K_px tied to K_py")
                .vary(rng, case, Parameter::PRIMARY_LATERAL_STIFFNESS)
                .vary(rng, case, Parameter::SECONDARY_LATERAL_STIFFNESS);
            let ratio = Parameter::PRIMARY_LONGITUDINAL_STIFFNESS.get(case)
                / Parameter::PRIMARY_LATERAL_STIFFNESS.get(case);
            let to = Parameter::PRIMARY_LATERAL_STIFFNESS;
            problem.study = problem.study.rule(
                Parameter::PRIMARY_LONGITUDINAL_STIFFNESS,
                Rule::Tied { to, ratio },
            );
            ride(problem, rng, [PrimaryLateralStroke, WheelsetExcursion])
        }
        _ => {
            let problem = of("K_pz, ξ vertical")
                .vary(rng, case, Parameter::SECONDARY_VERTICAL_DAMPING_RATIO)
                .vary(rng, case, Parameter::PRIMARY_VERTICAL_STIFFNESS);
            ride(
                problem,
                rng,
                [VerticalAcceleration, SecondaryVerticalStroke],
            )
            .demand(rng, case, Index::PrimaryVerticalStroke)
        }
    }
}

/// A study's objective or its demands alone, which is quicker to evaluate than both.
fn only(study: &Study, objective: bool) -> Study {
    study.with_roles(|_, term| {
        let is_objective = matches!(term.role, Role::Objective { .. });
        (is_objective == objective).then_some(term.role)
    })
}

/// What is wrong with what the search gave, beside `designs` of the box.
fn faults(problem: &Random, designs: &[Vec<f64>]) -> Vec<String> {
    let study = &problem.study;
    let archive = Archive::new(&Silent);
    let solved: Solved = match search(study, &Start::everywhere(3), &archive) {
        Ok(found) => found.solved,
        Err(reason) => {
            let none = designs.par_iter().all(|x| study.evaluate(x).is_err());
            return if none {
                Vec::new()
            } else {
                vec![reason.to_string()]
            };
        }
    };
    let x = solved.point.x[..study.parameters().len()].to_vec();
    let case = study.design(&x);
    let mut faults = Vec::new();
    let judged = match solved.status {
        Status::Infeasible => shortfall(study),
        _ => study.clone(),
    };
    let best = match judged.evaluate(&x) {
        Ok(values) => values.objective(),
        Err(failure) => return vec![format!("the design returned has no performance: {failure}")],
    };
    match solved.status {
        Status::Optimal => {
            let residual = solved.certificate.map_or(f64::INFINITY, |c| c.kkt_residual);
            if residual > KKT_TOLERANCE {
                faults.push(format!("optimal with a residual of {residual:e}"));
            }
        }
        Status::Infeasible => {}
        other => faults.push(format!("ended {other:?}")),
    }
    for margin in margins(&case, &problem.demands, &[]) {
        if solved.status != Status::Infeasible && !margin.met() {
            faults.push(format!(
                "{:?} not met by {:?}",
                margin.index, margin.reached
            ));
        }
    }
    let (objective, demands) = (only(&judged, true), only(&judged, false));
    let better = |x: &Vec<f64>| {
        let found = objective.evaluate(x).ok()?.objective();
        let better = found < best - TOLERANCE;
        // Strictly within the demands.
        (better && demands.evaluate(x).ok()?.violation() <= 0.0).then_some((found, x.clone()))
    };
    let missed = designs.par_iter().filter_map(better);
    if let Some((found, at)) = missed.min_by(|a, b| a.0.total_cmp(&b.0)) {
        faults.push(format!(
            "{:?} with {best:.6} at {x:.4?}, but {found:.6} at {at:.4?}",
            solved.status
        ));
    }
    if solved.status == Status::Infeasible {
        let meets = |x: &&Vec<f64>| {
            let values = study.evaluate(x);
            values.is_ok_and(|v| v.violation() <= 0.0)
        };
        if let Some(at) = designs.par_iter().find_first(meets) {
            faults.push(format!("called infeasible, but {at:.4?} meets all demands"));
        }
    }
    eprintln!(
        "  {} {:?} {best:.5} {x:.3?} {} evaluations",
        problem.what,
        solved.status,
        archive.count()
    );
    faults
}

fn grid(n: usize) -> Vec<Vec<f64>> {
    let at = |k: usize| k as f64 / (n - 1) as f64;
    (0..n * n).map(|k| vec![at(k / n), at(k % n)]).collect()
}

#[test]
fn no_design_of_a_grid_beats_what_the_search_gives() {
    let from: u64 = std::env::var("FROM").map_or(0, |s| s.parse().unwrap());
    let to: u64 = std::env::var("TO").map_or(16, |s| s.parse().unwrap());
    let designs = grid(9);
    let seeds: Vec<u64> = (from..to).collect();
    let faults: Vec<String> = seeds
        .par_iter()
        .flat_map_iter(|seed| {
            let t = std::time::Instant::now();
            let problem = in_two_variables(*seed);
            let f = faults(&problem, &designs);
            eprintln!("   seed {seed} {:?}", t.elapsed());
            let what = problem.what;
            f.into_iter().map(move |fault| format!("{what}: {fault}"))
        })
        .collect();
    assert!(faults.is_empty(), "{}\n{}", faults.len(), faults.join("\n"));
}

/// Three and four parameters, where a grid of the same fineness would be out of proportion.
fn in_more_variables(seed: u64) -> Random {
    let mut rng = ChaCha8Rng::seed_from_u64(1000 + seed);
    let rng = &mut rng;
    let case = &vehicle(rng);
    let of = |kind: &str| Random::new(1000 + seed, kind, Study::new(case, &[]));
    match seed % 4 {
        0 => of("K_b, K_py, K_sψ")
            .vary(rng, case, Parameter::PRIMARY_BENDING_STIFFNESS)
            .vary(rng, case, Parameter::PRIMARY_LATERAL_STIFFNESS)
            .vary(rng, case, Parameter::SECONDARY_YAW_STIFFNESS)
            .optimise(0, Index::DegreeCurve)
            .demand(rng, case, Index::CriticalSpeed),
        1 => of("f_n, ξ, K_pz vertical")
            .vary(rng, case, Parameter::SECONDARY_VERTICAL_FREQUENCY)
            .vary(rng, case, Parameter::SECONDARY_VERTICAL_DAMPING_RATIO)
            .vary(rng, case, Parameter::PRIMARY_VERTICAL_STIFFNESS)
            .optimise(0, Index::VerticalAcceleration)
            .demand(rng, case, Index::SecondaryVerticalStroke)
            .demand(rng, case, Index::WheelLoadVariation),
        2 => of("f_n, ξ lateral, f_n, ξ vertical")
            .vary(rng, case, Parameter::SECONDARY_LATERAL_FREQUENCY)
            .vary(rng, case, Parameter::SECONDARY_LATERAL_DAMPING_RATIO)
            .vary(rng, case, Parameter::SECONDARY_VERTICAL_FREQUENCY)
            .vary(rng, case, Parameter::SECONDARY_VERTICAL_DAMPING_RATIO)
            .optimise(0, Index::LateralAcceleration)
            .optimise(1, Index::VerticalAcceleration)
            .demand(rng, case, Index::SecondaryLateralStroke)
            .demand(rng, case, Index::SecondaryVerticalStroke),
        _ => of("f_n, ξ lateral, K_b, K_py")
            .vary(rng, case, Parameter::SECONDARY_LATERAL_FREQUENCY)
            .vary(rng, case, Parameter::SECONDARY_LATERAL_DAMPING_RATIO)
            .vary(rng, case, Parameter::PRIMARY_BENDING_STIFFNESS)
            .vary(rng, case, Parameter::PRIMARY_LATERAL_STIFFNESS)
            .optimise(0, Index::DegreeCurve)
            .optimise(1, Index::LateralAcceleration)
            .demand(rng, case, Index::CriticalSpeed)
            .demand(rng, case, Index::SecondaryLateralStroke),
    }
}

#[test]
fn no_random_design_beats_what_the_search_gives_in_three_and_four_variables() {
    let from: u64 = std::env::var("FROM").map_or(0, |s| s.parse().unwrap());
    let to: u64 = std::env::var("TO").map_or(4, |s| s.parse().unwrap());
    let seeds: Vec<u64> = (from..to).collect();
    let faults: Vec<String> = seeds
        .iter()
        .flat_map(|seed| {
            let t = std::time::Instant::now();
            let problem = in_more_variables(*seed);
            let mut rng = ChaCha8Rng::seed_from_u64(2000 + seed);
            let n = problem.study.parameters().len();
            let designs: Vec<Vec<f64>> = (0..2000)
                .map(|_| (0..n).map(|_| rng.random_range(0.0..1.0)).collect())
                .collect();
            let f = faults(&problem, &designs);
            eprintln!("   seed {seed} {:?}", t.elapsed());
            let what = problem.what;
            f.into_iter().map(move |fault| format!("{what}: {fault}"))
        })
        .collect();
    assert!(faults.is_empty(), "{}\n{}", faults.len(), faults.join("\n"));
}
