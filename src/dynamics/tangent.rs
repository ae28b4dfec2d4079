//! Derivatives of a model's equations by a number of the case.

use nalgebra::{Complex, DVector};

use super::{ForcedModel, Output, Row};
use crate::numerics::LinearSystem;

/// Derivative of the matrices of a linear system: what is not zero in them.
#[derive(Debug, Clone)]
pub struct SystemTangent {
    /// Entries over [q, u].
    pub entries: Vec<TangentEntry>,
}

/// Derivative of one entry of K, of C0, C1, C2, and of M.
#[derive(Debug, Clone, Copy)]
pub struct TangentEntry {
    /// Row, a coordinate.
    pub row: usize,
    /// Column, over [q, u].
    pub column: usize,
    /// Of K.
    pub k: f64,
    /// Of C0, C1, C2.
    pub c: [f64; 3],
    /// Of M.
    pub m: f64,
}

impl TangentEntry {
    /// Of C at speed V, m/s.
    pub fn damping_at(&self, v: f64) -> f64 {
        self.c[0] + self.c[1] / v + self.c[2] * v
    }
}

/// Derivative of a forced model.
#[derive(Debug, Clone)]
pub struct ForcedTangent {
    /// Of its equations of motion.
    pub system: SystemTangent,
    /// Of its outputs; `None` for those that stay as they are.
    pub outputs: Vec<Option<Output>>,
    /// Of the distance of each wheelset behind the first, m.
    pub lags: [f64; 4],
    /// Of the scale of each excitation, over the scale.
    pub scales: Vec<f64>,
}

/// Sums of this share of their terms are rounding.
const ROUNDING: f64 = 1e-11;

/// Weighted sum of values, which is zero where all are the same, and where it is rounding.
fn sum(terms: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let mut values = terms.clone().map(|(_, value)| value.to_bits());
    let first = values.next();
    if values.all(|value| Some(value) == first) {
        return 0.0;
    }
    let (mut sum, mut size) = (0.0, 0.0_f64);
    for (weight, value) in terms {
        sum += weight * value;
        size = size.max((weight * value).abs());
    }
    if sum.abs() > ROUNDING * size {
        sum
    } else {
        0.0
    }
}

impl SystemTangent {
    /// Weighted sum of systems of one structure, with weights that add up to zero.
    pub fn of(systems: &[(f64, &LinearSystem)]) -> Self {
        let rows = systems[0].1.stiffness.nrows();
        let matrices: [Vec<(f64, &[f64])>; 4] = std::array::from_fn(|n| {
            let weighted = systems.iter().map(|&(weight, system)| {
                let [c0, c1, c2] = &system.damping;
                let matrix = [&system.stiffness, c0, c1, c2][n];
                (weight, matrix.as_slice())
            });
            weighted.collect()
        });
        let masses = |i: usize| sum(systems.iter().map(move |(w, system)| (*w, system.mass[i])));
        let mut entries = Vec::new();
        for at in 0..systems[0].1.stiffness.len() {
            let [k, c0, c1, c2] = matrices
                .each_ref()
                .map(|matrix| sum(matrix.iter().map(|(w, values)| (*w, values[at]))));
            let (row, column) = (at % rows, at / rows);
            let m = if row == column { masses(row) } else { 0.0 };
            if [k, c0, c1, c2, m].iter().any(|change| *change != 0.0) {
                entries.push(TangentEntry {
                    row,
                    column,
                    k,
                    c: [c0, c1, c2],
                    m,
                });
            }
        }
        Self { entries }
    }

    /// wᴴ (∂K + s ∂C(V) + s² ∂M) x over the coordinates.
    pub fn between(
        &self,
        left: &DVector<Complex<f64>>,
        s: Complex<f64>,
        v: f64,
        right: &DVector<Complex<f64>>,
    ) -> Complex<f64> {
        let n = right.len();
        let of_coordinates = self.entries.iter().filter(|entry| entry.column < n);
        of_coordinates
            .map(|entry| {
                let d = s * (entry.damping_at(v) + s * entry.m) + entry.k;
                left[entry.row].conj() * d * right[entry.column]
            })
            .sum()
    }
}

impl ForcedTangent {
    /// Weighted sum of models, with weights that add up to zero; `None` if they do not have the same number of
    /// coordinates.
    pub fn of(models: &[(f64, &ForcedModel)]) -> Option<Self> {
        let order = models[0].1.system.order();
        if models
            .iter()
            .any(|(_, model)| model.system.order() != order)
        {
            return None;
        }
        let systems: Vec<(f64, &LinearSystem)> = models
            .iter()
            .map(|(w, model)| (*w, &model.system))
            .collect();
        let columns = systems[0].1.stiffness.ncols();
        let row = |of: &dyn Fn(&ForcedModel) -> Row| {
            let dense: Vec<(f64, Vec<f64>)> = models
                .iter()
                .map(|(w, model)| {
                    let mut dense = vec![0.0; columns];
                    for &(i, c) in of(model).terms() {
                        dense[i] += c;
                    }
                    (*w, dense)
                })
                .collect();
            let terms = (0..columns).map(|i| (i, sum(dense.iter().map(|(w, row)| (*w, row[i])))));
            terms
                .filter(|(_, c)| *c != 0.0)
                .fold(Row::default(), |row, (i, c)| row + c * Row::unit(i))
        };
        let outputs = (0..models[0].1.outputs.len()).map(|k| {
            let first = &models[0].1.outputs[k];
            if models.iter().all(|(_, model)| model.outputs[k] == *first) {
                return None;
            }
            let output = Output {
                displacement: row(&|model| model.outputs[k].displacement.clone()),
                velocity: row(&|model| model.outputs[k].velocity.clone()),
                acceleration: row(&|model| model.outputs[k].acceleration.clone()),
            };
            let rows = [&output.displacement, &output.velocity, &output.acceleration];
            let changes = rows.iter().any(|row| !row.terms().is_empty());
            changes.then_some(output)
        });
        let first = models[0].1;
        let scale = |k: usize| {
            let change = sum(models
                .iter()
                .map(|(w, model)| (*w, model.excitations[k].scale)));
            change / first.excitations[k].scale
        };
        Some(Self {
            outputs: outputs.collect(),
            system: SystemTangent::of(&systems),
            lags: std::array::from_fn(|i| sum(models.iter().map(|(w, model)| (*w, model.lags[i])))),
            scales: (0..first.excitations.len()).map(scale).collect(),
        })
    }
}
