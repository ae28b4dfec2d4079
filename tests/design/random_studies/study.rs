//! Random studies as the lines of a spec, all with dotted keys, so that any line can be left out.

use bogie::{
    case::{Case, Crosslevel, TruckRoll},
    design::margin::value,
    index::{Index, Sense},
    parameter::Parameter,
    spec::{Spec, keys},
    track::Track,
    units::{Quantity, Range},
};
use rand::{Rng, SeedableRng, seq::IndexedRandom, seq::SliceRandom};
use rand_chacha::ChaCha8Rng;

use crate::support::random_vehicle;

type Random = ChaCha8Rng;

/// The text of a study; `spoilt`: with a mistake of typing somewhere.
pub fn text(seed: u64, spoilt: bool) -> String {
    let mut rng = Random::seed_from_u64(seed);
    let rng = &mut rng;
    let mut lines = lines(rng);
    lines.shuffle(rng);
    let mut text = lines.join("\n") + "\n";
    if spoilt {
        spoil(rng, &mut text);
    }
    text
}

/// A study that the reader accepts: that of a number, or of the next that holds together.
pub fn readable(seed: u64) -> String {
    (0..1000)
        .map(|again| text(seed + 1_000_000 * again, false))
        .find(|text| Spec::read(text.as_bytes()).is_ok())
        .expect("a study in a thousand holds together")
}

/// A mistake of typing: a character lost, doubled or replaced by another.
fn spoil(rng: &mut Random, text: &mut String) {
    let mut chars: Vec<char> = text.chars().collect();
    let at = rng.random_range(0..chars.len());
    match rng.random_range(0..3) {
        0 => drop(chars.remove(at)),
        1 => chars.insert(at, chars[at]),
        _ => {
            let typed = ['"', '0', 'k', ' ', '\n', ']', '-', 'µ'];
            chars[at] = typed[rng.random_range(0..typed.len())];
        }
    }
    *text = chars.into_iter().collect();
}

/// Which design is delivered, in half of the studies.
fn delivery(rng: &mut Random, lines: &mut Vec<String>) {
    if rng.random_bool(0.5) {
        let prefer = ["as-given", "softest", "optimum"][rng.random_range(0..3)];
        lines.push(format!("design.prefer = \"{prefer}\""));
    }
    for key in ["deliver_within", "free_within"] {
        if rng.random_bool(0.2) {
            let share = 10_f64.powf(rng.random_range(-5.0..-0.5));
            lines.push(format!("design.{key} = {share}"));
        }
    }
}

fn lines(rng: &mut Random) -> Vec<String> {
    let mut lines = vec!["vehicle.base = \"prototype\"".to_owned()];
    let case = vehicle(rng, &mut lines);
    design(rng, &case, &mut lines);
    delivery(rng, &mut lines);
    for index in indices(rng, 4) {
        lines.push(demand(rng, &case, index, ""));
    }
    if rng.random_bool(0.4) {
        objective(rng, &mut lines);
    }
    for name in ["worn", "half creep"]
        .into_iter()
        .take(rng.random_range(0..6) / 2)
    {
        condition(rng, &case, name, &mut lines);
    }
    front(rng, &case, &mut lines);
    lines
}

/// A value with its unit, SI or US customary, as TOML.
fn written(rng: &mut Random, quantity: Quantity, si: f64) -> String {
    let unit = if rng.random_bool(0.5) {
        quantity.si()
    } else {
        quantity.us()
    };
    match unit.label {
        "" => format!("{:?}", unit.of(si)),
        label => format!("\"{:?} {label}\"", unit.of(si)),
    }
}

/// The prototype or a random vehicle, in use.
fn vehicle(rng: &mut Random, lines: &mut Vec<String>) -> Case {
    let mut case = Case::prototype();
    if rng.random_bool(0.6) {
        let factor = if rng.random_bool(0.7) { 1.3 } else { 3.0 };
        case = random_vehicle(rng, factor);
        for (path, si) in keys::inputs_si(&case) {
            let key = keys::at(path).expect(path);
            if path != "service.speed" {
                lines.push(format!("{path} = {}", written(rng, key.quantity, si)));
            }
        }
        if case.model.truck_roll == TruckRoll::Dynamic {
            lines.push("model.truck_roll = \"dynamic\"".into());
        }
        if case.model.crosslevel == Crosslevel::Contact {
            lines.push("model.crosslevel = \"contact\"".into());
        }
    }
    // Mostly well below the speed at which it hunts, so that there is a lateral ride.
    if let Ok(critical) = value(&case, Index::CriticalSpeed)
        && rng.random_bool(0.85)
    {
        case.service.speed = (critical * rng.random_range(0.3..0.9)).clamp(3.0, 90.0);
    }
    let speed = written(rng, Quantity::Speed, case.service.speed);
    lines.push(format!("service.speed = {speed}"));
    if rng.random_bool(0.5) {
        let names: Vec<String> = Track::names().collect();
        let name = names.choose(rng).expect("tracks");
        case.service.track = Track::named(name).expect("a track");
        lines.push(format!("service.track = \"{name}\""));
    }
    if rng.random_bool(0.3) {
        let degree = rng.random_range(0.2..6.0_f64);
        lines.push(format!("service.curve = \"{degree} deg\""));
        case.service.curve = Some(degree.to_radians());
    }
    if rng.random_bool(0.3) {
        let angle = rng.random_range(-3.0..6.0_f64);
        lines.push(format!("service.cant_deficiency = \"{angle} deg\""));
        case.service.cant_deficiency = Some(angle.to_radians());
    }
    if rng.random_bool(0.25) {
        let k_sz = case.vehicle.suspension.secondary.vertical_stiffness;
        let mut of = |name: &str, quantity, si| {
            let path = format!("suspension.secondary.air_spring.{name}");
            lines.push(format!("{path} = {}", written(rng, quantity, si)));
            let key = keys::at(&path).expect("a key");
            key.set(&mut case, si);
        };
        of("direct_stiffness", Quantity::Stiffness, 0.4 * k_sz);
        of("series_stiffness", Quantity::Stiffness, 2.0 * k_sz);
        of("reservoir_stiffness", Quantity::Stiffness, 0.9 * k_sz);
        of("orifice_damping", Quantity::Damping, 0.2 * k_sz);
    }
    case
}

/// Within a range, as far as its ends are known.
fn within(range: Range, si: f64) -> f64 {
    match range {
        Range::PositiveUpTo(most) => si.min(most),
        Range::Between(least, most) => si.clamp(least, most),
        _ => si,
    }
}

/// One to six constants: open, set, tied or to be chosen from a list.
fn design(rng: &mut Random, case: &Case, lines: &mut Vec<String>) {
    let mut all = Parameter::of_table().collect::<Vec<_>>();
    all.shuffle(rng);
    let mut chosen: Vec<Parameter> = Vec::new();
    let count = rng.random_range(1..=6);
    for parameter in all {
        if chosen.len() < count && chosen.iter().all(|p| p.constant() != parameter.constant()) {
            chosen.push(parameter);
        }
    }
    for (i, parameter) in chosen.iter().enumerate() {
        // What can be searched comes first, so that something is open.
        let form = match rng.random_range(0.0..1.0) {
            x if i == 0 || x < 0.6 => bounds(rng, case, *parameter),
            x if x < 0.78 => {
                let own = parameter.get(case) * rng.random_range(0.7..1.4);
                written(rng, parameter.quantity(), within(parameter.range(), own))
            }
            _ => tie(rng, case, *parameter),
        };
        lines.push(format!("{} = {form}", parameter.path()));
    }
    if rng.random_bool(0.4) {
        let order = if rng.random_bool(0.7) {
            "joint"
        } else {
            "sequential"
        };
        lines.push(format!("design.order = \"{order}\""));
    }
    if rng.random_bool(0.3) {
        lines.push(format!("design.seed = {}", rng.random_range(0..1000)));
    }
}

/// Bounds around the vehicle's own value, now and then beside it; profiles to choose from.
fn bounds(rng: &mut Random, case: &Case, parameter: Parameter) -> String {
    let own = parameter.get(case);
    if parameter == Parameter::CONICITY && rng.random_bool(0.5) {
        let mut profiles = vec![0.05, 0.1, 0.15, 0.2, 0.25, own];
        profiles.shuffle(rng);
        profiles.truncate(rng.random_range(1..4));
        return format!("{{ choices = {profiles:?} }}");
    }
    let mut ends = [
        own / rng.random_range(1.05..6.0),
        own * rng.random_range(1.05..6.0),
    ];
    match rng.random_range(0..10) {
        0 => ends = ends.map(|end| 7.0 * end),
        1 => ends = ends.map(|end| end / 7.0),
        2 if parameter.range().contains(0.0) => ends[0] = 0.0,
        _ => {}
    }
    let ends = ends.map(|end| {
        let end = within(parameter.range(), end);
        written(rng, parameter.quantity(), end)
    });
    format!("[{}, {}]", ends[0], ends[1])
}

/// A tie to another parameter of the same kind, at the vehicle's own ratio or another.
fn tie(rng: &mut Random, case: &Case, parameter: Parameter) -> String {
    let fits = |to: &Parameter| {
        to.quantity() == parameter.quantity() && to.constant() != parameter.constant()
    };
    let others: Vec<Parameter> = Parameter::of_table().filter(fits).collect();
    let Some(to) = others.choose(rng) else {
        return bounds(rng, case, parameter);
    };
    let mut ratio = parameter.get(case) / to.get(case);
    if rng.random_bool(0.6) {
        ratio *= rng.random_range(0.6..1.8);
    }
    format!("{{ tied_to = \"{}\", ratio = {ratio:?} }}", to.name())
}

/// Up to `most` different indices.
fn indices(rng: &mut Random, most: usize) -> Vec<Index> {
    let count = rng.random_range(0..=most);
    let mut all = Index::ALL.to_vec();
    // What designs are made for, more often than its share.
    if rng.random_bool(0.5) {
        all.truncate(9);
    }
    all.shuffle(rng);
    all.truncate(count);
    all
}

/// A demand: easy, about what the vehicle has, or out of reach.
fn demand(rng: &mut Random, case: &Case, index: Index, prefix: &str) -> String {
    let easier = match rng.random_range(0..10) {
        0..5 => rng.random_range(1.05..1.6),
        5..9 => rng.random_range(0.85..1.05),
        _ => 0.3,
    };
    let factor = match index.sense() {
        Sense::AtLeast => 1.0 / easier,
        Sense::AtMost => easier,
    };
    let has = value(case, index).unwrap_or(match index.quantity() {
        Quantity::Speed => 60.0,
        Quantity::DegreeOfCurve => 0.02,
        Quantity::Stroke => 0.03,
        _ => 0.3,
    });
    let bound = within(index.range(), factor * has);
    let bound = written(rng, index.quantity(), bound);
    format!("{prefix}{} = {bound}", index.path())
}

/// One or two indices each way, as a name, a list or a table of weights.
fn objective(rng: &mut Random, lines: &mut Vec<String>) {
    for (key, sense) in [("maximize", Sense::AtLeast), ("minimize", Sense::AtMost)] {
        let names: Vec<&str> = indices(rng, 3)
            .into_iter()
            .filter(|index| index.sense() == sense)
            .map(Index::name)
            .collect();
        let form = match (names.len(), rng.random_range(0..3)) {
            (0, _) => continue,
            (1, 0) => format!("{:?}", names[0]),
            (_, 1) => {
                let weight = |name: &&str| format!("{name} = {:?}", rng.random_range(0.1..5.0));
                let weights: Vec<String> = names.iter().map(weight).collect();
                format!("{{ {} }}", weights.join(", "))
            }
            _ => format!("{names:?}"),
        };
        lines.push(format!("objective.{key} = {form}"));
    }
}

/// A condition with up to three values and up to two demands of its own.
fn condition(rng: &mut Random, case: &Case, name: &str, lines: &mut Vec<String>) {
    let prefix = format!("conditions.\"{name}\".");
    let mut changed: Vec<&str> = vec![
        "wheel_rail.conicity",
        "wheel_rail.creep_factor",
        "wheel_rail.friction",
        "vehicle.carbody.mass",
        "vehicle.wheelset.rolling_radius",
        "service.speed",
        "service.curve",
        "suspension.primary.lateral_stiffness",
        "suspension.secondary.lateral_damping",
        "suspension.secondary.vertical_stiffness",
    ];
    changed.shuffle(rng);
    changed.truncate(rng.random_range(0..=3));
    let mut case = case.clone();
    for path in changed {
        let key = keys::at(path).expect(path);
        let own = key.get(&case).unwrap_or(0.02);
        let si = within(key.range, own * rng.random_range(0.7..1.3));
        key.set(&mut case, si);
        lines.push(format!(
            "{prefix}{path} = {}",
            written(rng, key.quantity, si)
        ));
    }
    if rng.random_bool(0.3) {
        lines.push(format!("{prefix}service.track = \"fra-class-5\""));
    }
    for index in indices(rng, 2) {
        lines.push(demand(rng, &case, index, &prefix));
    }
}

/// What a front trades off, and where it ends.
fn front(rng: &mut Random, case: &Case, lines: &mut Vec<String>) {
    let mut traded = indices(rng, 3);
    if traded.len() < 2 {
        traded = vec![Index::CriticalSpeed, Index::DegreeCurve];
    }
    let names: Vec<&str> = traded.iter().map(|index| index.name()).collect();
    lines.push(format!("pareto.indices = {names:?}"));
    lines.push(format!("pareto.points = {}", rng.random_range(2..7)));
    if rng.random_bool(0.3) {
        let bound = demand(rng, case, traded[0], "");
        let (_, bound) = bound.split_once(" = ").expect("a value");
        lines.push(format!("pareto.bounds = {{ {} = {bound} }}", names[0]));
    }
}
