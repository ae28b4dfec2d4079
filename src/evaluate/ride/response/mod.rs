//! Response of a forced model to the irregularities of the track, frequency by frequency.
//!
//! ```math
//! D(iω) q = −(iω C_u + K_u) Σᵢ uᵢ e^{−iωτᵢ},   D = −ω² M + iω C + K
//! ```
//!
//! Input reaches wheelset i delayed by its distance behind the first wheelset over V, exactly.

mod fast;
pub mod plain;

pub use fast::Response;
