//! Suspension elements: a row, a stretch, and a law.
//!
//! ```math
//! K += k row⊗stretch,   C += c row⊗stretch
//! ```
//!
//! The row is the linear form of the coordinates along which the element's force acts, the stretch that which the
//! element feels. A roll prescribed by the rails is part of stretches, never of rows: its reactions go into the
//! rails' vertical loads.

use super::{LinearSystem, Row};
use crate::vehicle::AirSpring;

/// An element of the suspension.
#[derive(Debug, Clone)]
pub struct Element {
    /// Its name.
    pub name: Name,
    /// Row: where its force acts.
    pub row: Row,
    /// Stretch.
    pub stretch: Row,
    /// Force over stretch.
    pub law: Law,
    /// Force or torque at which it slips, N or N m; `None`: never.
    pub breakaway: Option<f64>,
}

/// Name of an element: its kind, its place, and its side (0 left, 1 right) where both sides have one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Name {
    /// Place along the vehicle.
    pub place: Place,
    /// Kind, in words.
    pub kind: &'static str,
    /// Side.
    pub side: usize,
}

/// Place of an element along the vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// At truck 0 or 1.
    Truck(usize),
    /// At wheelset 0–3.
    Wheelset(usize),
    /// At none of them.
    Vehicle,
}

impl Name {
    /// Of an element of truck `j`.
    pub const fn of_truck(kind: &'static str, j: usize) -> Self {
        let place = Place::Truck(j);
        Self {
            kind,
            place,
            side: 0,
        }
    }

    /// Of an element of wheelset `i`.
    pub const fn of_wheelset(kind: &'static str, i: usize) -> Self {
        let place = Place::Wheelset(i);
        Self {
            kind,
            place,
            side: 0,
        }
    }

    /// The same element on a side.
    #[must_use]
    pub const fn on_side(self, side: usize) -> Self {
        Self { side, ..self }
    }

    /// The same element of the trailing end, for one of the leading end.
    pub fn at_trailing_end(self) -> Option<Self> {
        let place = match self.place {
            Place::Truck(0) => Place::Truck(1),
            Place::Wheelset(i @ (0 | 1)) => Place::Wheelset(i + 2),
            _ => return None,
        };
        Some(Self { place, ..self })
    }

    /// The mirror image behind the middle of the vehicle, for an element ahead of it.
    pub fn mirrored_behind(self) -> Option<Self> {
        let place = match self.place {
            Place::Truck(0) => Place::Truck(1),
            Place::Wheelset(i @ (0 | 1)) => Place::Wheelset(3 - i),
            _ => return None,
        };
        Some(Self { place, ..self })
    }
}

/// Law of an element: a spring and a damper side by side, and beside them perhaps a branch with a massless inner
/// point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// k, N/m or N m/rad.
    pub stiffness: f64,
    /// c, N s/m or N m s/rad.
    pub damping: f64,
    /// Branch in parallel.
    pub branch: Option<Branch>,
}

/// A spring k_1 in series with a damper c and a spring k_r side by side. With x the elongation of the damper:
///
/// ```math
/// K += k_1 (row − x)⊗(stretch − x) + k_r x⊗x,   C += c x⊗x
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// k_1.
    pub series: f64,
    /// c, above 0.
    pub damping: f64,
    /// k_r.
    pub reservoir: f64,
}

impl Law {
    /// A spring k and a damper c side by side.
    pub fn new(stiffness: f64, damping: f64) -> Self {
        Self {
            stiffness,
            damping,
            branch: None,
        }
    }

    /// A spring k beside a damper c that is in series with a spring k_s; `None`: the damper is held rigidly.
    pub fn with_series(stiffness: f64, damping: f64, series: Option<f64>) -> Self {
        match series {
            None => Self::new(stiffness, damping),
            Some(_) if damping == 0.0 => Self::new(stiffness, 0.0),
            Some(series) => Self {
                stiffness,
                damping: 0.0,
                branch: Some(Branch {
                    series,
                    damping,
                    reservoir: 0.0,
                }),
            },
        }
    }

    /// An air spring with an orifice (Figure 3.4.5a). An orifice without damping leaves springs alone.
    pub fn air(spring: &AirSpring) -> Self {
        if spring.orifice_damping == 0.0 {
            return Self::new(spring.static_stiffness(), 0.0);
        }
        Self {
            stiffness: spring.direct_stiffness,
            damping: 0.0,
            branch: Some(Branch {
                series: spring.series_stiffness,
                damping: spring.orifice_damping,
                reservoir: spring.reservoir_stiffness,
            }),
        }
    }

    /// The law of `factor` such elements side by side, or of one at a lever arm whose square is the factor.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        let branch = self.branch.map(|branch| Branch {
            series: factor * branch.series,
            damping: factor * branch.damping,
            reservoir: factor * branch.reservoir,
        });
        Self {
            stiffness: factor * self.stiffness,
            damping: factor * self.damping,
            branch,
        }
    }

    /// Stiffness under a load that does not change: dampers carry none.
    pub fn steady_stiffness(&self) -> f64 {
        let branch = self.branch.map_or(
            0.0,
            |Branch {
                 series, reservoir, ..
             }| { series * reservoir / (series + reservoir) },
        );
        self.stiffness + branch
    }
}

impl Element {
    /// An element whose force acts along the stretch.
    pub fn new(name: Name, stretch: Row, law: Law) -> Self {
        Self::acting(name, stretch.clone(), stretch, law)
    }

    /// An element whose force acts along another form than the stretch.
    pub fn acting(name: Name, row: Row, stretch: Row, law: Law) -> Self {
        Self {
            name,
            row,
            stretch,
            law,
            breakaway: None,
        }
    }

    /// The element with a force or torque, N or N m, at which it slips.
    #[must_use]
    pub fn slipping_at(self, breakaway: f64) -> Self {
        Self {
            breakaway: Some(breakaway),
            ..self
        }
    }

    /// Adds the element to a system; `inner` is the index of its inner coordinate.
    fn add_to(&self, system: &mut LinearSystem, inner: usize) {
        let Self {
            row, stretch, law, ..
        } = self;
        system.add_element(row, stretch, law.stiffness, law.damping);
        if let Some(branch) = law.branch {
            let x = Row::unit(inner);
            let (row, stretch) = (row.clone() - x.clone(), stretch.clone() - x.clone());
            system.add_stiffness(&row, &stretch, branch.series);
            system.add_element(&x, &x, branch.reservoir, branch.damping);
        }
    }
}

/// Names of the elements with an inner coordinate, in the order of these.
pub fn inner_coordinates(elements: &[Element]) -> Vec<Name> {
    let with_branch = elements
        .iter()
        .filter(|element| element.law.branch.is_some());
    with_branch.map(|element| element.name).collect()
}

/// Adds elements to a system whose inner coordinates begin at an index.
pub fn assemble(elements: &[Element], system: &mut LinearSystem, mut inner: usize) {
    for element in elements {
        element.add_to(system, inner);
        inner += usize::from(element.law.branch.is_some());
    }
}

/// Stretch of the element with a name.
///
/// # Panics
///
/// If there is no such element: models name their own.
pub fn named(elements: &[Element], name: Name) -> &Element {
    let found = elements.iter().find(|element| element.name == name);
    found.expect("an element of the model")
}
