//! What 3.2 and 3.4 say of the limits of unbalance and of the track.

use bogie::units::us::{FOOT, INCH};

use super::{figure, stability_column, support::assert_ratio, workbook};

/// 3.4.2: class 6 has A_v = A_a, and one break wavenumber: profile and alignment are alike.
#[test]
fn figure_3_4_2() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "3.4.2");
    let own = &figure.panels[0].family("track").unwrap().curves;
    assert_eq!(own.len(), 2);
    assert_eq!(own[0].pieces, own[1].pieces);
    // (3.4.2-2) at 1 rad/ft: A_v Ω_c²/(Ω²(Ω² + Ω_c²)).
    let [omega, density] = own[0].points().last().unwrap();
    assert_ratio("wavenumber", omega * FOOT, 1.0, 1e-12);
    let square = (2.0 * std::f64::consts::PI / 25.0_f64).powi(2);
    let printed = 0.00159 * square / (1.0 + square);
    assert_ratio("density", density / (INCH * INCH * FOOT), printed, 1e-9);
}

/// 3.2.3: the boundaries are (3.2-2) put into (3.2-1) with 6 in of superelevation, and rest on 6 in
/// and, in yards, 1 in. By the rounded 0.0007 of (3.2-2) the first is not the 3.07° of 4.5.2.
#[test]
fn figure_3_2_5() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "3.2.5");
    let bounds = &figure.panels[0].family("boundary").unwrap().curves;
    let degrees: Vec<f64> = bounds
        .iter()
        .map(|curve| curve.points().last().unwrap()[1].to_degrees())
        .collect();
    // (6 + 3)/0.0007 mph² on a curve of 5730 ft/D over 56 in, minus 6 in; 3.07° over 3 in.
    let speed = (9.0_f64 / 0.0007).sqrt() * 5280.0 / 3600.0;
    let fra = (speed * speed / 5730.0 / 32.174 - 6.0 / 56.0).to_degrees();
    assert!((degrees[0] - fra).abs() < 0.03, "{} {fra}", degrees[0]);
    assert!(degrees[0] < 2.6);
    assert!((degrees[1] + 6.14).abs() < 0.005);
    assert!((degrees[2] + 1.023).abs() < 0.005);
}
