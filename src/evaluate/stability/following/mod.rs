//! The fast methods: modes followed over the speed from the spectrum at one speed.
//!
//! An eigenvalue s(V) is analytic in V except where two meet. From one speed to the next it is
//! extrapolated and then refined with its vectors, several modes side by side; the vectors give
//! its slope too. Between two speeds s is a Hermite cubic in ln V, on which onsets of instability and
//! minima of damping are estimated and then refined.
//!
//! The answer is `None` where two modes cannot be distinguished, or where the mode count finds one that
//! was not followed; then the plain methods (`spectra`) answer.

mod confirmation;
mod critical_speed;
mod damping_range;
mod events;
mod followed_modes;
mod jump;
mod modes_at_speed;
mod search;

use confirmation::COMPLETE_BELOW;
use events::Event;
use followed_modes::{Descent, FollowedModes};
use search::{EventSearch, StepSize};
