//! Do the models keep the laws of mechanics, and do they agree with published numbers?

mod edges;
mod elements;
mod identities;
mod kinematic_damping;
mod published;
mod random_vehicles;
mod reference_cases;
mod service_curve;
#[path = "../support/mod.rs"]
mod support;
mod ten_thousand_vehicles;
