//! Numbering of the coordinates and inputs of the lateral model.

use crate::{case::TruckRoll, dynamics::Row, vehicle::Vehicle};

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
}

impl Coordinate {
    /// The body it moves.
    pub fn body(self) -> Body {
        match self {
            Self::WheelsetLateral(i) | Self::WheelsetYaw(i) => Body::Wheelset(i),
            Self::TruckLateral(j) | Self::TruckYaw(j) | Self::TruckRoll(j) => Body::Truck(j),
            Self::CarbodyLateral | Self::CarbodyYaw | Self::CarbodyRoll => Body::Carbody,
        }
    }
}

/// Numbering of [q, u]: wheelsets, trucks, carbody; then alignment and roll at the wheelsets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Coordinates {
    truck_roll: TruckRoll,
}

// Methods of one shape, although the first coordinates stand in the same place in every form.
#[allow(clippy::unused_self)]
impl Coordinates {
    pub(super) fn new(truck_roll: TruckRoll) -> Self {
        Self { truck_roll }
    }

    fn carbody(self) -> usize {
        match self.truck_roll {
            TruckRoll::Prescribed => 12,
            TruckRoll::Dynamic => 14,
        }
    }

    /// Number of degrees of freedom.
    pub fn len(self) -> usize {
        self.carbody() + 3
    }

    /// Never: there are always degrees of freedom.
    pub fn is_empty(self) -> bool {
        false
    }

    /// What the coordinate at `index` is.
    pub fn coordinate(self, index: usize) -> Coordinate {
        match index {
            0..4 => Coordinate::WheelsetLateral(index),
            4..8 => Coordinate::WheelsetYaw(index - 4),
            8..10 => Coordinate::TruckLateral(index - 8),
            10..12 => Coordinate::TruckYaw(index - 10),
            _ => match index - self.carbody().min(index) {
                _ if index < self.carbody() => Coordinate::TruckRoll(index - 12),
                0 => Coordinate::CarbodyLateral,
                1 => Coordinate::CarbodyYaw,
                _ => Coordinate::CarbodyRoll,
            },
        }
    }

    /// Coordinates of the leading truck and its wheelsets with those of the trailing one.
    pub(super) fn trucks(self) -> Vec<[usize; 2]> {
        let counterpart = |index: usize| match self.coordinate(index) {
            Coordinate::WheelsetLateral(0 | 1) | Coordinate::WheelsetYaw(0 | 1) => Some(index + 2),
            Coordinate::TruckLateral(0) | Coordinate::TruckYaw(0) | Coordinate::TruckRoll(0) => {
                Some(index + 1)
            }
            _ => None,
        };
        (0..self.len())
            .filter_map(|index| Some([index, counterpart(index)?]))
            .collect()
    }

    /// Diagonal of M, kg and kg m².
    pub(in crate::dynamics) fn masses(self, vehicle: &Vehicle) -> Vec<f64> {
        let (w, t, c) = (&vehicle.wheelset, &vehicle.truck, &vehicle.carbody);
        (0..self.len())
            .map(|index| match self.coordinate(index) {
                Coordinate::WheelsetLateral(_) => w.mass,
                Coordinate::WheelsetYaw(_) => w.yaw_inertia,
                Coordinate::TruckLateral(_) => t.mass,
                Coordinate::TruckYaw(_) => t.yaw_inertia,
                Coordinate::TruckRoll(_) => t.roll_inertia,
                Coordinate::CarbodyLateral => c.mass,
                Coordinate::CarbodyYaw => c.yaw_inertia,
                Coordinate::CarbodyRoll => c.roll_inertia,
            })
            .collect()
    }

    pub(in crate::dynamics) fn y_w(self, i: usize) -> Row {
        Row::unit(i)
    }

    pub(in crate::dynamics) fn psi_w(self, i: usize) -> Row {
        Row::unit(4 + i)
    }

    pub(in crate::dynamics) fn y_t(self, j: usize) -> Row {
        Row::unit(8 + j)
    }

    pub(in crate::dynamics) fn psi_t(self, j: usize) -> Row {
        Row::unit(10 + j)
    }

    /// φ_t where truck roll is a degree of freedom.
    pub(super) fn phi_t(self, j: usize) -> Option<Row> {
        (self.truck_roll == TruckRoll::Dynamic).then(|| Row::unit(12 + j))
    }

    pub(in crate::dynamics) fn y_c(self) -> Row {
        Row::unit(self.carbody())
    }

    pub(super) fn psi_c(self) -> Row {
        Row::unit(self.carbody() + 1)
    }

    pub(super) fn phi_c(self) -> Row {
        Row::unit(self.carbody() + 2)
    }

    /// Index of y_a at wheelset `i` in [q, u].
    pub(super) fn alignment_input(self, i: usize) -> usize {
        self.len() + i
    }

    /// Index of φ_x at wheelset `i` in [q, u].
    pub(super) fn roll_input(self, i: usize) -> usize {
        self.len() + 4 + i
    }

    pub(super) fn y_a(self, i: usize) -> Row {
        Row::unit(self.alignment_input(i))
    }

    pub(super) fn phi_x(self, i: usize) -> Row {
        Row::unit(self.roll_input(i))
    }
}
