//! The suspension as a list of elements, in the lateral and in the vertical model.
//!
//! | element | lateral model: row | stretch | constant |
//! |---|---|---|---|
//! | primary lateral, wheelset at s = ±b | y_t + sψ_t − y_w | row + h_tp φ_t | 2K_py, 2C_py |
//! | primary yaw (longitudinal springs at ±d_p) | ψ_t − ψ_w | row | 2d_p²K_px, 2d_p²C_px |
//! | secondary lateral, truck at ±l_s | y_c ± l_s ψ_c + h_cs φ_c − y_t | row + h_ts φ_t | 2K_sy, 2C_sy |
//! | secondary roll | φ_c | φ_c − φ_t | 2d_s²K_sz, 2d_s²C_sz |
//! | secondary yaw | ψ_c − ψ_t | row | K_sψ, C_sψ |
//! | anti-roll bar | φ_c | φ_c − φ_t | K_ar |
//! | carbody weight on its springs | φ_c | φ_c | −M_c g h_cs |
//! | primary roll, truck roll free | φ_t | φ_t − φ_w | 2d_p²K_pz, 2d_p²C_pz |
//! | weight on the truck, truck roll free | φ_t | φ_t | −(M_c g/2) h_ts − (M_c g/2 + M_t g) h_tp |
//!
//! With truck roll free, φ_t is part of the rows just as of the stretches. In the vertical model elements act along
//! the stretch: secondary ones at (±l_s, ±d_s), primary ones at (±l_s ± b, ±d_p), an anti-roll bar along
//! φ_c + T1 u_1 + T2 u_2 − φ_t.

use super::{
    Row,
    element::{Element, Law, Name, Place},
    lateral, vertical,
};
use crate::vehicle::{End, GRAVITY};

/// Kinds of elements.
pub const PRIMARY_LATERAL: &str = "primary lateral";
/// Longitudinal springs, in yaw.
pub const PRIMARY_YAW: &str = "primary yaw";
/// Vertical springs, in roll of the frame.
pub const PRIMARY_ROLL: &str = "primary roll";
/// One spring.
pub const PRIMARY_VERTICAL: &str = "primary vertical";
/// Both sides.
pub const SECONDARY_LATERAL: &str = "secondary lateral";
/// Vertical springs, in roll.
pub const SECONDARY_ROLL: &str = "secondary roll";
/// The element that may slip.
pub const SECONDARY_YAW: &str = "secondary yaw";
/// One spring.
pub const SECONDARY_VERTICAL: &str = "secondary vertical";
/// Between truck frame and carbody.
pub const ANTI_ROLL_BAR: &str = "anti-roll bar";
/// Overturning weight of a body on its springs.
const WEIGHT: &str = "weight";

/// Elements of the lateral model.
pub(super) fn lateral(model: &lateral::Builder) -> Vec<Element> {
    let mut elements = Vec::with_capacity(24);
    add_primary(model, &mut elements);
    add_secondary(model, &mut elements);
    elements
}

/// An element whose stretch holds a truck's roll, which is part of the row only where it is `free`.
fn with_roll(name: Name, row: Row, stretch: Row, free: bool, law: Law) -> Element {
    let row = if free { stretch.clone() } else { row };
    Element::acting(name, row, stretch, law)
}

fn add_primary(model: &lateral::Builder, elements: &mut Vec<Element>) {
    let q = &model.q;
    for i in 0..4 {
        let j = i / 2;
        let End {
            truck, suspension, ..
        } = &model.ends[j];
        let (primary, d_p2) = (&suspension.primary, truck.half_primary_spacing.powi(2));
        let free = q.phi_t(j).is_some();
        let (row, stretch) = (
            model.primary_lateral_row(i),
            model.primary_lateral_stretch(i),
        );
        let law = Law::new(primary.lateral_stiffness, primary.c_py()).times(2.0);
        elements.push(with_roll(
            Name::of_wheelset(PRIMARY_LATERAL, i),
            row,
            stretch,
            free,
            law,
        ));

        let law = Law::new(primary.longitudinal_stiffness, primary.c_px()).times(2.0 * d_p2);
        let yaw = q.psi_t(j) - q.psi_w(i);
        elements.push(Element::new(Name::of_wheelset(PRIMARY_YAW, i), yaw, law));

        if let Some(phi_t) = q.phi_t(j) {
            let stretch = phi_t.clone() - model.wheelset_roll(i);
            let law = Law::new(primary.vertical_stiffness, primary.c_pz()).times(2.0 * d_p2);
            elements.push(Element::acting(
                Name::of_wheelset(PRIMARY_ROLL, i),
                phi_t,
                stretch,
                law,
            ));
        }
    }
}

fn add_secondary(model: &lateral::Builder, elements: &mut Vec<Element>) {
    let (q, vehicle) = (&model.q, model.vehicle);
    let half_carbody_weight = vehicle.carbody.mass * GRAVITY / 2.0;
    for j in 0..2 {
        let End {
            truck, suspension, ..
        } = &model.ends[j];
        let (secondary, d_s2) = (&suspension.secondary, truck.half_secondary_spacing.powi(2));
        let free = q.phi_t(j).is_some();
        let (row, stretch) = (
            model.secondary_lateral_row(j),
            model.secondary_lateral_stretch(j),
        );
        let law = Law::new(secondary.lateral_stiffness, secondary.lateral_damping).times(2.0);
        elements.push(with_roll(
            Name::of_truck(SECONDARY_LATERAL, j),
            row,
            stretch,
            free,
            law,
        ));

        let stretch = q.phi_c() - model.truck_roll(j);
        let law =
            Law::new(secondary.vertical_stiffness, secondary.vertical_damping).times(2.0 * d_s2);
        elements.push(with_roll(
            Name::of_truck(SECONDARY_ROLL, j),
            q.phi_c(),
            stretch,
            free,
            law,
        ));

        let yaw = q.psi_c() - q.psi_t(j);
        let law = Law::new(secondary.yaw_stiffness, secondary.c_spsi());
        let yaw = Element::new(Name::of_truck(SECONDARY_YAW, j), yaw, law);
        elements.push(yaw.slipping_at(secondary.yaw_breakaway_torque));

        if let Some(phi_t) = q.phi_t(j) {
            let truck_weight = truck.mass * GRAVITY;
            let weight = half_carbody_weight * truck.depth_below_secondary
                + (half_carbody_weight + truck_weight) * truck.height_above_primary;
            let law = Law::new(-weight, 0.0);
            elements.push(Element::new(Name::of_truck(WEIGHT, j), phi_t, law));
        }
    }
    for j in 0..2 {
        if let Some(stiffness) = model.ends[j].suspension.anti_roll_bar {
            let (name, free) = (Name::of_truck(ANTI_ROLL_BAR, j), q.phi_t(j).is_some());
            let stretch = q.phi_c() - model.truck_roll(j);
            elements.push(with_roll(
                name,
                q.phi_c(),
                stretch,
                free,
                Law::new(stiffness, 0.0),
            ));
        }
    }
    let overturning = 2.0 * half_carbody_weight * vehicle.carbody.height_above_secondary;
    let law = Law::new(-overturning, 0.0);
    let overturns = Name {
        kind: WEIGHT,
        place: Place::Vehicle,
        side: 0,
    };
    elements.push(Element::new(overturns, q.phi_c(), law));
}

/// Elements of the vertical model.
pub(super) fn vertical(model: &vertical::Builder) -> Vec<Element> {
    let mut elements = Vec::with_capacity(12);
    for j in 0..2 {
        let secondary = &model.ends[j].suspension.secondary;
        let law = match &secondary.air_spring {
            Some(air) => Law::air(air),
            None => Law::new(secondary.vertical_stiffness, secondary.vertical_damping),
        };
        for (side, sign) in SIDES {
            let stretch = model.secondary_stretch(j, sign);
            elements.push(Element::new(
                Name::of_truck(SECONDARY_VERTICAL, j).on_side(side),
                stretch,
                law,
            ));
        }
    }
    for i in 0..4 {
        let primary = &model.ends[i / 2].suspension.primary;
        let law = Law::new(primary.vertical_stiffness, primary.c_pz());
        for (side, sign) in SIDES {
            let stretch = model.primary_stretch(i, sign);
            elements.push(Element::new(
                Name::of_wheelset(PRIMARY_VERTICAL, i).on_side(side),
                stretch,
                law,
            ));
        }
    }
    for j in 0..2 {
        if let Some(stiffness) = model.ends[j].suspension.anti_roll_bar {
            let stretch =
                model.carbody_roll(model.truck_station(j)) - vertical::Builder::truck_roll(j);
            let name = Name::of_truck(ANTI_ROLL_BAR, j);
            elements.push(Element::new(name, stretch, Law::new(stiffness, 0.0)));
        }
    }
    elements
}

/// Left and right with their signs.
const SIDES: [(usize, f64); 2] = [(0, 1.0), (1, -1.0)];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        dynamics::lateral::{Coordinate, suspension_on_rails},
        vehicle::Vehicle,
        wheel_rail::WheelRail,
    };

    /// A rigid vehicle that stays straight on a curve, at any place and angle, strains no element. 1e-13 of
    /// σ²/2R and of the place, which cancel.
    #[test]
    fn a_straight_vehicle_on_a_curve_strains_no_element() {
        let mut vehicle = Vehicle::prototype();
        vehicle.truck.half_wheelbase *= 1.1;
        let contact = WheelRail::default().contact();
        let (q, elements) = suspension_on_rails(&vehicle, contact);
        let (place, angle, curvature) = (0.01, 0.003, 1.0 / 300.0);
        let l_s = vehicle.carbody.half_truck_spacing;
        let relative = |index: usize| {
            let y = |s: f64| place + s * angle + s * s / 2.0 * curvature;
            let psi = |s: f64| angle + s * curvature;
            let truck = |j: usize| if j == 0 { l_s } else { -l_s };
            match q.coordinate(index) {
                Coordinate::WheelsetLateral(i) => y(vehicle.wheelset_position(i)),
                Coordinate::WheelsetYaw(i) => psi(vehicle.wheelset_position(i)),
                Coordinate::TruckLateral(j) => y(truck(j)),
                Coordinate::TruckYaw(j) => psi(truck(j)),
                Coordinate::CarbodyLateral => y(0.0),
                Coordinate::CarbodyYaw => psi(0.0),
                _ => 0.0,
            }
        };
        for element in elements {
            let terms = element.row.terms().iter();
            let form: f64 = terms.map(|&(i, c)| c * relative(i)).sum();
            let stretch = form + curvature * q.offset_in_curve(&element.row, &vehicle);
            assert!(stretch.abs() < 1e-13, "{:?}: {stretch}", element.name);
        }
    }

    /// A series spring of any stiffness carries no steady load; an orifice without damping leaves the springs.
    #[test]
    fn laws_have_their_limits() {
        let maxwell = Law::with_series(2e5, 3e4, Some(6e6));
        assert!((maxwell.steady_stiffness() - 2e5).abs() < 1e-9);
        assert_eq!(Law::with_series(2e5, 3e4, None), Law::new(2e5, 3e4));
        assert_eq!(Law::with_series(2e5, 0.0, Some(6e6)), Law::new(2e5, 0.0));
    }
}
