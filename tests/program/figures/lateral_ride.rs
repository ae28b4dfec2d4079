//! What 4.4, 4.6 and the design forms of 4.7 say of lateral ride, strokes and excursions.

use bogie::{
    dynamics::LateralModel,
    evaluate::ride::LateralRide,
    plot::{Curve, Figure},
    units::us::INCH,
    vehicle::GRAVITY,
};

use super::{
    at, curve, figure, lateral_column, stability_column,
    support::{LBF_FT, LBF_PER_FT, MPH, assert_ratio},
    workbook,
};

/// Points (stroke, acceleration) of a net where a line of constant natural frequency (Hz) meets one
/// of constant damping ratio: interpolated along the line of the ratio, which is drawn over the
/// logarithm of the frequency.
pub(super) fn net(figure: &Figure, frequency: f64, ratio: f64) -> [f64; 2] {
    let panel = &figure.panels[0];
    let lines = panel.family("frequency").unwrap();
    let ends = [lines.curves.first(), lines.curves.last()].map(|c| c.unwrap().value.unwrap());
    let line = panel.family("damping-ratio").unwrap().at(ratio).unwrap();
    let points: Vec<[f64; 2]> = line.points().collect();
    let place = (frequency / ends[0]).ln() / (ends[1] / ends[0]).ln() * (points.len() - 1) as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let i = (place.floor() as usize).min(points.len() - 2);
    let t = place - i as f64;
    [0, 1].map(|k| points[i][k] + t * (points[i + 1][k] - points[i][k]))
}

/// 4.4: more than 95 % of the RMS acceleration and of the secondary strokes lies below 2 Hz. Here
/// 94.6 % of the acceleration at the front point, and 80 % of the much smaller one at the c.g.
/// (validation.md).
#[test]
fn most_of_the_response_lies_below_two_hertz() {
    let spec = stability_column();
    let mut case = spec.case.clone();
    let model = LateralModel::new(&case);
    let all = LateralRide::new(&model, &case).unwrap();
    case.model.frequency_band[1] = 2.0;
    let low = LateralRide::new(&model, &case).unwrap();
    for truck in 0..2 {
        assert!(low.secondary_stroke[truck] > 0.95 * all.secondary_stroke[truck]);
    }
    for (point, least) in [(0, 0.79), (1, 0.94), (2, 0.94)] {
        let share = low.acceleration[point] / all.acceleration[point];
        assert!(share > least, "{point}: {share}");
    }
    assert!(all.acceleration[0] < 0.5 * all.acceleration[1]);
    // With the secondary yaw stiffness of the lateral charts it is the same.
    let stiff = lateral_column();
    let label = &figure(&workbook(&stiff), "4.4.2").panels[0].shades[0].label;
    assert!(label.contains("94.1 %"), "{label}");
    // The chart says so.
    let figure = figure(&workbook(&spec), "4.4.2");
    let percent = 100.0 * low.acceleration[1] / all.acceleration[1];
    let label = &figure.panels[0].shades[0].label;
    assert!(
        label.contains(&format!("{percent:.1} %")),
        "{label} {percent}"
    );
}

/// 4.4: the ISO plot shows the area of concern near 1 Hz.
#[test]
fn the_boundary_is_nearest_at_one_hertz() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.4.2");
    let bands = figure.panels[1].family("bands").unwrap();
    let boundary = figure.panels[1].family("boundary").unwrap();
    let nearest = bands.curves[0]
        .pieces
        .iter()
        .flat_map(|piece| piece.windows(2))
        .filter(|w| w[0][1].to_bits() == w[1][1].to_bits())
        .map(|w| ((w[0][0] * w[1][0]).sqrt(), w[0][1]))
        .map(|(f, value)| (f, value / at(&boundary.curves[0], f.max(1.001))))
        .filter(|(f, _)| *f > 0.95)
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap();
    assert!((0.9..1.5).contains(&nearest.0), "{nearest:?}");
}

/// 4.6, step 11: below ξ = 0.2 both stroke and acceleration rise; above 0.3 the stroke falls, but
/// the acceleration rises steeply; 0.2–0.3 is best. The ride improves as f_n falls.
#[test]
fn figure_4_6_12() {
    let spec = lateral_column();
    let figure = figure(&workbook(&spec), "4.6.12");
    for f in [0.7, 0.8] {
        let [a, b, c, d, e] = [0.1, 0.2, 0.25, 0.3, 0.5].map(|xi| net(&figure, f, xi));
        assert!(a[0] > b[0] && a[1] > b[1], "{f} Hz below 0.2: {a:?} {b:?}");
        assert!(
            e[0] < d[0] && e[1] > 1.08 * d[1],
            "{f} Hz above 0.3: {d:?} {e:?}"
        );
        assert!(c[1] < 1.02 * b[1].min(d[1]), "{f} Hz: {b:?} {c:?} {d:?}");
    }
    for xi in [0.2, 0.25, 0.3] {
        let rising = [0.6, 0.7, 0.8, 1.0, 1.2].map(|f| net(&figure, f, xi)[1]);
        assert!(rising.is_sorted_by(|a, b| a < b), "ξ {xi}: {rising:?}");
    }
}

/// What the design forms of both examples read off the nets, between 60 and 110 mph by their
/// formula: inches and g. Two-figure readings of interpolated lines, so 10 %.
#[test]
fn readings_of_the_nets() {
    let spec = lateral_column();
    let book = workbook(&spec);
    let (fast, slow) = (figure(&book, "4.6.12"), figure(&book, "4.6.13"));
    for (f, xi, speed, acceleration, stroke) in [
        (0.7, 0.25, 130.0, 0.046, 0.49),
        (0.8, 0.2, 80.0, 0.036, 0.353),
    ] {
        let (at_110, at_60) = (net(&fast, f, xi), net(&slow, f, xi));
        let read = [0, 1].map(|k| at_110[k] + (speed - 110.0) / 50.0 * (at_110[k] - at_60[k]));
        assert_ratio("stroke", read[0] / INCH, stroke, 0.1);
        assert_ratio("acceleration", read[1] / GRAVITY, acceleration, 0.1);
    }
}

/// What the forms read off Figures 4.6.6–4.6.17. Strokes and excursions in inches, accelerations in
/// g; changes are differences of readings with two figures after the last one printed, so they hold
/// to a few units of it.
#[test]
fn readings_of_the_influences() {
    let spec = lateral_column();
    let book = workbook(&spec);
    let read = |number: &str, label: &str, x: f64| at(curve(&figure(&book, number), 0, label), x);
    let near = |what: &str, ours: f64, printed: f64, tolerance: f64| {
        assert!(
            (ours - printed).abs() <= tolerance,
            "{what}: {ours} against {printed}"
        );
    };
    let ps = |conicity: f64| read("4.6.6", "wheelset 4", conicity) / INCH;
    near("PS(λ = 0.05)", ps(0.05), 0.027, 0.003);
    near("PS(λ = 0.1)", ps(0.1), 0.026, 0.003);
    let ps = |k_py: f64| read("4.6.7", "wheelset 4", k_py * LBF_PER_FT) / INCH;
    near("ΔPS(K_py)", ps(2e5) - ps(5e5), 0.030, 0.005);
    let ps = |conicity: &str, speed: f64| read("4.6.8", conicity, speed * MPH) / INCH;
    near(
        "ΔPS(130 mph)",
        ps("λ = 0.05", 130.0) - ps("λ = 0.05", 110.0),
        0.003,
        0.002,
    );
    near(
        "ΔPS(80 mph)",
        ps("λ = 0.1", 80.0) - ps("λ = 0.1", 110.0),
        -0.008,
        0.002,
    );
    let we = |conicity: f64| read("4.6.9", "wheelset 1", conicity) / INCH;
    near("WE(λ = 0.05)", we(0.05), 0.25, 0.01);
    near("WE(λ = 0.1)", we(0.1), 0.19, 0.01);
    let we = |k_b: f64| read("4.6.10", "wheelset 1", k_b * LBF_FT) / INCH;
    near("ΔWE(K_b)", we(1.8e6) - we(4e6), 0.0, 0.012);
    let we = |conicity: &str, speed: f64| read("4.6.11", conicity, speed * MPH) / INCH;
    near(
        "ΔWE(130 mph)",
        we("λ = 0.05", 130.0) - we("λ = 0.05", 110.0),
        0.01,
        0.005,
    );
    near(
        "ΔWE(80 mph)",
        we("λ = 0.1", 80.0) - we("λ = 0.1", 110.0),
        -0.01,
        0.01,
    );
    let acc = |conicity: f64| read("4.6.14", "average", conicity) / GRAVITY;
    near("ΔACC(λ = 0.1)", acc(0.1) - acc(0.05), -0.005, 0.002);
    let acc = |k_b: f64| read("4.6.15", "average", k_b * LBF_FT) / GRAVITY;
    near("ΔACC(K_b)", acc(1.8e6) - acc(4e6), 0.003, 0.004);
    let st = |conicity: f64| read("4.6.16", "average", conicity) / INCH;
    near("ΔST(λ = 0.1)", st(0.1) - st(0.05), -0.055, 0.011);
    let st = |k_b: f64| read("4.6.17", "average", k_b * LBF_FT) / INCH;
    near("ΔST(K_b)", st(1.8e6) - st(4e6), 0.0, 0.01);
}

/// Every curve of the influence charts passes through the marked design.
#[test]
fn the_design_lies_on_its_curve() {
    let spec = stability_column();
    let book = workbook(&spec);
    for number in [
        "4.6.6", "4.6.7", "4.6.9", "4.6.10", "4.6.14", "4.6.15", "4.6.16", "4.6.17",
    ] {
        let figure = figure(&book, number);
        let mark = figure.panels[0].marks[0].at;
        let distance = figure.panels[0]
            .families
            .iter()
            .flat_map(|family| &family.curves)
            .map(|curve: &Curve| (at(curve, mark[0]) / mark[1] - 1.0).abs())
            .fold(f64::INFINITY, f64::min);
        // Straight lines between the points of a curve.
        assert!(distance < 2e-3, "{number}: {distance}");
    }
}
