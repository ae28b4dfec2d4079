//! Layout: where on the drawing everything stands, in pixels of 1/96 inch.

use serde_json::{Value, json};

use super::{
    Figure, Frame, PlacedLabel,
    legend::Entry,
    obstacle::Obstacles,
    placement::place,
    ruler::{Rulers, rulers},
    text,
};

/// Width of every drawing: 190 mm, the width of a page between its margins.
pub(super) const WIDTH: f64 = 720.0;
/// Space around everything.
pub(super) const MARGIN: f64 = 12.0;
/// Space between panels.
const GAP: f64 = 14.0;
/// Height of the frame of a panel alone, and of panels side by side.
const HEIGHTS: [f64; 2] = [420.0, 300.0];

/// Font sizes.
pub(super) mod size {
    /// Title.
    pub const TITLE: f64 = 15.0;
    /// Subtitle.
    pub const SUBTITLE: f64 = 11.0;
    /// Titles of panels and axes.
    pub const AXIS: f64 = 12.0;
    /// Ticks, labels and legend.
    pub const LABEL: f64 = 11.0;
    /// Notes.
    pub const NOTE: f64 = 10.0;
}

/// Height of a line of text over its size.
pub(super) const LEADING: f64 = 1.35;

/// A line of text of the head or foot.
#[derive(Debug, Clone)]
pub(super) struct Written {
    pub text: String,
    pub class: &'static str,
    pub size: f64,
    pub at: [f64; 2],
}

/// A figure laid out.
#[derive(Debug, Clone)]
pub struct Drawing<'a> {
    /// The figure.
    pub figure: &'a Figure,
    /// Width of the drawing, px.
    pub width: f64,
    /// Height of the drawing, px.
    pub height: f64,
    /// Frames of the panels.
    pub frames: Vec<Frame>,
    /// Labels of curves, limits and points.
    pub labels: Vec<PlacedLabel>,
    pub(super) rulers: Vec<Rulers>,
    pub(super) legend: Vec<Entry>,
    pub(super) written: Vec<Written>,
}

impl<'a> Drawing<'a> {
    /// Lays out a figure.
    pub fn new(figure: &'a Figure) -> Self {
        let mut drawing = Self {
            figure,
            width: WIDTH,
            height: MARGIN,
            frames: Vec::new(),
            labels: Vec::new(),
            rulers: Vec::new(),
            legend: Vec::new(),
            written: Vec::new(),
        };
        drawing.write_bold(&figure.heading(), "title", size::TITLE);
        drawing.write(&figure.subtitle, "subtitle", size::SUBTITLE);
        drawing.height += 4.0;
        // Labels without a place go to the legend, whose height moves the frames: all that is
        // below moves as one, so the labels are placed first.
        let top = drawing.height;
        drawing.frames(0.0);
        let mut missing = Vec::new();
        for (index, (panel, frame)) in figure.panels.iter().zip(&drawing.frames).enumerate() {
            let (labels, rest) = place(index, panel, frame, &Obstacles::new(panel, frame));
            drawing.labels.extend(labels);
            missing.extend(rest);
        }
        let below = drawing.height;
        drawing.height = top;
        drawing.lay_legend(&missing);
        let legend = drawing.height - top;
        for frame in &mut drawing.frames {
            frame.y += top + legend;
        }
        for label in &mut drawing.labels {
            label.centre[1] += top + legend;
        }
        drawing.height += below;
        drawing.height += 4.0;
        for note in &figure.notes {
            drawing.write(note, "note", size::NOTE);
        }
        drawing.height += MARGIN;
        drawing
    }

    /// Adds a paragraph below what is there.
    fn write(&mut self, marked: &str, class: &'static str, size: f64) {
        self.write_in(marked, class, size, WIDTH - 2.0 * MARGIN);
    }

    /// Bold letters are a tenth wider.
    fn write_bold(&mut self, marked: &str, class: &'static str, size: f64) {
        self.write_in(marked, class, size, 0.9 * (WIDTH - 2.0 * MARGIN));
    }

    fn write_in(&mut self, marked: &str, class: &'static str, size: f64, room: f64) {
        if marked.is_empty() {
            return;
        }
        for line in text::wrap(marked, size, room) {
            self.height += LEADING * size;
            self.written.push(Written {
                text: line,
                class,
                size,
                at: [MARGIN, self.height - 0.3 * size],
            });
        }
    }

    /// Frames and rulers of all panels, the first row at `top`; leaves the height that they take
    /// in `height`.
    fn frames(&mut self, top: f64) {
        let panels = &self.figure.panels;
        let columns = self.figure.columns.max(1);
        let cell = (WIDTH - 2.0 * MARGIN - GAP * (columns - 1) as f64) / columns as f64;
        let height = HEIGHTS[usize::from(columns > 1)] * self.figure.height;
        let mut y = top;
        for row in panels.chunks(columns) {
            let rulers: Vec<Rulers> = row
                .iter()
                .map(|panel| rulers(panel, cell, height))
                .collect();
            let above = row
                .iter()
                .zip(&rulers)
                .map(|(panel, rulers)| {
                    let title = if panel.title.is_empty() { 4.0 } else { 20.0 };
                    title + if rulers.top.is_some() { 36.0 } else { 0.0 }
                })
                .fold(0.0, f64::max);
            for (i, rulers) in rulers.into_iter().enumerate() {
                let left = 26.0 + rulers.left.width();
                let right = rulers.right.as_ref().map_or_else(
                    // Half of the last label of the axis below.
                    || 14.0,
                    |ruler| 26.0 + ruler.width(),
                );
                self.frames.push(Frame {
                    x: MARGIN + i as f64 * (cell + GAP) + left,
                    y: y + above,
                    width: cell - left - right,
                    height,
                });
                self.rulers.push(rulers);
            }
            y += above + height + 42.0;
        }
        self.height = y - top;
    }

    /// The figure with the frames of its panels, for programs that show it: a point stands at
    /// [`Frame::point`] of its panel.
    pub fn json(&self) -> Value {
        json!({
            "figure": self.figure,
            "width_px": self.width,
            "height_px": self.height,
            "frames_px": self.frames,
        })
    }
}

/// Half of the height of text above and below its middle.
pub(super) fn half_height(size: f64) -> f64 {
    0.62 * size
}

/// Base line below the middle of text.
pub(super) fn base_line(size: f64) -> f64 {
    0.36 * size
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Axis, Curve, Family, Panel, Scale, Stroke, Unit};

    #[test]
    fn frames_stand_beside_and_below_each_other_without_overlap() {
        let axis = |column: &str| {
            Axis::new(
                "length",
                "",
                column,
                Scale::Linear,
                [0.0, 1.0],
                [Unit::new("m", 1.0), Unit::new("ft", 0.3048)],
            )
        };
        let mut figure = Figure::new("1.2.3", "frames", "Frames").columns(2);
        for id in ["a", "b", "c"] {
            let line = Curve::line("line", [[0.0, 0.0], [1.0, 1.0]]);
            figure = figure.panel(
                Panel::new(id, axis("x"), axis("y"))
                    .with(Family::new("line", "", Stroke::default()).curve(line)),
            );
        }
        let drawing = Drawing::new(&figure);
        let [a, b, c] = drawing.frames[..] else {
            panic!("{:?}", drawing.frames)
        };
        assert!(a.x + a.width < b.x && a.y + a.height < c.y);
        assert!(b.x + b.width < drawing.width && c.y + c.height < drawing.height);
        let corner = a.point(&figure.panels[0], [1.0, 0.0]);
        assert!((corner[0] - a.x - a.width).abs() < 1e-9);
        assert!((corner[1] - a.y - a.height).abs() < 1e-9);
    }
}
