//! What 4.3, 4.4 and 4.5.3 say of natural frequencies and damping.

use bogie::plot::{Curve, Figure};

use super::{
    at, figure, stability_column,
    support::{MPH, assert_ratio},
    workbook,
};

/// Frequency and damping ratio of the modes of that name.
fn mode(figure: &Figure, name: &str) -> [f64; 2] {
    let family = figure.panels[0].family("modes").unwrap();
    let found = family.curves.iter().find(|c| c.label == name);
    found.unwrap().points().next().unwrap()
}

/// 4.3: roll, heave and pitch in 0.6–1.1 Hz, flexible modes in 7–30 Hz, in the range of truck roll
/// and heave.
#[test]
fn figure_4_3_1() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.3.1");
    for name in ["carbody roll", "carbody heave", "carbody pitch"] {
        assert!((0.6..1.1).contains(&mode(&figure, name)[0]), "{name}");
    }
    for name in [
        "carbody bending",
        "carbody torsion, first",
        "carbody torsion, second",
        "truck roll",
        "truck bounce",
    ] {
        assert!((7.0..30.0).contains(&mode(&figure, name)[0]), "{name}");
    }
}

/// 4.4 at 110 mph: carbody modes between 0.4 and 1.1 Hz, the kinematic mode at 2.16 Hz, a
/// wheelset–truck mode at 6.16 Hz (6.61 Hz here: validation.md), the others above 10 Hz.
#[test]
fn figure_4_4_1() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.4.1");
    for name in ["carbody lower sway", "carbody upper sway", "carbody yaw"] {
        assert!((0.4..1.1).contains(&mode(&figure, name)[0]), "{name}");
    }
    assert_ratio("kinematic", mode(&figure, "truck hunting")[0], 2.16, 0.02);
    assert_ratio("wheelset", mode(&figure, "wheelset lateral")[0], 6.16, 0.08);
    for name in ["truck lateral", "truck yaw"] {
        assert!(mode(&figure, name)[0] > 10.0, "{name}");
    }
}

/// 4.5.3: the kinematic modes' damping falls as the speed rises, to zero at 280 mph; the carbody's
/// modes hardly depend on it.
#[test]
fn figure_4_5_7() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.5.7");
    let panel = &figure.panels[0];
    let kinematic = &panel.family("kinematic").unwrap().curves;
    assert!(!kinematic.is_empty());
    for mode in kinematic {
        let falling = [80.0, 110.0, 150.0, 200.0, 250.0, 290.0].map(|v| at(mode, v * MPH));
        assert!(falling.is_sorted_by(|a, b| a > b), "{falling:?}");
    }
    let zero = kinematic
        .iter()
        .flat_map(|mode| mode.pieces.iter().flat_map(|piece| piece.windows(2)))
        .find(|w| w[0][1] > 0.0 && w[1][1] <= 0.0)
        .unwrap()[0][0];
    assert_ratio("critical speed", zero / MPH, 280.0, 0.02);
    // The second critical mode, of the wheelsets, is damped less and less too.
    let second = panel.family("other").unwrap().curves.iter();
    let second = second.filter(|mode: &&Curve| at(mode, 110.0 * MPH) > 0.9);
    let falls = |mode: &Curve| {
        [50.0, 110.0, 150.0, 280.0]
            .map(|v| at(mode, v * MPH))
            .is_sorted_by(|a, b| a > b)
    };
    assert!(second.clone().count() > 0 && second.clone().all(falls));
    let carbody = panel.family("other").unwrap().curves.iter();
    let flat = carbody.filter(|mode: &&Curve| at(mode, 110.0 * MPH) < 0.3);
    assert_eq!(
        flat.inspect(|mode| {
            let values = [60.0, 110.0, 200.0, 280.0].map(|v| at(mode, v * MPH));
            let spread = values
                .iter()
                .fold(0.0, |s: f64, v| s.max((v - values[1]).abs()));
            assert!(spread < 0.02, "{values:?}");
        })
        .count(),
        3
    );
}
