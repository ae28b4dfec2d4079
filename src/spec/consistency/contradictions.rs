//! Values that cannot hold together.

use super::situation::{Situation, shown};
use crate::closed_form::natural_frequencies::primary_vertical_stiffness;
use crate::index::{Demands, Index};
use crate::parameter::Parameter;
use crate::spec::diagnostic::Diagnostic;
use crate::spec::{DesignSpace, Freedom, Front, keys};
use crate::units::Quantity;

type Mistakes = Vec<Diagnostic>;

const SPEED_RANGE: &str = "model.speed_range";

/// Finds them in all conditions and in what may vary.
pub fn contradictions(
    situations: &[Situation],
    design: &DesignSpace,
    front: &Front,
    mistakes: &mut Mistakes,
) {
    for situation in situations {
        geometry(situation, mistakes);
        carbody_inertia(situation, mistakes);
        speeds(situation, mistakes);
    }
    if let Some(nominal) = situations.first() {
        front_bounds(nominal, &front.bounds, mistakes);
        frame_frequency(nominal, design, mistakes);
    }
}

/// Bodies that would be in each other's place.
fn geometry(situation: &Situation, mistakes: &mut Mistakes) {
    let vehicle = &situation.case.vehicle;
    let (b, l_s) = (
        vehicle.truck.half_wheelbase,
        vehicle.carbody.half_truck_spacing,
    );
    let (l_c, r_0) = (vehicle.carbody.length, vehicle.wheelset.rolling_radius);
    let suffix = situation.suffix();
    let mut unless = |holds: bool, paths: &[&str], message: String, expected: &str, help: &str| {
        if !holds && let Some(place) = situation.place(paths) {
            let mistake = Diagnostic::at(place, message, expected);
            mistakes.push(mistake.help(help.to_owned()));
        }
    };
    unless(
        b < l_s,
        &[
            "vehicle.truck.half_wheelbase",
            "vehicle.carbody.half_truck_spacing",
        ],
        format!("the trucks overlap: b = {b:.3} m, l_s = {l_s:.3} m{suffix}"),
        "expected `half_wheelbase` below `half_truck_spacing`",
        "both are half of the distance between axles and between centre pins",
    );
    unless(
        r_0 < b,
        &[
            "vehicle.wheelset.rolling_radius",
            "vehicle.truck.half_wheelbase",
        ],
        format!("the wheels of a truck overlap: r_0 = {r_0:.3} m, b = {b:.3} m{suffix}"),
        "expected `rolling_radius` below `half_wheelbase`",
        "both are halves: of a wheel's diameter and of the distance between the axles",
    );
    unless(
        2.0 * l_s < l_c,
        &[
            "vehicle.carbody.half_truck_spacing",
            "vehicle.carbody.length",
        ],
        format!(
            "the trucks stand beyond the carbody: 2 l_s = {:.3} m, l_c = {l_c:.3} m{suffix}",
            2.0 * l_s
        ),
        "expected twice `half_truck_spacing` below `length`",
        "`length` is the whole carbody's, `half_truck_spacing` half of the distance between centre pins",
    );
}

/// No body of length l has I > M l²/4 about a transverse axis through its centre: that is with all
/// of its mass at the ends.
fn carbody_inertia(situation: &Situation, mistakes: &mut Mistakes) {
    let carbody = &situation.case.vehicle.carbody;
    let most = carbody.mass * (carbody.length / 2.0).powi(2);
    for (path, name, inertia) in [
        (
            "vehicle.carbody.pitch_inertia",
            "pitch_inertia",
            carbody.pitch_inertia,
        ),
        (
            "vehicle.carbody.yaw_inertia",
            "yaw_inertia",
            carbody.yaw_inertia,
        ),
    ] {
        let paths = [path, "vehicle.carbody.mass", "vehicle.carbody.length"];
        if inertia > most
            && let Some(place) = situation.place(&paths)
        {
            let message = format!(
                "`{name}` is more than mass and length allow{}",
                situation.suffix()
            );
            let most = shown(most, Quantity::Inertia);
            mistakes.push(
                Diagnostic::at(
                    place,
                    message,
                    format!("expected below mass × (length / 2)² = {most}"),
                )
                .help("a uniform body has a third of that".to_owned()),
            );
        }
    }
}

/// The critical speed is known within the range searched only.
fn speeds(situation: &Situation, mistakes: &mut Mistakes) {
    let range = situation.case.model.speed_range;
    let speed = situation.case.service.speed;
    let suffix = situation.suffix();
    if speed > range[1]
        && let Some(place) = situation.place(&["service.speed", SPEED_RANGE])
    {
        mistakes.push(
            Diagnostic::at(
                place,
                format!("the operating speed lies above `model.speed_range`{suffix}"),
                format!("expected {} at the most", shown(range[1], Quantity::Speed)),
            )
            .help(
                "whether the vehicle hunts is looked for in that range only: raise its end"
                    .to_owned(),
            ),
        );
    }
    if let Some(bound) = situation.demands.get(Index::CriticalSpeed)
        && !(range[0]..=range[1]).contains(&bound)
        && let Some(place) = situation.place(&[Index::CriticalSpeed.path(), SPEED_RANGE])
    {
        mistakes.push(outside(place, range, &suffix));
    }
}

fn outside(place: std::ops::Range<usize>, range: [f64; 2], suffix: &str) -> Diagnostic {
    let [low, high] = range.map(|v| shown(v, Quantity::Speed));
    Diagnostic::at(
        place,
        format!("the critical speed asked for lies outside `model.speed_range`{suffix}"),
        format!("expected a speed from {low} to {high}"),
    )
    .help(
        "the critical speed is looked for in that range only: ask for less, or widen it".to_owned(),
    )
}

fn front_bounds(nominal: &Situation, bounds: &Demands, mistakes: &mut Mistakes) {
    let range = nominal.case.model.speed_range;
    if let Some(bound) = bounds.get(Index::CriticalSpeed)
        && !(range[0]..=range[1]).contains(&bound)
        && let Some(place) = nominal.place(&[keys::FRONT_BOUNDS, SPEED_RANGE])
    {
        mistakes.push(outside(place, range, ""));
    }
}

/// The frame stands on both stages: no primary spring gives it less than the secondary springs
/// alone (3.5-9).
fn frame_frequency(nominal: &Situation, design: &DesignSpace, mistakes: &mut Mistakes) {
    let parameter = Parameter::PRIMARY_VERTICAL_FREQUENCY;
    let highest = match design.freedom(parameter) {
        Some(Freedom::Between(bounds)) => bounds.upper,
        Some(Freedom::Fixed(value)) => *value,
        _ => return,
    };
    let softest = design_space_end(nominal, design, |bounds| bounds.lower);
    let mass = nominal.case.vehicle.truck.mass;
    let k_sz = softest.vehicle.suspension.secondary.vertical_stiffness;
    if primary_vertical_stiffness(mass, k_sz, highest) <= 0.0
        && let Some(place) = nominal.place(&[
            parameter.path(),
            "vehicle.truck.mass",
            "suspension.secondary.vertical_stiffness",
        ])
    {
        let alone = (2.0 * k_sz / mass).sqrt() / std::f64::consts::TAU;
        mistakes.push(Diagnostic::at(
            place,
            "no primary spring gives the truck frame so low a frequency",
            format!(
                "expected above {}, which the secondary springs alone give it",
                shown(alone, Quantity::Frequency)
            ),
        ));
    }
}

/// The case with the secondary vertical springs at one end of what the design may choose.
pub(super) fn design_space_end(
    nominal: &Situation,
    design: &DesignSpace,
    end: impl Fn(&crate::spec::Interval) -> f64,
) -> crate::case::Case {
    let mut case = nominal.case.clone();
    for parameter in [
        Parameter::SECONDARY_VERTICAL_STIFFNESS,
        Parameter::SECONDARY_VERTICAL_FREQUENCY,
    ] {
        match design.freedom(parameter) {
            Some(Freedom::Between(bounds)) => parameter.set(&mut case, end(bounds)),
            Some(Freedom::Fixed(value)) => parameter.set(&mut case, *value),
            _ => {}
        }
    }
    case
}
