//! What 4.5, 4.6 and Appendix A say of stability, curving and their trade-off.

use bogie::{
    chart::CONICITIES,
    dynamics::curving::lifting_cant_deficiency,
    plot::{Curve, Symbol},
};

use super::{
    at, curve, figure, stability_column,
    support::{LBF_FT, LBF_PER_FT, MPH, assert_ratio},
    workbook,
};

/// 4.5.2: flange contact before slip, at about 0.8° (0.90° here, as in validation.md); the slip
/// boundary reaches furthest at a cant deficiency of about one degree, where nothing of μN is left
/// at the other wheel.
#[test]
fn figure_4_5_5() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.5.5");
    let panel = &figure.panels[0];
    let flange = panel.family("flange").unwrap();
    let at_zero = flange
        .curves
        .iter()
        .flat_map(Curve::points)
        .min_by(|a, b| a[1].abs().total_cmp(&b[1].abs()))
        .unwrap();
    assert_ratio("flange-limited curve", at_zero[0], 0.85, 0.07);
    let slip = panel.family("slip").unwrap();
    let tip = slip
        .curves
        .iter()
        .flat_map(Curve::points)
        .max_by(|a, b| a[0].total_cmp(&b[0]))
        .unwrap();
    assert!((0.7..1.4).contains(&tip[1].to_degrees()), "{tip:?}");
    assert!(tip[0] > at_zero[0]);
    // The boundary's wheels there: outer below the tip, inner above it, of the first wheelset.
    for wheel in ["wheelset 1 outer", "wheelset 1 inner"] {
        let ends = &curve(&figure, 0, wheel).pieces[0];
        let near = |p: &[f64; 2]| (p[0] - tip[0]).abs() < 0.02;
        assert!(near(&ends[0]) || near(&ends[ends.len() - 1]), "{wheel}");
    }
    let left = panel
        .marks
        .iter()
        .filter(|m| m.symbol == Symbol::Dot)
        .min_by(|a, b| {
            (a.at[1] - tip[1])
                .abs()
                .total_cmp(&(b.at[1] - tip[1]).abs())
        });
    assert_eq!(left.unwrap().label, "2 %");
    // At the FRA's 3.07° about 20 % should be left; here 44 %.
    let fra = panel
        .marks
        .iter()
        .find(|m| (m.at[1].to_degrees() - 3.0).abs() < 0.01);
    assert_eq!(fra.unwrap().label, "44 %");
}

/// A high, narrow vehicle: the boundary ends on either side where its wheels lift, at the cant
/// deficiency φ = N / (ΔN/φ), and the chart says so.
#[test]
fn the_boundary_ends_where_wheels_lift() {
    let mut spec = stability_column();
    spec.case.vehicle.carbody.height_above_secondary = 4.0;
    spec.case.vehicle.wheelset.half_contact_distance = 0.3;
    let lift = lifting_cant_deficiency(&spec.case.vehicle);
    assert!(lift < 5.0_f64.to_radians());
    let figure = figure(&workbook(&spec), "4.5.5");
    let panel = &figure.panels[0];
    let curves = panel.families.iter().flat_map(|family| &family.curves);
    let angles = curves.flat_map(Curve::points).map(|point| point[1]);
    let ends = angles.fold([0.0, 0.0], |[low, high]: [f64; 2], angle| {
        [low.min(angle), high.max(angle)]
    });
    // The boundary ends 1e-9 short of it.
    assert_ratio("end", ends[1], lift, 1e-8);
    assert_ratio("end", ends[0], -lift, 1e-8);
    let labels: Vec<&str> = panel.shades.iter().map(|s| s.label.as_str()).collect();
    assert_eq!(labels, ["inner wheels lifted", "outer wheels lifted"]);
    assert!(figure.notes.iter().any(|note| note.contains("lift")));
}

/// 4.5.2 of Figure 4.5.6: the degree curve rises as K_b falls, hardly depends on K_py, and rises
/// with conicity (towards a rigid truck it falls: validation.md).
#[test]
fn figure_4_5_6() {
    let spec = stability_column();
    let mut book = workbook(&spec);
    book.grid = 25;
    let [x, y] = book.stiffness_axes();
    let axes = [&x, &y];
    let degree = |conicity: usize, k_b: f64, k_py: f64| {
        let point = [k_b * LBF_FT, k_py * LBF_PER_FT];
        book.curving(conicity).value(0, point, axes).unwrap()
    };
    for k_py in [1e5, 5e5, 2e6] {
        for conicity in [1, 3] {
            let falling = [3e5, 1e6, 3e6, 1e7].map(|k_b| degree(conicity, k_b, k_py));
            assert!(falling.is_sorted_by(|a, b| a > b), "{falling:?}");
            assert!(falling[0] > 2.5 * falling[3]);
        }
        for k_b in [3e5, 1e6, 3e6] {
            let [low, high] = [1, 3].map(|conicity| degree(conicity, k_b, k_py));
            assert!(high > low, "{k_b} {k_py}: {low} {high}");
        }
    }
    // Towards a rigid truck the conicity does not help.
    assert!(degree(3, 1e7, 5e5) < 0.9 * degree(1, 1e7, 5e5));
    // A factor of 50 in K_py changes it by less than a fifth of what one of 33 in K_b does.
    for k_b in [1e6, 3e6] {
        let change = degree(1, k_b, 1e5) / degree(1, k_b, 5e6);
        assert!((change - 1.0).abs() < 0.2, "{change}");
    }
}

/// 4.5.3: as K_py grows the critical speed rises sharply in a limited region; above 8e5 lb/ft it
/// hardly rises. As conicity grows it falls.
#[test]
fn figure_4_5_8() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.5.8");
    let speed = |conicity: f64, k_py: f64| {
        at(
            curve(&figure, 0, &format!("λ = {conicity}")),
            k_py * LBF_PER_FT,
        ) / MPH
    };
    for (conicity, flat) in [(0.05, 0.02), (0.1, 0.07), (0.15, 0.08), (0.25, 0.08)] {
        let [soft, bend, stiff] = [2.1e4, 8e5, 4.9e6].map(|k| speed(conicity, k));
        assert!(
            (stiff / bend - 1.0).abs() < flat,
            "λ {conicity}: {bend} {stiff}"
        );
        assert!(bend / soft > 1.6, "λ {conicity}: {soft} {bend}");
    }
    for k_py in [2.1e4, 1e5, 5e5, 2e6] {
        let falling = CONICITIES.map(|conicity| speed(conicity, k_py));
        assert!(falling.is_sorted_by(|a, b| a > b), "{k_py}: {falling:?}");
    }
}

/// 4.5.3: for small K_b the critical speed is below the operating speed; it rises with K_b and
/// falls again towards a rigid truck. As conicity grows it falls (but for K_b below 1.8e5
/// ft-lb/rad, where small conicities hunt at low speeds: validation.md). 4.5.4: a higher critical
/// speed needs a higher K_b, and so does a greater conicity at the same speed.
#[test]
fn figure_4_5_9() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.5.9");
    let own = curve(&figure, 0, "λ = 0.05");
    let top = own.points().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    assert!(at(own, 2e5 * LBF_FT) < 110.0 * MPH);
    assert!(at(own, 1.9e7 * LBF_FT) < 0.85 * top[1]);
    assert!((3e6..7e6).contains(&(top[0] / LBF_FT)), "{top:?}");
    let speeds = |k_b: f64| {
        CONICITIES.map(|conicity| at(curve(&figure, 0, &format!("λ = {conicity}")), k_b * LBF_FT))
    };
    for k_b in [2e5, 1e6, 3e6, 1e7] {
        let falling = speeds(k_b);
        assert!(falling.is_sorted_by(|a, b| a > b), "{k_b}: {falling:?}");
    }
    let soft = speeds(1.1e5);
    assert!(soft[..3].iter().all(|v| *v < soft[4]), "{soft:?}");
    let needed = |conicity: f64, speed: f64| {
        let points: Vec<[f64; 2]> = curve(&figure, 0, &format!("λ = {conicity}"))
            .points()
            .collect();
        let reached = points.iter().find(|p| p[1] >= speed * MPH);
        reached.map_or(f64::INFINITY, |p| p[0] / LBF_FT)
    };
    for speed in [100.0, 150.0] {
        let rising = CONICITIES.map(|conicity| needed(conicity, speed));
        assert!(rising.is_sorted_by(|a, b| a < b), "{speed} mph: {rising:?}");
    }
    for conicity in CONICITIES {
        let rising = [100.0, 125.0, 150.0, 170.0].map(|speed| needed(conicity, speed));
        assert!(
            rising.is_sorted_by(|a, b| a < b),
            "λ {conicity}: {rising:?}"
        );
    }
}

/// 4.7 reads 220 and 270 mph off Figure 4.6.5 at half the primary stiffness, for 1e6 and 6e6
/// ft-lb/rad: read to 10 mph. Below 5e6 the critical speed should hardly depend on K_sψ: here
/// below 1e6; above it rises (validation.md).
#[test]
fn figure_4_6_5() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.6.5");
    let half = curve(&figure, 0, "0.5 × primary stiffnesses");
    let speed = |k: f64| at(half, k * LBF_FT) / MPH;
    assert!((speed(1e6) - 220.0).abs() < 5.0, "{}", speed(1e6));
    assert!((speed(6e6) - 270.0).abs() < 12.0, "{}", speed(6e6));
    assert!(speed(1e6) / speed(1.1e5) < 1.06);
    let rising = [1e6, 3e6, 6e6, 1e7].map(speed);
    assert!(rising.is_sorted_by(|a, b| a < b), "{rising:?}");
    for label in ["design’s primary stiffnesses", "2 × primary stiffnesses"] {
        let speed = |k: f64| at(curve(&figure, 0, label), k * LBF_FT);
        assert!(speed(1e6) / speed(1.1e5) < 1.08);
        assert!((1.2..1.35).contains(&(speed(5e6) / speed(1e6))));
    }
}

/// What 4.7 reads off Figures 4.6.1 and 4.6.2 at the designs of its examples. The critical speed of
/// the second, 160 mph, is 143 mph here and 139 mph in the report's own full model.
#[test]
fn readings_of_the_contours() {
    let spec = stability_column();
    let mut book = workbook(&spec);
    book.grid = 25;
    let read = |conicity: usize, k_b: f64, k_py: f64| {
        let [x, y] = book.stiffness_axes();
        let field = book.stability_curving(conicity);
        let at = [k_b * LBF_FT, k_py * LBF_PER_FT];
        [0, 1].map(|layer| field.value(layer, at, [&x, &y]).unwrap())
    };
    let [degree, speed] = read(1, 1.8e6, 2e5);
    assert_ratio("example 1, degree curve", degree, 1.5, 0.09);
    assert_ratio("example 1, critical speed", speed / MPH, 200.0, 0.05);
    let [degree, speed] = read(2, 2e6, 2e5);
    assert_ratio("example 2, degree curve", degree, 2.2, 0.04);
    assert_ratio("example 2, critical speed", speed / MPH, 0.89 * 160.0, 0.02);
}

/// 4.5.4: above 175 mph λ = 0.05 allows the tightest curves, from 100 to 175 mph λ = 0.1, below
/// λ = 0.15 (and 0.25, which is not so here: validation.md). Our curves cross at 88 and 169 mph, so
/// speeds within 10 % of the report's two are not asked about.
#[test]
fn figure_4_5_13() {
    let spec = stability_column();
    let mut book = workbook(&spec);
    book.grid = 25;
    let figure = figure(&book, "4.5.13");
    let best = |speed: f64| {
        let degree = |conicity: f64| at(curve(&figure, 0, &format!("λ = {conicity}")), speed * MPH);
        CONICITIES
            .into_iter()
            .filter(|conicity| degree(*conicity).is_finite())
            .max_by(|a, b| degree(*a).total_cmp(&degree(*b)))
            .unwrap()
            .to_string()
    };
    for speed in [60.0, 70.0, 80.0] {
        assert_eq!(best(speed), "0.15", "{speed}");
    }
    for speed in [110.0, 125.0, 140.0, 155.0] {
        assert_eq!(best(speed), "0.1", "{speed}");
    }
    for speed in [193.0, 225.0, 250.0] {
        assert_eq!(best(speed), "0.05", "{speed}");
    }
    let at_75 = |conicity: f64| at(curve(&figure, 0, &format!("λ = {conicity}")), 75.0 * MPH);
    assert!(at_75(0.25) < 0.9 * at_75(0.1));
}

/// 4.5.2: above 7500 ft-lb the degree curve does not depend on T_sψ for K_sψ below 1e6 ft-lb/rad.
/// Appendix A: it is degraded in proportion to the torque.
#[test]
fn figure_a_2() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "A.2");
    let degree = |label: &str, torque: f64| at(curve(&figure, 0, label), torque * LBF_FT);
    for label in ["K_sψ = 5×10^5 lbf ft/rad", "K_sψ = 10^6 lbf ft/rad"] {
        assert_ratio(label, degree(label, 19_000.0), degree(label, 7500.0), 1e-9);
    }
    let stiff = |torque: f64| degree("K_sψ = 6×10^6 lbf ft/rad", torque);
    let lost = stiff(0.0) - stiff(12_000.0);
    assert!(lost > 0.2);
    for torque in [3000.0, 6000.0, 9000.0] {
        let share = (stiff(0.0) - stiff(torque)) / lost;
        assert!(
            (share - torque / 12_000.0).abs() < 0.01,
            "{torque}: {share}"
        );
    }
}
