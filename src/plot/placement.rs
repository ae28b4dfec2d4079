//! Places for the labels of curves, limits and points, so that none covers another.
//!
//! A label on a curve lies along it where the curve is straight and few others cross. A label at
//! a point stands beside it. Every place is judged in pixels; the best of all is taken, one label
//! after the other. What finds no place is handed back for the legend.

use super::{
    Family, Frame, Ink, Labels, Mark, Panel, PlacedLabel,
    layout::{half_height, size},
    legend::Look,
    obstacle::Obstacles,
    polyline::{between, length},
    text,
};

/// A candidate with its cost.
type Candidate = (f64, PlacedLabel);

/// Labels with a place, and those without, with the look of their lines.
pub(super) fn place(
    index: usize,
    panel: &Panel,
    frame: &Frame,
    obstacles: &Obstacles,
) -> (Vec<PlacedLabel>, Vec<(String, Look)>) {
    let mut placing = Placing {
        index,
        frame,
        obstacles,
        placed: Vec::new(),
    };
    let mut missing = Vec::new();
    for (mark, point) in panel.marks.iter().zip(&obstacles.points) {
        if !mark.label.is_empty() && !placing.beside(mark, point.centre) {
            missing.push((mark.label.clone(), Look::Symbol(mark.symbol, mark.ink)));
        }
    }
    let count = panel.families.iter().map(|f| f.curves.len()).sum::<usize>();
    for (i, limit) in panel.limits.iter().enumerate() {
        if !placing.along(&limit.label, Ink::Vermilion, count + i, 0.85) {
            missing.push((limit.label.clone(), Look::Hatched));
        }
    }
    let mut number = 0;
    for family in &panel.families {
        for (k, curve) in family.curves.iter().enumerate() {
            let own = number;
            number += 1;
            if curve.label.is_empty() || family.labels != Labels::Inline {
                continue;
            }
            let stroke = family.stroke_of(curve);
            let visible = obstacles.lines.iter().any(|(n, _)| *n == own);
            let at = preferred(family, k);
            // In the legend a line tells nothing that looks like the others of its family.
            let placed = !visible || placing.along(&curve.label, stroke.ink, own, at);
            if !placed && curve.stroke.is_some() {
                missing.push((curve.label.clone(), Look::Line(stroke, curve.dots)));
            }
        }
    }
    (placing.placed, missing)
}

/// Where along a curve its label is best: in the middle, of neighbours a little apart.
fn preferred(family: &Family, k: usize) -> f64 {
    match family.curves.len() {
        1 => 0.6,
        _ => 0.5 + 0.1 * (k % 3) as f64,
    }
}

struct Placing<'a> {
    index: usize,
    frame: &'a Frame,
    obstacles: &'a Obstacles,
    placed: Vec<PlacedLabel>,
}

/// Directions in which a label may stand beside a point, best first.
const AROUND: [(f64, f64); 8] = [
    (1.0, 0.0),
    (-1.0, 0.0),
    (0.0, -1.0),
    (0.0, 1.0),
    (1.0, -1.0),
    (1.0, 1.0),
    (-1.0, -1.0),
    (-1.0, 1.0),
];
/// Step along a curve between places that are tried.
const STEP: f64 = 5.0;
/// Text on steeper lines is read from below, degrees.
const STEEPEST: f64 = 78.0;
/// How far a curve may bend away from its label.
const BEND: f64 = 4.0;
/// A further part of a curve gets a label too if it is this long.
const LONG: f64 = 120.0;

impl Placing<'_> {
    fn label(&self, text: &str, centre: [f64; 2], angle: f64, ink: Ink) -> PlacedLabel {
        PlacedLabel {
            panel: self.index,
            text: text.into(),
            centre,
            size: [
                text::width(text, size::LABEL) + 6.0,
                2.0 * half_height(size::LABEL),
            ],
            angle,
            ink,
        }
    }

    /// Cost of a place for a label; `None`: not possible.
    fn cost(&self, label: &PlacedLabel, own: usize) -> Option<f64> {
        let inside = label.corners().iter().all(|p| self.frame.holds(*p, 2.0));
        let free = |other: &PlacedLabel| !label.overlaps(other);
        (inside && self.placed.iter().all(free) && self.obstacles.points.iter().all(free))
            .then(|| 7.0 * self.obstacles.crossings(label, own) as f64)
    }

    fn take(&mut self, candidates: Vec<Candidate>) -> bool {
        let best = candidates
            .into_iter()
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, label)| label);
        let found = best.is_some();
        self.placed.extend(best);
        found
    }

    /// Places a label beside a point.
    fn beside(&mut self, mark: &Mark, point: [f64; 2]) -> bool {
        let size = self.label(&mark.label, point, 0.0, mark.ink).size;
        let clear = mark.symbol.extent() / 2.0 + 1e-6;
        let mut candidates = Vec::new();
        for distance in [0.0, 8.0, 18.0, 30.0] {
            let away = [
                size[0] / 2.0 + clear + distance,
                size[1] / 2.0 + clear + distance,
            ];
            for (preference, (x, y)) in AROUND.into_iter().enumerate() {
                let centre = [point[0] + x * away[0], point[1] + y * away[1]];
                let label = self.label(&mark.label, centre, 0.0, mark.ink);
                if let Some(cost) = self.cost(&label, usize::MAX) {
                    candidates.push((cost + 0.5 * preference as f64 + 0.6 * distance, label));
                }
            }
        }
        self.take(candidates)
    }

    /// Places a label along the longest part of a line, and along further long ones; failing that
    /// beside its end.
    fn along(&mut self, text: &str, ink: Ink, own: usize, at: f64) -> bool {
        let mut parts: Vec<(f64, &Vec<[f64; 2]>)> = self
            .obstacles
            .lines
            .iter()
            .filter(|(number, _)| *number == own)
            .map(|(_, line)| (length(line), line))
            .collect();
        parts.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut found = false;
        for (rank, (length, line)) in parts.iter().enumerate() {
            if rank > 0 && *length < LONG {
                break;
            }
            let candidates = self.candidates(text, ink, own, line, at);
            found |= self.take(candidates);
        }
        if !found && let Some((_, line)) = parts.first() {
            let candidates = self.ends(text, ink, own, line);
            found = self.take(candidates);
        }
        found
    }

    fn candidates(
        &self,
        text: &str,
        ink: Ink,
        own: usize,
        line: &[[f64; 2]],
        at: f64,
    ) -> Vec<Candidate> {
        let total = length(line);
        let width = self.label(text, [0.0; 2], 0.0, ink).size[0];
        let mut candidates = Vec::new();
        let mut start = 2.0;
        while start + width + 2.0 <= total {
            let part = between(line, start, start + width);
            let (p, q) = (part[0], part[part.len() - 1]);
            let chord = [q[0] - p[0], q[1] - p[1]];
            let long = chord[0].hypot(chord[1]);
            start += STEP;
            if long < 0.9 * width {
                continue;
            }
            let off = |point: &[f64; 2]| {
                ((point[0] - p[0]) * chord[1] - (point[1] - p[1]) * chord[0]) / long
            };
            let bend = part.iter().map(|p| off(p).abs()).fold(0.0, f64::max);
            if bend > BEND {
                continue;
            }
            let mean = part.iter().map(off).sum::<f64>() / part.len() as f64;
            let centre = [
                f64::midpoint(p[0], q[0]) + mean * chord[1] / long,
                f64::midpoint(p[1], q[1]) - mean * chord[0] / long,
            ];
            let mut angle = chord[1].atan2(chord[0]).to_degrees();
            if angle > STEEPEST {
                angle -= 180.0;
            } else if angle <= STEEPEST - 180.0 {
                angle += 180.0;
            }
            let label = self.label(text, centre, angle, ink);
            if let Some(cost) = self.cost(&label, own) {
                let place = ((start - STEP + width / 2.0) / total - at).abs();
                let steep = (angle.abs() / 90.0).powi(4);
                candidates.push((cost + 2.0 * bend + 12.0 * place + 4.0 * steep, label));
            }
        }
        candidates
    }

    /// Places beside a line that is too short or too bent to write along.
    fn ends(&self, text: &str, ink: Ink, own: usize, line: &[[f64; 2]]) -> Vec<Candidate> {
        let size = self.label(text, [0.0; 2], 0.0, ink).size;
        let total = length(line);
        let mut candidates = Vec::new();
        for (rank, share) in [1.0, 0.5, 0.0, 0.75, 0.25].into_iter().enumerate() {
            let point = between(line, share * total, share * total)[0];
            for distance in [3.0, 12.0] {
                let away = [size[0] / 2.0 + distance, size[1] / 2.0 + distance];
                for (x, y) in AROUND {
                    let centre = [point[0] + x * away[0], point[1] + y * away[1]];
                    let label = self.label(text, centre, 0.0, ink);
                    if let Some(cost) = self.cost(&label, own) {
                        candidates.push((cost + rank as f64 + distance, label));
                    }
                }
            }
        }
        candidates
    }
}
