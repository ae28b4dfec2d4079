//! Elements of a drawing as SVG.

use std::fmt::Write;

use super::{
    Curve, Direction, Family, Frame, Level, Mark, Panel, PlacedLabel, Stroke, Symbol, Text,
    layout::{base_line, size},
    polyline::visible,
    text::SMALL,
};

/// SVG as it is written.
#[derive(Default)]
pub(super) struct Svg(pub String);

impl Svg {
    pub fn line(&mut self, text: &str) {
        self.0.push_str(text);
        self.0.push('\n');
    }

    pub fn path(&mut self, d: &str, class: &str) {
        if !d.is_empty() {
            self.line(&format!("<path class=\"{class}\" d=\"{d}\"/>"));
        }
    }

    /// Text at a base line point, turned clockwise by `angle` degrees about it.
    pub fn text(
        &mut self,
        marked: &str,
        class: &str,
        size: f64,
        [x, y]: [f64; 2],
        anchor: &str,
        angle: f64,
    ) {
        let mut attributes = format!("class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\"");
        if anchor != "start" {
            let _ = write!(attributes, " text-anchor=\"{anchor}\"");
        }
        if angle != 0.0 {
            let _ = write!(
                attributes,
                " transform=\"rotate({angle:.1} {x:.1} {y:.1})\""
            );
        }
        self.line(&format!(
            "<text {attributes}>{}</text>",
            spans(&Text::new(marked), size)
        ));
    }

    pub fn label(&mut self, label: &PlacedLabel) {
        // The base line is below the middle, across the direction of the text.
        let (s, c) = label.angle.to_radians().sin_cos();
        let down = base_line(size::LABEL);
        let at = [label.centre[0] - down * s, label.centre[1] + down * c];
        let class = format!("label {}", label.ink.class());
        // The line is interrupted where the text stands.
        let [x, y] = label.centre;
        let (width, height) = (label.size[0] - 2.0, label.size[1] - 2.0);
        let mut gap = format!(
            "<rect class=\"paper\" x=\"{:.1}\" y=\"{:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"",
            x - width / 2.0,
            y - height / 2.0
        );
        if label.angle != 0.0 {
            let _ = write!(
                gap,
                " transform=\"rotate({:.1} {x:.1} {y:.1})\"",
                label.angle
            );
        }
        self.line(&(gap + "/>"));
        self.text(&label.text, &class, size::LABEL, at, "middle", label.angle);
    }

    pub fn curve(&mut self, panel: &Panel, frame: &Frame, family: &Family, curve: &Curve) {
        let stroke = family.stroke_of(curve);
        let mut attributes = format!("data-family=\"{}\"", escape(&family.id));
        if !curve.label.is_empty() {
            let label = Text::new(&curve.label).plain();
            let _ = write!(attributes, " data-label=\"{}\"", escape(&label));
        }
        if let Some(value) = curve.value {
            let _ = write!(attributes, " data-value=\"{value}\"");
        }
        self.line(&format!("<g class=\"curve\" {attributes}>"));
        let mut path = String::new();
        for piece in &curve.pieces {
            for part in visible(panel, frame, piece) {
                write_line(&mut path, &part);
            }
        }
        self.path(&path, &line_class(stroke));
        if curve.dots {
            for point in curve.points() {
                let at = frame.point(panel, point);
                if frame.holds(at, 0.0) {
                    self.symbol(Symbol::Dot, stroke.ink.class(), at);
                }
            }
        }
        self.line("</g>");
    }

    pub fn shade(&mut self, panel: &Panel, frame: &Frame, axis: Direction, range: [f64; 2]) {
        let along = match axis {
            Direction::X => &panel.x,
            Direction::Y => &panel.y,
        };
        let [from, to] = range.map(|v| {
            let fraction = along.fraction(v);
            if fraction.is_nan() {
                0.0
            } else {
                fraction.clamp(0.0, 1.0)
            }
        });
        let (x, y, width, height) = match axis {
            Direction::X => (
                frame.x + frame.width * from,
                frame.y,
                frame.width * (to - from),
                frame.height,
            ),
            Direction::Y => (
                frame.x,
                frame.y + frame.height * (1.0 - to),
                frame.width,
                frame.height * (to - from),
            ),
        };
        self.line(&format!(
            "<rect class=\"shade\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" \
             height=\"{height:.1}\"/>"
        ));
    }

    /// A limit: a line with short strokes on its forbidden side.
    pub fn hatched(&mut self, [p, q]: [[f64; 2]; 2], normal: [f64; 2]) {
        let long = (q[0] - p[0]).hypot(q[1] - p[1]);
        let along = [(q[0] - p[0]) / long, (q[1] - p[1]) / long];
        let mut path = String::new();
        let mut s = 3.0;
        while s < long {
            let at = [p[0] + s * along[0], p[1] + s * along[1]];
            let [dx, dy] = [0, 1].map(|k| 5.0 * (normal[k] + 0.7 * along[k]));
            let _ = write!(path, "M{:.1} {:.1}l{dx:.1} {dy:.1}", at[0], at[1]);
            s += 7.0;
        }
        self.path(&path, "hatch");
        self.path(
            &format!("M{:.1} {:.1}L{:.1} {:.1}", p[0], p[1], q[0], q[1]),
            "limit",
        );
    }

    pub fn mark(&mut self, panel: &Panel, frame: &Frame, mark: &Mark) {
        let at = frame.point(panel, mark.at);
        if !frame.holds(at, -0.5) {
            return;
        }
        let label = escape(&Text::new(&mark.label).plain());
        self.line(&format!("<g class=\"mark\" data-label=\"{label}\">"));
        self.symbol(mark.symbol, mark.ink.class(), at);
        self.line("</g>");
    }

    pub fn symbol(&mut self, symbol: Symbol, ink: &str, [x, y]: [f64; 2]) {
        let circle = |class: &str, r: f64| {
            format!("<circle class=\"{class} {ink}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"/>")
        };
        let path =
            |d: &str| format!("<path class=\"solid-mark halo {ink}\" d=\"M{x:.1} {y:.1}{d}\"/>");
        let text = match symbol {
            // A ring around a dot: no other mark looks like it, in black and white either.
            Symbol::Design => circle("open-mark", 6.0) + &circle("solid-mark", 2.6),
            Symbol::Disc => circle("solid-mark halo", 4.0),
            Symbol::Ring => circle("open-mark", 3.6),
            Symbol::Square => path("m-3.6 -3.6h7.2v7.2h-7.2z"),
            Symbol::Triangle => path("m0 -4.6l4.4 7.4h-8.8z"),
            Symbol::Dot => circle("solid-mark", 2.2),
        };
        self.line(&text);
    }
}

/// Style classes of a line.
pub(super) fn line_class(stroke: Stroke) -> String {
    format!(
        "line {} {} {}",
        stroke.ink.class(),
        stroke.dash.class(),
        stroke.weight.class()
    )
}

/// A line in tenths of a pixel, without points that lie on the straight way between their
/// neighbours.
fn write_line(path: &mut String, line: &[[f64; 2]]) {
    const OFF: f64 = 0.06;
    let Some(first) = line.first() else { return };
    let _ = write!(path, "M{:.1} {:.1}", first[0], first[1]);
    let mut start = 0;
    for end in 2..=line.len() {
        let straight = end < line.len() && {
            let (p, q) = (line[start], line[end]);
            let chord = [q[0] - p[0], q[1] - p[1]];
            let long = chord[0].hypot(chord[1]).max(1e-12);
            line[start + 1..end]
                .iter()
                .all(|m| ((m[0] - p[0]) * chord[1] - (m[1] - p[1]) * chord[0]).abs() / long < OFF)
        };
        if !straight {
            let point = line[end - 1];
            let _ = write!(path, "L{:.1} {:.1}", point[0], point[1]);
            start = end - 1;
        }
    }
}

fn spans(text: &Text, size: f64) -> String {
    let mut out = String::new();
    let mut height = 0.0;
    for (piece, level) in &text.0 {
        let wanted = match level {
            Level::Base => 0.0,
            Level::Lowered => 0.22 * size,
            Level::Raised => -0.36 * size,
        };
        let shift = wanted - height;
        height = wanted;
        let piece = escape(piece);
        if *level == Level::Base && shift == 0.0 {
            out.push_str(&piece);
        } else if *level == Level::Base {
            let _ = write!(out, "<tspan dy=\"{shift:.1}\">{piece}</tspan>");
        } else {
            let small = SMALL * size;
            let _ = write!(
                out,
                "<tspan dy=\"{shift:.1}\" font-size=\"{small:.1}\">{piece}</tspan>"
            );
        }
    }
    out
}

/// Text in which nothing is read as an element.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// A name with letters, digits, dots and dashes only, as identifiers and files have it.
pub(super) fn identifier(name: &str) -> String {
    name.chars()
        .map(|c| {
            if c.is_ascii_alphanumeric() || c == '.' {
                c
            } else {
                '-'
            }
        })
        .collect()
}
