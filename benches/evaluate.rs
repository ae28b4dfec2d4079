//! Cost of one evaluation and its parts, for the prototype: `cargo bench --bench evaluate`.

use bogie::{
    case::Case,
    dynamics::{LateralModel, VerticalModel, eigenvalues},
    evaluate::{
        Evaluation,
        critical_speed::Stability,
        curving::CurvingLimits,
        ride::{LateralRide, VerticalRide},
    },
};
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

#[divan::bench]
fn full_evaluation(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| Evaluation::new(black_box(&case)));
}

#[divan::bench]
fn eigenvalues_at_one_speed(bencher: Bencher) {
    let model = LateralModel::new(&Case::prototype());
    bencher.bench_local(|| eigenvalues(model.forced.system.state_matrix(black_box(50.0))));
}

#[divan::bench]
fn critical_speed(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| {
        Stability::search(&LateralModel::new(black_box(&case)), case.model.speed_range)
    });
}

#[divan::bench]
fn degree_curves(bencher: Bencher) {
    let case = Case::prototype();
    bencher.bench_local(|| CurvingLimits::new(black_box(&case), 0.0));
}

#[divan::bench]
fn lateral_ride(bencher: Bencher) {
    let case = Case::prototype();
    let model = LateralModel::new(&case);
    bencher.bench_local(|| LateralRide::new(black_box(&model), &case));
}

#[divan::bench]
fn vertical_ride(bencher: Bencher) {
    let case = Case::prototype();
    let model = VerticalModel::new(&case);
    bencher.bench_local(|| VerticalRide::new(black_box(&model), &case));
}
