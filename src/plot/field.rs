//! Values over a grid, from which contour lines are drawn.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{
    Axis,
    contour::{Jump, contour},
};

/// A quantity over the grid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Layer {
    /// Name of its column in files, SI unit included.
    pub column: String,
    /// Values in the unit of the column, row by row: `values[j * x.len() + i]` belongs to x_i, y_j.
    /// `None`: there is no such performance.
    pub values: Vec<Option<f64>>,
    /// Where they jump between grid points; fractions are along the scales of the axes.
    pub jumps: Vec<Jump>,
}

/// Quantities over a grid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Field {
    /// Grid lines along x, SI, ascending.
    pub x: Vec<f64>,
    /// Grid lines along y, SI, ascending.
    pub y: Vec<f64>,
    /// Quantities.
    pub layers: Vec<Layer>,
}

impl Field {
    /// Lines on which a layer has a value, in SI points. Between grid points the value is taken
    /// as linear along the scales of the axes, but for its jumps.
    pub fn level(&self, layer: usize, level: f64, axes: [&Axis; 2]) -> Vec<Vec<[f64; 2]>> {
        let Some(layer) = self.layers.get(layer) else {
            return Vec::new();
        };
        let [x, y] = [(&self.x, axes[0]), (&self.y, axes[1])].map(|(lines, axis)| {
            lines
                .iter()
                .map(|v| axis.scale.forward(*v))
                .collect::<Vec<_>>()
        });
        let values: Vec<f64> = layer.values.iter().map(|v| v.unwrap_or(f64::NAN)).collect();
        let mut lines = contour(&x, &y, &values, &layer.jumps, level);
        for point in lines.iter_mut().flatten() {
            *point = [axes[0].scale.back(point[0]), axes[1].scale.back(point[1])];
        }
        lines
    }

    /// The course of a layer's jumps through the cells of the grid: for each cell that one runs
    /// through its ends, each a point in SI with the greater value there.
    pub fn cliffs(&self, layer: usize, axes: [&Axis; 2]) -> Vec<[([f64; 2], f64); 2]> {
        let Some(layer) = self.layers.get(layer) else {
            return Vec::new();
        };
        let between = |lines: &[f64], axis: &Axis, i: usize, t: f64| {
            let [a, b] = [lines[i], lines[i + 1]].map(|v| axis.scale.forward(v));
            axis.scale.back(a + t * (b - a))
        };
        let mut ends: BTreeMap<[usize; 2], Vec<([f64; 2], f64)>> = BTreeMap::new();
        for jump in &layer.jumps {
            let (i, j, along_x) = jump.side;
            let at = if along_x {
                [between(&self.x, axes[0], i, jump.at), self.y[j]]
            } else {
                [self.x[i], between(&self.y, axes[1], j, jump.at)]
            };
            let end = (at, jump.values[0].max(jump.values[1]));
            // The cells on both sides of the side.
            ends.entry([i, j]).or_default().push(end);
            let other = if along_x {
                j.checked_sub(1).map(|j| [i, j])
            } else {
                i.checked_sub(1).map(|i| [i, j])
            };
            if let Some(other) = other {
                ends.entry(other).or_default().push(end);
            }
        }
        let pair = |ends: Vec<([f64; 2], f64)>| <[_; 2]>::try_from(ends).ok();
        ends.into_values().filter_map(pair).collect()
    }

    /// Value of a layer at a point, linear between grid points along the axes' scales; `None`
    /// outside the grid or beside a grid point without a value.
    pub fn value(&self, layer: usize, at: [f64; 2], axes: [&Axis; 2]) -> Option<f64> {
        let layer = self.layers.get(layer)?;
        let place = |lines: &[f64], axis: &Axis, value: f64| {
            let last = lines.len().checked_sub(2)?;
            let i = lines
                .partition_point(|x| *x <= value)
                .checked_sub(1)?
                .min(last);
            let [low, high, value] = [lines[i], lines[i + 1], value].map(|v| axis.scale.forward(v));
            let t = (value - low) / (high - low);
            (t <= 1.0 + 1e-9).then_some((i, t))
        };
        let (i, s) = place(&self.x, axes[0], at[0])?;
        let (j, t) = place(&self.y, axes[1], at[1])?;
        let corner = |i: usize, j: usize| layer.values[j * self.x.len() + i];
        let low = corner(i, j)? * (1.0 - s) + corner(i + 1, j)? * s;
        let high = corner(i, j + 1)? * (1.0 - s) + corner(i + 1, j + 1)? * s;
        Some(low * (1.0 - t) + high * t)
    }
}
