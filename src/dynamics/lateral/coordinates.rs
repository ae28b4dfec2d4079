//! Numbering of the coordinates and inputs of the lateral model.

use crate::{
    case::TruckRoll,
    dynamics::{Row, element::Name},
    vehicle::Vehicle,
};

/// A degree of freedom; wheelsets and trucks count from 0 at the front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinate {
    /// y_w.
    WheelsetLateral(usize),
    /// ψ_w.
    WheelsetYaw(usize),
    /// y_t.
    TruckLateral(usize),
    /// ψ_t.
    TruckYaw(usize),
    /// φ_t.
    TruckRoll(usize),
    /// y_c.
    CarbodyLateral,
    /// ψ_c.
    CarbodyYaw,
    /// φ_c.
    CarbodyRoll,
    /// Elongation of the damper in an element with a spring in series.
    Inner(Name),
}

/// The body that a coordinate moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// A wheelset, 0–3.
    Wheelset(usize),
    /// A truck frame, 0–1.
    Truck(usize),
    /// The carbody.
    Carbody,
    /// None: a point within an element.
    Element,
}

impl Coordinate {
    /// The body it moves.
    pub fn body(self) -> Body {
        match self {
            Self::WheelsetLateral(i) | Self::WheelsetYaw(i) => Body::Wheelset(i),
            Self::TruckLateral(j) | Self::TruckYaw(j) | Self::TruckRoll(j) => Body::Truck(j),
            Self::CarbodyLateral | Self::CarbodyYaw | Self::CarbodyRoll => Body::Carbody,
            Self::Inner(_) => Body::Element,
        }
    }

    /// Whether it is a lateral displacement of a body.
    pub(in crate::dynamics) fn is_lateral(self) -> bool {
        matches!(
            self,
            Self::WheelsetLateral(_) | Self::TruckLateral(_) | Self::CarbodyLateral
        )
    }

    /// The same coordinate of the trailing end, for one of the leading end.
    fn counterpart(self) -> Option<Self> {
        match self {
            Self::WheelsetLateral(i @ (0 | 1)) => Some(Self::WheelsetLateral(i + 2)),
            Self::WheelsetYaw(i @ (0 | 1)) => Some(Self::WheelsetYaw(i + 2)),
            Self::TruckLateral(0) => Some(Self::TruckLateral(1)),
            Self::TruckYaw(0) => Some(Self::TruckYaw(1)),
            Self::TruckRoll(0) => Some(Self::TruckRoll(1)),
            Self::Inner(name) => name.at_trailing_end().map(Self::Inner),
            _ => None,
        }
    }

    /// Its mass or inertia in a vehicle, kg or kg m²; none of an inner point.
    fn mass(self, vehicle: &Vehicle) -> f64 {
        let (truck, carbody) = (|j| vehicle.truck_at(j), &vehicle.carbody);
        match self {
            Self::WheelsetLateral(i) => vehicle.wheelset_at(i / 2).mass,
            Self::WheelsetYaw(i) => vehicle.wheelset_at(i / 2).yaw_inertia,
            Self::TruckLateral(j) => truck(j).mass,
            Self::TruckYaw(j) => truck(j).yaw_inertia,
            Self::TruckRoll(j) => truck(j).roll_inertia,
            Self::CarbodyLateral => carbody.mass,
            Self::CarbodyYaw => carbody.yaw_inertia,
            Self::CarbodyRoll => carbody.roll_inertia,
            Self::Inner(_) => 0.0,
        }
    }
}

/// Numbering of [q, u]: wheelsets, trucks, carbody, inner points of elements; then alignment and roll at the
/// wheelsets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coordinates {
    list: Vec<Coordinate>,
    places: Places,
}

/// Indices of the bodies' coordinates, found once.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct Places {
    y_w: [usize; 4],
    psi_w: [usize; 4],
    y_t: [usize; 2],
    psi_t: [usize; 2],
    phi_t: Option<[usize; 2]>,
    y_c: usize,
    psi_c: usize,
    phi_c: usize,
}

impl Coordinates {
    /// Of a model with some form of truck roll, and inner points of elements.
    pub(super) fn new(truck_roll: TruckRoll, inner: &[Name]) -> Self {
        let mut list = Vec::with_capacity(17 + inner.len());
        list.extend((0..4).map(Coordinate::WheelsetLateral));
        list.extend((0..4).map(Coordinate::WheelsetYaw));
        list.extend((0..2).map(Coordinate::TruckLateral));
        list.extend((0..2).map(Coordinate::TruckYaw));
        if truck_roll == TruckRoll::Dynamic {
            list.extend((0..2).map(Coordinate::TruckRoll));
        }
        list.push(Coordinate::CarbodyLateral);
        list.push(Coordinate::CarbodyYaw);
        list.push(Coordinate::CarbodyRoll);
        list.extend(inner.iter().copied().map(Coordinate::Inner));
        let mut places = Places::default();
        for (index, coordinate) in list.iter().enumerate() {
            match *coordinate {
                Coordinate::WheelsetLateral(i) => places.y_w[i] = index,
                Coordinate::WheelsetYaw(i) => places.psi_w[i] = index,
                Coordinate::TruckLateral(j) => places.y_t[j] = index,
                Coordinate::TruckYaw(j) => places.psi_t[j] = index,
                Coordinate::TruckRoll(j) => places.phi_t.get_or_insert_default()[j] = index,
                Coordinate::CarbodyLateral => places.y_c = index,
                Coordinate::CarbodyYaw => places.psi_c = index,
                Coordinate::CarbodyRoll => places.phi_c = index,
                Coordinate::Inner(_) => {}
            }
        }
        Self { list, places }
    }

    /// Number of coordinates.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Number of coordinates with mass, which come first.
    pub(in crate::dynamics) fn massive(&self) -> usize {
        let massive = self.list.iter().take_while(|c| c.body() != Body::Element);
        massive.count()
    }

    /// The coordinate at `index`.
    pub fn coordinate(&self, index: usize) -> Coordinate {
        self.list[index]
    }

    /// Index of a coordinate; `None` if the model does not have it.
    fn find(&self, coordinate: Coordinate) -> Option<usize> {
        self.list.iter().position(|other| *other == coordinate)
    }

    /// Indices of y_w and ψ_w of wheelset `i`.
    pub fn wheelset(&self, i: usize) -> [usize; 2] {
        [self.places.y_w[i], self.places.psi_w[i]]
    }

    /// Coordinates of the leading end with those of the trailing one.
    pub(super) fn ends(&self) -> Vec<[usize; 2]> {
        let pair = |(index, coordinate): (usize, &Coordinate)| {
            Some([index, self.find(coordinate.counterpart()?)?])
        };
        self.list.iter().enumerate().filter_map(pair).collect()
    }

    /// Diagonal of M, kg and kg m².
    pub(in crate::dynamics) fn masses(&self, vehicle: &Vehicle) -> Vec<f64> {
        self.list.iter().map(|c| c.mass(vehicle)).collect()
    }

    pub(in crate::dynamics) fn y_w(&self, i: usize) -> Row {
        Row::unit(self.places.y_w[i])
    }

    pub(in crate::dynamics) fn psi_w(&self, i: usize) -> Row {
        Row::unit(self.places.psi_w[i])
    }

    pub(in crate::dynamics) fn y_t(&self, j: usize) -> Row {
        Row::unit(self.places.y_t[j])
    }

    pub(in crate::dynamics) fn psi_t(&self, j: usize) -> Row {
        Row::unit(self.places.psi_t[j])
    }

    /// φ_t where truck roll is a degree of freedom.
    pub(in crate::dynamics) fn phi_t(&self, j: usize) -> Option<Row> {
        self.places.phi_t.map(|phi_t| Row::unit(phi_t[j]))
    }

    pub(in crate::dynamics) fn y_c(&self) -> Row {
        Row::unit(self.places.y_c)
    }

    pub(in crate::dynamics) fn psi_c(&self) -> Row {
        Row::unit(self.places.psi_c)
    }

    pub(in crate::dynamics) fn phi_c(&self) -> Row {
        Row::unit(self.places.phi_c)
    }

    /// Index of y_a at wheelset `i` in [q, u].
    pub(super) fn alignment_input(&self, i: usize) -> usize {
        self.len() + i
    }

    /// Index of φ_x at wheelset `i` in [q, u].
    pub(super) fn roll_input(&self, i: usize) -> usize {
        self.len() + 4 + i
    }

    pub(super) fn y_a(&self, i: usize) -> Row {
        Row::unit(self.alignment_input(i))
    }

    pub(super) fn phi_x(&self, i: usize) -> Row {
        Row::unit(self.roll_input(i))
    }

    /// Change per unit of curvature, 1/m, of a form in coordinates relative to the local centre line and radial
    /// line, against the same in straight axes: ψ counts less σ/R and y less σ²/(2R), σ being the station of
    /// the body ahead of the carbody's middle, m. Roll is not replaced, so that a prescribed roll, which follows
    /// from coordinates relative to the track, must not be part of the form.
    pub(in crate::dynamics) fn offset_in_curve(&self, row: &Row, vehicle: &Vehicle) -> f64 {
        let l_s = vehicle.carbody.half_truck_spacing;
        // Station of the end that a body belongs to, and of the body within it.
        let station = |&(index, _): &(usize, f64)| match self.list[index].body() {
            Body::Wheelset(i) => {
                let b = vehicle.truck_at(i / 2).half_wheelbase;
                let sign = if i.is_multiple_of(2) { b } else { -b };
                (if i < 2 { l_s } else { -l_s }, sign)
            }
            Body::Truck(0) => (l_s, 0.0),
            Body::Truck(_) => (-l_s, 0.0),
            Body::Carbody | Body::Element => (0.0, 0.0),
        };
        // Elements do not feel a displacement of the whole vehicle: within one end its own station is left out,
        // which saves rounding.
        let mut ends = row.terms().iter().map(|term| station(term).0.to_bits());
        let first = ends.next();
        let within = ends.all(|end| Some(end) == first);
        let terms = row.terms().iter().map(|term| {
            let (end, own) = station(term);
            let sigma = if within { own } else { end + own };
            let (coordinate, c) = (self.list[term.0], term.1);
            match coordinate {
                Coordinate::WheelsetLateral(_)
                | Coordinate::TruckLateral(_)
                | Coordinate::CarbodyLateral => -c * sigma * sigma / 2.0,
                Coordinate::WheelsetYaw(_) | Coordinate::TruckYaw(_) | Coordinate::CarbodyYaw => {
                    -c * sigma
                }
                Coordinate::TruckRoll(_) | Coordinate::CarbodyRoll | Coordinate::Inner(_) => 0.0,
            }
        });
        terms.sum()
    }
}
