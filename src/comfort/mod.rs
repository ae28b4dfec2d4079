//! Measures of ride comfort as functions of frequency, applied to acceleration spectra.
//!
//! Roll discomfort: the report judges RMS roll acceleration by the equal-discomfort curves of its
//! Figure 3.2.2 (its reference 29), which is lost from the text at hand. The RMS roll acceleration
//! and its spectrum are reported; no curves are made up for it.

pub mod iso_boundary;
pub mod sperling;
pub mod third_octave;
pub mod weighting;
