//! Curves sampled where they bend, and broken where they jump.

use super::workbook::Workbook;
use crate::plot::Scale;

/// Points to begin with.
const FIRST: usize = 33;
/// How often an interval may be halved: to less than a pixel of a chart.
const HALVINGS: u32 = 6;
/// How far a point may lie off the straight way between its neighbours, over the extent of the
/// curve: half the width of its line.
const BEND: f64 = 2e-3;
/// A change across the smallest interval is a jump if it is larger than this, over the extent
/// of the curve.
const JUMP: f64 = 2e-2;

/// Points of a curve over a range. Where there is no value, and in the middle of a jump, a point is
/// not a number: the curve is interrupted there.
pub(super) fn sample(
    book: &Workbook,
    scale: Scale,
    range: [f64; 2],
    compute: impl Fn(f64) -> Option<f64> + Sync,
) -> Vec<[f64; 2]> {
    let values = |x: &[f64]| book.each(x, |x| compute(*x).unwrap_or(f64::NAN));
    let x = scale.spread(range, FIRST);
    let y = values(&x);
    let mut points: Vec<[f64; 2]> = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
    let smallest = smallest(scale, range);
    for _ in 0..HALVINGS {
        let extent = extent(&points);
        let middles: Vec<f64> = points
            .windows(2)
            .enumerate()
            .filter(|(i, _)| coarse(scale, &points, *i, extent))
            .map(|(_, w)| {
                scale.back(f64::midpoint(
                    scale.forward(w[0][0]),
                    scale.forward(w[1][0]),
                ))
            })
            .collect();
        if middles.is_empty() {
            break;
        }
        let new = values(&middles);
        points.extend(middles.into_iter().zip(new).map(|(x, y)| [x, y]));
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    broken(scale, points, smallest)
}

/// Length of the smallest interval, on the scale.
fn smallest(scale: Scale, range: [f64; 2]) -> f64 {
    let [low, high] = range.map(|x| scale.forward(x));
    (high - low) / (FIRST - 1) as f64 / f64::from(1_u32 << HALVINGS)
}

/// The largest value: charts of positive values begin at zero.
fn extent(points: &[[f64; 2]]) -> f64 {
    points.iter().map(|p| p[1].abs()).fold(0.0, f64::max)
}

/// Whether the interval after point `i` is too long: an end of the curve is in it, or the curve
/// bends at one of its ends.
fn coarse(scale: Scale, points: &[[f64; 2]], i: usize, extent: f64) -> bool {
    let [here, next] = [points[i], points[i + 1]];
    if here[1].is_finite() != next[1].is_finite() {
        return true;
    }
    let bends = |k: usize| {
        let Some([a, b, c]) = points.get(k.wrapping_sub(1)..k + 2) else {
            return false;
        };
        let [from, at, to] = [a, b, c].map(|p| scale.forward(p[0]));
        let straight = a[1] + (at - from) / (to - from) * (c[1] - a[1]);
        (b[1] - straight).abs() > BEND * extent
    };
    bends(i) || bends(i + 1)
}

/// The points with a gap in every jump.
fn broken(scale: Scale, points: Vec<[f64; 2]>, smallest: f64) -> Vec<[f64; 2]> {
    let jump = JUMP * extent(&points);
    let mut whole: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for point in points {
        if let Some(last) = whole.last() {
            let length = scale.forward(point[0]) - scale.forward(last[0]);
            if length < 1.5 * smallest && (point[1] - last[1]).abs() > jump {
                whole.push([f64::midpoint(last[0], point[0]), f64::NAN]);
            }
        }
        whole.push(point);
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        plot::{Curve, System},
        spec::{STARTER, Spec},
    };

    /// A parabola that jumps at 2 and ends at 3: two pieces, each to within a smallest interval of
    /// its end, and nowhere farther from the curve than what is asked.
    #[test]
    fn jumps_and_ends_are_found() {
        let spec = Spec::parse(STARTER).unwrap_or_else(|_| panic!("the starter spec"));
        let book = Workbook::new(&spec, "starter", System::Us, &());
        let value = |x: f64| if x < 2.0 { x * x } else { 10.0 };
        let points = sample(&book, Scale::Linear, [0.0, 4.0], |x| {
            (x <= 3.0).then(|| value(x))
        });
        let curve = Curve::line("", points);
        let [rising, flat] = &curve.pieces[..] else {
            panic!("{} pieces", curve.pieces.len())
        };
        let close = 1.01 * smallest(Scale::Linear, [0.0, 4.0]);
        let ends = [
            rising[0],
            rising[rising.len() - 1],
            flat[0],
            flat[flat.len() - 1],
        ];
        for (end, expected) in ends.iter().zip([0.0, 2.0, 2.0, 3.0]) {
            assert!((end[0] - expected).abs() <= close, "{end:?} {expected}");
        }
        for w in rising.windows(2) {
            let middle = f64::midpoint(w[0][0], w[1][0]);
            let off = (f64::midpoint(w[0][1], w[1][1]) - value(middle)).abs();
            assert!(off < BEND * 10.0, "{middle}: {off}");
        }
        assert!(curve.points().count() < 80);
    }
}
