//! Nominal limits of 3.3, with which every design is compared.

use crate::units::us::INCH;

/// Standard deviations taken as the peak of a random motion (3.3.4).
pub const PEAK: f64 = 3.0;
/// Primary suspension stops, zero to peak, lateral, longitudinal and vertical alike, m: 3/8 in
/// (4.7), printed as 0.95 cm in 3.3.4.
pub const PRIMARY_STOP: f64 = 0.375 * INCH;
/// Secondary suspension stops, zero to peak, lateral and vertical alike, m: 1.5 in (4.7), printed
/// as 3.8 cm in 3.3.4.
pub const SECONDARY_STOP: f64 = 1.5 * INCH;
/// Wheelset excursion, zero to peak, m: 0.3 in, printed as 0.76 cm (3.3.5).
pub const EXCURSION: f64 = 0.3 * INCH;
/// L/V at the leading outer wheel, against wheel climb (3.3.3).
pub const WHEEL_L_OVER_V: f64 = 0.9;
/// L/V of one side of a truck, against rail rollover (3.3.3).
pub const TRUCK_SIDE_L_OVER_V: f64 = 0.5;
/// Net lateral over vertical axle load, against track shift on poor track (3.3.3).
pub const NET_AXLE_L_OVER_V: f64 = 0.4;
/// Height by which one wheel is raised in the equalization test, m (3.3.2).
pub const RAISE: f64 = 0.05;
/// Change of wheel load allowed in that test, share of the static load (3.3.2).
pub const LOAD_CHANGE: f64 = 0.25;
/// Ratio of the natural frequencies of coupled members (3.5.3).
pub const SEPARATION: f64 = 2.0;
/// Cant deficiency of the static curving check, m: the FRA's 3 in (3.2-2).
pub const CANT_DEFICIENCY: f64 = 3.0 * INCH;
/// Tolerance of a bound: relative, or absolute for damping ratios. A larger shortfall shows in printed
/// values; a smaller one is within the accuracy of a search.
pub const MET: f64 = 1e-4;
