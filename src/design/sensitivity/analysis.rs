//! Sensitivity of a case's performance indices.

use std::collections::BTreeMap;

use super::{
    factors::{Factor, Factors},
    morris,
    ranking::{Effects, Ranking},
    runs::{Outcome, Output, Watch},
    sobol,
};
use crate::{
    case::Case,
    design::measure::{Shared, Wanted, absence, is_only_bounded},
    index::{Index, Scale},
    optimize::problem::{Failure, Piece},
    spec::{DesignSpace, Spec},
};

/// Method of the sensitivity analysis, with its sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Shares of variance, see [`sobol`].
    Sobol {
        /// Rows of the sample.
        rows: usize,
    },
    /// Elementary effects, see [`morris`].
    Morris {
        /// Trajectories.
        trajectories: usize,
    },
}

impl Method {
    /// Sobol' indices from 256 rows: among 50 factors total indices are then good to about ± 0.1
    /// where they are large and ± 0.01 where they are small.
    pub const SOBOL: Self = Self::Sobol { rows: 256 };
    /// Screening with 20 trajectories: twice the usual least number.
    pub const MORRIS: Self = Self::Morris { trajectories: 20 };

    /// Evaluations that it takes with a number of factors.
    pub fn evaluations(self, factors: usize) -> usize {
        self.groups() * self.group(factors)
    }

    /// Rows or trajectories.
    pub fn groups(self) -> usize {
        match self {
            Self::Sobol { rows } => rows,
            Self::Morris { trajectories } => trajectories,
        }
    }

    /// Evaluations in one of them.
    fn group(self, factors: usize) -> usize {
        match self {
            Self::Sobol { .. } => factors + 2,
            Self::Morris { .. } => factors + 1,
        }
    }
}

/// Settings of an analysis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Method.
    pub method: Method,
    /// Seed: the same gives the same bits.
    pub seed: u64,
}

/// Sensitivity of several indices to the same factors.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// Settings.
    pub settings: Settings,
    /// Factors.
    pub factors: Vec<Factor>,
    /// Relative spread of the factors that are inputs.
    pub spread: f64,
    /// Results by index.
    pub indices: Vec<IndexSensitivity>,
    /// Number of whole rows or trajectories evaluated: fewer than asked for if the run was interrupted.
    pub groups: usize,
}

/// Sensitivity of one index. Values and effects are of ln(index), with the index in SI, or of the
/// index itself where its scale is linear.
#[derive(Debug, Clone, PartialEq)]
pub struct IndexSensitivity {
    /// Which.
    pub index: Index,
    /// Mean and standard deviation over the sample; `None` where fewer than two evaluations
    /// succeeded.
    pub moments: Option<[f64; 2]>,
    /// Failed evaluations by kind.
    pub failures: BTreeMap<Failure, usize>,
    /// Effects by factor.
    pub effects: Effects,
}

impl Sensitivity {
    /// Sensitivity of indices to factors.
    pub fn new(factors: &Factors, indices: &[Index], settings: Settings, watch: &Watch) -> Self {
        let wanted: Vec<Wanted> = indices.iter().map(|index| Wanted::Index(*index)).collect();
        let shared = Shared::new(factors.base(), &wanted);
        let function = |x: &[f64]| {
            let case = factors.case(x);
            outcomes(&case, indices, shared.measure_each(&case))
        };
        let (n, outputs, seed) = (factors.list().len(), indices.len(), settings.seed);
        watch.progress.stage("sensitivity");
        watch.progress.expected(settings.method.evaluations(n));
        let (indices, groups) = match settings.method {
            Method::Sobol { rows } => {
                let settings = sobol::Settings { rows, seed };
                let found = sobol::decomposition(&function, n, outputs, &settings, watch);
                let pairs = indices.iter().zip(found.outputs);
                let indices = pairs.map(|(i, o)| IndexSensitivity::new(*i, o, Effects::Sobol));
                (indices.collect(), found.rows)
            }
            Method::Morris { trajectories } => {
                let settings = morris::Settings {
                    trajectories,
                    levels: morris::LEVELS,
                    seed,
                };
                let found = morris::screening(&function, n, outputs, &settings, watch);
                let pairs = indices.iter().zip(found.outputs);
                let indices = pairs.map(|(i, o)| IndexSensitivity::new(*i, o, Effects::Morris));
                (indices.collect(), found.trajectories)
            }
        };
        Self {
            settings,
            factors: factors.list().to_vec(),
            spread: factors.spread(),
            indices,
            groups,
        }
    }

    /// Evaluations of which the result is made.
    pub fn evaluations(&self) -> usize {
        self.groups * self.settings.method.group(self.factors.len())
    }

    /// True if the run ended before all evaluations.
    pub fn interrupted(&self) -> bool {
        self.groups < self.settings.method.groups()
    }

    /// Factors without influence on any index.
    pub fn negligible(&self) -> Vec<usize> {
        let rankings: Vec<Ranking> = self.indices.iter().map(|i| i.ranking()).collect();
        (0..self.factors.len())
            .filter(|factor| rankings.iter().all(|r| r.negligible.contains(factor)))
            .collect()
    }
}

impl IndexSensitivity {
    fn new<E>(index: Index, output: Output<E>, effects: fn(Vec<Option<E>>) -> Effects) -> Self {
        Self {
            index,
            moments: output.moments,
            failures: output.failures,
            effects: effects(output.effects),
        }
    }

    /// Factors by importance.
    pub fn ranking(&self) -> Ranking {
        self.effects.ranking()
    }
}

/// Default indices: the report's own and the indices with a demand.
pub fn indices_of(spec: &Spec) -> Vec<Index> {
    const REPORT: [Index; 6] = [
        Index::CriticalSpeed,
        Index::DegreeCurve,
        Index::LateralAcceleration,
        Index::VerticalAcceleration,
        Index::SecondaryLateralStroke,
        Index::SecondaryVerticalStroke,
    ];
    let asked = |index: &Index| {
        spec.demands.get(*index).is_some() || spec.objective.iter().any(|goal| goal.index == *index)
    };
    Index::ALL
        .into_iter()
        .filter(|index| REPORT.contains(index) || asked(index))
        .collect()
}

/// Screens all inputs of a finished design within ± 10 %, with 10 trajectories: enough to separate
/// influential inputs from others.
pub fn screen(design: &Case, indices: &[Index], seed: u64, watch: &Watch) -> Sensitivity {
    let factors = Factors::new(design, &DesignSpace::default(), 0.1);
    let method = Method::Morris { trajectories: 10 };
    Sensitivity::new(&factors, indices, Settings { method, seed }, watch)
}

/// Indices of a case, on the scale on which they are compared, from their measurements.
fn outcomes(
    case: &Case,
    indices: &[Index],
    measured: Vec<Result<Vec<Piece>, Failure>>,
) -> Vec<Outcome> {
    let pairs = measured.into_iter().zip(indices);
    pairs
        .map(|(pieces, index)| compared(case, *index, &pieces?))
        .collect()
}

/// The worst piece of an index; its logarithm where the index is compared by ratios.
fn compared(case: &Case, index: Index, pieces: &[Piece]) -> Outcome {
    let values = pieces.iter().map(|piece| piece.value);
    if values.clone().any(f64::is_nan) {
        return Err(Failure::NotFinite);
    }
    let value = index.worst(values).ok_or_else(|| absence(index))?;
    if is_only_bounded(case, index, value) {
        return Err(Failure::OnlyBounded);
    }
    match index.scale() {
        Scale::Linear => Ok(value),
        Scale::Logarithmic if value > 0.0 => Ok(value.ln()),
        Scale::Logarithmic => Err(Failure::NotFinite),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_is_its_worst_piece() {
        let pieces = |values: &[f64]| -> Vec<Piece> {
            values.iter().map(|v| Piece::single(0, *v)).collect()
        };
        let e = std::f64::consts::E;
        for (index, values, outcome) in [
            (Index::CriticalSpeed, &[50.0, 90.0][..], Ok(50.0_f64.ln())),
            (Index::CriticalSpeed, &[1.0, e], Err(Failure::OnlyBounded)),
            (Index::WheelLOverV, &[1.0, e], Ok(1.0)),
            (Index::LeastDampingRatio, &[-0.1, 0.2], Ok(-0.1)),
            (Index::WheelLOverV, &[0.0], Err(Failure::NotFinite)),
            (
                Index::WheelLOverV,
                &[1.0, f64::NAN],
                Err(Failure::NotFinite),
            ),
            (Index::FrequencySeparation, &[], Err(Failure::NoMode)),
        ] {
            assert_eq!(
                compared(&Case::prototype(), index, &pieces(values)),
                outcome,
                "{index:?} {values:?}"
            );
        }
    }

    /// Unstable at its speed: no lateral ride, but all the rest.
    #[test]
    fn what_fails_takes_nothing_else_along() {
        let mut case = Case::prototype();
        case.service.speed = 200.0;
        let indices = [
            Index::LateralAcceleration,
            Index::CriticalSpeed,
            Index::VerticalAcceleration,
        ];
        let wanted = indices.map(Wanted::Index);
        let found = outcomes(
            &case,
            &indices,
            Shared::new(&case, &wanted).measure_each(&case),
        );
        assert_eq!(found[0], Err(Failure::Unstable));
        assert!(found[1].is_ok() && found[2].is_ok());
    }
}
