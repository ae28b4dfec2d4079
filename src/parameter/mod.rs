//! The registry of parameters: every number of a case that a design may vary, that may be uncertain, and that a
//! condition may replace.
//!
//! A number has one row in a table beside the part of the case that holds it ([`crate::vehicle`],
//! [`crate::wheel_rail`], [`crate::case`]): its path in specs, symbol, quantity, range, meaning, and field. The
//! registry is composed of these rows. A number of an end of the vehicle has two parameters: that of the leading
//! end, which the trailing end follows, and the trailing end's own. `natural.rs` has other ways to state a
//! constant, as a natural frequency or a damping ratio.

mod case_key;
mod natural;
mod registry;
mod trade_off;

pub use case_key::{CaseKey, keys};
pub use trade_off::TradeOff;

use crate::{
    case::Case,
    units::{Quantity, Range},
    wheel_rail::rows_around,
};
use registry::{Access, entries};

/// A parameter of a design, by its number in the registry. Stiffness and damping of the secondary suspension
/// are also given as the carbody's natural frequency and damping ratio (4.6-8, 9, 14, 15), bending stiffness
/// stands for longitudinal stiffness (K_b = d_p² K_px).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Parameter(u16);

impl std::fmt::Debug for Parameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// Dependence of the matrices of all models on a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Dependence {
    /// Affine: stiffness, damping and torque of an element.
    Affine,
    /// Quadratic between two values.
    QuadraticBetween([f64; 2]),
    /// Smooth.
    Smooth,
}

impl Parameter {
    /// λ.
    pub const CONICITY: Self = Self(0);
    /// K_px.
    pub const PRIMARY_LONGITUDINAL_STIFFNESS: Self = Self(1);
    /// K_b.
    pub const PRIMARY_BENDING_STIFFNESS: Self = Self(2);
    /// K_py.
    pub const PRIMARY_LATERAL_STIFFNESS: Self = Self(3);
    /// K_sψ.
    pub const SECONDARY_YAW_STIFFNESS: Self = Self(4);
    /// T_sψ.
    pub const SECONDARY_YAW_BREAKAWAY_TORQUE: Self = Self(5);
    /// K_sy.
    pub const SECONDARY_LATERAL_STIFFNESS: Self = Self(6);
    /// Carbody on its secondary lateral springs; moving it keeps the damping ratio.
    pub const SECONDARY_LATERAL_FREQUENCY: Self = Self(7);
    /// C_sy.
    pub const SECONDARY_LATERAL_DAMPING: Self = Self(8);
    /// ξ of the secondary lateral suspension.
    pub const SECONDARY_LATERAL_DAMPING_RATIO: Self = Self(9);
    /// K_sz.
    pub const SECONDARY_VERTICAL_STIFFNESS: Self = Self(10);
    /// Carbody on its secondary vertical springs; moving it keeps the damping ratio.
    pub const SECONDARY_VERTICAL_FREQUENCY: Self = Self(11);
    /// C_sz.
    pub const SECONDARY_VERTICAL_DAMPING: Self = Self(12);
    /// ξ of the secondary vertical suspension.
    pub const SECONDARY_VERTICAL_DAMPING_RATIO: Self = Self(13);
    /// K_pz.
    pub const PRIMARY_VERTICAL_STIFFNESS: Self = Self(14);
    /// Vertical natural frequency of the truck frame, from which K_pz follows (3.5-9).
    pub const PRIMARY_VERTICAL_FREQUENCY: Self = Self(15);

    /// All parameters: those of Table 4.1.1 first, in whatever form, then every other number.
    pub fn all() -> impl DoubleEndedIterator<Item = Self> + Clone {
        (0..registry::number(entries().len())).map(Self)
    }

    /// The parameters of Table 4.1.1, in the order in which they are set: frequencies before damping ratios,
    /// secondary springs before the frame's frequency on all of its springs.
    pub fn of_table() -> impl DoubleEndedIterator<Item = Self> + Clone {
        (0..registry::OF_TABLE).map(Self)
    }

    /// Whether it is one of Table 4.1.1.
    pub fn is_of_table(self) -> bool {
        self.0 < registry::OF_TABLE
    }

    /// Parameters that are numbers of the case themselves: together they say all that a design can be.
    pub fn plain() -> impl DoubleEndedIterator<Item = Self> + Clone {
        Self::all().filter(|p| p.constant() == *p)
    }

    /// Place in the order in which the parameters of a design are set: masses and lengths before the springs
    /// whose frequencies depend on them.
    pub fn setting_order(self) -> (bool, u16) {
        (self.is_of_table(), self.0)
    }

    /// The same, of Table 4.1.1.
    pub fn plain_of_table() -> impl DoubleEndedIterator<Item = Self> + Clone {
        Self::of_table().filter(|p| p.constant() == *p)
    }

    fn entry(self) -> &'static registry::Entry {
        &entries()[usize::from(self.0)]
    }

    /// Path in specs as a variable.
    pub fn path(self) -> &'static str {
        self.entry().path
    }

    /// Name in `[design]` and in files.
    pub fn name(self) -> &'static str {
        let path = self.path();
        path.strip_prefix("design.").unwrap_or(path)
    }

    /// Name in tables.
    pub fn words(self) -> &'static str {
        self.entry().words
    }

    /// Symbol in the report; the end of its path where it has none.
    pub fn symbol(self) -> &'static str {
        self.entry().symbol
    }

    /// Kind of quantity, for units.
    pub fn quantity(self) -> Quantity {
        self.entry().quantity
    }

    /// Name of an exported column, SI unit included.
    pub fn column(self) -> String {
        format!(
            "{}{}",
            self.name().replace('.', "_"),
            registry::unit_suffix(self.quantity())
        )
    }

    /// The parameter with that name in specs.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|p| p.name() == name)
    }

    /// Key of the number; `None` for one that stands for another.
    pub fn key(self) -> Option<&'static CaseKey> {
        match self.entry().access {
            Access::Key(key) => Some(key),
            Access::Natural(_) => None,
        }
    }

    /// Key of the number that it sets: two parameters with the same one exclude each other.
    ///
    /// # Panics
    ///
    /// Never: every constant is a number.
    pub fn key_of_constant(self) -> &'static CaseKey {
        self.constant().key().expect("a constant is a number")
    }

    /// The number that it sets: two parameters with the same one exclude each other.
    #[must_use]
    pub fn constant(self) -> Self {
        match self.entry().access {
            Access::Natural(natural) => natural.constant,
            Access::Key(_) => self,
        }
    }

    /// Its relation to the number that it sets.
    pub fn relation(self) -> Option<&'static str> {
        match self.entry().access {
            Access::Natural(natural) => Some(natural.relation),
            Access::Key(_) => None,
        }
    }

    /// Values that are physical, SI.
    pub fn range(self) -> Range {
        self.entry().range
    }

    /// Its value in force in a case, SI; `None` where there is none, as of an air spring that is not there.
    pub fn find(self, case: &Case) -> Option<f64> {
        match self.entry().access {
            Access::Key(key) => key.get(case).or_else(|| key.in_force(case)),
            Access::Natural(natural) => Some((natural.get)(case)),
        }
    }

    /// As [`Parameter::find`], NaN where there is none.
    pub fn get(self, case: &Case) -> f64 {
        self.find(case).unwrap_or(f64::NAN)
    }

    /// Sets its value in a case, SI.
    pub fn set(self, case: &mut Case, value: f64) {
        match self.entry().access {
            Access::Key(key) => key.set(case, value),
            Access::Natural(natural) => {
                let kept = natural.keeps.map(|kept| (kept, kept.get(case)));
                let constant = (natural.constant_for)(case, value);
                natural.constant.set(case, constant);
                if let Some((kept, value)) = kept {
                    kept.set(case, value);
                }
            }
        }
    }

    /// Dependence of the models' matrices on it, at a value.
    pub fn dependence(self, value: f64) -> Dependence {
        let of_air_spring = self.name().contains("air_spring");
        match self.quantity() {
            _ if self == Self::CONICITY => Dependence::QuadraticBetween(rows_around(value)),
            Quantity::Stiffness
            | Quantity::Damping
            | Quantity::RotationalStiffness
            | Quantity::RotationalDamping
            | Quantity::Torque
                if !of_air_spring =>
            {
                Dependence::Affine
            }
            _ => Dependence::Smooth,
        }
    }
}

#[cfg(test)]
mod tests;
