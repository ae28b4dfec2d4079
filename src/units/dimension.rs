//! Dimensions: exponents of mass, length, time and angle.

use std::fmt;

/// Exponents of the base units kg, m, s and rad.
///
/// SI calls the radian 1. It is tracked here all the same, because it tells a rotational
/// stiffness (N m/rad) from a torque (N m) and a wavenumber in rad/m from one in cycles per metre.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Dimension {
    /// Exponent of mass.
    pub mass: i32,
    /// Exponent of length.
    pub length: i32,
    /// Exponent of time.
    pub time: i32,
    /// Exponent of angle.
    pub angle: i32,
}

impl Dimension {
    /// Dimension with these exponents of mass, length, time and angle.
    pub const fn new(mass: i32, length: i32, time: i32, angle: i32) -> Self {
        Self {
            mass,
            length,
            time,
            angle,
        }
    }

    /// Dimension of `self · otherⁿ`; exponents saturate.
    #[must_use]
    pub const fn times(self, other: Self, n: i32) -> Self {
        const fn add(a: i32, b: i32, n: i32) -> i32 {
            a.saturating_add(b.saturating_mul(n))
        }
        Self::new(
            add(self.mass, other.mass, n),
            add(self.length, other.length, n),
            add(self.time, other.time, n),
            add(self.angle, other.angle, n),
        )
    }

    /// The same without the angle, as SI counts it.
    #[must_use]
    pub const fn without_angle(self) -> Self {
        Self { angle: 0, ..self }
    }
}

impl fmt::Display for Dimension {
    /// In SI base units: `kg m^2 s^-2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors: Vec<String> = [
            ("kg", self.mass),
            ("m", self.length),
            ("s", self.time),
            ("rad", self.angle),
        ]
        .into_iter()
        .filter(|&(_, n)| n != 0)
        .map(|(unit, n)| match n {
            1 => unit.to_owned(),
            _ => format!("{unit}^{n}"),
        })
        .collect();
        if factors.is_empty() {
            f.write_str("1")
        } else {
            f.write_str(&factors.join(" "))
        }
    }
}
