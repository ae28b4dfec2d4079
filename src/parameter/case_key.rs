//! The numbers of a case by their paths.

use std::sync::OnceLock;

use crate::{
    case::{Case, SERVICE, Service},
    units::{Need, Number, Quantity, Range},
    vehicle::{Vehicle, tables},
    wheel_rail::{WHEEL_RAIL, WheelRail},
};

/// A numeric key of a case.
#[derive(Debug)]
pub struct CaseKey {
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
    part: Part,
    /// Whether it is the trailing end's own.
    pub is_trailing: bool,
}

/// The part of a case that holds a number.
#[derive(Debug)]
enum Part {
    Service(&'static Number<Service>),
    Vehicle(&'static Number<Vehicle>),
    WheelRail(&'static Number<WheelRail>),
}

impl CaseKey {
    fn new<T>(number: &'static Number<T>, part: fn(&'static Number<T>) -> Part) -> Self {
        let key = &number.key;
        Self {
            path: key.path,
            symbol: key.symbol,
            quantity: key.quantity,
            meaning: key.meaning,
            range: key.range,
            need: key.need,
            part: part(number),
            is_trailing: false,
        }
    }

    fn trailing(number: &'static Number<Vehicle>) -> Option<Self> {
        let key = number.trailing.as_ref()?;
        Some(Self {
            path: key.path,
            need: key.need,
            is_trailing: true,
            ..Self::new(number, Part::Vehicle)
        })
    }

    /// Its value in SI; `None` where it is not set.
    pub fn get(&self, case: &Case) -> Option<f64> {
        match self.part {
            Part::Service(number) => (number.key.get)(&case.service),
            Part::WheelRail(number) => (number.key.get)(&case.wheel_rail),
            Part::Vehicle(number) => match &number.trailing {
                Some(trailing) if self.is_trailing => (trailing.get)(&case.vehicle),
                _ => (number.key.get)(&case.vehicle),
            },
        }
    }

    /// The value in force in SI, set or not; `None` where there is none.
    pub fn in_force(&self, case: &Case) -> Option<f64> {
        let end = usize::from(self.is_trailing);
        match self.part {
            Part::Service(number) => (number.in_force)(&case.service, end),
            Part::WheelRail(number) => (number.in_force)(&case.wheel_rail, end),
            Part::Vehicle(number) => (number.in_force)(&case.vehicle, end),
        }
    }

    /// Sets its value in SI.
    pub fn set(&self, case: &mut Case, value: f64) {
        match self.part {
            Part::Service(number) => (number.key.set)(&mut case.service, value),
            Part::WheelRail(number) => (number.key.set)(&mut case.wheel_rail, value),
            Part::Vehicle(number) => match &number.trailing {
                Some(trailing) if self.is_trailing => (trailing.set)(&mut case.vehicle, value),
                _ => (number.key.set)(&mut case.vehicle, value),
            },
        }
    }

    /// Last part of the path.
    pub fn name(&self) -> &'static str {
        self.path.rsplit('.').next().unwrap_or(self.path)
    }

    /// Path of the table that it stands in.
    pub fn table(&self) -> &'static str {
        self.path.rsplit_once('.').map_or("", |(table, _)| table)
    }
}

/// All keys: those of the leading end, which stand for both ends, then those of the trailing end.
pub fn keys() -> &'static [CaseKey] {
    static KEYS: OnceLock<Vec<CaseKey>> = OnceLock::new();
    KEYS.get_or_init(|| {
        let of_vehicle = |prefix: &'static str| {
            let tables = tables().filter(move |t| t.path.starts_with(prefix));
            tables.flat_map(|table| table.numbers)
        };
        let service = SERVICE.numbers.iter();
        let wheel_rail = WHEEL_RAIL.numbers.iter();
        let vehicle = of_vehicle("vehicle").chain(of_vehicle("suspension"));
        service
            .map(|number| CaseKey::new(number, Part::Service))
            .chain(
                vehicle
                    .clone()
                    .map(|number| CaseKey::new(number, Part::Vehicle)),
            )
            .chain(wheel_rail.map(|number| CaseKey::new(number, Part::WheelRail)))
            .chain(of_vehicle("passenger").map(|number| CaseKey::new(number, Part::Vehicle)))
            .chain(vehicle.filter_map(CaseKey::trailing))
            .collect()
    })
}
