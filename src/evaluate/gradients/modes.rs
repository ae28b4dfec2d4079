//! Derivatives of eigenvalues and of what is made of them.

use nalgebra::Complex;

use crate::{
    dynamics::ForcedTangent,
    evaluate::{modes::Mode, stability::Crossing},
    numerics::LinearSystem,
};

/// wᴴ D′ v with D′ = 2 s M + C(V).
fn weight(system: &LinearSystem, v: f64, mode: &Mode) -> Complex<f64> {
    let damping = system.damping_at(v);
    let d = system.stiffness_derivative_times(&damping, mode.eigenvalue, &mode.shape);
    mode.left.dotc(&d)
}

/// ∂s by each constant, at speed `v`, m/s.
pub fn by_constants(
    system: &LinearSystem,
    tangents: &[ForcedTangent],
    v: f64,
    mode: &Mode,
) -> Vec<Complex<f64>> {
    let weight = weight(system, v, mode);
    let s = mode.eigenvalue;
    let change =
        |tangent: &ForcedTangent| -tangent.system.between(&mode.left, s, v, &mode.shape) / weight;
    tangents.iter().map(change).collect()
}

/// ds/dV at speed `v`, m/s.
pub fn by_speed(system: &LinearSystem, v: f64, mode: &Mode) -> Complex<f64> {
    let n = system.order();
    let damping = system.damping_derivative_at(v);
    let force = damping.columns(0, n).map(Complex::from) * &mode.shape;
    -mode.eigenvalue * mode.left.dotc(&force) / weight(system, v, mode)
}

/// ∂V by each constant of the speed at which a mode loses its damping.
pub fn critical_speed(
    system: &LinearSystem,
    tangents: &[ForcedTangent],
    onset: &Crossing,
) -> Vec<f64> {
    let slope = by_speed(system, onset.speed, &onset.mode).re;
    let changes = by_constants(system, tangents, onset.speed, &onset.mode);
    changes.iter().map(|change| -change.re / slope).collect()
}
