//! The spec: a TOML file with the vehicle, its use, and what its suspension must reach.
//!
//! ```
//! use bogie::spec::Spec;
//!
//! let source = "[vehicle]\nbase = \"prototype\"\n[vehicle.carbody]\nmass = 2500";
//! let mistakes = Spec::parse(source).unwrap_err();
//! let text = mistakes.render("light.toml", source, false);
//! assert!(text.contains("light.toml:4:8") && text.contains("2860 slug"));
//! ```
//!
//! The tables in [`keys`] are the single source of what a spec may contain: they serve reading,
//! the inputs in results, and documentation.

mod case;
mod conditions;
mod consistency;
mod demands;
mod design;
mod diagnostic;
mod document;
pub mod keys;
mod read;
mod scale;
pub mod schema;
mod tracks;
mod value;

pub use conditions::Condition;
pub use demands::{FRONT_POINTS, Front, Goal};
pub use design::{DesignSpace, Freedom, Interval, Order, Prefer};
pub use diagnostic::{Diagnostic, Diagnostics, Doubts, printable};
pub use keys::inputs_si;
pub use read::{MAX_BYTES, STARTER, Spec};
