//! Screening by elementary effects (Morris 1991).

use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

use super::{
    random::{below, permutation},
    runs::{self, Outcome, Output, Watch},
};

/// Levels in common use (Campolongo et al. 2007): the bounds, and two between them.
pub const LEVELS: usize = 4;

/// Size of the sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// r, trajectories: each takes one evaluation more than there are factors.
    pub trajectories: usize,
    /// p, levels of every factor, an even number, see [`LEVELS`].
    pub levels: usize,
    /// Seed of the trajectories.
    pub seed: u64,
}

/// Effects of one factor on one output. An effect is the change of the output per change of the
/// factor's coordinate in the unit cube: as if over the factor's whole range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effect {
    /// μ, mean of the effects (Morris 1991): its sign says which way the output goes.
    pub mu: f64,
    /// μ*, mean of their sizes (Campolongo et al. 2007): effects of either sign do not cancel.
    pub mu_star: f64,
    /// σ, their standard deviation: 0 if the output is linear in this factor and independent of
    /// the others.
    pub sigma: f64,
    /// Effects that could be had.
    pub count: usize,
}

impl Effect {
    /// Mean square of the effects, μ² + σ² (n − 1)/n. Its share in the sum over all factors is the
    /// share of variance where the output is a sum of linear terms. In general the mean square of
    /// derivatives, for which the effects stand, is a bound of the total index, but for a factor
    /// common to all (Sobol' and Kucherenko 2009).
    pub fn mean_square(&self) -> f64 {
        let n = self.count as f64;
        self.mu.powi(2) + self.sigma.powi(2) * (n - 1.0) / n
    }

    fn new(effects: &[f64]) -> Option<Self> {
        if effects.is_empty() {
            return None;
        }
        let n = effects.len() as f64;
        let [mu, sigma] = runs::moments(effects.iter().copied()).unwrap_or([effects[0], 0.0]);
        Some(Self {
            mu,
            mu_star: effects.iter().map(|d| d.abs()).sum::<f64>() / n,
            sigma,
            count: effects.len(),
        })
    }
}

/// A screening.
#[derive(Debug, Clone, PartialEq)]
pub struct Screening {
    /// Effects by output.
    pub outputs: Vec<Output<Effect>>,
    /// Number of whole trajectories evaluated.
    pub trajectories: usize,
}

/// Elementary effects of every factor on `outputs` outputs of a function on the unit cube (Morris
/// 1991, section 3).
///
/// ```math
/// d_i = [f(x + Δ e_i) − f(x)] / Δ,   Δ = p / (2 (p − 1)),   x on the grid {0, 1/(p−1), …, 1}
/// ```
///
/// A trajectory moves every factor once, in random order, from a random point of the grid. An effect
/// at whose ends the function fails is left out.
///
/// # Panics
///
/// If the number of levels is odd or zero.
pub fn screening<F>(
    function: &F,
    factors: usize,
    outputs: usize,
    settings: &Settings,
    watch: &Watch,
) -> Screening
where
    F: Fn(&[f64]) -> Vec<Outcome> + Sync + ?Sized,
{
    assert!(
        settings.levels >= 2 && settings.levels.is_multiple_of(2),
        "{} levels: their number must be even",
        settings.levels
    );
    let trajectory = |i: usize| Trajectory::new(i, factors, settings);
    let points = |i: usize| trajectory(i).points(settings.levels);
    let groups = runs::evaluate(function, settings.trajectories, points, watch);
    let trajectories: Vec<Trajectory> = (0..groups.len()).map(trajectory).collect();
    let delta = step(settings.levels);
    let output = |output: usize| {
        let mut effects = vec![Vec::with_capacity(groups.len()); factors];
        for (trajectory, group) in trajectories.iter().zip(&groups) {
            for (i, ends) in trajectory.order.iter().zip(group.windows(2)) {
                if let (Ok(before), Ok(after)) = (ends[0][output], ends[1][output]) {
                    let change = if trajectory.up[*i] {
                        after - before
                    } else {
                        before - after
                    };
                    effects[*i].push(change / delta);
                }
            }
        }
        let values = groups
            .iter()
            .flatten()
            .filter_map(|point| point[output].ok());
        Output {
            moments: runs::moments(values),
            failures: runs::failures(&groups, output),
            effects: effects.iter().map(|effects| Effect::new(effects)).collect(),
        }
    };
    Screening {
        outputs: (0..outputs).map(output).collect(),
        trajectories: groups.len(),
    }
}

/// Δ.
fn step(levels: usize) -> f64 {
    levels as f64 / (2.0 * (levels - 1) as f64)
}

/// A trajectory through the grid.
struct Trajectory {
    /// Level of every factor at the lower end of its step: below p/2.
    lower: Vec<usize>,
    /// True if the step goes up.
    up: Vec<bool>,
    /// In which order the factors move.
    order: Vec<usize>,
}

impl Trajectory {
    /// Trajectory `i`, whose random numbers are a stream of their own.
    fn new(i: usize, factors: usize, settings: &Settings) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(settings.seed);
        rng.set_stream(i as u64);
        Self {
            lower: (0..factors)
                .map(|_| below(&mut rng, settings.levels / 2))
                .collect(),
            up: (0..factors).map(|_| below(&mut rng, 2) == 1).collect(),
            order: permutation(&mut rng, factors),
        }
    }

    /// Its points: the start, then one after each move.
    fn points(&self, levels: usize) -> Vec<Vec<f64>> {
        let at = |i: usize, upper: bool| {
            let level = self.lower[i] + if upper { levels / 2 } else { 0 };
            level as f64 / (levels - 1) as f64
        };
        let mut x: Vec<f64> = (0..self.order.len()).map(|i| at(i, !self.up[i])).collect();
        let mut points = vec![x.clone()];
        for &i in &self.order {
            x[i] = at(i, self.up[i]);
            points.push(x.clone());
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trajectory_moves_each_factor_once_on_the_grid() {
        let settings = Settings {
            trajectories: 1,
            levels: 6,
            seed: 1,
        };
        for i in 0..50 {
            let points = Trajectory::new(i, 7, &settings).points(6);
            assert_eq!(points.len(), 8);
            let mut moved = [0; 7];
            for pair in points.windows(2) {
                for (i, (a, b)) in pair[0].iter().zip(&pair[1]).enumerate() {
                    assert!((5.0 * a).fract() == 0.0 && (0.0..=1.0).contains(a));
                    if (a - b).abs() > 0.0 {
                        moved[i] += 1;
                        assert!(((a - b).abs() - 0.6).abs() < 1e-15);
                    }
                }
            }
            assert_eq!(moved, [1; 7]);
        }
    }
}
