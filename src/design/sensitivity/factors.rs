//! Factors of a sensitivity analysis, and the case at a point of it.

use crate::{
    case::Case,
    design::study::{Rule, Study},
    optimize::problem::{Problem, Scale, Variable},
    parameter::Parameter,
    spec::{
        DesignSpace, Freedom, Interval,
        keys::{self, CaseKey},
    },
    units::Range,
};

/// Something that varies.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// Path in the spec: of a design parameter below `design`, else of an input.
    pub path: &'static str,
    /// Its bounds and the scale on which it is evenly distributed between them.
    pub variable: Variable,
    /// Whether it is a parameter that the design leaves open, rather than an input.
    pub open: bool,
}

impl Factor {
    /// Short name: the symbol of the report, or the end of the path.
    pub fn label(&self) -> &'static str {
        if !self.variable.symbol.is_empty() {
            return self.variable.symbol;
        }
        let mut dots = self.path.rmatch_indices('.').skip(1);
        dots.next()
            .map_or(self.path, |(at, _)| &self.path[at + 1..])
    }
}

/// All that varies: design parameters between their bounds, and the other inputs of a case by a
/// relative spread.
///
/// Inputs that another value determines are none of their own: those that a design parameter or a
/// rule sets, and what follows a default (passengers at floor height, roll inertia of wheelsets as
/// their yaw inertia, primary and yaw damping from their stiffness). Speed, track and curve are
/// the service asked for, not uncertain.
#[derive(Debug, Clone)]
pub struct Factors {
    base: Case,
    open: Vec<(Parameter, Interval)>,
    rules: Vec<(Parameter, Rule)>,
    inputs: Vec<&'static CaseKey>,
    list: Vec<Factor>,
    spread: f64,
    derived: Derived,
}

/// Which values follow others because the spec does not give them.
#[derive(Debug, Clone, Copy)]
struct Derived {
    passenger_height: bool,
    wheelset_roll_inertia: bool,
}

impl Derived {
    const PATHS: [&'static str; 2] = [
        "passenger.height_above_carbody_cg",
        "vehicle.wheelset.roll_inertia",
    ];

    #[expect(clippy::float_cmp, reason = "a default is taken over bit by bit")]
    fn of(case: &Case) -> Self {
        let vehicle = &case.vehicle;
        Self {
            passenger_height: vehicle.passenger.height_above_carbody_cg
                == -vehicle.carbody.height_above_secondary,
            wheelset_roll_inertia: vehicle.wheelset.roll_inertia == vehicle.wheelset.yaw_inertia,
        }
    }

    fn contains(self, path: &str) -> bool {
        let derived = [self.passenger_height, self.wheelset_roll_inertia];
        Self::PATHS
            .iter()
            .zip(derived)
            .any(|(p, derived)| derived && *p == path)
    }

    fn follow(self, case: &mut Case) {
        let vehicle = &mut case.vehicle;
        if self.passenger_height {
            vehicle.passenger.height_above_carbody_cg = -vehicle.carbody.height_above_secondary;
        }
        if self.wheelset_roll_inertia {
            vehicle.wheelset.roll_inertia = vehicle.wheelset.yaw_inertia;
        }
    }
}

impl Factors {
    /// The open parameters of `space`, and all other inputs of `base` within ± `spread` of their
    /// value, as far as that is physical; with a spread of 0 the open parameters alone. Choices of
    /// conicity count as anything from the least to the greatest.
    ///
    /// # Panics
    ///
    /// If the spread is negative, or not below 1.
    pub fn new(base: &Case, space: &DesignSpace, spread: f64) -> Self {
        assert!((0.0..1.0).contains(&spread), "spread {spread}");
        let mut factors = Self {
            base: base.clone(),
            open: Vec::new(),
            rules: Vec::new(),
            inputs: Vec::new(),
            list: Vec::new(),
            spread,
            derived: Derived::of(base),
        };
        for (parameter, freedom) in &space.parameters {
            match freedom {
                Freedom::Between(bounds) => factors.open.push((*parameter, *bounds)),
                Freedom::Choices(choices) => factors.choices(*parameter, choices),
                Freedom::Tied { to, ratio } => {
                    let (to, ratio) = (*to, *ratio);
                    factors.rules.push((*parameter, Rule::Tied { to, ratio }));
                }
                Freedom::Fixed(value) => {
                    factors.rules.push((*parameter, Rule::Fixed(*value)));
                }
            }
        }
        let study = factors.study(base);
        let pairs = study.parameters().iter().zip(study.variables());
        factors.list = pairs
            .map(|(parameter, variable)| Factor {
                path: parameter.path(),
                variable: variable.clone(),
                open: true,
            })
            .collect();
        if spread > 0.0 {
            factors.add_inputs();
        }
        factors
    }

    fn choices(&mut self, parameter: Parameter, choices: &[f64]) {
        let lower = choices.iter().copied().fold(f64::INFINITY, f64::min);
        let upper = choices.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if lower < upper {
            self.open.push((parameter, Interval { lower, upper }));
        } else if lower.is_finite() {
            self.rules.push((parameter, Rule::Fixed(lower)));
        }
    }

    fn add_inputs(&mut self) {
        for key in keys::case() {
            if key.table() == "service" || self.derived.contains(key.path) {
                continue;
            }
            let Some(value) = key.get(&self.base).filter(|value| *value != 0.0) else {
                continue;
            };
            let bounds = around(value, self.spread, key.range);
            if self.determined(key, bounds[0]) {
                continue;
            }
            self.inputs.push(key);
            self.list.push(Factor {
                path: key.path,
                variable: Variable {
                    name: key.meaning,
                    symbol: key.symbol,
                    quantity: key.quantity,
                    bounds,
                    scale: Scale::Linear,
                },
                open: false,
            });
        }
    }

    /// Whether the design gives an input its value, whatever the base says.
    fn determined(&self, key: &CaseKey, other: f64) -> bool {
        let middle = vec![0.5; self.open.len()];
        let mut moved = self.base.clone();
        key.set(&mut moved, other);
        let designed = |base: &Case| key.get(&self.study(base).design(&middle));
        designed(&moved) == designed(&self.base)
    }

    /// The factors: coordinate `i` of a point belongs to number `i`.
    pub fn list(&self) -> &[Factor] {
        &self.list
    }

    /// The case from which inputs spread.
    pub fn base(&self) -> &Case {
        &self.base
    }

    /// Relative spread of the inputs.
    pub fn spread(&self) -> f64 {
        self.spread
    }

    /// The case at a point of the unit cube: inputs first, then the design upon them.
    pub fn case(&self, x: &[f64]) -> Case {
        let (design, inputs) = x.split_at(self.open.len());
        let mut base = self.base.clone();
        let varied = self.inputs.iter().zip(&self.list[self.open.len()..]);
        for ((key, factor), x) in varied.zip(inputs) {
            key.set(&mut base, factor.variable.value(*x));
        }
        self.derived.follow(&mut base);
        self.study(&base).design(design)
    }

    fn study(&self, base: &Case) -> Study {
        let study = Study::new(base, &[]);
        let open = self.open.iter();
        let study = open.fold(study, |s, (parameter, bounds)| s.vary(*parameter, *bounds));
        let rules = self.rules.iter();
        rules.fold(study, |s, (parameter, rule)| s.rule(*parameter, *rule))
    }
}

/// Bounds around a value, within its physical range. A value that lies outside (a conicity beyond
/// the table, with all coefficients given) is not held to it.
fn around(value: f64, spread: f64, range: Range) -> [f64; 2] {
    let reach = spread * value.abs();
    let bounds = [value - reach, value + reach];
    if !range.contains(value) {
        return bounds;
    }
    match range {
        Range::PositiveUpTo(greatest) => bounds.map(|bound| bound.min(greatest)),
        Range::Between(least, greatest) => bounds.map(|bound| bound.clamp(least, greatest)),
        Range::Any | Range::Positive | Range::NonNegative => bounds,
    }
}

#[cfg(test)]
mod tests;
