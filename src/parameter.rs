//! The design parameters of Table 4.1.1 by name: what a design may vary.

use crate::{
    case::Case,
    closed_form::natural_frequencies as closed,
    units::{Quantity, Range},
    wheel_rail::CONICITY_MAX,
};

/// A design parameter. Stiffness and damping of the secondary suspension are also given as the
/// carbody's natural frequency and damping ratio (4.6-8, 9, 14, 15), bending stiffness stands for
/// longitudinal stiffness (K_b = d_p² K_px).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Parameter {
    /// λ.
    Conicity,
    /// K_px.
    PrimaryLongitudinalStiffness,
    /// K_b.
    PrimaryBendingStiffness,
    /// K_py.
    PrimaryLateralStiffness,
    /// K_sψ.
    SecondaryYawStiffness,
    /// T_sψ.
    SecondaryYawBreakawayTorque,
    /// K_sy.
    SecondaryLateralStiffness,
    /// Carbody on its secondary lateral springs; moving it keeps the damping ratio.
    SecondaryLateralFrequency,
    /// C_sy.
    SecondaryLateralDamping,
    /// ξ of the secondary lateral suspension.
    SecondaryLateralDampingRatio,
    /// K_sz.
    SecondaryVerticalStiffness,
    /// Carbody on its secondary vertical springs; moving it keeps the damping ratio.
    SecondaryVerticalFrequency,
    /// C_sz.
    SecondaryVerticalDamping,
    /// ξ of the secondary vertical suspension.
    SecondaryVerticalDampingRatio,
    /// K_pz.
    PrimaryVerticalStiffness,
    /// Vertical natural frequency of the truck frame, from which K_pz follows (3.5-9).
    PrimaryVerticalFrequency,
}

/// Trade-off of the report that a parameter belongs to (Figure 4.2.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TradeOff {
    /// Vertical ride against stroke (4.3).
    Vertical,
    /// Stability against curving (4.5).
    StabilityCurving,
    /// Lateral ride against stroke (4.4).
    Lateral,
}

impl std::fmt::Display for TradeOff {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Vertical => "vertical ride–stroke",
            Self::StabilityCurving => "stability–curving",
            Self::Lateral => "lateral ride–stroke",
        })
    }
}

struct Row {
    path: &'static str,
    words: &'static str,
    symbol: &'static str,
    quantity: Quantity,
    column: &'static str,
}

impl Parameter {
    /// All parameters, in the order in which they are set: frequencies before damping ratios,
    /// secondary springs before the frame's frequency on all of its springs.
    pub const ALL: [Self; 16] = [
        Self::Conicity,
        Self::PrimaryLongitudinalStiffness,
        Self::PrimaryBendingStiffness,
        Self::PrimaryLateralStiffness,
        Self::SecondaryYawStiffness,
        Self::SecondaryYawBreakawayTorque,
        Self::SecondaryLateralStiffness,
        Self::SecondaryLateralFrequency,
        Self::SecondaryLateralDamping,
        Self::SecondaryLateralDampingRatio,
        Self::SecondaryVerticalStiffness,
        Self::SecondaryVerticalFrequency,
        Self::SecondaryVerticalDamping,
        Self::SecondaryVerticalDampingRatio,
        Self::PrimaryVerticalStiffness,
        Self::PrimaryVerticalFrequency,
    ];

    /// The ten of Table 4.1.1, by their own constants: together they say all that a design is.
    pub const TEN: [Self; 10] = [
        Self::Conicity,
        Self::PrimaryLongitudinalStiffness,
        Self::PrimaryLateralStiffness,
        Self::SecondaryYawStiffness,
        Self::SecondaryYawBreakawayTorque,
        Self::SecondaryLateralStiffness,
        Self::SecondaryLateralDamping,
        Self::SecondaryVerticalStiffness,
        Self::SecondaryVerticalDamping,
        Self::PrimaryVerticalStiffness,
    ];

    #[rustfmt::skip]
    const fn row(self) -> Row {
        use Quantity::{Damping, Dimensionless, Frequency, RotationalStiffness, Stiffness, Torque};
        const fn row(
            path: &'static str,
            words: &'static str,
            symbol: &'static str,
            quantity: Quantity,
        ) -> Row {
            let column = match quantity {
                Stiffness => "_n_per_m",
                Damping => "_n_s_per_m",
                RotationalStiffness => "_n_m_per_rad",
                Torque => "_n_m",
                Frequency => "_hz",
                _ => "",
            };
            Row { path, words, symbol, quantity, column }
        }
        match self {
            Self::Conicity => row("design.conicity", "wheel conicity", "λ", Dimensionless),
            Self::PrimaryLongitudinalStiffness => row("design.primary_longitudinal_stiffness", "primary longitudinal stiffness", "K_px", Stiffness),
            Self::PrimaryBendingStiffness => row("design.primary_bending_stiffness", "primary bending stiffness", "K_b", RotationalStiffness),
            Self::PrimaryLateralStiffness => row("design.primary_lateral_stiffness", "primary lateral stiffness", "K_py", Stiffness),
            Self::SecondaryYawStiffness => row("design.secondary_yaw_stiffness", "secondary yaw stiffness", "K_sψ", RotationalStiffness),
            Self::SecondaryYawBreakawayTorque => row("design.secondary_yaw_breakaway_torque", "yaw breakaway torque", "T_sψ", Torque),
            Self::SecondaryLateralStiffness => row("design.secondary_lateral_stiffness", "secondary lateral stiffness", "K_sy", Stiffness),
            Self::SecondaryLateralFrequency => row("design.secondary_lateral_frequency", "lateral natural frequency", "f_nL", Frequency),
            Self::SecondaryLateralDamping => row("design.secondary_lateral_damping", "secondary lateral damping", "C_sy", Damping),
            Self::SecondaryLateralDampingRatio => row("design.secondary_lateral_damping_ratio", "lateral damping ratio", "ξ_L", Dimensionless),
            Self::SecondaryVerticalStiffness => row("design.secondary_vertical_stiffness", "secondary vertical stiffness", "K_sz", Stiffness),
            Self::SecondaryVerticalFrequency => row("design.secondary_vertical_frequency", "vertical natural frequency", "f_nV", Frequency),
            Self::SecondaryVerticalDamping => row("design.secondary_vertical_damping", "secondary vertical damping", "C_sz", Damping),
            Self::SecondaryVerticalDampingRatio => row("design.secondary_vertical_damping_ratio", "vertical damping ratio", "ξ_V", Dimensionless),
            Self::PrimaryVerticalStiffness => row("design.primary_vertical_stiffness", "primary vertical stiffness", "K_pz", Stiffness),
            Self::PrimaryVerticalFrequency => row("design.primary_vertical_frequency", "truck bounce frequency", "f_nP", Frequency),
        }
    }

    /// Path in specs.
    pub const fn path(self) -> &'static str {
        self.row().path
    }

    /// Name in specs and files.
    pub fn name(self) -> &'static str {
        let path = self.path();
        path.rsplit_once('.').map_or(path, |(_, name)| name)
    }

    /// Name in tables.
    pub const fn words(self) -> &'static str {
        self.row().words
    }

    /// Symbol in the report.
    pub const fn symbol(self) -> &'static str {
        self.row().symbol
    }

    /// Kind of quantity, for units.
    pub const fn quantity(self) -> Quantity {
        self.row().quantity
    }

    /// Name of an exported column, SI unit included.
    pub fn column(self) -> String {
        format!("{}{}", self.name(), self.row().column)
    }

    /// The parameter with that name in specs.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|p| p.name() == name)
    }

    /// Trade-off that it belongs to.
    pub const fn trade_off(self) -> TradeOff {
        match self {
            Self::Conicity
            | Self::PrimaryLongitudinalStiffness
            | Self::PrimaryBendingStiffness
            | Self::PrimaryLateralStiffness
            | Self::SecondaryYawStiffness
            | Self::SecondaryYawBreakawayTorque => TradeOff::StabilityCurving,
            Self::SecondaryLateralStiffness
            | Self::SecondaryLateralFrequency
            | Self::SecondaryLateralDamping
            | Self::SecondaryLateralDampingRatio => TradeOff::Lateral,
            Self::SecondaryVerticalStiffness
            | Self::SecondaryVerticalFrequency
            | Self::SecondaryVerticalDamping
            | Self::SecondaryVerticalDampingRatio
            | Self::PrimaryVerticalStiffness
            | Self::PrimaryVerticalFrequency => TradeOff::Vertical,
        }
    }

    /// The constant of Table 4.1.1 that it sets: two parameters with the same one exclude each
    /// other.
    #[must_use]
    pub const fn constant(self) -> Self {
        match self {
            Self::PrimaryBendingStiffness => Self::PrimaryLongitudinalStiffness,
            Self::SecondaryLateralFrequency => Self::SecondaryLateralStiffness,
            Self::SecondaryLateralDampingRatio => Self::SecondaryLateralDamping,
            Self::SecondaryVerticalFrequency => Self::SecondaryVerticalStiffness,
            Self::SecondaryVerticalDampingRatio => Self::SecondaryVerticalDamping,
            Self::PrimaryVerticalFrequency => Self::PrimaryVerticalStiffness,
            constant => constant,
        }
    }

    /// How it follows from the constant that it sets.
    pub const fn relation(self) -> Option<&'static str> {
        match self {
            Self::PrimaryBendingStiffness => Some("K_b = d_p² K_px"),
            Self::SecondaryLateralFrequency => Some("f_n = √(4 K_sy / M_c) / 2π"),
            Self::SecondaryLateralDampingRatio => Some("ξ = C_sy / √(K_sy M_c)"),
            Self::SecondaryVerticalFrequency => Some("f_n = √(4 K_sz / M_c) / 2π"),
            Self::SecondaryVerticalDampingRatio => Some("ξ = C_sz / √(K_sz M_c)"),
            Self::PrimaryVerticalFrequency => Some("K_pz follows from it by (3.5-9)"),
            _ => None,
        }
    }

    /// Values that are physical, SI.
    pub const fn range(self) -> Range {
        match self {
            Self::Conicity => Range::PositiveUpTo(CONICITY_MAX),
            Self::SecondaryLateralDampingRatio | Self::SecondaryVerticalDampingRatio => {
                Range::PositiveUpTo(2.0)
            }
            Self::SecondaryYawStiffness | Self::SecondaryYawBreakawayTorque => Range::NonNegative,
            _ => Range::Positive,
        }
    }

    /// Its value in a case, SI.
    pub fn get(self, case: &Case) -> f64 {
        let mass = case.vehicle.carbody.mass;
        let primary = &case.vehicle.suspension.primary;
        let secondary = &case.vehicle.suspension.secondary;
        match self {
            Self::Conicity => case.wheel_rail.conicity,
            Self::PrimaryLongitudinalStiffness => primary.longitudinal_stiffness,
            Self::PrimaryBendingStiffness => case.vehicle.bending_stiffness(),
            Self::PrimaryLateralStiffness => primary.lateral_stiffness,
            Self::SecondaryYawStiffness => secondary.yaw_stiffness,
            Self::SecondaryYawBreakawayTorque => secondary.yaw_breakaway_torque,
            Self::SecondaryLateralStiffness => secondary.lateral_stiffness,
            Self::SecondaryLateralFrequency => {
                closed::secondary_frequency(mass, secondary.lateral_stiffness)
            }
            Self::SecondaryLateralDamping => secondary.lateral_damping,
            Self::SecondaryLateralDampingRatio => closed::secondary_damping_ratio(
                mass,
                secondary.lateral_stiffness,
                secondary.lateral_damping,
            ),
            Self::SecondaryVerticalStiffness => secondary.vertical_stiffness,
            Self::SecondaryVerticalFrequency => {
                closed::secondary_frequency(mass, secondary.vertical_stiffness)
            }
            Self::SecondaryVerticalDamping => secondary.vertical_damping,
            Self::SecondaryVerticalDampingRatio => closed::secondary_damping_ratio(
                mass,
                secondary.vertical_stiffness,
                secondary.vertical_damping,
            ),
            Self::PrimaryVerticalStiffness => primary.vertical_stiffness,
            Self::PrimaryVerticalFrequency => closed::truck_vertical(&case.vehicle).frequency,
        }
    }

    /// Sets its value in a case, SI.
    pub fn set(self, case: &mut Case, value: f64) {
        let mass = case.vehicle.carbody.mass;
        let frame = case.vehicle.truck.mass;
        match self {
            Self::Conicity => case.wheel_rail.conicity = value,
            Self::PrimaryBendingStiffness => case.vehicle.set_bending_stiffness(value),
            Self::SecondaryLateralFrequency => {
                let ratio = Self::SecondaryLateralDampingRatio.get(case);
                let k = closed::secondary_stiffness(mass, value);
                case.vehicle.suspension.secondary.lateral_stiffness = k;
                Self::SecondaryLateralDampingRatio.set(case, ratio);
            }
            Self::SecondaryVerticalFrequency => {
                let ratio = Self::SecondaryVerticalDampingRatio.get(case);
                let k = closed::secondary_stiffness(mass, value);
                case.vehicle.suspension.secondary.vertical_stiffness = k;
                Self::SecondaryVerticalDampingRatio.set(case, ratio);
            }
            _ => {
                let primary = &mut case.vehicle.suspension.primary;
                let secondary = &mut case.vehicle.suspension.secondary;
                match self {
                    Self::PrimaryLongitudinalStiffness => primary.longitudinal_stiffness = value,
                    Self::PrimaryLateralStiffness => primary.lateral_stiffness = value,
                    Self::PrimaryVerticalStiffness => primary.vertical_stiffness = value,
                    Self::PrimaryVerticalFrequency => {
                        let k_sz = secondary.static_vertical_stiffness();
                        primary.vertical_stiffness =
                            closed::primary_vertical_stiffness(frame, k_sz, value);
                    }
                    Self::SecondaryYawStiffness => secondary.yaw_stiffness = value,
                    Self::SecondaryYawBreakawayTorque => secondary.yaw_breakaway_torque = value,
                    Self::SecondaryLateralStiffness => secondary.lateral_stiffness = value,
                    Self::SecondaryLateralDamping => secondary.lateral_damping = value,
                    Self::SecondaryVerticalStiffness => secondary.vertical_stiffness = value,
                    Self::SecondaryVerticalDamping => secondary.vertical_damping = value,
                    Self::SecondaryLateralDampingRatio => {
                        let k = secondary.lateral_stiffness;
                        secondary.lateral_damping = closed::secondary_damping(mass, k, value);
                    }
                    _ => {
                        let k = secondary.vertical_stiffness;
                        secondary.vertical_damping = closed::secondary_damping(mass, k, value);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_set_is_what_is_got() {
        for parameter in Parameter::ALL {
            let mut case = Case::prototype();
            let value = 1.1 * parameter.get(&case);
            parameter.set(&mut case, value);
            assert!(
                (parameter.get(&case) / value - 1.0).abs() < 1e-12,
                "{parameter:?}"
            );
            let constant = parameter.constant();
            assert!(Parameter::TEN.contains(&constant) && constant.constant() == constant);
            assert_eq!(Parameter::named(parameter.name()), Some(parameter));
        }
    }

    #[test]
    fn a_frequency_keeps_the_damping_ratio() {
        let mut case = Case::prototype();
        let ratio = Parameter::SecondaryLateralDampingRatio.get(&case);
        Parameter::SecondaryLateralFrequency.set(&mut case, 0.6);
        let kept = Parameter::SecondaryLateralDampingRatio.get(&case);
        assert!((kept / ratio - 1.0).abs() < 1e-12);
    }
}
