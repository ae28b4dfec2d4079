//! Unit symbols.

use super::us::{FOOT, INCH, LBF, LBM, MILE, SLUG};
use super::{Dimension, GRAVITY};

const NONE: Dimension = Dimension::new(0, 0, 0, 0);
const MASS: Dimension = Dimension::new(1, 0, 0, 0);
const LENGTH: Dimension = Dimension::new(0, 1, 0, 0);
const TIME: Dimension = Dimension::new(0, 0, 1, 0);
const ANGLE: Dimension = Dimension::new(0, 0, 0, 1);
const SPEED: Dimension = Dimension::new(0, 1, -1, 0);
const RATE: Dimension = Dimension::new(0, 0, -1, 0);
const ACCELERATION: Dimension = Dimension::new(0, 1, -2, 0);
const FORCE: Dimension = Dimension::new(1, 1, -2, 0);
const PRESSURE: Dimension = Dimension::new(1, -1, -2, 0);

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Symbol, size in SI, dimension, and whether it takes SI prefixes. `g` is the acceleration of
/// gravity: no vehicle is weighed in grams.
const SYMBOLS: [(&str, f64, Dimension, bool); 23] = [
    ("kg", 1.0, MASS, false),
    ("t", 1000.0, MASS, false),
    ("slug", SLUG, MASS, false),
    ("lbm", LBM, MASS, false),
    ("m", 1.0, LENGTH, true),
    ("in", INCH, LENGTH, false),
    ("ft", FOOT, LENGTH, false),
    ("yd", 3.0 * FOOT, LENGTH, false),
    ("mi", MILE, LENGTH, false),
    ("s", 1.0, TIME, true),
    ("min", 60.0, TIME, false),
    ("h", 3600.0, TIME, false),
    ("rad", 1.0, ANGLE, true),
    ("deg", DEGREE, ANGLE, false),
    ("°", DEGREE, ANGLE, false),
    ("Hz", 1.0, RATE, true),
    ("mph", MILE / 3600.0, SPEED, false),
    ("g", GRAVITY, ACCELERATION, false),
    ("N", 1.0, FORCE, true),
    ("lbf", LBF, FORCE, false),
    ("kip", 1000.0 * LBF, FORCE, false),
    ("Pa", 1.0, PRESSURE, true),
    ("1", 1.0, NONE, false),
];

const PREFIXES: [(char, f64); 9] = [
    ('G', 1e9),
    ('M', 1e6),
    ('k', 1e3),
    ('d', 1e-1),
    ('c', 1e-2),
    ('m', 1e-3),
    ('u', 1e-6),
    ('µ', 1e-6), // micro sign
    ('μ', 1e-6), // Greek mu
];

/// Usual spellings, with the unit meant.
const ADVICE: [(&str, &str); 14] = [
    ("sec", "s"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("inch", "in"),
    ("inches", "in"),
    ("mile", "mi"),
    ("miles", "mi"),
    ("kph", "km/h"),
    ("kmh", "km/h"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("slugs", "slug"),
    ("ton", "t"),
    ("tonne", "t"),
];

/// Size in SI and dimension of a symbol, with or without an SI prefix.
pub(super) fn find(symbol: &str) -> Option<(f64, Dimension)> {
    let exact = |name: &str| SYMBOLS.iter().find(|row| row.0 == name);
    if let Some(&(_, size, dimension, _)) = exact(symbol) {
        return Some((size, dimension));
    }
    let mut rest = symbol.chars();
    let first = rest.next()?;
    let (_, factor) = PREFIXES.iter().find(|(prefix, _)| *prefix == first)?;
    let &(_, size, dimension, prefixable) = exact(rest.as_str())?;
    prefixable.then_some((factor * size, dimension))
}

/// Symbols with and without prefixes as alternatives of a regular expression.
pub(super) fn alternatives() -> String {
    let names = |prefixable| {
        let rows = SYMBOLS.iter().filter(move |row| row.3 == prefixable);
        rows.map(|row| row.0).collect::<Vec<_>>().join("|")
    };
    let prefixes: String = PREFIXES.iter().map(|(prefix, _)| prefix).collect();
    format!("{}|[{prefixes}]?(?:{})", names(false), names(true))
}

/// The unit that the author of an unknown symbol may have meant.
pub(super) fn nearest(symbol: &str) -> Option<&'static str> {
    let lower = symbol.to_lowercase();
    if let Some((_, meant)) = ADVICE.iter().find(|(written, _)| *written == lower) {
        return Some(meant);
    }
    let common = ["kN", "MN", "mm", "cm", "km", "kHz", "ms", "mrad", "kPa"];
    SYMBOLS
        .iter()
        .map(|row| row.0)
        .chain(common)
        .filter(|name| name.chars().all(char::is_alphabetic))
        .map(|name| {
            let distance = strsim::osa_distance(&name.to_lowercase(), &lower);
            (distance, strsim::osa_distance(name, symbol), name)
        })
        // Half of a symbol wrong is another symbol.
        .filter(|(distance, _, name)| 2 * distance < name.chars().count().max(2))
        .min()
        .map(|(_, _, name)| name)
}
