//! Ride on irregular track: RMS values, and comfort measures for passengers.

pub mod panels;
mod passengers;
pub mod response;
mod rms;
mod rounding;

pub use passengers::{BandDerivatives, BandRide, PassengerRide};
pub(crate) use rms::mean_squares_between;
pub use rms::{LateralRide, NoRide, VerticalRide, average, stationary};
