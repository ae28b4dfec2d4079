//! Critical speed and degree curve over the primary stiffnesses, which several charts share.

use super::{
    performance::{critical_speed, degree_curve},
    workbook::{CONICITIES, Workbook},
};
use crate::{
    case::Case,
    parameter::Parameter,
    plot::{
        Axis, Field, Layer,
        contour::{Jump, Side},
    },
    units::us,
};

/// Change along the side of a cell below which no jump is looked for, over the value.
const STEEP: f64 = 0.02;
/// Nor without being so many times the change along a side before or behind it.
const STEEPER: f64 = 1.6;
/// How often the side is halved: to less than a pixel of a chart.
const HALVINGS: usize = 6;

/// Change between two positive values, over them.
fn change(a: f64, b: f64) -> f64 {
    (b / a).ln().abs()
}

/// Critical speed; the end of the range searched where the vehicle is stable over all of it.
fn speed(case: &Case) -> Option<f64> {
    Some(
        critical_speed(case)
            .ok()?
            .unwrap_or(case.model.speed_range[1]),
    )
}

/// How much the logarithm of a value bends at each interval between grid lines: the largest second
/// difference at its ends, along any of the `lines` of indices across them. What jumps bends no
/// more than what is steep: jumps are found otherwise.
fn bends(values: &[Option<f64>], lines: &[Vec<usize>]) -> Vec<f64> {
    const MOST: f64 = 0.1;
    let count = lines.first().map_or(0, Vec::len);
    let at = |line: &[usize], k: usize| values[line[k]].map_or(f64::NAN, f64::ln);
    let bend = |k: usize| {
        let second = |line: &Vec<usize>| {
            (at(line, k - 1) - 2.0 * at(line, k) + at(line, k + 1))
                .abs()
                .min(MOST)
        };
        lines.iter().map(second).fold(0.0, f64::max)
    };
    let bends: Vec<f64> = (0..count)
        .map(|k| {
            if k == 0 || k + 1 >= count {
                0.0
            } else {
                bend(k)
            }
        })
        .collect();
    bends.windows(2).map(|w| w[0].max(w[1])).collect()
}

/// As many grid lines as wanted: every interval between the given ones in parts, the more the
/// more the value bends there.
fn denser(lines: &[f64], bends: &[f64], wanted: usize) -> Vec<f64> {
    let mut parts = vec![1_u32; bends.len()];
    // A second difference falls with the square of the step.
    let error = |k: usize, parts: u32| (bends[k] + 1e-3) / f64::from(parts * parts);
    for _ in lines.len()..wanted {
        let worst = (0..parts.len()).reduce(|a, b| {
            if error(b, parts[b]) > error(a, parts[a]) {
                b
            } else {
                a
            }
        });
        if let Some(worst) = worst {
            parts[worst] += 1;
        }
    }
    let mut all: Vec<f64> = Vec::with_capacity(wanted);
    for (w, parts) in lines.windows(2).zip(parts) {
        all.extend((0..parts).map(|k| {
            let t = f64::from(k) / f64::from(parts);
            if k == 0 {
                w[0]
            } else {
                w[0] * (w[1] / w[0]).powf(t)
            }
        }));
    }
    all.extend(lines.last());
    all
}

impl Workbook<'_> {
    /// Axes of the primary bending and lateral stiffness, over the range of the report's charts.
    pub fn stiffness_axes(&self) -> [Axis; 2] {
        let bending = [1e5 * us::LBF * us::FOOT, 2e7 * us::LBF * us::FOOT];
        let lateral = [2e4 * us::LBF / us::FOOT, 5e6 * us::LBF / us::FOOT];
        [
            self.parameter_axis(Parameter::PRIMARY_BENDING_STIFFNESS, bending),
            self.parameter_axis(Parameter::PRIMARY_LATERAL_STIFFNESS, lateral),
        ]
    }

    /// The case at a point of K_b and K_py, at one of [`CONICITIES`].
    fn at(&self, conicity: usize, [k_b, k_py]: [f64; 2]) -> Case {
        self.with(&[
            (Parameter::CONICITY, CONICITIES[conicity]),
            (Parameter::PRIMARY_BENDING_STIFFNESS, k_b),
            (Parameter::PRIMARY_LATERAL_STIFFNESS, k_py),
        ])
    }

    /// Something over K_b and K_py at one of [`CONICITIES`], as a layer of a field.
    fn layer(
        &self,
        conicity: usize,
        column: &str,
        compute: impl Fn(&Case) -> Option<f64> + Sync,
    ) -> Layer {
        let values = self.over(conicity, self.stiffness_grid(conicity), compute);
        Layer {
            column: column.into(),
            values,
            jumps: Vec::new(),
        }
    }

    /// Values over grid lines, row by row.
    fn over(
        &self,
        conicity: usize,
        [x, y]: &[Vec<f64>; 2],
        compute: impl Fn(&Case) -> Option<f64> + Sync,
    ) -> Vec<Option<f64>> {
        let points: Vec<[f64; 2]> = y
            .iter()
            .flat_map(|k_py| x.iter().map(|k_b| [*k_b, *k_py]))
            .collect();
        self.each(&points, |point| compute(&self.at(conicity, *point)))
    }

    /// The jumps of a layer, found by halving the sides of cells over which it changes much.
    fn jumps(
        &self,
        conicity: usize,
        layer: &Layer,
        compute: impl Fn(&Case) -> Option<f64> + Sync,
    ) -> Vec<Jump> {
        let [x, y] = self.stiffness_grid(conicity);
        let value = |i: usize, j: usize| {
            let row = layer.values.get(j * x.len()..(j + 1) * x.len())?;
            row.get(i).copied().flatten()
        };
        // Change along a side, from i, j on; its neighbours in its direction tell how steep it is
        // there without a jump.
        let along = |i: usize, j: usize, along_x: bool| {
            let (p, q) = if along_x { (i + 1, j) } else { (i, j + 1) };
            Some([value(i, j)?, value(p, q)?])
        };
        let mut sides: Vec<(Side, [f64; 2])> = Vec::new();
        for j in 0..y.len() {
            for i in 0..x.len() {
                for along_x in [true, false] {
                    let Some(ends) = along(i, j, along_x) else {
                        continue;
                    };
                    let (dx, dy) = if along_x { (1, 0) } else { (0, 1) };
                    let before = i.checked_sub(dx).zip(j.checked_sub(dy));
                    let neighbours = [before, Some((i + dx, j + dy))];
                    let steepness = neighbours
                        .into_iter()
                        .flatten()
                        .filter_map(|(i, j)| along(i, j, along_x))
                        .map(|[a, b]| change(a, b))
                        .reduce(f64::min)
                        .unwrap_or(0.0);
                    let here = change(ends[0], ends[1]);
                    if here > STEEP && here > STEEPER * steepness {
                        sides.push(((i, j, along_x), ends));
                    }
                }
            }
        }
        let found = self.each(&sides, |&((i, j, along_x), ends)| {
            let place = |t: f64| {
                let between = |a: f64, b: f64| a * (b / a).powf(t);
                if along_x {
                    [between(x[i], x[i + 1]), y[j]]
                } else {
                    [x[i], between(y[j], y[j + 1])]
                }
            };
            let ([mut from, mut to], mut values) = ([0.0, 1.0], ends);
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(from, to);
                let here = compute(&self.at(conicity, place(middle)))?;
                if change(values[0], here) > change(here, values[1]) {
                    (to, values[1]) = (middle, here);
                } else {
                    (from, values[0]) = (middle, here);
                }
                // Steep, but no jump.
                if change(values[0], values[1]) < 0.5 * change(ends[0], ends[1]) {
                    return None;
                }
            }
            Some(Jump {
                side: (i, j, along_x),
                at: f64::midpoint(from, to),
                values,
            })
        });
        found.into_iter().flatten().collect()
    }

    /// Grid lines of the fields at one of [`CONICITIES`], denser where the critical speed bends:
    /// half of them, evenly spread, show where the other half belongs.
    fn stiffness_grid(&self, conicity: usize) -> &[Vec<f64>; 2] {
        self.grids[conicity].get_or_init(|| {
            let axes = self.stiffness_axes();
            let even = [0, 1].map(|k| {
                let axis: &Axis = &axes[k];
                axis.scale.spread(axis.range, self.grid / 2 + 1)
            });
            let values = self.over(conicity, &even, speed);
            let n = even[0].len();
            let column = |i: usize| (0..even[1].len()).map(move |j| j * n + i).collect();
            let row = |j: usize| (0..n).map(|i| j * n + i).collect();
            let columns: Vec<Vec<usize>> = (0..even[1].len()).map(row).collect();
            let rows: Vec<Vec<usize>> = (0..n).map(column).collect();
            [
                denser(&even[0], &bends(&values, &columns), self.grid),
                denser(&even[1], &bends(&values, &rows), self.grid),
            ]
        })
    }

    /// Degree curve over K_b and K_py, at one of [`CONICITIES`].
    pub fn curving(&self, conicity: usize) -> Field {
        let [x, y] = self.stiffness_grid(conicity).clone();
        let degrees = self.degrees[conicity]
            .get_or_init(|| self.layer(conicity, "degree_curve_deg", degree_curve));
        Field {
            x,
            y,
            layers: vec![degrees.clone()],
        }
    }

    /// Degree curve (layer 0) and critical speed (layer 1) over K_b and K_py, at one of
    /// [`CONICITIES`].
    pub fn stability_curving(&self, conicity: usize) -> Field {
        let mut field = self.curving(conicity);
        let speeds = self.speeds[conicity].get_or_init(|| {
            let mut layer = self.layer(conicity, "critical_speed_m_per_s", speed);
            layer.jumps = self.jumps(conicity, &layer, speed);
            layer
        });
        field.layers.push(speeds.clone());
        field
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines gather where the value bends, none is lost, the ends stay.
    #[test]
    fn grid_lines_follow_the_bends() {
        let lines: Vec<f64> = (0..=10).map(|k| 10_f64.powf(0.1 * f64::from(k))).collect();
        let values: Vec<Option<f64>> = lines
            .iter()
            .map(|x| Some(1.0 + 20.0 * (x - 5.0).clamp(0.0, 1.0)))
            .collect();
        let index: Vec<usize> = (0..lines.len()).collect();
        let all = denser(&lines, &bends(&values, &[index]), 21);
        assert_eq!(all.len(), 21);
        assert!(all.is_sorted_by(|a, b| a < b));
        assert!(lines.iter().all(|line| all.contains(line)));
        let between = |from: f64, to: f64| all.iter().filter(|x| (from..to).contains(*x)).count();
        assert!(between(3.9, 8.0) > 8, "{all:?}");
        assert!(between(1.0, 3.0) < 7, "{all:?}");
    }
}
