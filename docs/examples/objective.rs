//! An objective of one's own: the worst of the three places in the carbody, where the spec's
//! `lateral_acceleration` is their average; with a critical speed of 240 mph at least.
//!
//! `cargo run --release --example objective`

use bogie::{
    Case, Evaluation, Parameter,
    evaluate::ride::NoRide,
    optimize::{
        archive::{Archive, Silent},
        problem::{Detail, Failure, Piece, Problem, Scale, Values, Variable},
        solve::{Start, solve},
    },
    units::us::MILE,
};

/// Critical speed asked for, m/s.
const ASKED: f64 = 240.0 * MILE / 3600.0;

/// ```math
/// minimise  max_i a_i(x)   subject to   1 - V_c(x)/V_asked ≤ 0
/// ```
struct WorstPlace {
    base: Case,
    parameters: [Parameter; 2],
    variables: [Variable; 2],
}

impl WorstPlace {
    fn new() -> Self {
        let ranges = [
            (Parameter::PRIMARY_LATERAL_STIFFNESS, [1e6, 7e7]),
            (Parameter::SECONDARY_LATERAL_DAMPING_RATIO, [0.1, 0.6]),
        ];
        Self {
            base: Case::prototype(),
            parameters: ranges.map(|(parameter, _)| parameter),
            variables: ranges.map(|(parameter, bounds)| Variable {
                name: parameter.name(),
                symbol: parameter.symbol(),
                quantity: parameter.quantity(),
                bounds,
                scale: Scale::Logarithmic,
            }),
        }
    }

    fn case(&self, x: &[f64]) -> Case {
        let mut case = self.base.clone();
        for ((parameter, variable), x) in self.parameters.iter().zip(&self.variables).zip(x) {
            parameter.set(&mut case, variable.value(*x));
        }
        case
    }
}

impl Problem for WorstPlace {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn piece_name(&self, index: usize) -> String {
        ["acceleration at the worst place", "critical speed"][index].into()
    }

    /// Three accelerations, then the critical speed: smooth pieces, each scaled to order one.
    fn measure(&self, x: &[f64], _: Detail) -> Result<Vec<Piece>, Failure> {
        let case = self.case(x);
        let evaluation = Evaluation::new(&case).map_err(|_| Failure::Eigenvalues)?;
        let ride = evaluation.lateral.map_err(|reason| match reason {
            NoRide::Diverges => Failure::Diverges,
            NoRide::NotConverged => Failure::Integration,
            _ => Failure::Unstable,
        })?;
        // Stable over the whole range searched: at least its end.
        let speed = evaluation.stability.critical_speed();
        let speed = speed.unwrap_or(case.model.speed_range[1]);
        let places = ride.acceleration.iter().zip([0.0, 1.0, 2.0]);
        let mut pieces: Vec<Piece> = places
            .map(|(acceleration, label)| Piece {
                label,
                ..Piece::single(0, *acceleration)
            })
            .collect();
        pieces.push(Piece::single(1, 1.0 - speed / ASKED));
        Ok(pieces)
    }

    fn judge(&self, measured: &[Piece]) -> Values {
        let (objective, constraints) = measured.split_at(3);
        Values {
            objectives: vec![objective.to_vec()],
            constraints: constraints.to_vec(),
        }
    }
}

/// Solves the problem and prints the design.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let problem = WorstPlace::new();
    let archive = Archive::new(&Silent);
    let solved = solve(&problem, &Start::everywhere(1), &archive)?;
    for (variable, x) in problem.variables.iter().zip(&solved.point.x) {
        println!("{}: {:.4e} (SI)", variable.name, variable.value(*x));
    }
    println!("worst place: {:.4} m/s² RMS", solved.point.objective());
    println!("{:?} after {} evaluations", solved.status, archive.count());
    Ok(())
}
