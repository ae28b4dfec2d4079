//! What 4.3, 4.6 and the design forms of 4.7 say of vertical ride.

use bogie::{dynamics::VerticalModel, evaluate::ride::VerticalRide, plot::Figure, units::us::INCH};

use super::{
    at, curve, figure, lateral_ride::net, stability_column, support::assert_ratio, workbook,
};

/// 4.6, step 19: an optimal combination has 0.15 ≤ ξ ≤ 0.4 and 0.7 ≤ f_n ≤ 1.2 Hz: at a given
/// stroke the least acceleration is found there.
#[test]
fn figure_4_6_18() {
    let spec = stability_column();
    let book = workbook(&spec);
    for (number, strokes) in [
        ("4.6.18", [0.34, 0.38, 0.42]),
        ("4.6.19", [0.24, 0.26, 0.28]),
    ] {
        let figure = figure(&book, number);
        for stroke in strokes {
            let (ratio, _) = best(&figure, stroke * INCH);
            assert!(
                (0.15..=0.4).contains(&ratio),
                "{number} {stroke} in: ξ {ratio}"
            );
        }
    }
}

/// The same at a given natural frequency in that range.
#[test]
fn damping_at_a_natural_frequency() {
    let spec = stability_column();
    let book = workbook(&spec);
    for number in ["4.6.18", "4.6.19"] {
        let figure = figure(&book, number);
        let least = figure.panels[0]
            .family("damping-ratio")
            .unwrap()
            .curves
            .iter()
            .map(|line| line.value.unwrap());
        for f in [0.7, 0.8, 0.9, 1.0, 1.2] {
            let (ratio, _) = least
                .clone()
                .map(|ratio| (ratio, net(&figure, f, ratio)[1]))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap();
            assert!((0.15..=0.4).contains(&ratio), "{number} {f} Hz: ξ {ratio}");
        }
    }
}

/// 4.3: the trade-off is to first order independent of the primary vertical suspension.
#[test]
fn the_primary_vertical_suspension_matters_little() {
    let spec = stability_column();
    let ride = |factor: f64| {
        let mut case = spec.case.clone();
        case.vehicle.suspension.primary.vertical_stiffness *= factor;
        let ride = VerticalRide::new(&VerticalModel::new(&case), &case).unwrap();
        [ride.average_stroke(), ride.average_acceleration()]
    };
    let [stroke, acceleration] = ride(1.0);
    for factor in [0.5, 2.0] {
        let [other_stroke, other_acceleration] = ride(factor);
        assert_ratio("stroke", other_stroke, stroke, 0.01);
        assert_ratio("acceleration", other_acceleration, acceleration, 0.05);
    }
}

/// 4.3: the primary contribution to the acceleration lies in 0–2 Hz, about 80 % of its RMS value.
/// Here the peak is there, but 65 and 64 % (validation.md).
#[test]
fn figure_4_3_2() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.3.2");
    for (panel, percent) in figure.panels.iter().zip(["64.6 %", "63.5 %"]) {
        let peak = panel.families[0].curves[0]
            .points()
            .max_by(|a, b| a[1].total_cmp(&b[1]))
            .unwrap();
        assert!((0.6..1.2).contains(&peak[0]), "{peak:?}");
        assert!(panel.shades[0].label.contains(percent));
    }
}

/// Damping ratio with the least acceleration at a stroke, among the net's lines.
fn best(figure: &Figure, stroke: f64) -> (f64, f64) {
    figure.panels[0]
        .family("damping-ratio")
        .unwrap()
        .curves
        .iter()
        .flat_map(|line| {
            let points: Vec<[f64; 2]> = line.points().collect();
            let value = line.value.unwrap();
            points
                .windows(2)
                .filter(|w| (w[0][0] - stroke) * (w[1][0] - stroke) <= 0.0)
                .map(|w| {
                    let t = (stroke - w[0][0]) / (w[1][0] - w[0][0]);
                    (value, w[0][1] + t * (w[1][1] - w[0][1]))
                })
                .collect::<Vec<_>>()
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap()
}

/// Strokes that both design forms read off the nets for f_n = 0.9 Hz, ξ = 0.25, between the charts'
/// speeds by their formula (with its divisor of 50). Accelerations are compared in validation.md.
#[test]
fn readings_of_the_nets() {
    let spec = stability_column();
    let book = workbook(&spec);
    let (fast, slow) = (figure(&book, "4.6.18"), figure(&book, "4.6.19"));
    // Between the lines for 0.2 and 0.3.
    let stroke =
        |figure: &Figure| f64::midpoint(net(figure, 0.9, 0.2)[0], net(figure, 0.9, 0.3)[0]) / INCH;
    for (speed, printed) in [(130.0, 0.406), (80.0, 0.291)] {
        let read = stroke(&fast) + (speed - 110.0) / 50.0 * (stroke(&fast) - stroke(&slow));
        assert_ratio("stroke", read, printed, 0.04);
    }
}

/// 4.3: as ω_n falls the stroke rises and the acceleration falls; as ξ rises the stroke falls;
/// very small ξ gives a large resonant peak, very large ξ transmits high frequencies.
#[test]
fn figure_4_3_3() {
    let spec = stability_column();
    let figure = figure(&workbook(&spec), "4.3.3");
    for (panel, f, sign) in [(0, 5.0, 1.0), (1, 0.4, -1.0)] {
        let values = [0.5, 0.7, 1.0, 1.4]
            .map(|f_n| sign * at(curve(&figure, panel, &format!("{f_n} Hz")), f));
        assert!(values.is_sorted_by(|a, b| a < b), "{panel}: {values:?}");
    }
    let peak = |panel: usize, xi: f64| {
        let curve = curve(&figure, panel, &format!("ξ = {xi}"));
        curve
            .points()
            .filter(|p| p[0] < 3.0)
            .map(|p| p[1])
            .fold(0.0, f64::max)
    };
    let strokes = [0.05, 0.1, 0.25, 0.8].map(|xi| peak(3, xi));
    assert!(strokes.is_sorted_by(|a, b| a > b), "{strokes:?}");
    let at_resonance = |xi: f64| at(curve(&figure, 2, &format!("ξ = {xi}")), 0.88);
    assert!(at_resonance(0.05) > 3.0 * at_resonance(0.25));
    let high = |xi: f64| at(curve(&figure, 2, &format!("ξ = {xi}")), 10.0);
    assert!(high(0.8) > 2.5 * high(0.25) && high(1.5) > high(0.8));
}
