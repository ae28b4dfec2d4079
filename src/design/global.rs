//! Global phase: a particle swarm (argmin) over the whole range of the variables.

use argmin::{
    core::{CostFunction, Error, Executor},
    solver::particleswarm::ParticleSwarm,
};
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

use super::{evaluations::Evaluations, problem::Point};

/// Particles per variable, and sweeps of the swarm.
const PARTICLES_PER_VARIABLE: usize = 8;
const SWEEPS: u64 = 10;
/// Price of a violation in the swarm's merit: high enough that no feasible design looks worse
/// than one that misses a requirement by a few per cent.
pub(super) const PENALTY: f64 = 20.0;

struct Merit<'a, 'b>(&'a Evaluations<'b>);

impl CostFunction for Merit<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.0.at(x).merit(PENALTY))
    }
}

/// Searches the unit box; the same seed gives the same designs on any number of threads. Returns
/// the best design met.
pub(super) fn search(evaluations: &Evaluations, seed: u64) -> Option<Point> {
    let n = evaluations.dimension();
    let solver = ParticleSwarm::new((vec![0.0; n], vec![1.0; n]), PARTICLES_PER_VARIABLE * n)
        .with_rng_generator(ChaCha8Rng::seed_from_u64(seed));
    // The merit is finite everywhere and the bounds are the box: the swarm has no other way to
    // fail, and what it found is in the log whatever it says.
    let _ = Executor::new(Merit(evaluations), solver)
        .configure(|state| state.max_iters(SWEEPS))
        .run();
    evaluations.best()
}
