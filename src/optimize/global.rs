//! Global phase: an even covering and a particle swarm (argmin) over the whole range of the
//! variables.

use std::borrow::Borrow;

use argmin::{
    core::{CostFunction, Error, Executor},
    solver::particleswarm::ParticleSwarm,
};
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

use super::{archive::Stop, evaluations::Evaluations, problem::Point};

/// Designs of the first, even covering of the box, per variable.
const COVERING_PER_VARIABLE: usize = 8;
/// Particles per variable, and sweeps of the swarm.
const PARTICLES_PER_VARIABLE: usize = 4;
const SWEEPS: usize = 2;
/// Evaluations of the global phase per variable.
pub(super) const EVALUATIONS_PER_VARIABLE: usize =
    COVERING_PER_VARIABLE + PARTICLES_PER_VARIABLE * (1 + SWEEPS);
/// Price of a violation in the swarm's merit.
const PENALTY: f64 = 20.0;
/// Price by which starts of the local search are ranked: lower, because what is a few per cent
/// short of a requirement here may still be best once the requirement is met.
pub(super) const START_PENALTY: f64 = 4.0;
/// Distance of the starts of the local search, in at least one direction.
pub(super) const APART: f64 = 0.12;

struct Merit<'a, 'b>(&'a Evaluations<'b>);

impl CostFunction for Merit<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.0.at(x)?.merit(PENALTY))
    }

    /// A sweep goes to the archive as a whole, which keeps its order whatever the threads do.
    fn bulk_cost<P: Borrow<Vec<f64>> + Sync>(&self, sweep: &[P]) -> Result<Vec<f64>, Error> {
        let designs: Vec<Vec<f64>> = sweep.iter().map(|x| x.borrow().clone()).collect();
        let points = self.0.all(&designs)?;
        Ok(points.iter().map(|p| p.merit(PENALTY)).collect())
    }
}

/// Searches the unit box; the same seed gives the same designs on any number of threads. Returns
/// designs from which to search locally, the most promising first.
pub(super) fn search(
    evaluations: &Evaluations,
    seed: u64,
    starts: usize,
) -> Result<Vec<Point>, Stop> {
    let n = evaluations.problem.variables().len();
    let covering: Vec<Vec<f64>> = (1..=COVERING_PER_VARIABLE * n)
        .map(|i| halton(i, n))
        .collect();
    evaluations.all(&covering)?;
    let solver = ParticleSwarm::new((vec![0.0; n], vec![1.0; n]), PARTICLES_PER_VARIABLE * n)
        .with_rng_generator(ChaCha8Rng::seed_from_u64(seed));
    let swarm = Executor::new(Merit(evaluations), solver)
        .configure(|state| state.max_iters(SWEEPS as u64))
        .run();
    // The merit is finite everywhere and the bounds are the box: the swarm has no other way to
    // fail, and what it found is among the evaluations.
    if let Err(error) = swarm
        && let Some(stop) = error.downcast_ref::<Stop>()
    {
        return Err(*stop);
    }
    Ok(evaluations.best_apart(START_PENALTY, APART, starts + n))
}

/// Point `i` of Halton's low-discrepancy sequence in `n` dimensions (Halton 1960).
pub fn halton(i: usize, n: usize) -> Vec<f64> {
    const PRIMES: [usize; 16] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];
    PRIMES
        .iter()
        .take(n)
        .map(|&base| {
            let (mut rest, mut digit, mut x) = (i, 1.0, 0.0);
            while rest > 0 {
                digit /= base as f64;
                x += digit * (rest % base) as f64;
                rest /= base;
            }
            x
        })
        .collect()
}
