//! The two ends of a vehicle, alike or not.

use serde::Serialize;

use super::{Suspension, Truck, Vehicle, Wheelset};

/// One end: a truck frame, its two wheelsets, and its suspension.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct End {
    /// Truck frame.
    pub truck: Truck,
    /// Either of its wheelsets.
    pub wheelset: Wheelset,
    /// Its springs and dampers.
    pub suspension: Suspension,
}

/// A trailing end that differs from the leading one in some of its numbers, and follows it in the others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trailing {
    /// All of its numbers.
    pub(super) end: End,
    /// Paths of the numbers that are its own.
    own: Vec<&'static str>,
}

impl Trailing {
    /// The trailing end of a vehicle with such a leading end: rolling radius and distance of the contact
    /// points are those of the whole vehicle.
    pub(super) fn beside(&self, leading: &End) -> End {
        let mut end = self.end;
        end.wheelset.rolling_radius = leading.wheelset.rolling_radius;
        end.wheelset.half_contact_distance = leading.wheelset.half_contact_distance;
        end
    }
}

impl Vehicle {
    /// The trailing end if it differs from the leading one, but not in the number at `path`.
    pub(super) fn trailing_end_following(&mut self, path: &str) -> Option<&mut End> {
        let trailing = self.trailing.as_deref_mut()?;
        (!trailing.own.contains(&path)).then_some(&mut trailing.end)
    }

    /// The trailing end if the number at `path` is its own.
    pub(super) fn trailing_end_with_own(&self, path: &str) -> Option<&End> {
        let trailing = self.trailing.as_deref()?;
        trailing.own.contains(&path).then_some(&trailing.end)
    }

    /// The trailing end, whose number at `path` is its own from now on.
    pub(super) fn trailing_end_of_its_own(&mut self, path: &'static str) -> &mut End {
        let end = self.end(1);
        let trailing = self.trailing.get_or_insert_with(|| {
            Box::new(Trailing {
                end,
                own: Vec::new(),
            })
        });
        if !trailing.own.contains(&path) {
            trailing.own.push(path);
        }
        &mut trailing.end
    }
}

/// A number of an end of the vehicle by the field of an [`End`], which a [`Vehicle`] has under the same name;
/// behind it perhaps the value in force at an end where it is not set.
macro_rules! of_end {
    ($path:literal, $symbol:literal, $quantity:ident, $range:expr, $need:expr, $meaning:literal,
     $($field:ident).+) => {
        of_end!($path, $symbol, $quantity, $range, $need, $meaning, $($field).+,
            |end| $crate::units::Slot::read(&end.$($field).+))
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
                get: |vehicle: &$crate::vehicle::Vehicle| {
                    $crate::units::Slot::read(&vehicle.$($field).+)
                },
                set: |vehicle: &mut $crate::vehicle::Vehicle, value| {
                    $crate::units::Slot::write(&mut vehicle.$($field).+, value);
                    if let Some(end) = vehicle.trailing_end_following(concat!("trailing.", $path)) {
                        $crate::units::Slot::write(&mut end.$($field).+, value);
                    }
                },
            },
            trailing: Some($crate::units::Key {
                path: concat!("trailing.", $path),
                symbol: $symbol,
                quantity: $crate::units::Quantity::$quantity,
                meaning: $meaning,
                range: $range,
                need: $crate::units::Need::Optional("as at the leading end"),
                get: |vehicle: &$crate::vehicle::Vehicle| {
                    let end = vehicle.trailing_end_with_own(concat!("trailing.", $path))?;
                    $crate::units::Slot::read(&end.$($field).+)
                },
                set: |vehicle: &mut $crate::vehicle::Vehicle, value| {
                    let end = vehicle.trailing_end_of_its_own(concat!("trailing.", $path));
                    $crate::units::Slot::write(&mut end.$($field).+, value);
                },
            }),
            in_force: |vehicle, j| {
                let in_force: fn(&$crate::vehicle::End) -> Option<f64> = $in_force;
                in_force(&vehicle.end(j))
            },
        }
    };
}
pub(super) use of_end;
