//! Contour lines by marching squares.
//!
//! In every cell of the grid the line joins the points of its sides where the value, linear along
//! the side, equals the level. In a saddle, where all four sides are crossed, the mean of the
//! corners decides which pair. The pieces of all cells are joined into lines.
//!
//! Where the value jumps on a side, as the least of several functions may, it is linear on either side
//! of the jump, and every level between runs through it.

use std::collections::HashMap;

use serde::Serialize;

/// Side of a cell: from a grid point i, j along x, or along y.
pub type Side = (usize, usize, bool);

/// Where the value over a grid jumps on a side of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Jump {
    /// The side.
    pub side: Side,
    /// Where on it, as a fraction of its length.
    pub at: f64,
    /// Values before and after it.
    pub values: [f64; 2],
}

impl Jump {
    /// Where on the side, as a fraction of its length, the value passes a level that lies between
    /// those at its ends.
    fn crossing(&self, ends: [f64; 2], level: f64) -> f64 {
        let [before, after] = self.values;
        let between = |a: f64, b: f64| (a >= level) != (b >= level);
        if between(ends[0], before) {
            self.at * (level - ends[0]) / (before - ends[0])
        } else if between(before, after) {
            self.at
        } else {
            self.at + (1.0 - self.at) * (level - after) / (ends[1] - after)
        }
    }
}

/// Lines on which the values over a grid equal `level`. `values[j * x.len() + i]` belongs to x_i,
/// y_j; cells with a value that is not finite are left out. A closed line ends where it begins.
///
/// ```
/// use bogie::plot::contour::contour;
///
/// let lines = contour(&[0.0, 1.0], &[0.0, 1.0], &[0.0, 1.0, 0.0, 1.0], &[], 0.25);
/// assert_eq!(lines, [[[0.25, 0.0], [0.25, 1.0]]]);
/// ```
pub fn contour(
    x: &[f64],
    y: &[f64],
    values: &[f64],
    jumps: &[Jump],
    level: f64,
) -> Vec<Vec<[f64; 2]>> {
    let n = x.len();
    let value = |i: usize, j: usize| values[j * n + i];
    let mut pieces: Vec<[Side; 2]> = Vec::new();
    for j in 1..y.len() {
        for i in 1..n {
            let corners = [
                value(i - 1, j - 1),
                value(i, j - 1),
                value(i, j),
                value(i - 1, j),
            ];
            if corners.iter().all(|v| v.is_finite()) {
                cell(i - 1, j - 1, corners, level, &mut pieces);
            }
        }
    }
    let jumps: HashMap<Side, &Jump> = jumps.iter().map(|jump| (jump.side, jump)).collect();
    let crossing = |side: Side| {
        let (i, j, along_x) = side;
        let (p, q) = if along_x { (i + 1, j) } else { (i, j + 1) };
        let ends = [value(i, j), value(p, q)];
        let t = match jumps.get(&side) {
            Some(jump) => jump.crossing(ends, level),
            None => (level - ends[0]) / (ends[1] - ends[0]),
        };
        [x[i] + t * (x[p] - x[i]), y[j] + t * (y[q] - y[j])]
    };
    join(&pieces)
        .into_iter()
        .map(|sides| sides.into_iter().map(crossing).collect())
        .collect()
}

/// Pieces of the line in one cell. Corners counter-clockwise from the lower left.
fn cell(i: usize, j: usize, corners: [f64; 4], level: f64, pieces: &mut Vec<[Side; 2]>) {
    let sides: [Side; 4] = [
        (i, j, true),
        (i + 1, j, false),
        (i, j + 1, true),
        (i, j, false),
    ];
    let above = corners.map(|v| v >= level);
    let crossed: Vec<usize> = (0..4).filter(|k| above[*k] != above[(k + 1) % 4]).collect();
    match crossed[..] {
        [a, b] => pieces.push([sides[a], sides[b]]),
        [_, _, _, _] => {
            let middle_above = corners.iter().sum::<f64>() / 4.0 >= level;
            // Cut off the two corners that are not on the side of the middle.
            for k in 0..4 {
                if above[k] != middle_above {
                    pieces.push([sides[(k + 3) % 4], sides[k]]);
                }
            }
        }
        _ => {}
    }
}

/// Joins pieces that share a side into lines, open ones first, in the order of the pieces.
fn join(pieces: &[[Side; 2]]) -> Vec<Vec<Side>> {
    let mut at: HashMap<Side, Vec<usize>> = HashMap::new();
    for (k, piece) in pieces.iter().enumerate() {
        for side in piece {
            at.entry(*side).or_default().push(k);
        }
    }
    let mut used = vec![false; pieces.len()];
    let mut lines = Vec::new();
    for closed in [false, true] {
        for (k, piece) in pieces.iter().enumerate() {
            let end = piece.iter().find(|side| at[*side].len() == 1);
            let start = if closed { Some(&piece[0]) } else { end };
            if let Some(start) = start.filter(|_| !used[k]) {
                lines.push(follow(pieces, &at, &mut used, k, *start));
            }
        }
    }
    lines
}

/// The line through piece `k` from one of its sides on, as far as unused pieces go.
fn follow(
    pieces: &[[Side; 2]],
    at: &HashMap<Side, Vec<usize>>,
    used: &mut [bool],
    mut k: usize,
    from: Side,
) -> Vec<Side> {
    let mut line = vec![from];
    let mut end = from;
    loop {
        used[k] = true;
        let [a, b] = pieces[k];
        end = if a == end { b } else { a };
        line.push(end);
        match at[&end].iter().find(|next| !used[**next]) {
            Some(next) => k = *next,
            None => return line,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(n: usize, f: impl Fn(f64, f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        let lines: Vec<f64> = (0..n)
            .map(|i| -1.0 + 2.0 * i as f64 / (n - 1) as f64)
            .collect();
        let values = lines
            .iter()
            .flat_map(|y| lines.iter().map(|x| f(*x, *y)).collect::<Vec<_>>())
            .collect();
        (lines, values)
    }

    /// The contour of x² + y² at r² is one closed circle; linear interpolation of the square over a
    /// cell of size h is off by at most h²/8 · f″ = h²/4, so the radius by h²/(8r).
    #[test]
    fn a_circle() {
        for (n, r) in [(21, 0.7), (41, 0.5), (61, 0.9)] {
            let (lines, values) = grid(n, |x, y| x * x + y * y);
            let found = contour(&lines, &lines, &values, &[], r * r);
            assert_eq!(found.len(), 1, "{n}");
            let circle = &found[0];
            assert_eq!(circle.first(), circle.last());
            let h = 2.0 / (n - 1) as f64;
            for [x, y] in circle {
                assert!(
                    (x.hypot(*y) - r).abs() <= h * h / (8.0 * r) * 1.1,
                    "{n}: {x} {y}"
                );
            }
            let length: f64 = circle
                .windows(2)
                .map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]))
                .sum();
            assert!((length / (std::f64::consts::TAU * r) - 1.0).abs() < 0.01);
        }
    }

    /// xy = c has two branches on either side of the saddle, which never cross.
    #[test]
    fn a_saddle() {
        let (lines, values) = grid(20, |x, y| x * y);
        for level in [-0.001, 0.001, 0.2] {
            let found = contour(&lines, &lines, &values, &[], level);
            assert_eq!(found.len(), 2, "{level}");
            for line in &found {
                let left = line[0][0] < 0.0;
                assert!(line.iter().all(|p| (p[0] < 0.0) == left), "{level}");
            }
        }
    }

    /// A cliff across the grid: every level between its foot and its edge runs along it, exactly
    /// where it was found; levels above and below do not.
    #[test]
    fn a_cliff() {
        let place = |y: f64| 0.1 + 0.2 * y;
        let value = |x: f64, y: f64| if x < place(y) { x } else { 10.0 + x };
        let (lines, values) = grid(11, value);
        let jumps: Vec<Jump> = (0..11)
            .map(|j| {
                let at = place(lines[j]);
                let i = lines.partition_point(|x| *x < at) - 1;
                Jump {
                    side: (i, j, true),
                    at: (at - lines[i]) / (lines[i + 1] - lines[i]),
                    values: [at, 10.0 + at],
                }
            })
            .collect();
        for level in [2.0, 5.0, 9.0] {
            let found = contour(&lines, &lines, &values, &jumps, level);
            let along_x = found.iter().flatten().filter(|p| lines.contains(&p[1]));
            assert!(along_x.clone().count() >= 11);
            for [x, y] in along_x {
                assert!((x - place(*y)).abs() < 1e-12, "{level}: {x} {y}");
            }
        }
        let found = contour(&lines, &lines, &values, &jumps, 10.7);
        assert!(found.iter().flatten().all(|p| (p[0] - 0.7).abs() < 1e-12));
    }

    #[test]
    fn cells_without_a_value_are_left_out() {
        let (lines, mut values) = grid(11, |x, _| x);
        values[5 * 11 + 6] = f64::NAN;
        let found = contour(&lines, &lines, &values, &[], 0.1);
        // The hole splits the straight line in two.
        assert_eq!(found.len(), 2);
        assert!(found.iter().flatten().all(|p| (p[0] - 0.1).abs() < 1e-12));
        assert!(contour(&lines, &lines, &values, &[], 3.0).is_empty());
    }
}
