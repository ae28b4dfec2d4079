//! How charts are drawn: labels, files, the same bits for any number of threads.

use bogie::{
    chart::BOOK,
    export::{figure as numbers, table::Column},
    plot::{
        Axis, Curve, Drawing, Family, Figure, Ink, Mark, Panel, Scale, Stroke, Symbol, Theme, Unit,
    },
};
use proptest::prelude::*;

use super::{figure, stability_column, workbook};

/// Labels of a drawing that overlap one another or leave their frame.
fn misplaced(drawing: &Drawing) -> Vec<String> {
    let labels = &drawing.labels;
    let mut found = Vec::new();
    for (i, a) in labels.iter().enumerate() {
        let frame = &drawing.frames[a.panel];
        if !a.corners().iter().all(|p| frame.holds(*p, -0.01)) {
            found.push(format!("{} leaves its frame", a.text));
        }
        for b in &labels[i + 1..] {
            if a.overlaps(b) {
                found.push(format!("{} over {}", a.text, b.text));
            }
        }
    }
    found
}

fn axis(range: [f64; 2]) -> Axis {
    Axis::new("x", "", "x", Scale::Linear, range, [Unit::new("", 1.0)])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever curves and points are drawn, no label covers another, and none is lost: it is on
    /// the chart or in the legend.
    #[test]
    fn labels_never_overlap(
        slopes in prop::collection::vec((-3.0..3.0, -1.0..1.0, 0.5..6.0), 1..14),
        points in prop::collection::vec((-1.0..1.0, -1.0..1.0), 0..10),
    ) {
        let curves = slopes.iter().enumerate().map(|(i, (slope, offset, bend))| {
            let x = (0..=40).map(|k| -1.0 + 0.05 * f64::from(k));
            let y = |x: f64| slope * x + offset + f64::sin(bend * x);
            Curve::line(format!("curve {i}"), x.map(|x| [x, y(x)]))
                .stroke(Stroke::nth(i))
        });
        let mut panel = Panel::new("", axis([-1.0, 1.0]), axis([-1.5, 1.5]))
            .with(Family::new("curves", "", Stroke::default()).curves(curves));
        for (i, (x, y)) in points.iter().enumerate() {
            panel = panel.mark(Mark::new([*x, *y], Symbol::Disc, Ink::Blue, format!("point {i}")));
        }
        let figure = Figure::new("", "random", "Random").panel(panel);
        let drawing = Drawing::new(&figure);
        prop_assert_eq!(misplaced(&drawing), Vec::<String>::new());
        let svg = drawing.svg(Theme::Print);
        for i in 0..points.len() {
            prop_assert!(svg.contains(&format!(">point {i}</text>")), "point {}", i);
        }
    }
}

/// Every chart, drawn in every theme.
#[test]
fn charts_are_whole() {
    let spec = stability_column();
    let mut book = workbook(&spec);
    book.grid = 9;
    for entry in &BOOK {
        let figure = entry.draw(&book);
        let drawing = Drawing::new(&figure);
        assert_eq!(misplaced(&drawing), Vec::<String>::new(), "{}", entry.name);
        assert!(!figure.subtitle.is_empty() && !figure.description.is_empty());
        for theme in [Theme::Print, Theme::Page, Theme::Bare] {
            let svg = drawing.svg(theme);
            assert!(svg.len() < 60_000, "{}: {} bytes", entry.name, svg.len());
            assert!(
                !svg.contains("NaN") && !svg.contains("inf"),
                "{}",
                entry.name
            );
            for part in ["<title ", "<desc ", "class=\"frame\"", "</svg>"] {
                assert!(svg.contains(part), "{}: {part}", entry.name);
            }
            let page = matches!(theme, Theme::Page);
            assert_eq!(svg.contains("prefers-color-scheme"), page);
            assert_eq!(svg.contains("<style>"), theme != Theme::Bare);
        }
    }
}

/// The table of a panel is what is drawn: curves point by point, contours at the field's level.
#[test]
fn tables_agree_with_the_figures() {
    let spec = stability_column();
    let mut book = workbook(&spec);
    book.grid = 9;
    let lines = figure(&book, "4.6.7");
    let drawn: Vec<[f64; 2]> = lines.panels[0]
        .families
        .iter()
        .flat_map(|f| &f.curves)
        .flat_map(Curve::points)
        .collect();
    let text = numbers::tables(&lines)[0].1.csv();
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    assert_eq!(
        reader.headers().unwrap(),
        vec![
            "family",
            "curve",
            "value",
            "primary_lateral_stiffness_n_per_m",
            "primary_stroke_rms_m"
        ]
    );
    let read: Vec<[f64; 2]> = reader
        .records()
        .map(|record| [3, 4].map(|i| record.as_ref().unwrap()[i].parse().unwrap()))
        .collect();
    assert_eq!(read, drawn);

    let contours = figure(&book, "4.6.1");
    let panel = &contours.panels[0];
    let table = numbers::table(panel);
    let columns: Vec<(&str, &Column)> = table.columns().collect();
    assert_eq!(columns.len(), 4);
    assert_eq!(table.rows(), 81);
    let field = panel.field.as_ref().unwrap();
    for curve in &panel.family("critical-speed").unwrap().curves {
        for point in curve.points() {
            let value = field.value(1, point, [&panel.x, &panel.y]).unwrap();
            // Between the two sides of a jump the chart knows better than the grid.
            let jump = field.layers[1].jumps.iter().any(|jump| {
                let (i, j, _) = jump.side;
                let [x, y] = [(&field.x, i, point[0]), (&field.y, j, point[1])];
                [x, y].iter().all(|(lines, k, v)| {
                    lines[*k] * (1.0 - 1e-9) <= *v
                        && lines
                            .get(k + 1)
                            .is_none_or(|next| *v <= next * (1.0 + 1e-9))
                })
            });
            assert!(jump || (value / curve.value.unwrap() - 1.0).abs() < 1e-9);
        }
    }
}

/// A chart that is drawn from many evaluations is the same for one thread and for two.
#[test]
fn threads_change_nothing() {
    let spec = stability_column();
    let svg = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut book = workbook(&spec);
            book.grid = 9;
            ["4.6.1", "4.6.12", "4.5.8"].map(|number| {
                let figure = figure(&book, number);
                let drawing = Drawing::new(&figure);
                (drawing.svg(Theme::Print), drawing.json().to_string())
            })
        })
    };
    assert_eq!(svg(1), svg(2));
}
