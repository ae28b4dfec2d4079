//! Lines of straight pieces, in pixels: what of them is in a frame, and parts by length.

use super::{Frame, Panel};

/// The parts of a line that lie in the frame, in pixels.
pub(super) fn visible(panel: &Panel, frame: &Frame, piece: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open = false;
    for pair in piece.windows(2) {
        let [p, q] = [pair[0], pair[1]].map(|point| frame.point(panel, point));
        let Some(([a, b], whole)) = clip(frame, p, q) else {
            open = false;
            continue;
        };
        match parts.last_mut().filter(|_| open) {
            Some(part) => part.push(b),
            None => parts.push(vec![a, b]),
        }
        open = whole;
    }
    parts
}

/// The part of a straight line that lies in the frame, and whether it goes on to q (Liang and
/// Barsky).
fn clip(frame: &Frame, p: [f64; 2], q: [f64; 2]) -> Option<([[f64; 2]; 2], bool)> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    let low = [frame.x, frame.y];
    let high = [frame.x + frame.width, frame.y + frame.height];
    for k in 0..2 {
        let d = q[k] - p[k];
        if !d.is_finite() {
            return None;
        }
        if d == 0.0 {
            if p[k] < low[k] || p[k] > high[k] {
                return None;
            }
        } else {
            let (a, b) = ((low[k] - p[k]) / d, (high[k] - p[k]) / d);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
    }
    let at = |t: f64| [0, 1].map(|k| p[k] + t * (q[k] - p[k]));
    let end = if to >= 1.0 { q } else { at(to) };
    (from <= to).then(|| ([at(from), end], to >= 1.0))
}

/// Length of a line.
pub(super) fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(|w| distance(w[0], w[1])).sum()
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (q[0] - p[0]).hypot(q[1] - p[1])
}

/// The part of a line between two lengths along it; never empty.
pub(super) fn between(line: &[[f64; 2]], from: f64, to: f64) -> Vec<[f64; 2]> {
    let mut part = Vec::new();
    let mut along = 0.0;
    for w in line.windows(2) {
        let step = distance(w[0], w[1]);
        if step == 0.0 {
            continue;
        }
        let at = |s: f64| {
            let t = (s - along) / step;
            [0, 1].map(|k| w[0][k] + t * (w[1][k] - w[0][k]))
        };
        if part.is_empty() && along + step >= from {
            part.push(at(from));
        }
        if !part.is_empty() {
            if along + step >= to {
                part.push(at(to));
                return part;
            }
            part.push(w[1]);
        }
        along += step;
    }
    if part.is_empty() {
        part.extend(line.last());
    }
    part
}
