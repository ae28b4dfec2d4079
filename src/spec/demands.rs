//! Demands on a design: `[objective]`, `[requirements]`, `[limits]` and `[pareto]`.

use toml::de::DeValue;

use super::diagnostic::{Collect, Diagnostic};
use super::document::{Document, Value};
use super::keys::{self, Range};
use super::value::{choice, number, whole};
use crate::index::{Demands, Index, Sense};
use crate::units::Quantity;

type Mistakes = Vec<Diagnostic>;

/// An index to be made as good as can be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// Which.
    pub index: Index,
    /// Weight of its relative change among several goals.
    pub weight: f64,
}

/// Indices that a front trades off, with its points and bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Front {
    /// Whether the spec has a table of it, so that one belongs to a report.
    pub asked: bool,
    /// Two or three indices; the report's stability–curving trade-off unless given.
    pub indices: Vec<Index>,
    /// Points asked for.
    pub points: usize,
    /// Where it ends: bounds in place of the requirements and limits on the indices traded off.
    pub bounds: Demands,
}

impl Default for Front {
    fn default() -> Self {
        Self {
            asked: false,
            indices: vec![Index::CriticalSpeed, Index::DegreeCurve],
            points: 20,
            bounds: Demands::default(),
        }
    }
}

/// Points that a front may have.
pub const FRONT_POINTS: std::ops::RangeInclusive<usize> = 2..=2000;

/// Reads `[requirements]` and `[limits]`.
pub(super) fn demands(document: &Document, mistakes: &mut Mistakes) -> Demands {
    let mut demands = Demands::default();
    for index in Index::ALL {
        if let Some(value) = document.get(index.path()) {
            let read = number(value, index.name(), index.quantity(), index.range());
            if let Some(bound) = mistakes.collect(read) {
                demands.set(index, bound);
            }
        }
    }
    demands
}

/// Reads `[objective]`; none: the report's own.
pub(super) fn objective(document: &Document, mistakes: &mut Mistakes) -> Vec<Goal> {
    let mut goals = Vec::new();
    for (path, sense) in [
        (keys::MAXIMIZE, Sense::AtLeast),
        (keys::MINIMIZE, Sense::AtMost),
    ] {
        if let Some(value) = document.get(path) {
            for goal in mistakes.collect(goals_of(value, sense)).unwrap_or_default() {
                if goals.iter().any(|g: &Goal| g.index == goal.index) {
                    mistakes.push(Diagnostic::at(
                        value.span(),
                        format!("`{}` stands twice", goal.index.name()),
                        "expected it once; to count more it takes a weight: { degree_curve = 2.0 }",
                    ));
                }
                goals.push(goal);
            }
        }
    }
    goals
}

/// `"degree_curve"`, `["degree_curve", …]` or `{ degree_curve = 2.0, … }`.
fn goals_of(value: &Value, sense: Sense) -> Result<Vec<Goal>, Diagnostic> {
    let goal = |name: &Value, weight: f64| {
        let index = index(name)?;
        if index.sense() == sense {
            return Ok(Goal { index, weight });
        }
        let (better, verb) = match index.sense() {
            Sense::AtLeast => ("larger", "maximize"),
            Sense::AtMost => ("smaller", "minimize"),
        };
        let message = format!("`{}` is better the {better} it is", index.name());
        Err(Diagnostic::at(
            name.span(),
            message,
            format!("expected it under `{verb}`"),
        ))
    };
    match value.get_ref() {
        DeValue::Array(names) => names.iter().map(|name| goal(name, 1.0)).collect(),
        DeValue::Table(table) => table
            .iter()
            .map(|(name, weight)| {
                let text = DeValue::String(name.get_ref().clone());
                let name = toml::Spanned::new(name.span(), text);
                let range = Range::Positive;
                goal(
                    &name,
                    number(weight, "weight", Quantity::Dimensionless, range)?,
                )
            })
            .collect(),
        _ => Ok(vec![goal(value, 1.0)?]),
    }
}

fn index(value: &Value) -> Result<Index, Diagnostic> {
    let names = Index::ALL.map(Index::name);
    Ok(Index::ALL[choice(value, "index", &names)?])
}

/// Reads `[pareto]`.
pub(super) fn front(document: &Document, mistakes: &mut Mistakes) -> Front {
    let mut front = Front {
        asked: document.table("pareto").is_some(),
        ..Front::default()
    };
    if let Some(value) = document.get(keys::FRONT_INDICES) {
        front.indices = mistakes.collect(front_indices(value)).unwrap_or_default();
    }
    if let Some(value) = document.get(keys::FRONT_POINTS)
        && let Some(points) = mistakes.collect(whole(value, "points"))
    {
        let points = usize::try_from(points).unwrap_or(usize::MAX);
        if FRONT_POINTS.contains(&points) {
            front.points = points;
        } else {
            mistakes.push(Diagnostic::at(
                value.span(),
                "`points` is out of range",
                format!(
                    "expected {} to {}",
                    FRONT_POINTS.start(),
                    FRONT_POINTS.end()
                ),
            ));
        }
    }
    if let Some(value) = document.get(keys::FRONT_BOUNDS) {
        front.bounds = front_bounds(value, mistakes);
    }
    front
}

/// `{ critical_speed = "75 mph" }`: the worst value of an index on the front.
fn front_bounds(value: &Value, mistakes: &mut Mistakes) -> Demands {
    let mut bounds = Demands::default();
    let DeValue::Table(table) = value.get_ref() else {
        mistakes.push(Diagnostic::at(
            value.span(),
            "`bounds` is a table",
            "expected such as { critical_speed = \"75 mph\" }",
        ));
        return bounds;
    };
    for (name, bound) in table {
        let text = toml::Spanned::new(name.span(), DeValue::String(name.get_ref().clone()));
        if let Some(index) = mistakes.collect(index(&text)) {
            let read = number(bound, index.name(), index.quantity(), index.range());
            if let Some(bound) = mistakes.collect(read) {
                bounds.set(index, bound);
            }
        }
    }
    bounds
}

fn front_indices(value: &Value) -> Result<Vec<Index>, Diagnostic> {
    let expected = || {
        Diagnostic::at(
            value.span(),
            "`indices` is a list of two or three different indices",
            "expected such as [\"critical_speed\", \"degree_curve\"]",
        )
    };
    let DeValue::Array(names) = value.get_ref() else {
        return Err(expected());
    };
    let indices: Vec<Index> = names.iter().map(index).collect::<Result<_, _>>()?;
    let twice = (1..indices.len()).any(|i| indices[..i].contains(&indices[i]));
    if twice || !(2..=3).contains(&indices.len()) {
        return Err(expected());
    }
    Ok(indices)
}
