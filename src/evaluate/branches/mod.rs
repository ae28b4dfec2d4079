//! Modes as branches over the speed: eigenvalues followed from the spectrum at one speed to others.
//!
//! An eigenvalue s(V) is analytic in V but where two meet. From one speed to the next it is
//! extrapolated and then refined with its vectors, several modes side by side; the vectors give
//! its slope too. Between two speeds s is a cubic in ln V with the right values and slopes at both,
//! on which crossings and minima of damping are found and refined in turn.
//!
//! Where modes come too close to be told apart, or one that was not followed turns up, the answer
//! is `None`: full spectra answer then.

mod events;
mod jump;
mod search;
mod state;
mod track;

pub use events::{Event, Sought};
pub use search::{Care, Search};
pub use track::{Branches, COMPLETE, Walked};
