//! How far the parts of an evaluation are from what the processor could do at best:
//! `cargo bench --bench floor`.
//!
//! Counts the floating-point operations that each part cannot do without, with its own method, and
//! sets the time that they would take at the measured peak rate against the time that the part takes.

mod count;
mod peak;

use std::{hint::black_box, time::Instant};

use bogie::{
    case::Case,
    dynamics::{ForcedModel, LateralModel, VerticalModel},
    evaluate::{
        curving::CurvingLimits,
        ride::{LateralRide, VerticalRide, panels::response_panels, response::Response},
        stability::Stability,
    },
    numerics::{
        Eigenpairs, Poles, Refiner,
        elimination::{LANES, Lanes},
        quadrature::integrate,
    },
};
use count::Elimination;

/// Shortest time of many runs, µs: the one that the rest of the machine disturbed least.
fn microseconds<T>(mut run: impl FnMut() -> T) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..2000 {
        let start = Instant::now();
        black_box(run());
        least = least.min(start.elapsed().as_secs_f64());
    }
    1e6 * least
}

/// Batches of [`LANES`] frequencies that a ride takes.
fn batches(model: &ForcedModel, case: &Case, poles: &Poles) -> f64 {
    let mut response = Response::new(model, &case.service.track, case.service.speed);
    let mut count = 0;
    // To the tolerance of the ride.
    integrate(
        &response_panels(model, case, poles),
        [model.outputs.len(); 2],
        1e-6,
        |f, values| {
            response.densities(f, values);
            count += 1;
        },
    );
    f64::from(count)
}

/// Corrections of all eigenvalues at once that the prototype takes.
const ITERATIONS: f64 = 3.0;

struct Table {
    /// Operations per µs.
    peak: f64,
}

impl Table {
    fn row(&self, part: &str, operations: f64, measured: f64) {
        let least = operations / self.peak;
        println!(
            "| {part} | {operations:.0} | {least:.1} | {measured:.1} | {:.0} % |",
            100.0 * least / measured
        );
    }
}

fn main() {
    let case = Case::prototype();
    let (lateral, vertical) = (LateralModel::new(&case), VerticalModel::new(&case));
    let at = |model: &ForcedModel| Poles::at(model, case.service.speed);
    let (Ok(lateral_poles), Ok(vertical_poles)) = (at(&lateral.forced), at(&vertical.forced))
    else {
        println!("the prototype has no eigenvalues");
        return;
    };
    let lanes = LANES as f64;
    let operations = peak::OPERATIONS as f64;
    let table = Table {
        peak: operations / microseconds(|| peak::run(black_box(0.5))),
    };
    println!(
        "Peak of one core: {:.1} double-precision operations per ns, multiplication and addition \
         counted apart.\n",
        table.peak / 1e3
    );
    println!("| part | operations | at the peak, µs | measured, µs | share |");
    println!("|---|---|---|---|---|");

    let cubes = |orders: &[f64]| 10.0 * orders.iter().map(|n| n.powi(3)).sum::<f64>();
    let elimination = Elimination::of(&lateral.forced.system);
    let upper = lateral_poles.values.iter().filter(|s| s.im >= 0.0).count();
    table.row(
        "eigenvalues, lateral model: 10 Σ n³, n = 12, 6, and three corrections of all",
        cubes(&[12.0, 6.0]) + ITERATIONS * upper as f64 * elimination.correction(),
        microseconds(|| at(black_box(&lateral.forced))),
    );
    table.row(
        "eigenvalues, vertical model: 10 Σ n³, n = 6, 6, 4, 4, 2, 2",
        cubes(&[6.0, 6.0, 4.0, 4.0, 2.0, 2.0]),
        microseconds(|| at(black_box(&vertical.forced))),
    );

    let system = &lateral.forced.system;
    let mut refiner = Refiner::new(lateral.forced.stiffness());
    let s = lateral_poles.values[0] * 1.001;
    let mut pairs = Eigenpairs::near(
        Lanes::from_fn(|_| s),
        [case.service.speed; LANES],
        system.order(),
    );
    let step = lanes * elimination.rayleigh_step();
    let step_time = microseconds(|| refiner.step(&mut pairs));
    table.row("one step of eight modes", step, step_time);
    let built = microseconds(|| LateralModel::new(black_box(&case)));
    let known = microseconds(|| at(black_box(&lateral.forced)));
    let whole = microseconds(|| Stability::of(black_box(&case)));
    let following = whole - built - known;
    let steps = following / step_time;
    let part = format!("following modes over the speed: at most {steps:.0} steps");
    table.row(&part, steps * step, following);

    let count = batches(&lateral.forced, &case, &lateral_poles);
    let batch = lanes * elimination.response(lateral.forced.excitations.len());
    let measured = microseconds(|| LateralRide::from_poles(&lateral, &case, &lateral_poles));
    let part = format!("lateral ride: {count} batches of {LANES} frequencies");
    table.row(&part, count * batch, measured);

    let count = batches(&vertical.forced, &case, &vertical_poles);
    let elimination = Elimination::of(&vertical.forced.system);
    let batch = lanes * elimination.response(vertical.forced.excitations.len());
    let measured = microseconds(|| VerticalRide::from_poles(&vertical, &case, &vertical_poles));
    let part = format!("vertical ride: {count} batches of {LANES} frequencies");
    table.row(&part, count * batch, measured);

    // Four matrices, nine states of the yaw elements with two right sides each.
    let n = 15.0_f64;
    let curving = 4.0 * 2.0 / 3.0 * n.powi(3) + 9.0 * 2.0 * 2.0 * n * n;
    let measured = microseconds(|| CurvingLimits::new(black_box(&case), 0.0));
    table.row(
        "degree curves: 4 factorisations, 18 solutions",
        curving,
        measured,
    );
}
