//! Variance-based sensitivity (Sobol' 1993).
//!
//! The first-order index of a factor is the share of an output's variance that would go if that
//! factor alone were known; its total index is the share that would remain if all the others were
//! known (Homma and Saltelli 1996).
//!
//! Points come from a scrambled Sobol' sequence, see [`Sequence`].

use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
use rayon::prelude::*;

use super::{
    random::below,
    runs::{self, Group, Outcome, Output, Watch},
};
use crate::design::sequence::{self, Sequence};

/// Rows that one scrambling of the sequence has.
pub const MAX_ROWS: usize = sequence::BLOCK;
/// Resamples for the intervals: 25 lie beyond either end of a 95 % interval.
const RESAMPLES: usize = 1000;
/// An output whose standard deviation is below this, relative to its size where that is above 1,
/// does not vary.
const CONSTANT: f64 = 1e-9;

/// Size of the sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// N, rows of the sample: each takes two evaluations more than there are factors. Powers of
    /// two cover the cube most evenly. At most [`MAX_ROWS`].
    pub rows: usize,
    /// Seed of the scrambling and of the resampling.
    pub seed: u64,
}

/// An estimate with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Between which percentiles 2.5 and 97.5 of the resampled estimates lie.
    pub interval: [f64; 2],
}

/// Sensitivity of one output to one factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effect {
    /// S_i. The error of the estimate does not shrink with the index, so that it may come out below 0;
    /// small influences are judged by S_Ti.
    pub first: Estimate,
    /// S_Ti.
    pub total: Estimate,
    /// Number of rows in which A, B and AB_i could all be evaluated.
    pub rows: usize,
}

/// A variance decomposition.
#[derive(Debug, Clone, PartialEq)]
pub struct Decomposition {
    /// Indices by output.
    pub outputs: Vec<Output<Effect>>,
    /// Number of whole rows evaluated.
    pub rows: usize,
}

/// First-order and total indices of every factor for `outputs` outputs of a function on the unit
/// cube, with the sample of Saltelli et al. (2010): matrices A and B from the two halves of the
/// coordinates of one sequence, and AB_i, which is A with column i from B. Moments are taken over A
/// and B.
///
/// Rows in which the function fails at A, B or AB_i are left out for factor i. The remaining rows do not
/// fill the cube evenly: with many failures the indices are approximate.
///
/// # Panics
///
/// If there are more than [`MAX_ROWS`] rows.
pub fn decomposition<F>(
    function: &F,
    factors: usize,
    outputs: usize,
    settings: &Settings,
    watch: &Watch,
) -> Decomposition
where
    F: Fn(&[f64]) -> Vec<Outcome> + Sync + ?Sized,
{
    assert!(
        settings.rows <= MAX_ROWS,
        "{} rows: at most {MAX_ROWS}",
        settings.rows
    );
    let sequence = Sequence::new(settings.seed);
    let points = |row: usize| {
        let mut a = sequence.point(row, 2 * factors);
        let b = a.split_off(factors);
        let mut points = vec![a.clone(), b.clone()];
        for i in 0..factors {
            let mut mixed = a.clone();
            mixed[i] = b[i];
            points.push(mixed);
        }
        points
    };
    let groups = runs::evaluate(function, settings.rows, points, watch);
    let pairs: Vec<(usize, usize)> = (0..outputs)
        .flat_map(|output| (0..factors).map(move |factor| (output, factor)))
        .collect();
    let rows = pairs
        .iter()
        .map(|(output, factor)| rows(&groups, *output, *factor));
    let rows: Vec<Vec<(usize, Row)>> = rows.collect();
    let estimates = |counts: &[u32]| -> Vec<Option<[f64; 2]>> {
        rows.iter().map(|rows| indices(rows, counts)).collect()
    };
    let found = estimates(&vec![1; groups.len()]);
    let resampled: Vec<Vec<Option<[f64; 2]>>> = (0..RESAMPLES)
        .into_par_iter()
        .map(|i| estimates(&resample(groups.len(), settings.seed, i)))
        .collect();
    let effect = |pair: usize| -> Option<Effect> {
        let values = found[pair]?;
        let estimate = |i: usize| {
            let resampled = resampled.iter().filter_map(|r| Some(r[pair]?[i]));
            Estimate {
                value: values[i],
                interval: middle(resampled.collect(), values[i]),
            }
        };
        Some(Effect {
            first: estimate(0),
            total: estimate(1),
            rows: rows[pair].len(),
        })
    };
    let output = |output: usize| {
        let values = groups.iter().flat_map(|group| &group[..2]);
        Output {
            moments: runs::moments(values.filter_map(|point| point[output].ok())),
            failures: runs::failures(&groups, output),
            effects: (0..factors).map(|i| effect(output * factors + i)).collect(),
        }
    };
    Decomposition {
        outputs: (0..outputs).map(output).collect(),
        rows: groups.len(),
    }
}

/// A row for one factor.
#[derive(Clone, Copy)]
struct Row {
    a: f64,
    b: f64,
    mixed: f64,
}

impl Row {
    fn new(group: &Group, output: usize, factor: usize) -> Option<Self> {
        let value = |point: usize| group[point][output].ok();
        Some(Self {
            a: value(0)?,
            b: value(1)?,
            mixed: value(2 + factor)?,
        })
    }
}

/// Rows that have values for an output and a factor, with their numbers.
fn rows(groups: &[Group], output: usize, factor: usize) -> Vec<(usize, Row)> {
    let numbered = groups.iter().enumerate();
    numbered
        .filter_map(|(i, group)| Some((i, Row::new(group, output, factor)?)))
        .collect()
}

/// S_i and S_Ti from rows that count as often as said (Saltelli et al. 2010, Table 2, b and f; the
/// second is Jansen's of 1999):
///
/// ```math
/// S_i = Σ f(B) [f(AB_i) − f(A)] / (N V),   S_Ti = Σ [f(A) − f(AB_i)]² / (2 N V)
/// ```
///
/// V is the variance of f(A) and f(B) together; f(B) is taken less the mean. Jansen's own form of
/// S_i scatters much more where S_i is small. `None` for fewer than two rows.
fn indices(rows: &[(usize, Row)], counts: &[u32]) -> Option<[f64; 2]> {
    let rows = || rows.iter().map(|(row, r)| (r, f64::from(counts[*row])));
    let (mut n, mut sum) = (0.0, 0.0);
    for (r, w) in rows() {
        n += w;
        sum += w * (r.a + r.b);
    }
    if n < 2.0 {
        return None;
    }
    let mean = sum / (2.0 * n);
    let [mut variance, mut first, mut total] = [0.0; 3];
    for (r, w) in rows() {
        variance += w * ((r.a - mean).powi(2) + (r.b - mean).powi(2));
        first += w * (r.b - mean) * (r.mixed - r.a);
        total += w * (r.a - r.mixed).powi(2);
    }
    variance /= 2.0 * n - 1.0;
    if variance.sqrt() <= CONSTANT * mean.abs().max(1.0) {
        return Some([0.0; 2]);
    }
    Some([first / (n * variance), total / (2.0 * n * variance)])
}

/// Multiplicity of each row in a resample of the bootstrap (Efron 1979). Rows of a sequence are not
/// independent, as the bootstrap assumes: the intervals are rather too wide.
fn resample(rows: usize, seed: u64, number: usize) -> Vec<u32> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(1 + number as u64);
    let mut counts = vec![0; rows];
    for _ in 0..rows {
        counts[below(&mut rng, rows)] += 1;
    }
    counts
}

/// Percentiles 2.5 and 97.5; the value itself without a valid resample.
fn middle(mut values: Vec<f64>, value: f64) -> [f64; 2] {
    if values.is_empty() {
        return [value; 2];
    }
    values.sort_by(f64::total_cmp);
    let tail = values.len() / 40;
    [values[tail], values[values.len() - 1 - tail]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_has_no_sensitivity() {
        let group = vec![vec![Ok(3.0)]; 3];
        let five = vec![group.clone(); 5];
        assert_eq!(indices(&rows(&five, 0, 0), &[1; 5]), Some([0.0; 2]));
        assert_eq!(indices(&rows(&[group], 0, 0), &[1]), None);
    }
}
