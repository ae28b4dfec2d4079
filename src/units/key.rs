//! Numbers of a spec: path, unit, symbol, meaning, range, and the field that holds the value.

use super::{Quantity, Range};

/// A key of a spec whose value, of type `V`, belongs to a `T`.
#[derive(Debug)]
pub struct Key<T: 'static, V: 'static = f64> {
    /// Path in the spec.
    pub path: &'static str,
    /// Symbol in the report; empty where it has none.
    pub symbol: &'static str,
    /// Kind of quantity.
    pub quantity: Quantity,
    /// Meaning in words.
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
    /// It may be left out; the default, in words.
    Optional(&'static str),
}

/// A number of a part of the case.
#[derive(Debug)]
pub struct Number<T: 'static> {
    /// Its key. A number of an end of the vehicle is the leading end's here, and the trailing end's too
    /// unless that has its own.
    pub key: Key<T>,
    /// Key of the trailing end's own value, for numbers of an end.
    pub trailing: Option<Key<T>>,
    /// The value in force where the key is not set, at the leading (0) or the trailing end (1); `None`
    /// where there is no such value.
    pub in_force: fn(&T, usize) -> Option<f64>,
}

/// A table of a spec, with the numbers that stand in it.
#[derive(Debug)]
pub struct Table<T: 'static> {
    /// Path.
    pub path: &'static str,
    /// Contents in words.
    pub meaning: &'static str,
    /// Its numbers.
    pub numbers: &'static [Number<T>],
}

/// A place for a value that may or may not be optional.
pub trait Slot<V> {
    /// The value, if it is set.
    fn read(&self) -> Option<V>;
    /// Sets the value.
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

/// A number by its field: path, symbol, quantity, range, need, meaning, field; behind them perhaps the value
/// in force where it is not set.
macro_rules! number {
    ($path:literal, $symbol:literal, $quantity:ident, $range:expr, $need:expr, $meaning:literal,
     $($field:ident).+) => {
        $crate::units::number!($path, $symbol, $quantity, $range, $need, $meaning, $($field).+,
            |owner, _| $crate::units::Slot::read(&owner.$($field).+))
    };
    ($path:literal, $symbol:literal, $quantity:ident, $range:expr, $need:expr, $meaning:literal,
     $($field:ident).+, $in_force:expr) => {
        $crate::units::Number {
            key: $crate::units::Key {
                path: $path,
                symbol: $symbol,
                quantity: $crate::units::Quantity::$quantity,
                meaning: $meaning,
                range: $range,
                need: $need,
                get: |owner| $crate::units::Slot::read(&owner.$($field).+),
                set: |owner, value| $crate::units::Slot::write(&mut owner.$($field).+, value),
            },
            trailing: None,
            in_force: $in_force,
        }
    };
}
pub(crate) use number;
