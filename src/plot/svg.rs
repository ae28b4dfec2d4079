//! A drawing as SVG.
//!
//! Every element has a style class, every panel and curve says what it is:
//!
//! ```text
//! svg.bogie-chart#chart-4.6.1
//! ├ title, desc            what it shows, in words
//! ├ g.panel[data-panel]    one per panel
//! │ ├ g.grid, g.axis
//! │ ├ g.curves             clipped to the frame
//! │ │ └ g.curve[data-family][data-label][data-value] > path.line
//! │ ├ g.limits, g.marks
//! │ └ g.labels
//! └ g.legend
//! ```

use std::fmt::Write;

use super::{
    Axis, Direction, Drawing, Frame, Panel, Scale, Symbol, Text, Theme,
    layout::{base_line, size},
    legend::{Look, SAMPLE},
    markup::{Svg, escape, identifier, line_class},
    ruler::Ruler,
    stylesheet,
};

/// Length of ticks.
const TICK: f64 = 5.0;

impl Drawing<'_> {
    /// As SVG.
    pub fn svg(&self, theme: Theme) -> String {
        let figure = self.figure;
        let id = identifier(&figure.name);
        let mut svg = Svg::default();
        let (width, height) = (self.width, self.height);
        svg.line(&format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"bogie-chart\" id=\"chart-{id}\" \
             width=\"{width}\" height=\"{height:.0}\" viewBox=\"0 0 {width} {height:.0}\" \
             role=\"img\" aria-labelledby=\"title-{id} desc-{id}\">"
        ));
        svg.line(&format!(
            "<title id=\"title-{id}\">{}</title>",
            escape(&Text::new(&figure.heading()).plain())
        ));
        svg.line(&format!(
            "<desc id=\"desc-{id}\">{}</desc>",
            escape(&Text::new(&figure.description).plain())
        ));
        if theme != Theme::Bare {
            svg.line(&format!("<style>\n{}</style>", stylesheet(theme)));
        }
        svg.line("<rect class=\"paper\" width=\"100%\" height=\"100%\"/>");
        for written in &self.written {
            svg.text(
                &written.text,
                written.class,
                written.size,
                written.at,
                "start",
                0.0,
            );
        }
        self.legend(&mut svg);
        for (i, panel) in figure.panels.iter().enumerate() {
            self.panel(&mut svg, i, panel, &id);
        }
        svg.line("</svg>");
        svg.0
    }

    fn legend(&self, svg: &mut Svg) {
        if self.legend.is_empty() {
            return;
        }
        svg.line("<g class=\"legend\">");
        for entry in &self.legend {
            let [x, y] = entry.at;
            let middle = y - base_line(size::LABEL);
            match entry.look {
                Look::Line(stroke, dots) => {
                    svg.path(
                        &format!("M{x:.1} {middle:.1}h{:.1}", SAMPLE - 6.0),
                        &line_class(stroke),
                    );
                    if dots {
                        let centre = [x + (SAMPLE - 6.0) / 2.0, middle];
                        svg.symbol(Symbol::Dot, stroke.ink.class(), centre);
                    }
                }
                Look::Hatched => {
                    let line = [[x, middle], [x + SAMPLE - 6.0, middle]];
                    svg.hatched(line, [0.0, -1.0]);
                }
                Look::Symbol(symbol, ink) => {
                    svg.symbol(symbol, ink.class(), [x + (SAMPLE - 6.0) / 2.0, middle]);
                }
            }
            svg.text(
                &entry.text,
                "key",
                size::LABEL,
                [x + SAMPLE, y],
                "start",
                0.0,
            );
        }
        svg.line("</g>");
    }

    fn panel(&self, svg: &mut Svg, index: usize, panel: &Panel, id: &str) {
        let frame = &self.frames[index];
        let Frame {
            x,
            y,
            width,
            height,
        } = *frame;
        svg.line(&format!("<g class=\"panel\" data-panel=\"{index}\">"));
        let clip = format!("clip-{id}-{index}");
        let rectangle =
            format!("x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"");
        svg.line(&format!(
            "<clipPath id=\"{clip}\"><rect {rectangle}/></clipPath>"
        ));
        for shade in &panel.shades {
            svg.shade(panel, frame, shade.axis, shade.range);
        }
        self.grid(svg, index, frame);
        svg.line(&format!("<g class=\"curves\" clip-path=\"url(#{clip})\">"));
        for family in &panel.families {
            for curve in &family.curves {
                svg.curve(panel, frame, family, curve);
            }
        }
        svg.line("</g>");
        svg.line(&format!("<rect class=\"frame\" {rectangle}/>"));
        for shade in panel.shades.iter().filter(|s| !s.label.is_empty()) {
            let [from, to] = shade.range.map(|v| match shade.axis {
                Direction::X => x + width * panel.x.fraction(v).clamp(0.0, 1.0),
                Direction::Y => y + height * (1.0 - panel.y.fraction(v).clamp(0.0, 1.0)),
            });
            let middle = f64::midpoint(from, to);
            let at = match shade.axis {
                Direction::X => [middle, y + height - 6.0],
                Direction::Y => [x + width / 2.0, middle],
            };
            svg.text(&shade.label, "label grey", size::LABEL, at, "middle", 0.0);
        }
        for limit in &panel.limits {
            let line = limit.line(frame, panel);
            if frame.holds(line[0], -0.5) {
                let forbidden = if limit.at_least { -1.0 } else { 1.0 };
                let normal = match limit.axis {
                    Direction::X => [forbidden, 0.0],
                    Direction::Y => [0.0, -forbidden],
                };
                svg.hatched(line, normal);
            }
        }
        svg.line("<g class=\"marks\">");
        for mark in &panel.marks {
            svg.mark(panel, frame, mark);
        }
        svg.line("</g>");
        self.axes(svg, index, panel);
        svg.line("<g class=\"labels\">");
        for label in self.labels.iter().filter(|label| label.panel == index) {
            svg.label(label);
        }
        svg.line("</g>");
        if !panel.title.is_empty() {
            let top = if self.rulers[index].top.is_some() {
                44.0
            } else {
                8.0
            };
            let at = [x + width / 2.0, y - top];
            svg.text(&panel.title, "panel-title", size::AXIS, at, "middle", 0.0);
        }
        svg.line("</g>");
    }

    fn grid(&self, svg: &mut Svg, index: usize, frame: &Frame) {
        let rulers = &self.rulers[index];
        svg.line("<g class=\"grid\">");
        for (class, major) in [("minor", false), ("major", true)] {
            let mut path = String::new();
            for (tick, fraction) in &rulers.bottom.ticks {
                if tick.major == major {
                    let x = frame.x + frame.width * fraction;
                    let _ = write!(path, "M{x:.1} {:.1}v{:.1}", frame.y, frame.height);
                }
            }
            for (tick, fraction) in &rulers.left.ticks {
                if tick.major == major {
                    let y = frame.y + frame.height * (1.0 - fraction);
                    let _ = write!(path, "M{:.1} {y:.1}h{:.1}", frame.x, frame.width);
                }
            }
            svg.path(&path, class);
        }
        svg.line("</g>");
    }

    fn axes(&self, svg: &mut Svg, index: usize, panel: &Panel) {
        let (frame, rulers) = (&self.frames[index], &self.rulers[index]);
        let Frame {
            x,
            y,
            width,
            height,
        } = *frame;
        let bottom = y + height;
        svg.line("<g class=\"axis\">");
        let mut across = |ruler: &Ruler, edge: f64, outward: f64, title: f64| {
            let mut path = String::new();
            for (tick, fraction) in &ruler.ticks {
                let at = x + width * fraction;
                let length = outward
                    * if tick.label.is_some() {
                        TICK
                    } else {
                        TICK / 2.0
                    };
                let _ = write!(path, "M{at:.1} {edge:.1}v{length:.1}");
                if let Some(label) = &tick.label {
                    let shift = if outward > 0.0 {
                        TICK + 10.0
                    } else {
                        -TICK - 3.0
                    };
                    let at = [at, edge + shift];
                    svg.text(label, "tick-label", size::LABEL, at, "middle", 0.0);
                }
            }
            svg.path(&path, "tick");
            let at = [x + width / 2.0, edge + title];
            svg.text(&ruler.title, "axis-title", size::AXIS, at, "middle", 0.0);
        };
        across(&rulers.bottom, bottom, 1.0, 33.0);
        if let Some(top) = &rulers.top {
            across(top, y, -1.0, -24.0);
        }
        let mut up = |ruler: &Ruler, edge: f64, outward: f64| {
            let mut path = String::new();
            let mut widest: f64 = 0.0;
            for (tick, fraction) in &ruler.ticks {
                let at = y + height * (1.0 - fraction);
                let length = outward
                    * if tick.label.is_some() {
                        TICK
                    } else {
                        TICK / 2.0
                    };
                let _ = write!(path, "M{edge:.1} {at:.1}h{length:.1}");
                if let Some(label) = &tick.label {
                    widest = widest.max(Text::new(label).width(size::LABEL));
                    let at = [edge + outward * (TICK + 3.0), at + base_line(size::LABEL)];
                    let anchor = if outward > 0.0 { "start" } else { "end" };
                    svg.text(label, "tick-label", size::LABEL, at, anchor, 0.0);
                }
            }
            svg.path(&path, "tick");
            let shift = TICK + 3.0 + widest + if outward > 0.0 { 14.0 } else { 7.0 };
            let at = [edge + outward * shift, y + height / 2.0];
            svg.text(&ruler.title, "axis-title", size::AXIS, at, "middle", -90.0);
        };
        up(&rulers.left, x, -1.0);
        if let Some(right) = &rulers.right {
            up(right, x + width, 1.0);
        }
        // The zero line of an axis that crosses it.
        let zero =
            |axis: &Axis| axis.scale == Scale::Linear && axis.range[0] < 0.0 && axis.range[1] > 0.0;
        if zero(&panel.y) {
            let at = y + height * (1.0 - panel.y.fraction(0.0));
            svg.path(&format!("M{x:.1} {at:.1}h{width:.1}"), "tick");
        }
        if zero(&panel.x) {
            let at = x + width * panel.x.fraction(0.0);
            svg.path(&format!("M{at:.1} {y:.1}v{height:.1}"), "tick");
        }
        svg.line("</g>");
    }
}
