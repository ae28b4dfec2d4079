//! Style classes of a drawing.

use std::fmt::Write;

use super::{Dash, Ink, Weight, font, layout::size};

/// Purpose of a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Theme {
    /// A file of its own, for print: black on white.
    Print,
    /// A part of a page, with colours that follow the reader's choice of light or dark
    /// (`prefers-color-scheme`).
    Page,
    /// A part of a page that has the [`stylesheet`] of [`Theme::Page`] already.
    Bare,
}

/// Names of the colours, with their values on light and on dark paper.
///
/// The inks are those of Okabe and Ito's palette; black and white, and grey, change places on dark
/// paper, and blue is lightened there.
const COLOURS: [(&str, &str, &str); 12] = [
    ("paper", "#ffffff", "#16191d"),
    ("black", "#000000", "#f2f2f2"),
    ("blue", "#0072b2", "#56a8e0"),
    ("vermilion", "#d55e00", "#f07f2e"),
    ("green", "#00805e", "#2fc29a"),
    ("purple", "#a8487f", "#dc8bb9"),
    ("orange", "#b87b00", "#e6b040"),
    ("sky", "#3a9bd0", "#7fc4ee"),
    ("grey", "#8a8a8a", "#8f969d"),
    ("text", "#222222", "#dddddd"),
    ("major", "#c4c4c4", "#444b52"),
    ("minor", "#e8e8e8", "#2a2f35"),
];

/// The style sheet of a drawing. All its rules begin with `.bogie-chart`, so that it disturbs
/// nothing else on a page.
pub fn stylesheet(theme: Theme) -> String {
    let colour = |name: &str| match theme {
        Theme::Print => COLOURS
            .iter()
            .find(|(known, _, _)| *known == name)
            .map_or("#000000", |(_, light, _)| light)
            .to_owned(),
        Theme::Page | Theme::Bare => format!("var(--chart-{name})"),
    };
    let mut css = String::new();
    let mut rule = |selector: &str, declarations: &str| {
        let _ = writeln!(css, ".bogie-chart {selector}{{{declarations}}}");
    };
    rule(
        "text",
        &format!(
            "font-family:{};font-stretch:condensed;fill:{}",
            font::FAMILIES,
            colour("text")
        ),
    );
    let sizes: [(&str, f64, &str); 8] = [
        (".title", size::TITLE, "font-weight:bold"),
        (".subtitle", size::SUBTITLE, ""),
        (".note", size::NOTE, ""),
        (".panel-title", size::AXIS, "font-weight:bold"),
        (".axis-title", size::AXIS, ""),
        (".tick-label", size::LABEL, ""),
        (".label", size::LABEL, ""),
        (".key", size::LABEL, ""),
    ];
    for (selector, size, more) in sizes {
        rule(selector, &format!("font-size:{size}px;{more}"));
    }
    rule(".paper", &format!("fill:{}", colour("paper")));
    rule(
        ".frame",
        &format!("fill:none;stroke:{};stroke-width:1.2", colour("text")),
    );
    rule(
        ".tick",
        &format!("fill:none;stroke:{};stroke-width:1", colour("text")),
    );
    for (name, width) in [("major", 0.8), ("minor", 0.6)] {
        rule(
            &format!(".{name}"),
            &format!("fill:none;stroke:{};stroke-width:{width}", colour(name)),
        );
    }
    rule(
        ".shade",
        &format!("fill:{};fill-opacity:0.13", colour("blue")),
    );
    rule(
        ".limit",
        &format!("fill:none;stroke:{};stroke-width:1.6", colour("vermilion")),
    );
    rule(
        ".hatch",
        &format!("fill:none;stroke:{};stroke-width:0.8", colour("vermilion")),
    );
    rule(
        ".line",
        "fill:none;stroke-linejoin:round;stroke-linecap:butt",
    );
    inks(&mut rule, &colour);
    rule(
        ".halo",
        &format!("stroke:{};stroke-width:1.5", colour("paper")),
    );
    lines(&mut rule);
    match theme {
        Theme::Print => css,
        Theme::Page | Theme::Bare => variables() + &css,
    }
}

/// Rules for what has an ink.
fn inks(rule: &mut impl FnMut(&str, &str), colour: &impl Fn(&str) -> String) {
    for ink in Ink::ALL {
        let name = ink.class();
        rule(
            &format!(".line.{name}"),
            &format!("stroke:{}", colour(name)),
        );
        rule(
            &format!(".label.{name}"),
            &format!(
                "fill:{}",
                colour(if ink == Ink::Grey { "text" } else { name })
            ),
        );
        rule(
            &format!(".solid-mark.{name}"),
            &format!("fill:{}", colour(name)),
        );
        rule(
            &format!(".open-mark.{name}"),
            &format!(
                "fill:{};stroke:{};stroke-width:1.8",
                colour("paper"),
                colour(name)
            ),
        );
    }
}

/// Rules for interruptions and widths of lines.
fn lines(rule: &mut impl FnMut(&str, &str)) {
    for dash in Dash::ALL {
        let pattern = match dash {
            Dash::Solid => continue,
            Dash::Dashed => "6 3.5",
            Dash::Dotted => "1.6 2.6",
            Dash::DashDot => "9 3 2 3",
            Dash::Long => "13 4",
        };
        rule(
            &format!(".line.{}", dash.class()),
            &format!("stroke-dasharray:{pattern}"),
        );
    }
    for (weight, width) in [
        (Weight::Thin, 0.9),
        (Weight::Normal, 1.5),
        (Weight::Bold, 2.6),
    ] {
        rule(
            &format!(".line.{}", weight.class()),
            &format!("stroke-width:{width}"),
        );
    }
}

/// Colours as variables, for light paper and, where the reader prefers it, for dark.
fn variables() -> String {
    let list = |dark: bool| {
        COLOURS
            .iter()
            .fold(String::new(), |mut list, (name, light, night)| {
                let _ = write!(list, "--chart-{name}:{};", if dark { night } else { light });
                list
            })
    };
    format!(
        ".bogie-chart{{{}}}\n@media screen and (prefers-color-scheme:dark){{.bogie-chart{{{}}}}}\n",
        list(false),
        list(true)
    )
}
