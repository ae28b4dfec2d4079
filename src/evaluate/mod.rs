//! Performance indices of a case.

pub mod critical_speed;
pub mod curving;
mod hopf;
pub mod integration;
pub mod lateral_modes;
pub mod mode;
pub mod response;
