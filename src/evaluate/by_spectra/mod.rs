//! Stability by full spectra at many speeds: what following the modes is tested against.

mod critical_speed;
mod damping_range;
mod hopf;
mod spectrum;
