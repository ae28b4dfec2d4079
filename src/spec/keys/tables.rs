//! The tables of a spec, in the order in which one writes them.

/// A table of a spec.
#[derive(Debug)]
pub struct Table {
    /// Path.
    pub path: &'static str,
    /// What stands in it.
    pub meaning: &'static str,
}

impl Table {
    /// Whether the entry at `path` stands in it, not in a table within it.
    pub fn holds(&self, path: &str) -> bool {
        let table = path.rsplit_once('.').map_or(path, |(table, _)| table);
        table == self.path
    }
}

/// All of them.
pub static TABLES: &[Table] = &[
    table("service", "How the vehicle is used."),
    table(
        "vehicle",
        "The vehicle: a carbody on two like trucks with two wheelsets each.",
    ),
    table("vehicle.carbody", "One carbody."),
    table(
        "vehicle.carbody.bending",
        "First vertical bending mode of the carbody.",
    ),
    table(
        "vehicle.carbody.torsion_1",
        "First torsion mode of the carbody.",
    ),
    table(
        "vehicle.carbody.torsion_2",
        "Second torsion mode of the carbody.",
    ),
    table("vehicle.truck", "One truck frame, without its wheelsets."),
    table("vehicle.wheelset", "One wheelset."),
    table(
        "suspension",
        "Springs and dampers; constants are per element, not per truck.",
    ),
    table(
        "suspension.primary",
        "Between wheelsets and truck frame, per corner (4 per truck).",
    ),
    table(
        "suspension.secondary",
        "Between truck frame and carbody, per side (2 per truck); yaw per truck.",
    ),
    table(
        "suspension.secondary.air_spring",
        "An air spring with orifice damping, per side; it takes the place of K_sz and C_sz in the vertical model (Figure 3.4.5a).",
    ),
    table(
        "wheel_rail",
        "Wheel and rail. Coefficients that are not given come from Table 4.1.1 for the conicity.",
    ),
    table(
        "passenger",
        "Where ride is judged: at the carbody's c.g. and at a point towards either end.",
    ),
    table(
        "model",
        "What the models leave open, and the ranges that they look at.",
    ),
    table("tracks", "Tracks of one's own, each under its name."),
    table(
        "design",
        "What may vary, and how. A parameter takes bounds, a value that it has in every design, or a tie to another; what is not listed stays as the vehicle has it.",
    ),
    table(
        "objective",
        "What is to be best, in place of the report's three trade-offs.",
    ),
    table("requirements", "What the vehicle must reach."),
    table(
        "limits",
        "What must not be exceeded; of random motion, three standard deviations.",
    ),
    table("pareto", "What `bogie pareto` traces."),
    table(
        "conditions",
        "Further operating conditions, each under its name.",
    ),
];

const fn table(path: &'static str, meaning: &'static str) -> Table {
    Table { path, meaning }
}
