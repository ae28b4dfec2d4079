//! Methods that share nothing with the search under test: differential evolution over the whole box, and
//! an evolution strategy that follows active constraints from many starts.
//!
//! They see a study as values only: no gradients, no pieces but the largest, no penalty.

use std::{
    collections::BTreeMap,
    sync::atomic::{AtomicUsize, Ordering},
};

use bogie::{design::study::Study, optimize::problem::Problem as _};
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// A study with a count of its evaluations.
pub struct Counted<'a> {
    study: &'a Study,
    count: AtomicUsize,
}

/// A design that has been evaluated.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Scaled coordinates.
    pub x: Vec<f64>,
    /// Objective; infinite without a performance.
    pub objective: f64,
    /// Largest violation, at least 0; infinite without a performance.
    pub violation: f64,
    /// Numbers of the violated constraints.
    violated: Vec<usize>,
}

impl Sample {
    /// Feasible designs by objective, before the others by violation (Deb 2000).
    pub fn better_than(&self, other: &Self) -> bool {
        let rank = |s: &Self| {
            (
                s.violation,
                if s.violation > 0.0 { 0.0 } else { s.objective },
            )
        };
        let ((a, f), (b, g)) = (rank(self), rank(other));
        a < b || (a <= b && f < g)
    }

    /// Whether all constraints hold.
    pub fn feasible(&self) -> bool {
        self.violation <= 0.0
    }
}

/// The best of some designs.
pub fn best(samples: impl IntoIterator<Item = Sample>) -> Option<Sample> {
    samples
        .into_iter()
        .reduce(|a, b| if b.better_than(&a) { b } else { a })
}

impl<'a> Counted<'a> {
    /// A study that nobody has evaluated.
    pub fn new(study: &'a Study) -> Self {
        Self {
            study,
            count: AtomicUsize::new(0),
        }
    }

    /// Evaluations so far.
    pub fn count(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }

    fn variables(&self) -> usize {
        self.study.variables().len()
    }

    fn at(&self, x: Vec<f64>) -> Sample {
        self.count.fetch_add(1, Ordering::Relaxed);
        let Ok(values) = self.study.evaluate(&x) else {
            return Sample {
                x,
                objective: f64::INFINITY,
                violation: f64::INFINITY,
                violated: Vec::new(),
            };
        };
        let above = values.constraints.iter().filter(|c| c.value > 0.0);
        Sample {
            violated: above.map(|c| c.index).collect(),
            objective: values.objective(),
            violation: values.violation(),
            x,
        }
    }
}

/// Designs spread uniformly at random that have a performance, at most `count`, from at most ten times
/// as many.
pub fn uniform(study: &Counted, count: usize, seed: u64) -> Vec<Sample> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut found = Vec::new();
    for _ in 0..10 {
        let designs: Vec<Vec<f64>> = (0..count)
            .map(|_| (0..study.variables()).map(|_| rng.random()).collect())
            .collect();
        let samples = designs.into_par_iter().map(|x| study.at(x));
        let samples: Vec<Sample> = samples.collect();
        found.extend(samples.into_iter().filter(|s| s.violation.is_finite()));
        if found.len() >= count {
            break;
        }
    }
    found.truncate(count);
    found
}

/// Differential evolution that adapts its own parameters (jDE: Brest et al., IEEE Transactions on
/// Evolutionary Computation 10, 2006), rand/1/bin with Deb's rules. Returns the last population.
pub fn evolve(study: &Counted, evaluations: usize, seed: u64) -> Vec<Sample> {
    /// Individuals per variable, the least number of them, and the rate at which F and CR are redrawn.
    const PER_VARIABLE: usize = 10;
    const LEAST: usize = 30;
    const REDRAWN: f64 = 0.1;
    let n = study.variables();
    let size = (PER_VARIABLE * n).max(LEAST);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let first: Vec<Vec<f64>> = (0..size)
        .map(|_| (0..n).map(|_| rng.random()).collect())
        .collect();
    let mut population: Vec<Sample> = first.into_par_iter().map(|x| study.at(x)).collect();
    let mut rates = vec![[0.5, 0.9]; size];
    for _ in 1..evaluations / size {
        let mut trials = Vec::new();
        let mut trial_rates = Vec::new();
        for i in 0..size {
            let mut others = [i; 4];
            for k in 1..4 {
                while others[..k].contains(&others[k]) {
                    others[k] = rng.random_range(0..size);
                }
            }
            let [mut scale, mut crossing] = rates[i];
            if rng.random_bool(REDRAWN) {
                scale = rng.random_range(0.1..1.0);
            }
            if rng.random_bool(REDRAWN) {
                crossing = rng.random();
            }
            let forced = rng.random_range(0..n);
            let mut x = population[i].x.clone();
            let [_, a, b, c] = others.map(|k| &population[k].x);
            for j in 0..n {
                if j == forced || rng.random_bool(crossing) {
                    let moved = a[j] + scale * (b[j] - c[j]);
                    // Beyond a bound: half way between it and where it came from.
                    x[j] = match moved {
                        _ if moved < 0.0 => 0.5 * x[j],
                        _ if moved > 1.0 => 0.5 * (x[j] + 1.0),
                        _ => moved,
                    };
                }
            }
            trials.push(x);
            trial_rates.push([scale, crossing]);
        }
        let trials: Vec<Sample> = trials.into_par_iter().map(|x| study.at(x)).collect();
        for (i, trial) in trials.into_iter().enumerate() {
            if !population[i].better_than(&trial) {
                population[i] = trial;
                rates[i] = trial_rates[i];
            }
        }
    }
    population
}

/// A (1+1)-CMA-ES with active constraint handling (Arnold, Hansen, GECCO 2012, with their constants):
/// `sigma` is the first step, the bounds are constraints too. Outside the feasible set the violation is
/// the objective, until it is gone.
pub fn strategy(
    study: &Counted,
    from: &Sample,
    sigma: f64,
    evaluations: usize,
    seed: u64,
) -> Sample {
    /// Success rate aimed at, and its fading.
    const TARGET: f64 = 2.0 / 11.0;
    const FADING: f64 = 1.0 / 12.0;
    /// Ancestor that a step must at least beat, and the step below which no more can be gained.
    const ANCESTOR: usize = 5;
    const SMALLEST: f64 = 1e-7;
    let n = study.variables();
    let size = n as f64;
    let [damping, path_rate] = [1.0 + size / 2.0, 2.0 / (size + 2.0)];
    let [gain, fade, shrink] = [
        2.0 / (size * size + 6.0),
        1.0 / (size + 2.0),
        0.1 / (size + 2.0),
    ];
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut here = from.clone();
    let mut sigma = sigma;
    let mut shape = DMatrix::<f64>::identity(n, n);
    let mut path = DVector::<f64>::zeros(n);
    let mut success = TARGET;
    let mut constraints: BTreeMap<usize, DVector<f64>> = BTreeMap::new();
    let mut ancestors: Vec<f64> = Vec::new();
    for _ in 0..evaluations {
        if sigma < SMALLEST {
            break;
        }
        let z = DVector::from_fn(n, |_, _| normal(&mut rng));
        let step = &shape * &z;
        let x: Vec<f64> = (0..n).map(|j| here.x[j] + sigma * step[j]).collect();
        // Bounds have numbers after all constraints.
        let outside = |j: usize| !(0.0..=1.0).contains(&x[j]);
        let mut violated: Vec<usize> = (0..n)
            .filter(|j| outside(*j))
            .map(|j| usize::MAX - j)
            .collect();
        let mut trial = None;
        if violated.is_empty() {
            let sample = study.at(x);
            if here.feasible() {
                violated.clone_from(&sample.violated);
            }
            if sample.violation.is_finite() && violated.is_empty() {
                trial = Some(sample);
            }
        }
        let Some(trial) = trial else {
            let inverse = shape.clone().try_inverse();
            let count = violated.len() as f64;
            let mut change = DMatrix::zeros(n, n);
            for number in violated {
                let along = constraints
                    .entry(number)
                    .or_insert_with(|| DVector::zeros(n));
                *along = &*along * (1.0 - fade) + &step * fade;
                if let Some(inverse) = &inverse {
                    let w = inverse * &*along;
                    change += &*along * w.transpose() * (shrink / count / w.norm_squared());
                }
            }
            shape -= change;
            continue;
        };
        let cost = |s: &Sample| {
            if here.feasible() {
                s.objective
            } else {
                s.violation
            }
        };
        let (new, old) = (cost(&trial), cost(&here));
        let won = new <= old;
        success += FADING * (f64::from(u8::from(won)) - success);
        sigma *= ((success - TARGET) / (1.0 - TARGET) / damping).exp();
        if won {
            ancestors.push(old);
            path = path * (1.0 - path_rate) + &step * (path_rate * (2.0 - path_rate)).sqrt();
            if let Some(inverse) = shape.clone().try_inverse() {
                let w = inverse * &path;
                let square = w.norm_squared().max(f64::MIN_POSITIVE);
                let a = (1.0 - gain).sqrt();
                let b = a / square * ((1.0 + gain * square / (1.0 - gain)).sqrt() - 1.0);
                shape = shape * a + &path * w.transpose() * b;
            }
            if trial.feasible() != here.feasible() {
                ancestors.clear();
            }
            here = trial;
        } else if ancestors.len() >= ANCESTOR && new > ancestors[ancestors.len() - ANCESTOR] {
            let square = z.norm_squared();
            let loss = (0.4 / (size.powf(1.6) + 1.0)).min(1.0 / (2.0 * square - 1.0).abs());
            let a = (1.0 + loss).sqrt();
            let b = a / square * ((1.0 - loss * square / (1.0 + loss)).max(0.0).sqrt() - 1.0);
            shape = &shape * a + &step * z.transpose() * b;
        }
    }
    here
}

/// A number from the standard normal distribution (Box, Muller 1958).
fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let [u, v]: [f64; 2] = [1.0 - rng.random::<f64>(), rng.random()];
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}
