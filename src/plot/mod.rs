//! Plots: figures, their layout, and their drawing as SVG and PNG.
//!
//! A [`Figure`] is the content: panels with axes, curves, marks and, behind contour lines, the field on
//! its grid. All its coordinates are in SI units, so the numbers can be read back. [`Drawing::new`] is
//! the layout: frames of the panels, places of the labels. [`Drawing::svg`] writes it, for print or for
//! a page; the `png` module makes a picture of it.
//!
//! ```
//! use bogie::plot::{Axis, Curve, Drawing, Family, Figure, Panel, Scale, Stroke, Theme, Unit};
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
