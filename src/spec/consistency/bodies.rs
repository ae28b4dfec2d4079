//! Inertias that do not fit the mass and size of their bodies.

use super::situation::{Situation, shown};
use crate::spec::diagnostic::Diagnostic;
use crate::units::Quantity;
use crate::vehicle::Vehicle;

type Doubts = Vec<Diagnostic>;

/// A radius of gyration beside what the body can have.
struct Gyration {
    /// Paths of the inertia, the mass and the length, below `vehicle`.
    paths: [&'static str; 3],
    inertia: f64,
    mass: f64,
    /// Least and greatest usual radius √(I/M), m.
    usual: [f64; 2],
    /// Where these come from.
    why: &'static str,
}

impl Gyration {
    /// Of a body of some mass, kg: from paths, inertia, usual radii and where these come from.
    fn of(mass: f64) -> impl Fn([&'static str; 3], f64, [f64; 2], &'static str) -> Self {
        move |paths, inertia, usual, why| Self {
            paths,
            inertia,
            mass,
            usual,
            why,
        }
    }
}

/// I_z ≤ I_x + I_y for any body whatever; published inertias are rounded, and a frame's are often
/// summed from parts.
const INERTIA_SLACK: f64 = 1.05;

const LONG: &str = "a uniform body has 0.29 of its length, one spread over the middle 70 % 0.2, \
                    one gathered over the trucks 0.35";
const BOX: &str = "a uniform box of 3 m by 3 m has 1.22 m, its walls alone 1.73 m";
const WIDE: &str = "no frame is wider than 3 m";
const FRAME: &str = "no part of a frame reaches farther than its wheels";
const AXLE: &str = "most of a wheelset's mass is in its wheels, at half_contact_distance";
const DISC: &str = "a disc has 0.71 of its radius, a wheelset with its axle less";

/// Doubts about the inertias of carbody, truck frame and wheelset.
pub fn strange_bodies(situation: &Situation, doubts: &mut Doubts) {
    let vehicle = &situation.case.vehicle;
    let bodies = [carbody(vehicle), frame(vehicle), wheelset(vehicle)];
    for gyration in bodies.iter().flatten() {
        radius(situation, gyration, doubts);
    }
    for body in &bodies {
        other_two(situation, body, doubts);
    }
}

fn carbody(vehicle: &Vehicle) -> [Gyration; 3] {
    let body = &vehicle.carbody;
    let gyration = Gyration::of(body.mass);
    let [mass, length] = ["carbody.mass", "carbody.length"];
    let usual = [0.2 * body.length, 0.4 * body.length];
    [
        gyration(
            ["carbody.yaw_inertia", mass, length],
            body.yaw_inertia,
            usual,
            LONG,
        ),
        gyration(
            ["carbody.roll_inertia", mass, mass],
            body.roll_inertia,
            [0.4, 2.5],
            BOX,
        ),
        gyration(
            ["carbody.pitch_inertia", mass, length],
            body.pitch_inertia,
            usual,
            LONG,
        ),
    ]
}

fn frame(vehicle: &Vehicle) -> [Gyration; 3] {
    let body = &vehicle.truck;
    let gyration = Gyration::of(body.mass);
    let [mass, base] = ["truck.mass", "truck.half_wheelbase"];
    let ends = body.half_wheelbase + vehicle.wheelset.rolling_radius;
    let usual = [0.1 * ends, ends];
    [
        gyration(
            ["truck.yaw_inertia", mass, base],
            body.yaw_inertia,
            usual,
            FRAME,
        ),
        gyration(
            ["truck.roll_inertia", mass, mass],
            body.roll_inertia,
            [0.1, 1.5],
            WIDE,
        ),
        gyration(
            ["truck.pitch_inertia", mass, base],
            body.pitch_inertia,
            usual,
            FRAME,
        ),
    ]
}

fn wheelset(vehicle: &Vehicle) -> [Gyration; 3] {
    let body = &vehicle.wheelset;
    let gyration = Gyration::of(body.mass);
    let (mass, a, r_0) = (
        "wheelset.mass",
        body.half_contact_distance,
        body.rolling_radius,
    );
    let [distance, radius] = ["wheelset.half_contact_distance", "wheelset.rolling_radius"];
    let across = [0.4 * a, 1.5 * a];
    [
        gyration(
            ["wheelset.yaw_inertia", mass, distance],
            body.yaw_inertia,
            across,
            AXLE,
        ),
        gyration(
            ["wheelset.roll_inertia", mass, distance],
            body.roll_inertia,
            across,
            AXLE,
        ),
        gyration(
            ["wheelset.spin_inertia", mass, radius],
            body.spin_inertia,
            [0.2 * r_0, r_0],
            DISC,
        ),
    ]
}

/// Where the first of `paths`, below `vehicle`, stands.
fn place(situation: &Situation, paths: &[&str]) -> Option<std::ops::Range<usize>> {
    let paths: Vec<String> = paths.iter().map(|path| format!("vehicle.{path}")).collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    situation.place(&paths)
}

fn radius(situation: &Situation, gyration: &Gyration, doubts: &mut Doubts) {
    let [least, most] = gyration.usual;
    let radius = (gyration.inertia / gyration.mass).sqrt();
    if !(least..=most).contains(&radius)
        && let Some(place) = place(situation, &gyration.paths)
    {
        let [least, most, radius] = [least, most, radius].map(|m| shown(m, Quantity::Length));
        let (name, suffix) = (gyration.paths[0], situation.suffix());
        doubts.push(
            Diagnostic::at(
                place,
                format!("`{name}` gives a radius of gyration of {radius}{suffix}"),
                format!("usual: {least} to {most} for this mass and size"),
            )
            .help(gyration.why.to_owned()),
        );
    }
}

/// None of a body's three inertias exceeds the sum of the other two.
fn other_two(situation: &Situation, body: &[Gyration; 3], doubts: &mut Doubts) {
    let sum: f64 = body.iter().map(|gyration| gyration.inertia).sum();
    let [first, second, third] = body.each_ref().map(|gyration| gyration.paths[0]);
    for Gyration { paths, inertia, .. } in body {
        if *inertia > INERTIA_SLACK * (sum - inertia)
            && let Some(place) = place(situation, &[paths[0], first, second, third])
        {
            let suffix = situation.suffix();
            doubts.push(Diagnostic::at(
                place,
                format!(
                    "`{}` exceeds the sum of the body's other two inertias{suffix}",
                    paths[0]
                ),
                "no body has such inertias: I_z ≤ I_x + I_y, and so for each",
            ));
        }
    }
}
