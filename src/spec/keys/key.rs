//! One key of a spec.

use crate::units::{Quantity, Range};

/// A key of a spec whose value, of type `V`, belongs to a `T`.
#[derive(Debug)]
pub struct Key<T: 'static, V: 'static = f64> {
    /// Path in the spec.
    pub path: &'static str,
    /// Symbol in the report; empty where it has none.
    pub symbol: &'static str,
    /// What kind of quantity it is.
    pub quantity: Quantity,
    /// What it means.
    pub meaning: &'static str,
    /// Values that are physical.
    pub range: Range,
    /// Whether it must be given.
    pub need: Need,
    /// Its value in SI; `None` where it is not set.
    pub get: fn(&T) -> Option<V>,
    /// Sets its value in SI.
    pub set: fn(&mut T, V),
}

impl<T, V> Key<T, V> {
    /// Last part of the path.
    pub fn name(&self) -> &'static str {
        self.path.rsplit('.').next().unwrap_or(self.path)
    }

    /// Path of the table that it stands in.
    pub fn table(&self) -> &'static str {
        self.path.rsplit_once('.').map_or("", |(table, _)| table)
    }
}

/// Whether a key must be given where the spec has no base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// It must.
    Required,
    /// It may be left out; what then holds, in words.
    Optional(&'static str),
}

/// A place for a value that may or may not be optional.
pub(super) trait Slot<V> {
    fn read(&self) -> Option<V>;
    fn write(&mut self, value: V);
}

impl<V: Copy> Slot<V> for V {
    fn read(&self) -> Option<V> {
        Some(*self)
    }

    fn write(&mut self, value: V) {
        *self = value;
    }
}

impl<V: Copy> Slot<V> for Option<V> {
    fn read(&self) -> Option<V> {
        *self
    }

    fn write(&mut self, value: V) {
        *self = Some(value);
    }
}

/// A key that belongs to a field: path, symbol, quantity, range, need, meaning, field.
macro_rules! key {
    ($path:literal, $symbol:literal, $quantity:ident, $range:expr, $need:expr, $meaning:literal,
     $($field:ident).+) => {
        $crate::spec::keys::Key {
            path: $path,
            symbol: $symbol,
            quantity: $crate::units::Quantity::$quantity,
            meaning: $meaning,
            range: $range,
            need: $need,
            get: |owner| $crate::spec::keys::key::Slot::read(&owner.$($field).+),
            set: |owner, value| $crate::spec::keys::key::Slot::write(&mut owner.$($field).+, value),
        }
    };
}
pub(super) use key;
