//! Ranking of the factors by their influence on an index.

use super::{morris, sobol};

/// Effects by factor; `None` where too many evaluations failed.
#[derive(Debug, Clone, PartialEq)]
pub enum Effects {
    /// Shares of variance.
    Sobol(Vec<Option<sobol::Effect>>),
    /// Elementary effects.
    Morris(Vec<Option<morris::Effect>>),
}

/// Factors by importance to an index: numbers in the list of factors.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ranking {
    /// Influential factors, the most important first.
    pub matters: Vec<usize>,
    /// Negligible factors: together they explain less than [`NEGLIGIBLE`].
    pub negligible: Vec<usize>,
    /// Unknown factors, because too many evaluations failed.
    pub unknown: Vec<usize>,
}

/// Share of variance below which factors together do not matter.
pub const NEGLIGIBLE: f64 = 0.01;

impl Effects {
    /// Factors by importance: by total index or μ*. The least important ones do not matter as long
    /// as the sum of their total indices, which is no less than their total index as a group, or
    /// their share in the mean squares of all effects, is below [`NEGLIGIBLE`].
    pub fn ranking(&self) -> Ranking {
        // By factor: measure of its rank, and share that it explains.
        let known: Vec<Option<(f64, f64)>> = match self {
            Self::Sobol(effects) => effects
                .iter()
                .map(|e| e.map(|e| (e.total.value, e.total.value)))
                .collect(),
            Self::Morris(effects) => {
                let squares = effects.iter().flatten().map(|e| e.mean_square());
                let all: f64 = squares.sum();
                let share = |e: morris::Effect| {
                    if all > 0.0 {
                        e.mean_square() / all
                    } else {
                        0.0
                    }
                };
                effects
                    .iter()
                    .map(|e| e.map(|e| (e.mu_star, share(e))))
                    .collect()
            }
        };
        let mut ranked: Vec<(usize, f64, f64)> = known
            .iter()
            .enumerate()
            .filter_map(|(i, known)| known.map(|(rank, share)| (i, rank, share)))
            .collect();
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut explained = 0.0;
        let negligible = ranked.iter().rev().take_while(|(_, _, share)| {
            explained += share;
            explained < NEGLIGIBLE
        });
        let matter = ranked.len() - negligible.count();
        let order = |part: &[(usize, f64, f64)]| part.iter().map(|(i, _, _)| *i).collect();
        Ranking {
            matters: order(&ranked[..matter]),
            negligible: order(&ranked[matter..]),
            unknown: (0..known.len()).filter(|i| known[*i].is_none()).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn total(value: f64) -> sobol::Effect {
        let estimate = sobol::Estimate {
            value,
            interval: [value; 2],
        };
        sobol::Effect {
            first: estimate,
            total: estimate,
            rows: 100,
        }
    }

    #[test]
    fn the_least_important_do_not_matter_while_they_explain_little_together() {
        let effects = [0.004, 0.5, 0.003, 0.6, 0.004].map(|t| Some(total(t)));
        let ranking = Effects::Sobol(effects.into_iter().chain([None]).collect()).ranking();
        assert_eq!(ranking.matters, [3, 1, 0]);
        assert_eq!(ranking.negligible, [4, 2]);
        assert_eq!(ranking.unknown, [5]);
        let nothing = Effects::Sobol(vec![Some(total(0.0)); 3]).ranking();
        assert_eq!(nothing.negligible, [0, 1, 2]);
    }
}
