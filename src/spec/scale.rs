//! Sizes beyond which a value is a slip of the unit or of the pen.

use crate::units::{Quantity, Range};

/// Least and greatest size of a quantity other than zero, SI.
///
/// Each end lies a factor of a hundred or more beyond anything that runs on rails, models on roller
/// rigs included (a tenth in length, a thousandth in mass). Within them squares and ratios of
/// constants stay far inside `f64`, so that no result overflows unseen.
const fn sizes(quantity: Quantity) -> [f64; 2] {
    match quantity {
        Quantity::Mass => [1e-3, 1e7],
        Quantity::Length => [1e-4, 1e4],
        Quantity::Stroke => [1e-7, 1e2],
        Quantity::Inertia => [1e-7, 1e10],
        Quantity::Stiffness => [1e-2, 1e13],
        Quantity::Damping => [1e-4, 1e11],
        Quantity::RotationalStiffness => [1e-4, 1e14],
        Quantity::RotationalDamping => [1e-5, 1e12],
        Quantity::Torque => [1e-5, 1e10],
        Quantity::Speed => [1e-3, 1e4],
        Quantity::Frequency => [1e-5, 1e6],
        Quantity::Angle | Quantity::DegreeOfCurve => [1e-9, 1e2],
        Quantity::Force => [1e-2, 1e12],
        Quantity::LateralSpinCreep => [1e-6, 1e11],
        Quantity::SpinCreep => [1e-9, 1e10],
        Quantity::Acceleration => [1e-7, 1e4],
        Quantity::Roughness => [1e-18, 1.0],
        Quantity::Wavenumber => [1e-6, 1e5],
        // Steep spectra span some twenty decades.
        Quantity::SpectralDensity => [1e-30, 1e3],
        Quantity::Dimensionless => [1e-9, 1e6],
    }
}

/// Whether a value is of a size that the quantity can have.
pub(super) fn is_in_scale(si: f64, quantity: Quantity) -> bool {
    let [least, most] = sizes(quantity);
    si == 0.0 || (least..=most).contains(&si.abs())
}

/// As in "expected a mass of size 1e-3 kg to 1e7 kg, or 0".
pub(super) fn in_words(quantity: Quantity, range: Range) -> String {
    let [least, most] = sizes(quantity).map(|si| {
        let unit = quantity.si();
        format!("{:e} {}", unit.of(si), unit.label)
            .trim_end()
            .to_owned()
    });
    let zero = if range.contains(0.0) { ", or 0" } else { "" };
    format!("of size {least} to {most}{zero}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{case::Case, parameter::Parameter, spec::keys};

    /// A factor of a hundred around the prototype of Table 4.1.1 is always of the right size.
    #[test]
    fn the_prototype_lies_well_inside() {
        let case = Case::prototype();
        for key in keys::case() {
            if let Some(si) = key.get(&case) {
                for factor in [0.01, 1.0, 100.0] {
                    assert!(is_in_scale(factor * si, key.quantity), "{} {si}", key.path);
                }
            }
        }
        for parameter in Parameter::all() {
            let Some(si) = parameter.find(&case) else {
                continue;
            };
            for factor in [0.01, 1.0, 100.0] {
                assert!(
                    is_in_scale(factor * si, parameter.quantity()),
                    "{parameter:?}"
                );
            }
        }
    }
}
