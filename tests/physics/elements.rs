//! Suspension elements and ends that differ: limits in which a vehicle is one known from elsewhere.

use crate::support::random_vehicle;
use bogie::{
    case::{Case, TruckRoll},
    dynamics::{LateralModel, VerticalModel},
    evaluate::Evaluation,
    parameter::Parameter,
};
use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

fn number(name: &str) -> Parameter {
    Parameter::named(name).expect(name)
}

/// Largest difference of two matrices over the largest entry.
fn apart(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    (a - b).amax() / a.amax()
}

/// K_ar = d_s² K_sz per truck is half as much roll stiffness again as that of its springs, 2 d_s² K_sz: the lateral
/// model, where these springs act in roll alone, is that with 1.5 K_sz. 1e-15: the same sums in another order.
#[test]
fn an_anti_roll_bar_is_roll_stiffness() {
    for roll in [TruckRoll::Prescribed, TruckRoll::Dynamic] {
        let mut with_bar = Case::prototype();
        with_bar.model.truck_roll = roll;
        let mut stiffer = with_bar.clone();
        let vehicle = &mut with_bar.vehicle;
        let k_sz = vehicle.suspension.secondary.vertical_stiffness;
        let d_s = vehicle.truck.half_secondary_spacing;
        vehicle.suspension.anti_roll_bar = Some(d_s * d_s * k_sz);
        stiffer.vehicle.suspension.secondary.vertical_stiffness = 1.5 * k_sz;
        let [a, b] = [&with_bar, &stiffer].map(|case| LateralModel::new(case).forced.system);
        assert!(apart(&a.stiffness, &b.stiffness) < 1e-15);
        assert_eq!(a.damping, b.damping);
    }
}

/// In the vertical model a bar stiffens roll of carbody, truck frames and torsion, and leaves heave, pitch and
/// bending alone. Its force is odd in the lateral direction: a vehicle that only heaves and pitches does not feel it.
#[test]
fn an_anti_roll_bar_does_not_feel_heave() {
    let plain = Case::prototype();
    let mut with_bar = plain.clone();
    with_bar.vehicle.suspension.anti_roll_bar = Some(1e6);
    let [a, b] = [&plain, &with_bar].map(|case| VerticalModel::new(case).forced.system.stiffness);
    let change = b - a;
    // q = [z_c, φ_c, θ_c, u_b, u_1, u_2, (z_t, φ_t, θ_t)×2]
    let rolls = [1, 4, 5, 7, 10];
    for (i, row) in change.row_iter().enumerate() {
        for (j, entry) in row.iter().enumerate().take(12) {
            let in_roll = rolls.contains(&i) && rolls.contains(&j);
            assert!(in_roll || *entry == 0.0, "{i} {j}: {entry}");
        }
    }
    // Both bars at the carbody, one at each frame.
    let near = |entry: f64, expected: f64| (entry / expected - 1.0).abs() < 1e-9;
    assert!(near(change[(1, 1)], 2e6) && near(change[(7, 7)], 1e6) && near(change[(1, 7)], -1e6));
}

/// No bar, and a bar without stiffness, are the same bits.
#[test]
fn a_bar_without_stiffness_is_none() {
    let plain = Case::prototype();
    let mut with_bar = plain.clone();
    with_bar.vehicle.suspension.anti_roll_bar = Some(0.0);
    let models = [&plain, &with_bar].map(|case| LateralModel::new(case).forced.digest(&[]));
    assert_eq!(models[0], models[1]);
}

/// A trailing end given in full as the leading one is: the same bits in every index.
#[test]
fn ends_that_are_alike_are_one() {
    let mut rng = ChaCha8Rng::seed_from_u64(18);
    for _ in 0..4 {
        let plain = random_vehicle(&mut rng, 1.5);
        let mut given = plain.clone();
        for parameter in Parameter::plain().filter(|p| p.name().starts_with("trailing.")) {
            if let Some(value) = parameter.find(&plain) {
                parameter.set(&mut given, value);
            }
        }
        assert!(given.vehicle.trailing.is_some());
        let [a, b] = [&plain, &given].map(|case| format!("{:?}", Evaluation::new(case)));
        assert_eq!(a, b);
    }
}

/// Ends that differ, exchanged, with the direction of travel: on tangent track without wheel–rail forces the
/// vehicle is the other one seen from behind, so that the suspension's eigenvalues are the same.
#[test]
fn exchanged_ends_are_the_vehicle_from_behind() {
    let names = [
        "suspension.primary.lateral_stiffness",
        "suspension.primary.longitudinal_stiffness",
        "suspension.secondary.lateral_stiffness",
        "suspension.secondary.yaw_stiffness",
        "suspension.secondary.vertical_damping",
        "suspension.primary.vertical_stiffness",
        "vehicle.truck.mass",
        "vehicle.truck.half_wheelbase",
        "vehicle.wheelset.mass",
    ];
    let mut case = Case::prototype();
    let mut exchanged = case.clone();
    for (k, name) in names.into_iter().enumerate() {
        let leading = bogie::spec::keys::at(name).expect(name);
        let trailing = number(&format!("trailing.{name}"));
        let value = leading.get(&case).expect(name);
        let other = (1.2 + 0.1 * k as f64) * value;
        leading.set(&mut case, value);
        trailing.set(&mut case, other);
        leading.set(&mut exchanged, other);
        trailing.set(&mut exchanged, value);
    }
    let sorted = |case: &Case| {
        let system = VerticalModel::new(case).forced.system;
        let mut values = bogie::numerics::eigenvalues(system.state_matrix(50.0)).unwrap();
        values.sort_by(|a, b| (a.re, a.im).partial_cmp(&(b.re, b.im)).unwrap());
        values
    };
    for (a, b) in sorted(&case).iter().zip(sorted(&exchanged)) {
        // 1e-9: rounding of the Schur form over eigenvalues a hundred times smaller.
        assert!(
            (a - b).norm_sqr().sqrt() < 1e-9 * a.norm_sqr().sqrt(),
            "{a} {b}"
        );
    }
    assert!(LateralModel::new(&case).forced.system.alike.is_empty());
    assert!(
        !LateralModel::new(&Case::prototype())
            .forced
            .system
            .alike
            .is_empty()
    );
}
