//! Cost of one evaluation and its parts, for the prototype: `cargo bench --bench evaluate`.

use bogie::{
    case::Case,
    design::measure::{Wanted, measure, measure_graded},
    dynamics::{LateralModel, VerticalModel},
    evaluate::{
        Evaluation,
        curving::CurvingLimits,
        ride::{LateralRide, VerticalRide},
        stability::Stability,
    },
    index::Index,
    numerics::Poles,
    parameter::Parameter,
};
use divan::{Bencher, black_box, counter::ItemsCount};
use rayon::prelude::*;

#[path = "floor/peak.rs"]
mod peak;

fn main() {
    divan::main();
}

/// Everything that `bogie evaluate` computes of a spec.
#[divan::bench]
fn full_evaluation(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| Evaluation::new(black_box(&case)));
}

/// Critical speed, degree curves and both rides: what `benches/numpy` computes too.
#[divan::bench]
fn compared_indices(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| {
        let case = black_box(&case);
        let lateral = LateralModel::new(case);
        let vertical = VerticalModel::new(case);
        let speed = case.service.speed;
        let lateral_poles = Poles::at(&lateral.forced, speed)?;
        let vertical_poles = Poles::at(&vertical.forced, speed)?;
        Stability::new(&lateral, &lateral_poles, case.model.speed_range, 1.0).map(|stability| {
            (
                stability,
                CurvingLimits::new(case, 0.0),
                LateralRide::from_poles(&lateral, case, &lateral_poles),
                VerticalRide::from_poles(&vertical, case, &vertical_poles),
            )
        })
    });
}

#[divan::bench]
fn lateral_model(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| LateralModel::new(black_box(&case)));
}

#[divan::bench]
fn vertical_model(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| VerticalModel::new(black_box(&case)));
}

#[divan::bench]
fn lateral_poles(bencher: Bencher) {
    let model = LateralModel::new(&Case::prototype());
    bencher.bench_local(|| Poles::at(&model.forced, black_box(50.0)));
}

#[divan::bench]
fn vertical_poles(bencher: Bencher) {
    let model = VerticalModel::new(&Case::prototype());
    bencher.bench_local(|| Poles::at(&model.forced, black_box(50.0)));
}

/// By following the modes, as the program does it; model and poles included.
#[divan::bench]
fn critical_speed(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| Stability::of(black_box(&case)));
}

/// By full spectra on a grid of speeds, where modes cannot be followed; model included.
#[divan::bench]
fn critical_speed_by_spectra(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| {
        Stability::by_spectra(&LateralModel::new(black_box(&case)), case.model.speed_range)
    });
}

/// Flange- and slip-limited; model included.
#[divan::bench]
fn degree_curves(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| CurvingLimits::new(black_box(&case), 0.0));
}

/// From a model; poles included.
#[divan::bench]
fn lateral_ride(bencher: Bencher) {
    let case = Case::prototype();
    let model = LateralModel::new(&case);
    bencher.bench_local(|| LateralRide::new(black_box(&model), &case));
}

/// From a model; poles included.
#[divan::bench]
fn vertical_ride(bencher: Bencher) {
    let case = Case::prototype();
    let model = VerticalModel::new(&case);
    bencher.bench_local(|| VerticalRide::new(black_box(&model), &case));
}

/// Critical speed, degree curves and both rides as the optimiser measures them.
const INDICES: [Wanted; 4] = [
    Wanted::Index(Index::CriticalSpeed),
    Wanted::Index(Index::DegreeCurve),
    Wanted::Index(Index::LateralAcceleration),
    Wanted::Index(Index::VerticalAcceleration),
];

#[divan::bench]
fn indices(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| measure(black_box(&case), &INDICES));
}

/// The same with the derivatives by all ten constants of Table 4.1.1.
#[divan::bench]
fn indices_with_gradients(bencher: Bencher) {
    let case = Case::prototype();
    let ten: Vec<Parameter> = Parameter::plain_of_table().collect();
    bencher.bench_local(|| measure_graded(black_box(&case), &INDICES, &ten));
}

/// Critical speed and degree curve of 100 × 100 designs in K_b and K_py, a tenth to ten times the
/// prototype's: the work of a design chart.
#[divan::bench(args = [1, 2], sample_count = 3, sample_size = 1)]
fn chart_grid(bencher: Bencher, threads: usize) {
    const SIDE: u32 = 100;
    let factor = |i: u32| 10_f64.powf(2.0 * f64::from(i) / f64::from(SIDE - 1) - 1.0);
    let designs: Vec<Case> = (0..SIDE * SIDE)
        .map(|k| {
            let mut case = Case::prototype();
            let primary = &mut case.vehicle.suspension.primary;
            primary.longitudinal_stiffness *= factor(k / SIDE);
            primary.lateral_stiffness *= factor(k % SIDE);
            case
        })
        .collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.expect("threads");
    bencher
        .counter(ItemsCount::new(designs.len()))
        .bench_local(|| {
            let evaluate = |case: &Case| (Stability::of(case), CurvingLimits::new(case, 0.0));
            pool.install(|| designs.par_iter().map(evaluate).collect::<Vec<_>>())
        });
}

/// Floating-point operations that one core can do at most.
#[divan::bench]
fn peak_operations(bencher: Bencher) {
    bencher
        .counter(ItemsCount::new(peak::OPERATIONS))
        .bench_local(|| peak::run(black_box(0.5)));
}
