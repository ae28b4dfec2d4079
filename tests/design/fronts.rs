//! Fronts, and what the report reads off its own (4.5.4).

use crate::support::{LBF_FT, LBF_PER_FT, MPH};
use bogie::{
    case::Case,
    design::{margin::value, pareto::pareto, search, study::Study},
    index::Index,
    optimize::{
        archive::{Archive, Silent},
        local::Status,
        solve::Start,
    },
    parameter::Parameter,
    spec::{Interval, Spec},
};

/// Highest degree curve, degrees, that a profile allows at a critical speed, over the ranges of the
/// report's charts; `None` if it does not reach that speed.
fn best_curve(conicity: f64, mph: f64) -> Option<f64> {
    let mut case = Case::prototype();
    case.wheel_rail.conicity = conicity;
    let bending = Interval::from([1e5 * LBF_FT, 2e7 * LBF_FT]);
    let lateral = Interval::from([4e4 * LBF_PER_FT, 5e6 * LBF_PER_FT]);
    let study = Study::new(&case, &[])
        .vary(Parameter::PRIMARY_BENDING_STIFFNESS, bending)
        .vary(Parameter::PRIMARY_LATERAL_STIFFNESS, lateral)
        .optimise(0, Index::DegreeCurve, 0, 1.0)
        .demand(0, Index::CriticalSpeed, mph * MPH);
    let archive = Archive::new(&Silent);
    let found = search(&study, &Start::everywhere(1), &archive)
        .unwrap()
        .solved;
    let values = found.point.values.unwrap();
    (found.status == Status::Optimal).then(|| (-values.objective()).exp().to_degrees())
}

/// Figure 4.5.13 as 4.5.4 reads it: above 175 mph a conicity of 0.05 curves best, between 100 and
/// 175 mph 0.10, and as the speed falls a larger one. In our model the first two change places
/// between 166 and 179 mph, and 0.15 takes over below 80 mph, where the report says 100.
#[test]
fn each_critical_speed_has_its_profile() {
    for (mph, best) in [
        (200.0, 0.05),
        (180.0, 0.05),
        (160.0, 0.10),
        (110.0, 0.10),
        (75.0, 0.15),
    ] {
        let curves = [0.05, 0.10, 0.15, 0.25].map(|conicity| (conicity, best_curve(conicity, mph)));
        let winner = curves
            .iter()
            .filter_map(|(conicity, curve)| Some((*curve.as_ref()?, *conicity)))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(winner.map(|w| w.1), Some(best), "{mph} mph: {curves:?}");
    }
}

fn front(text: &str) -> (Spec, Vec<Vec<f64>>) {
    let source = format!(
        "[service]\nspeed = \"110 mph\"\ntrack = \"fra-class-6\"\n[vehicle]\nbase = \"prototype\"\n\
         [design]\nsecondary_lateral_frequency = [\"0.5 Hz\", \"1.5 Hz\"]\n\
         secondary_lateral_damping_ratio = [0.1, 0.8]\n{text}"
    );
    let spec = Spec::parse(&source).unwrap_or_else(|m| panic!("{}", m.render("", &source, false)));
    let front = pareto(&spec, &Archive::new(&Silent));
    assert!(front.stopped.is_none());
    // Every point between the ends is an optimum.
    for point in &front.points {
        let is_end = (0..point.values.len())
            .any(|k| front.points.iter().all(|p| p.values[k] >= point.values[k]));
        let status = point.explained.status;
        assert!(
            is_end || status == Status::Optimal,
            "{:?} {status:?}",
            point.values
        );
    }
    let values: Vec<Vec<f64>> = front.points.iter().map(|p| p.values.clone()).collect();
    // Smaller is better in all indices used here.
    for a in &values {
        for b in &values {
            let better = a.iter().zip(b).all(|(a, b)| *a < b * (1.0 - 1e-5));
            assert!(!better, "{a:?} dominates {b:?}");
        }
    }
    (spec, values)
}

/// Figure 4.4.3: as the stroke is allowed to grow the acceleration falls, and the points lie evenly
/// between the least of either.
#[test]
fn lateral_ride_against_stroke() {
    let (spec, values) = front(
        "[pareto]\nindices = [\"secondary_lateral_stroke\", \"lateral_acceleration\"]\npoints = 10\n",
    );
    assert_eq!(values.len(), spec.front.points);
    assert!(
        values
            .windows(2)
            .all(|w| w[0][0] < w[1][0] && w[0][1] > w[1][1])
    );
    let extent = |k: usize| {
        let logs = values.iter().map(|v| v[k].ln());
        logs.clone().fold(f64::MIN, f64::max) - logs.fold(f64::MAX, f64::min)
    };
    let extents = [extent(0), extent(1)];
    let gaps: Vec<f64> = values
        .windows(2)
        .map(|w| {
            let square = |k: usize| ((w[0][k] / w[1][k]).ln() / extents[k]).powi(2);
            (square(0) + square(1)).sqrt()
        })
        .collect();
    let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
    let widest = gaps.iter().copied().fold(0.0, f64::max);
    // Gaps are halved until there are points enough: none is left much wider than twice the mean.
    assert!(widest < 2.5 * mean, "{gaps:?}");
}

#[test]
fn three_indices() {
    let (_, values) = front(
        "[pareto]\nindices = [\"secondary_lateral_stroke\", \"lateral_acceleration\", \
         \"wheelset_excursion\"]\npoints = 8\n",
    );
    assert!(values.len() >= 4, "{}", values.len());
}

/// The vertical springs carry the carbody against roll, so that vertical ride has a little to do with
/// lateral: no point of the front gives much of one for hardly anything of another.
#[test]
fn no_point_is_a_bad_bargain() {
    let (_, values) = front(
        "secondary_vertical_frequency = [\"0.7 Hz\", \"1.5 Hz\"]\n\
         secondary_vertical_damping_ratio = [0.1, 0.6]\n\
         [pareto]\nindices = [\"secondary_lateral_stroke\", \"lateral_acceleration\", \
         \"vertical_acceleration\"]\npoints = 8\n",
    );
    assert!(values.len() >= 4, "{}", values.len());
    let better = |a: &[f64], b: &[f64]| {
        let pairs = a.iter().zip(b);
        pairs.map(|(a, b)| (b / a).ln()).fold(0.0, f64::max)
    };
    for a in &values {
        for b in &values {
            assert!(better(a, b) <= 20.0 * better(b, a), "{a:?} {b:?}");
        }
    }
}

/// Forces in a curve are traded off only where the linear model covers it.
#[test]
fn forces_in_a_curve_are_traded_off_within_the_model() {
    let source = |degree: f64| {
        format!(
            "[service]\ncurve = \"{degree} deg\"\n[vehicle]\nbase = \"prototype\"\n[design]\n\
             primary_bending_stiffness = [\"2e5 lbf ft/rad\", \"1e7 lbf ft/rad\"]\n\
             primary_lateral_stiffness = [\"2e5 lbf/ft\", \"5e6 lbf/ft\"]\n\
             [pareto]\nindices = [\"wheel_l_over_v\", \"critical_speed\"]\npoints = 4\n"
        )
    };
    let front = |degree: f64| {
        let source = source(degree);
        let spec = Spec::read(source.as_bytes()).unwrap_or_else(|_| panic!("{source}"));
        pareto(&spec, &Archive::new(&Silent))
    };
    // Flange contact comes at 0.9° as the vehicle is given.
    let gentle = front(1.0);
    assert!(gentle.points.len() >= 3);
    for point in &gentle.points {
        let ratio = value(&point.case, Index::CurveLimitRatio).unwrap();
        assert!(ratio <= 1.0 + 1e-4, "{ratio}");
    }
    // No design within the bounds runs this curve without flange contact.
    assert_eq!(front(6.0).points.len(), 0);
}
