//! Modes of vibration: shapes, names, and the kinematic mode.

mod kinematic;
mod lateral;
mod mode;
mod vertical;

pub use kinematic::{KinematicBand, KinematicMode, TruckMotion};
pub use lateral::{AtSpeed, LateralMode, LateralModes, LateralShape, OVERDAMPED};
pub use mode::Mode;
pub use vertical::{Separation, VerticalMode, VerticalShape, flexible_separations, vertical_modes};
