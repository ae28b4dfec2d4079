//! The report's closed forms: what a designer checks the full models against by hand.
//!
//! One file per section: kinematic (hunting) models (3.5.2, 4.5.3), natural frequencies (3.5.3,
//! 4.6), simplified curving (4.5.2, Appendix A), corrections of chart readings (4.6).

pub mod corrections;
pub mod curving;
pub mod kinematic;
pub mod natural_frequencies;
pub mod unusual;
