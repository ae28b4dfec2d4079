//! Wheel load equalization: how much a wheel's load changes as it is raised (3.3.2).

use nalgebra::DVector;

use crate::{case::Case, dynamics::VerticalModel, evaluate::limits::RAISE};

/// Change of the load of each wheel of the leading truck as the left wheel of wheelset 1 is
/// raised by [`RAISE`], N: left and right of wheelset 1, left and right of wheelset 2.
///
/// Static: the vehicle settles on its springs, the truck frame being rigid. The springs at ±d_p
/// put F_l + F_r on the axle and d_p (F_l − F_r) about its centre, which the wheels at ±a take up.
/// `None` if the vehicle cannot settle.
pub fn wheel_load_changes(case: &Case) -> Option<[f64; 4]> {
    let model = VerticalModel::new(case);
    let system = &model.forced.system;
    let n = system.order();
    let a = case.vehicle.wheelset.half_contact_distance;
    let d_p = case.vehicle.truck.half_primary_spacing;
    let mut u = DVector::zeros(system.inputs);
    u[0] = RAISE / 2.0;
    u[4] = RAISE / (2.0 * a);
    let load = -system.stiffness.columns(n, system.inputs) * &u;
    let q = system.static_stiffness().lu().solve(&load)?;
    let k = case.vehicle.suspension.primary.vertical_stiffness;
    let b = case.vehicle.truck.half_wheelbase;
    let (z_t, phi_t, theta_t) = (q[6], q[7], q[8]);
    let mut changes = [0.0; 4];
    for (i, x) in [b, -b].into_iter().enumerate() {
        let [left, right] = [d_p, -d_p].map(|y| {
            let frame = z_t - x * theta_t + y * phi_t;
            // Force of the spring on the axle, downward positive: compression.
            k * (u[i] + y * u[4 + i] - frame)
        });
        let (sum, moment) = (left + right, d_p * (left - right));
        changes[2 * i] = f64::midpoint(sum, moment / a);
        changes[2 * i + 1] = (sum - moment / a) / 2.0;
    }
    changes.iter().all(|x| x.is_finite()).then_some(changes)
}
