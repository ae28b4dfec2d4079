//! One case: a vehicle with its wheels and rails, on a track at a speed, and the choices that the
//! models leave open.

use serde::Serialize;

use crate::{
    track::{MAX_DEGREE, Track},
    units::{
        Key,
        Need::{Optional, Required},
        Number, Quantity,
        Range::{Between, Positive, PositiveUpTo},
        Table, number,
    },
    vehicle::Vehicle,
    wheel_rail::WheelRail,
};

/// Everything that an evaluation needs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// Speed and track.
    pub service: Service,
    /// The vehicle.
    pub vehicle: Vehicle,
    /// Its wheels on the rails.
    pub wheel_rail: WheelRail,
    /// Modelling choices.
    pub model: Model,
}

/// How the vehicle is used.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Service {
    /// V, m/s.
    pub speed: f64,
    /// Irregularities of the tangent track.
    pub track: Track,
    /// Degree of the curve in which forces on the rails are judged, rad; `None`: the tightest
    /// that the vehicle runs without flange contact or slip.
    pub curve: Option<f64>,
    /// φ_d there, rad; `None`: zero.
    pub cant_deficiency: Option<f64>,
}

impl Service {
    /// φ_d in the service curve, rad: zero unless given.
    pub fn cant_deficiency(&self) -> f64 {
        self.cant_deficiency.unwrap_or(0.0)
    }
}

/// How the truck frame rolls in the lateral model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub enum TruckRoll {
    /// The mean of its wheelsets' roll (3.4.4.1): 15 degrees of freedom.
    #[default]
    Prescribed,
    /// A degree of freedom of each truck: 17 in all.
    Dynamic,
}

/// How crosslevel acts on the lateral model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub enum Crosslevel {
    /// Through the roll of wheelsets and trucks only (the report's form).
    #[default]
    Roll,
    /// The complete form: contact at rail level, and the weight carried by the tilted truck.
    Contact,
}

/// How the creep coefficients of the steady curving model follow the wheel loads (3.4.5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub enum CurvingCreep {
    /// As on tangent track.
    #[default]
    Static,
    /// f11, f33 ∝ N^⅔, f12 ∝ N, f22 ∝ N^(4/3) of each wheel.
    LoadDependent,
}

/// Choices that the models leave open; the defaults are the report's forms.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Model {
    /// Truck roll in the lateral model.
    pub truck_roll: TruckRoll,
    /// Crosslevel in the lateral model.
    pub crosslevel: Crosslevel,
    /// Creep coefficients in the curving model.
    pub curving_creep: CurvingCreep,
    /// Band of the random response, Hz: RMS values are defined over it.
    pub frequency_band: [f64; 2],
    /// Range of speeds searched for the critical speed, m/s.
    pub speed_range: [f64; 2],
}

impl Default for Model {
    fn default() -> Self {
        const MPH: f64 = crate::units::us::MILE / 3600.0;
        Self {
            truck_roll: TruckRoll::default(),
            crosslevel: Crosslevel::default(),
            curving_creep: CurvingCreep::default(),
            frequency_band: [0.02, 50.0],
            speed_range: [5.0 * MPH, 600.0 * MPH],
        }
    }
}

impl Case {
    /// The prototype of Table 4.1.1 at 110 mph on class 6 track.
    ///
    /// # Panics
    ///
    /// Never: class 6 is built in.
    pub fn prototype() -> Self {
        Self {
            service: Service {
                speed: 110.0 * crate::units::us::MILE / 3600.0,
                track: Track::fra_class(6).expect("class 6 exists"),
                curve: None,
                cant_deficiency: None,
            },
            vehicle: Vehicle::prototype(),
            wheel_rail: WheelRail::default(),
            model: Model::default(),
        }
    }
}

const RADIANS: f64 = std::f64::consts::PI / 180.0;

/// Numbers of `[service]`.
#[rustfmt::skip]
pub static SERVICE: Table<Service> = Table {
    path: "service",
    meaning: "How the vehicle is used.",
    numbers: &[
        number!("service.speed", "V", Speed, Positive, Required, "operating speed", speed),
        number!("service.curve", "D", DegreeOfCurve, PositiveUpTo(MAX_DEGREE * RADIANS), Optional("the tightest without flange contact or slip"), "degree of the curve in which forces on the rails are judged", curve),
        Number {
            key: Key {
                path: "service.cant_deficiency",
                symbol: "φ_d",
                quantity: Quantity::Angle,
                meaning: "cant deficiency there",
                range: Between(-0.2, 0.2),
                need: Optional("0"),
                // Its value in force is zero where it is not given.
                get: |service: &Service| Some(service.cant_deficiency()),
                set: |service: &mut Service, value| service.cant_deficiency = Some(value),
            },
            trailing: None,
            in_force: |service, _| Some(service.cant_deficiency()),
        },
    ],
};
