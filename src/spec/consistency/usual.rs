//! Values far from those of rail vehicles.

use super::situation::{Situation, shown};
use crate::spec::diagnostic::Diagnostic;
use crate::spec::keys;
use crate::units::Quantity;
use crate::vehicle::GRAVITY;

/// Path, least and greatest usual size, SI, and where the ends come from.
type Usual = (&'static str, f64, f64, &'static str);

const TRUCKS: &str = "from light railcars to six-axle freight locomotives";
/// The Görlitz I to III trucks of 1923 to 1930 have the longest wheelbase among passenger trucks with two
/// axles, 3.6 m (T. von Madeyski, Drehgestelle für Reisezugwagen, Elsners Taschenbuch der
/// Eisenbahntechnik 1975); today's coaches have 2.5 m, metro cars 2.0 m and more.
const WHEELBASES: &str = "half of the distance between the axles, which stand at most 3.6 m apart; \
                          2.5 m in today's coaches";
const GAUGES: &str = "from 600 mm gauge to the 1676 mm of India";
const UNIT: &str = "constants are per element, as in Table 4.1.1: check the unit";

/// Ends are rounded outward from what has run on rails.
#[rustfmt::skip]
const USUAL: &[Usual] = &[
    ("service.speed", 0.5, 160.0, "574.8 km/h is the record of a train on rails (2007)"),
    ("vehicle.carbody.mass", 2e3, 1.6e5, "from a railbus to a four-axle car at 40 t an axle"),
    ("vehicle.carbody.length", 5.0, 40.0, "from two-truck mine cars to the longest coaches"),
    ("vehicle.carbody.half_truck_spacing", 1.2, 15.0, "trucks stand 2.4 to 30 m apart"),
    ("vehicle.carbody.height_above_secondary", 0.0, 3.0, "no carbody's c.g. is higher above its springs"),
    ("vehicle.carbody.bending.frequency", 2.0, 60.0, "carbodies bend at some 5 to 20 Hz"),
    ("vehicle.carbody.bending.damping_ratio", 0.0, 0.3, "welded structures have 0.005 to 0.05"),
    ("vehicle.carbody.bending.modal_mass_ratio", 0.05, 5.0, "1 is a uniform beam"),
    ("vehicle.carbody.torsion_1.frequency", 2.0, 100.0, "carbodies twist at some 5 to 30 Hz"),
    ("vehicle.carbody.torsion_1.damping_ratio", 0.0, 0.3, "welded structures have 0.005 to 0.05"),
    ("vehicle.carbody.torsion_1.modal_mass_ratio", 0.05, 5.0, "1 is a uniform bar"),
    ("vehicle.carbody.torsion_2.frequency", 2.0, 200.0, "carbodies twist at some 5 to 30 Hz"),
    ("vehicle.carbody.torsion_2.damping_ratio", 0.0, 0.3, "welded structures have 0.005 to 0.05"),
    ("vehicle.carbody.torsion_2.modal_mass_ratio", 0.05, 5.0, "1 is a uniform bar"),
    ("vehicle.truck.mass", 200.0, 2e4, TRUCKS),
    ("vehicle.truck.half_wheelbase", 0.4, 1.9, WHEELBASES),
    ("vehicle.truck.half_primary_spacing", 0.2, 1.5, "springs stand inside or outside the wheels, within the loading gauge"),
    ("vehicle.truck.half_secondary_spacing", 0.2, 1.7, "springs stand within the loading gauge"),
    ("vehicle.truck.height_above_primary", 0.0, 1.0, TRUCKS),
    ("vehicle.truck.depth_below_secondary", 0.0, 2.0, TRUCKS),
    ("vehicle.wheelset.mass", 150.0, 5e3, TRUCKS),
    ("vehicle.wheelset.rolling_radius", 0.15, 0.75, "from car carriers of 360 mm to wheels of 1.5 m"),
    ("vehicle.wheelset.half_contact_distance", 0.3, 0.9, GAUGES),
    ("suspension.primary.longitudinal_stiffness", 1e5, 1e9, UNIT),
    ("suspension.primary.lateral_stiffness", 1e5, 1e9, UNIT),
    ("suspension.primary.vertical_stiffness", 1e5, 1e9, UNIT),
    ("suspension.secondary.lateral_stiffness", 1e4, 1e8, UNIT),
    ("suspension.secondary.vertical_stiffness", 1e4, 1e8, UNIT),
    ("wheel_rail.friction", 0.01, 0.7, "dry rails reach 0.5 to 0.6"),
    ("wheel_rail.creep_factor", 0.1, 1.0, "Kalker's theory, factor 1, is that of clean wheels and rails"),
    ("wheel_rail.flange_clearance", 0.001, 0.025, "half of the play in the gauge: 4 to 10 mm on new rails"),
    ("passenger.lateral_offset", 0.0, 1.7, "no carbody is wider than 3.4 m"),
    ("passenger.height_above_carbody_cg", 0.0, 3.5, "no passenger sits farther from the carbody's c.g."),
];

/// Heaviest axle load, kg: ore cars of the Pilbara have 40 t.
const AXLE: f64 = 45_000.0;

/// Doubts about values outside the usual.
pub fn unusual(situation: &Situation, doubts: &mut Vec<Diagnostic>) {
    let suffix = situation.suffix();
    for &(path, least, most, why) in USUAL {
        let Some(key) = keys::at(path) else {
            continue;
        };
        if let Some(si) = key.get(&situation.case)
            && !(least..=most).contains(&si.abs())
            && let Some(place) = situation.place(&[path])
        {
            let [least, most, value] = [least, most, si].map(|si| shown(si, key.quantity));
            let message = format!(
                "`{}` is {value}{suffix}, far from rail vehicles",
                key.name()
            );
            doubts.push(
                Diagnostic::at(place, message, format!("usual: {least} to {most}"))
                    .help(why.to_owned()),
            );
        }
    }
    axle_load(situation, doubts);
    passengers(situation, doubts);
}

fn axle_load(situation: &Situation, doubts: &mut Vec<Diagnostic>) {
    let mass = situation.case.vehicle.axle_load() / GRAVITY;
    let paths = [
        "vehicle.carbody.mass",
        "vehicle.truck.mass",
        "vehicle.wheelset.mass",
    ];
    if mass > AXLE
        && let Some(place) = situation.place(&paths)
    {
        let (mass, most) = (shown(mass, Quantity::Mass), shown(AXLE, Quantity::Mass));
        let suffix = situation.suffix();
        doubts.push(
            Diagnostic::at(
                place,
                format!("{mass} stand on each axle{suffix}"),
                format!("no track bears more than {most}"),
            )
            .help(
                "M_c / 4 + M_t / 2 + M_w, `mass` being one carbody, one truck frame, one wheelset"
                    .to_owned(),
            ),
        );
    }
}

fn passengers(situation: &Situation, doubts: &mut Vec<Diagnostic>) {
    let vehicle = &situation.case.vehicle;
    let (at, end) = (
        vehicle.passenger.longitudinal_offset,
        vehicle.carbody.length / 2.0,
    );
    let paths = ["passenger.longitudinal_offset", "vehicle.carbody.length"];
    if at > end
        && let Some(place) = situation.place(&paths)
    {
        let (at, end) = (shown(at, Quantity::Length), shown(end, Quantity::Length));
        let suffix = situation.suffix();
        doubts.push(Diagnostic::at(
            place,
            format!("the end passengers sit {at} from the c.g.{suffix}"),
            format!("the carbody ends at {end}"),
        ));
    }
}
