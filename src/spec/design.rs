//! The design space: `[design]`.

use toml::de::DeValue;

use super::diagnostic::{Collect, Diagnostic, word};
use super::document::{Document, Value};
use super::keys::{self, Range};
use super::value::{choice, interval, list, number, whole};
use crate::case::Case;
use crate::optimize::solve::UNSEEN;
use crate::parameter::Parameter;
use crate::units::Quantity;

/// Closed interval, lower < upper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower bound.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
}

impl From<[f64; 2]> for Interval {
    fn from([lower, upper]: [f64; 2]) -> Self {
        Self { lower, upper }
    }
}

impl From<Interval> for [f64; 2] {
    fn from(interval: Interval) -> Self {
        [interval.lower, interval.upper]
    }
}

/// Freedom of a parameter in the search. SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum Freedom {
    /// Anything between bounds.
    Between(Interval),
    /// One of a few values.
    Choices(Vec<f64>),
    /// A multiple of another parameter.
    Tied {
        /// The other.
        to: Parameter,
        /// Value over the other's.
        ratio: f64,
    },
    /// This value.
    Fixed(f64),
}

/// In which order a design is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// The report's three trade-offs one after the other, with the coupling loop (Figure 4.2.1).
    #[default]
    Sequential,
    /// All parameters at once.
    Joint,
}

/// Which design is delivered within a small loss of the optimum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Prefer {
    /// The one nearest to the design as given.
    #[default]
    AsGiven,
    /// The one with the softest springs.
    Softest,
    /// The optimum itself.
    Optimum,
}

/// Design space. Parameters that are not listed keep the value of the case.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignSpace {
    /// In the order of [`Parameter::all`].
    pub parameters: Vec<(Parameter, Freedom)>,
    /// In which order the design is found.
    pub order: Order,
    /// Seed of the search: the same seed gives the same design.
    pub seed: u64,
    /// Expected share of the space in basins not yet seen down to which a search goes on.
    pub unseen: f64,
    /// Loss of each objective within which the ranges of the variables are given, relative.
    pub free_within: f64,
    /// Loss of each objective within which the design is delivered, relative.
    pub deliver_within: f64,
    /// Which design is delivered within that loss.
    pub prefer: Prefer,
}

impl Default for DesignSpace {
    fn default() -> Self {
        Self {
            parameters: Vec::new(),
            order: Order::default(),
            seed: 1,
            unseen: UNSEEN,
            free_within: 0.01,
            deliver_within: 0.001,
            prefer: Prefer::default(),
        }
    }
}

impl DesignSpace {
    /// The parameters in the order in which they are set.
    pub fn in_setting_order(&self) -> impl Iterator<Item = (Parameter, &Freedom)> {
        let mut all: Vec<_> = self.parameters.iter().map(|(p, f)| (*p, f)).collect();
        all.sort_by_key(|(parameter, _)| parameter.setting_order());
        all.into_iter()
    }

    /// Freedom of a parameter.
    pub fn freedom(&self, parameter: Parameter) -> Option<&Freedom> {
        self.parameters
            .iter()
            .find(|(p, _)| *p == parameter)
            .map(|(_, freedom)| freedom)
    }
}

/// Names of [`Order`].
pub(super) const ORDERS: [&str; 2] = ["sequential", "joint"];
/// Names of [`Prefer`].
pub(super) const PREFERENCES: [&str; 3] = ["as-given", "softest", "optimum"];
/// Losses, and shares of the space, that may be allowed.
pub(super) const SHARES: Range = Range::PositiveUpTo(0.5);

/// Reads `[design]`.
pub(super) fn read(document: &Document, mistakes: &mut Vec<Diagnostic>) -> DesignSpace {
    let mut design = DesignSpace::default();
    let mut given: Vec<Parameter> = Vec::new();
    for parameter in Parameter::all() {
        let Some(value) = document.get(parameter.path()) else {
            continue;
        };
        let same = given.iter().find(|p| p.constant() == parameter.constant());
        if let Some(same) = same {
            let name = parameter.name();
            mistakes.push(
                Diagnostic::at(
                    value.span(),
                    format!("`{name}` and `{}` are the same variable", same.name()),
                    "expected one of the two",
                )
                .help(parameter.relation().map(|r| format!("{r}: leave one out"))),
            );
            continue;
        }
        given.push(parameter);
        if let Some(freedom) = mistakes.collect(freedom(parameter, value)) {
            design.parameters.push((parameter, freedom));
        }
    }
    ties(document, &design, mistakes);
    if let Some(value) = document.get(keys::ORDER)
        && let Some(i) = mistakes.collect(choice(value, "order", &ORDERS))
    {
        design.order = [Order::Sequential, Order::Joint][i];
    }
    if let Some(value) = document.get(keys::SEED) {
        design.seed = mistakes.collect(whole(value, "seed")).unwrap_or(1);
    }
    share(document, keys::UNSEEN, &mut design.unseen, mistakes);
    share(
        document,
        keys::FREE_WITHIN,
        &mut design.free_within,
        mistakes,
    );
    share(
        document,
        keys::DELIVER_WITHIN,
        &mut design.deliver_within,
        mistakes,
    );
    if let Some(value) = document.get(keys::PREFER)
        && let Some(i) = mistakes.collect(choice(value, "prefer", &PREFERENCES))
    {
        design.prefer = [Prefer::AsGiven, Prefer::Softest, Prefer::Optimum][i];
    }
    design
}

/// Reports parameters of what the vehicle does not have.
pub(super) fn absent(
    document: &Document,
    design: &DesignSpace,
    case: &Case,
    mistakes: &mut Vec<Diagnostic>,
) {
    for (parameter, _) in &design.parameters {
        if parameter.find(case).is_none()
            && let Some(value) = document.get(parameter.path())
        {
            let table = parameter.key_of_constant().table();
            let message = format!("`{}` has no value to start from", parameter.name());
            let mistake = Diagnostic::at(value.span(), message, "not a part of the vehicle");
            mistakes.push(mistake.help(format!("give the vehicle a [{table}]")));
        }
    }
}

impl Prefer {
    /// Name in specs and files.
    pub fn name(self) -> &'static str {
        PREFERENCES[self as usize]
    }
}

/// Reads a relative loss, or a share of the space.
fn share(document: &Document, path: &str, share: &mut f64, mistakes: &mut Vec<Diagnostic>) {
    let name = path.rsplit_once('.').map_or(path, |(_, name)| name);
    if let Some(value) = document.get(path)
        && let Some(given) = mistakes.collect(number(value, name, Quantity::Dimensionless, SHARES))
    {
        *share = given;
    }
}

/// `["1 MN/m", "9 MN/m"]`, `{ choices = [0.05, 0.10] }`, `{ tied_to = "…", ratio = 0.5 }` or a
/// value.
fn freedom(parameter: Parameter, value: &Value) -> Result<Freedom, Diagnostic> {
    let (name, quantity, range) = (parameter.name(), parameter.quantity(), parameter.range());
    match value.get_ref() {
        DeValue::Table(table) => {
            let entry = |key: &str| table.iter().find(|(k, _)| *k.get_ref() == key);
            let known = ["choices", "tied_to", "ratio"];
            let example = match parameter {
                Parameter::CONICITY => "expected { choices = [0.05, 0.10] }",
                _ => "expected { tied_to = \"primary_lateral_stiffness\", ratio = 0.5 }",
            };
            if let Some((key, _)) = table.iter().find(|(k, _)| !known.contains(&&**k.get_ref())) {
                let message = format!("unknown key `{}`", word(key.get_ref()));
                return Err(Diagnostic::at(key.span(), message, example));
            }
            match (entry("choices"), entry("tied_to"), entry("ratio")) {
                (Some((key, _)), _, _) if parameter != Parameter::CONICITY => Err(Diagnostic::at(
                    key.span(),
                    format!("`{name}` cannot be chosen from a list"),
                    "expected bounds: choices are for the wheel profile",
                )),
                (Some((_, choices)), None, None) => {
                    let values = list(choices, "choices", quantity, range, 1)?;
                    if (1..values.len()).any(|i| values[..i].contains(&values[i])) {
                        let expected = "expected every profile once";
                        let message = "`choices` has a value twice";
                        return Err(Diagnostic::at(choices.span(), message, expected));
                    }
                    Ok(Freedom::Choices(values))
                }
                (None, Some((_, to)), ratio) => {
                    let all: Vec<Parameter> = Parameter::all().collect();
                    let names: Vec<&str> = all.iter().map(|p| p.name()).collect();
                    let to = all[choice(to, "tied_to", &names)?];
                    if !may_be_tied(parameter, to) {
                        return Err(Diagnostic::at(
                            value.span(),
                            format!("`{name}` cannot be tied to `{}`", to.name()),
                            "expected another parameter of the same kind",
                        ));
                    }
                    let ratio = ratio.map_or(Ok(1.0), |(_, ratio)| {
                        number(ratio, "ratio", Quantity::Dimensionless, Range::Positive)
                    })?;
                    Ok(Freedom::Tied { to, ratio })
                }
                _ => {
                    let message = match parameter {
                        Parameter::CONICITY => format!("`{name}` has no choices"),
                        _ => format!("`{name}` says neither bounds nor what it is tied to"),
                    };
                    Err(Diagnostic::at(value.span(), message, example))
                }
            }
        }
        DeValue::Array(_) => interval(value, name, quantity, range).map(Freedom::Between),
        _ => number(value, name, quantity, range).map(Freedom::Fixed),
    }
}

/// Whether two parameters are of one kind: a conicity is no damping ratio, though both are plain numbers.
pub(super) fn may_be_tied(parameter: Parameter, to: Parameter) -> bool {
    let is_conicity = |p| p == Parameter::CONICITY;
    to.quantity() == parameter.quantity()
        && to.constant() != parameter.constant()
        && is_conicity(to) == is_conicity(parameter)
}

/// The frame's frequency depends on the secondary springs (3.5-9), and so does K_pz where it follows from a
/// frequency in `[design]`: these springs cannot be tied to what follows from them.
fn follows_from(to: Parameter, parameter: Parameter, design: &DesignSpace) -> bool {
    let by_frequency = design
        .freedom(Parameter::PRIMARY_VERTICAL_FREQUENCY)
        .is_some();
    parameter.constant() == Parameter::SECONDARY_VERTICAL_STIFFNESS
        && match to {
            Parameter::PRIMARY_VERTICAL_FREQUENCY => !by_frequency,
            Parameter::PRIMARY_VERTICAL_STIFFNESS => by_frequency,
            _ => false,
        }
}

/// A parameter may be tied to one that is not tied itself, by whichever name of its constant, and that does
/// not follow from it.
fn ties(document: &Document, design: &DesignSpace, mistakes: &mut Vec<Diagnostic>) {
    for (parameter, freedom) in &design.parameters {
        let Freedom::Tied { to, .. } = freedom else {
            continue;
        };
        let is_tied = |(p, freedom): &&(Parameter, Freedom)| {
            p.constant() == to.constant() && matches!(freedom, Freedom::Tied { .. })
        };
        if let Some((other, _)) = design.parameters.iter().find(is_tied)
            && let Some(value) = document.get(parameter.path())
        {
            let by = if other == to {
                String::new()
            } else {
                format!(" as `{}`", other.name())
            };
            mistakes.push(Diagnostic::at(
                value.span(),
                format!(
                    "`{}` is tied to `{}`, which is tied itself{by}",
                    parameter.name(),
                    to.name()
                ),
                "expected a parameter that is not tied",
            ));
        }
        if follows_from(*to, *parameter, design)
            && let Some(value) = document.get(parameter.path())
        {
            mistakes.push(Diagnostic::at(
                value.span(),
                format!(
                    "`{}` is tied to `{}`, which follows from it",
                    parameter.name(),
                    to.name()
                ),
                "expected a parameter that does not depend on the secondary springs",
            ));
        }
    }
}
