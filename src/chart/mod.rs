//! Design charts: figures, how they are drawn, and the book of the report's charts.
//!
//! A [`Figure`] says what is shown: panels with axes, curves, marks and, behind contour lines, the
//! field on its grid. All its coordinates are in SI units, so what is drawn can be read back.
//! [`Drawing::new`] lays it out: where each panel's frame is, where each label stands.
//! [`Drawing::svg`] writes it, for print or for a page; `png` makes a picture of it and
//! [`table`] the numbers behind it. The [`book`] has one function for every chart of the report.
//!
//! ```
//! use bogie::chart::{Axis, Curve, Drawing, Family, Figure, Panel, Scale, Stroke, Theme, Unit};
//!
//! let x = Axis::new("frequency", "f", "frequency_hz", Scale::Log, [1.0, 80.0], [Unit::new("Hz", 1.0)]);
//! let y = Axis::new("acceleration", "a", "acceleration_m_per_s2", Scale::Log, [0.1, 10.0], [
//!     Unit::new("m/s^2", 1.0),
//!     Unit::new("g", 9.80665),
//! ]);
//! let line = Curve::line("sum of all", (1..80).map(|f| [f64::from(f), 0.1 * f64::from(f)]));
//! let panel = Panel::new("", x, y).with(Family::new("sum", "", Stroke::default()).curve(line));
//! let figure = Figure::new("0.1", "sum", "A sum").panel(panel);
//! let svg = Drawing::new(&figure).svg(Theme::Print);
//! assert!(svg.starts_with("<svg"), "{svg}");
//! assert!(svg.contains("A sum"), "{svg}");
//! ```

mod axis;
pub mod book;
pub mod contour;
mod curve;
mod field;
mod figure;
mod font;
mod frame;
mod label;
mod layout;
mod legend;
mod mark;
mod markup;
mod obstacle;
mod placement;
#[cfg(feature = "png")]
pub mod png;
mod polyline;
mod ruler;
mod stroke;
mod svg;
pub mod table;
mod text;
mod theme;
mod tick;

pub use axis::{Axis, Scale, System, Unit};
pub use curve::{Curve, Family, Labels};
pub use field::{Field, Layer};
pub use figure::{Figure, Panel};
pub use frame::Frame;
pub use label::PlacedLabel;
pub use layout::Drawing;
pub use mark::{Direction, Limit, Mark, Shade, Symbol};
pub use stroke::{Dash, Ink, Stroke, Weight};
pub use text::{Level, Text};
pub use theme::{Theme, stylesheet};
pub use tick::{Tick, ticks};
