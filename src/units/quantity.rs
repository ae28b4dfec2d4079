//! Physical quantities of a spec and of its results.

use super::{Dimension, Measure, Unit, UnitError};

/// A physical quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// kg.
    Mass,
    /// Dimensions of the vehicle, m.
    Length,
    /// Strokes and clearances, m.
    Stroke,
    /// kg m².
    Inertia,
    /// N/m.
    Stiffness,
    /// N s/m.
    Damping,
    /// N m/rad.
    RotationalStiffness,
    /// N m s/rad.
    RotationalDamping,
    /// N m.
    Torque,
    /// m/s.
    Speed,
    /// Hz.
    Frequency,
    /// rad.
    Angle,
    /// Degree of curve, rad subtended by a chord of 100 ft.
    DegreeOfCurve,
    /// N; also the creep coefficients f11 and f33.
    Force,
    /// Lateral–spin creep coefficient f12, N m.
    LateralSpinCreep,
    /// Spin creep coefficient f22, N m².
    SpinCreep,
    /// m/s².
    Acceleration,
    /// Roughness constant of a track spectrum, m² rad/m.
    Roughness,
    /// rad/m.
    Wavenumber,
    /// Spectral density of a track irregularity, m²/(rad/m).
    SpectralDensity,
    /// A plain number.
    Dimensionless,
}

/// A unit in which results are printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayUnit {
    /// Its label; empty for plain numbers.
    pub label: &'static str,
    /// Its size in SI base units.
    pub factor: f64,
}

impl DisplayUnit {
    /// A value in SI base units, in this unit.
    pub fn of(&self, si: f64) -> f64 {
        si / self.factor
    }
}

struct Row {
    /// Name with its article.
    name: &'static str,
    dimension: [i32; 4],
    /// Right values in SI and in US customary units.
    examples: [&'static str; 2],
    /// Units that an engineer writes, SI and US customary.
    units: [&'static str; 2],
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 21] = [
        Self::Mass,
        Self::Length,
        Self::Stroke,
        Self::Inertia,
        Self::Stiffness,
        Self::Damping,
        Self::RotationalStiffness,
        Self::RotationalDamping,
        Self::Torque,
        Self::Speed,
        Self::Frequency,
        Self::Angle,
        Self::DegreeOfCurve,
        Self::Force,
        Self::LateralSpinCreep,
        Self::SpinCreep,
        Self::Acceleration,
        Self::Roughness,
        Self::Wavenumber,
        Self::SpectralDensity,
        Self::Dimensionless,
    ];

    #[rustfmt::skip]
    const fn row(self) -> Row {
        const fn row(
            name: &'static str,
            dimension: [i32; 4],
            examples: [&'static str; 2],
            units: [&'static str; 2],
        ) -> Row {
            Row { name, dimension, examples, units }
        }
        match self {
            Self::Mass => row("a mass", [1, 0, 0, 0], ["41740 kg", "2860 slug"], ["kg", "slug"]),
            Self::Length => row("a length", [0, 1, 0, 0], ["9.07 m", "29.75 ft"], ["m", "ft"]),
            Self::Stroke => row("a length", [0, 1, 0, 0], ["12.7 mm", "0.5 in"], ["mm", "in"]),
            Self::Inertia => row("a moment of inertia", [1, 2, 0, 0],
                ["103500 kg m^2", "76340 slug ft^2"], ["kg m^2", "slug ft^2"]),
            Self::Stiffness => row("a stiffness", [1, 0, -2, 0],
                ["350 kN/m", "24000 lbf/ft"], ["kN/m", "lbf/ft"]),
            Self::Damping => row("a damping constant", [1, 0, -1, 0],
                ["17.5 kN s/m", "1200 lbf s/ft"], ["kN s/m", "lbf s/ft"]),
            Self::RotationalStiffness => row("a rotational stiffness", [1, 2, -2, -1],
                ["1.36e6 N m/rad", "1e6 lbf ft/rad"], ["kN m/rad", "lbf ft/rad"]),
            Self::RotationalDamping => row("a rotational damping constant", [1, 2, -1, -1],
                ["5420 N m s/rad", "4000 lbf ft s/rad"], ["kN m s/rad", "lbf ft s/rad"]),
            Self::Torque => row("a torque", [1, 2, -2, 0],
                ["10.2 kN m", "7500 lbf ft"], ["kN m", "lbf ft"]),
            Self::Speed => row("a speed", [0, 1, -1, 0], ["210 km/h", "130 mph"], ["km/h", "mph"]),
            Self::Frequency => row("a frequency", [0, 0, -1, 0], ["7.1 Hz", "7.1 Hz"], ["Hz", "Hz"]),
            Self::Angle => row("an angle", [0, 0, 0, 1], ["1.5 deg", "0.026 rad"], ["deg", "deg"]),
            Self::DegreeOfCurve => row("a degree of curve", [0, 0, 0, 1],
                ["1.5 deg", "1.5°"], ["deg", "deg"]),
            Self::Force => row("a force", [1, 1, -2, 0], ["9430 kN", "2.12e6 lbf"], ["kN", "lbf"]),
            Self::LateralSpinCreep => row("a lateral–spin creep coefficient", [1, 2, -2, 0],
                ["23.7 kN m", "17500 lbf ft"], ["kN m", "lbf ft"]),
            Self::SpinCreep => row("a spin creep coefficient", [1, 3, -2, 0],
                ["66.1 N m^2", "160 lbf ft^2"], ["N m^2", "lbf ft^2"]),
            Self::Acceleration => row("an acceleration", [0, 1, -2, 0],
                ["0.5 m/s^2", "0.05 g"], ["m/s^2", "g"]),
            Self::Roughness => row("a roughness constant", [0, 1, 0, 1],
                ["3.39e-6 m^2 rad/m", "1.59e-3 in^2 rad/ft"], ["m^2 rad/m", "in^2 rad/ft"]),
            Self::Wavenumber => row("a wavenumber", [0, -1, 0, 1],
                ["0.8245 rad/m", "0.2513 rad/ft"], ["rad/m", "rad/ft"]),
            Self::SpectralDensity => row("a spectral density", [0, 3, 0, -1],
                ["1e-6 m^2/(rad/m)", "5e-4 in^2/(rad/ft)"], ["m^2/(rad/m)", "in^2/(rad/ft)"]),
            Self::Dimensionless => row("a plain number", [0, 0, 0, 0], ["0.05", "0.05"], ["", ""]),
        }
    }

    /// Name with its article, as in "a rotational stiffness".
    pub const fn with_article(self) -> &'static str {
        self.row().name
    }

    /// Its dimension.
    pub const fn dimension(self) -> Dimension {
        let [mass, length, time, angle] = self.row().dimension;
        Dimension::new(mass, length, time, angle)
    }

    /// Right values in SI and in US customary units, for documentation and messages.
    pub const fn examples(self) -> [&'static str; 2] {
        self.row().examples
    }

    /// Expectation where this quantity stands in a spec.
    pub fn expectation(self) -> String {
        let Row { name, examples, .. } = self.row();
        let [si, us] = examples;
        match self {
            Self::Dimensionless => format!("expected {name}, such as {si}"),
            Self::Angle => format!("expected {name}: a number in radians, or such as \"{si}\""),
            _ if si == us => format!("expected {name} with its unit, such as \"{si}\""),
            _ => format!("expected {name} with its unit, such as \"{si}\" or \"{us}\""),
        }
    }

    /// SI unit that an engineer writes.
    pub fn si(self) -> DisplayUnit {
        display(self.row().units[0])
    }

    /// US customary unit that an engineer writes.
    pub fn us(self) -> DisplayUnit {
        display(self.row().units[1])
    }

    /// SI uses no radian in these: N m stands for N m/rad too.
    const fn angle_is_optional(self) -> bool {
        matches!(self, Self::RotationalStiffness | Self::RotationalDamping)
    }

    /// Reads a value with its unit, in SI base units.
    ///
    /// # Errors
    ///
    /// No number, no unit, an unknown unit, or a unit of another quantity.
    pub fn parse(self, text: &str) -> Result<f64, UnitError> {
        let measure = Measure::parse(text)?;
        if self == Self::Dimensionless {
            return Err(UnitError::Quoted);
        }
        if measure.label.is_empty() {
            return Err(UnitError::NoUnit(text.trim().to_owned()));
        }
        let (found, expected) = (measure.unit.dimension, self.dimension());
        if found == expected || self.angle_is_optional() && found == expected.without_angle() {
            return Ok(measure.si());
        }
        let other = Self::ALL.into_iter().find(|q| q.dimension() == found);
        Err(UnitError::Dimension {
            unit: measure.label.to_owned(),
            found: match other {
                Some(quantity) => format!("the unit of {}", quantity.with_article()),
                None => format!("{found} in base units"),
            },
            expected: self,
        })
    }
}

fn display(label: &'static str) -> DisplayUnit {
    let factor = match label {
        "" => 1.0,
        _ => Unit::parse(label).map_or(f64::NAN, |unit| unit.factor),
    };
    DisplayUnit { label, factor }
}

#[cfg(test)]
mod tests;
