//! A design study: parameters that may vary, indices to be as good as can be, and demands, over one
//! or several operating conditions, as a problem for the optimiser.

mod chain;
mod epigraph;
mod problem;
mod scaling;
mod term;

pub use term::{Rank, Role, Term};

use sha2::{Digest, Sha256};

use super::measure::{Wanted, piece_name};

use crate::{
    case::Case,
    index::Index,
    optimize::problem::{self as optimiser, Variable},
    parameter::Parameter,
    spec::{Condition, Interval},
};

/// How a parameter that does not vary follows from the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// A value, SI.
    Fixed(f64),
    /// A multiple of another parameter.
    Tied {
        /// The other.
        to: Parameter,
        /// Value over the other's.
        ratio: f64,
    },
}

/// A variable or a rule, by its number.
#[derive(Debug, Clone, Copy)]
enum Setting {
    Variable(usize),
    Rule(usize),
}

/// The study as a problem for the optimiser.
#[derive(Debug, Clone)]
pub struct Study {
    base: Case,
    /// Digest of the case and its conditions.
    identity: String,
    conditions: Vec<Option<Condition>>,
    parameters: Vec<Parameter>,
    variables: Vec<Variable>,
    rules: Vec<(Parameter, Rule)>,
    /// The order in which variables and rules are set.
    settings: Vec<Setting>,
    terms: Vec<Term>,
    /// The critical speed as a variable of its own, the last one, see [`Study::with_epigraph`].
    has_epigraph: bool,
}

/// Pieces of one term, and the number of the piece that is the epigraph speed itself.
const PIECES: usize = 256;
const SPEED: usize = PIECES - 1;
/// Damping ratios this far above what is asked hold nothing back.
const AMPLE: f64 = 0.05;

impl Study {
    /// A case in the nominal condition (number 0) and further ones, with nothing to vary yet.
    pub fn new(base: &Case, conditions: &[Condition]) -> Self {
        let further = conditions.iter().cloned().map(Some);
        Self {
            base: base.clone(),
            identity: identity(base, conditions),
            conditions: std::iter::once(None).chain(further).collect(),
            parameters: Vec::new(),
            variables: Vec::new(),
            rules: Vec::new(),
            settings: Vec::new(),
            terms: Vec::new(),
            has_epigraph: false,
        }
    }

    /// Lets a parameter vary between bounds, on a logarithmic scale unless a bound is zero or the
    /// parameter is the conicity, between whose rows the report's table is linear.
    #[must_use]
    pub fn vary(mut self, parameter: Parameter, bounds: Interval) -> Self {
        let logarithmic = bounds.lower > 0.0 && parameter != Parameter::CONICITY;
        self.parameters.push(parameter);
        self.variables.push(Variable {
            name: parameter.words(),
            symbol: parameter.symbol(),
            quantity: parameter.quantity(),
            bounds: bounds.into(),
            scale: if logarithmic {
                optimiser::Scale::Logarithmic
            } else {
                optimiser::Scale::Linear
            },
        });
        self.in_order()
    }

    /// The study with some of its variables, by number, no longer free: each keeps its value in the
    /// case, or the bound next to it where that lies outside the bounds.
    #[must_use]
    pub fn without(mut self, variables: &[usize]) -> Self {
        for i in variables.iter().rev() {
            let (parameter, variable) = (self.parameters.remove(*i), self.variables.remove(*i));
            let [low, high] = variable.bounds;
            let value = parameter.get(&self.base);
            if !(low..=high).contains(&value) {
                let fixed = Rule::Fixed(value.clamp(low, high));
                self.rules.push((parameter, fixed));
            }
        }
        self.in_order()
    }

    /// Sets a parameter by a rule.
    #[must_use]
    pub fn rule(mut self, parameter: Parameter, rule: Rule) -> Self {
        self.rules.push((parameter, rule));
        self.in_order()
    }

    /// The study with its variables and rules in the order in which they are set.
    fn in_order(mut self) -> Self {
        let variables = self.parameters.iter().enumerate();
        let variables = variables.map(|(i, p)| (p.setting_order(), Setting::Variable(i)));
        let rules = self.rules.iter().enumerate();
        let rules = rules.map(|(i, (p, _))| (p.setting_order(), Setting::Rule(i)));
        let mut all: Vec<_> = variables.chain(rules).collect();
        all.sort_by_key(|(order, _)| *order);
        self.settings = all.into_iter().map(|(_, setting)| setting).collect();
        self
    }

    /// Adds an index to objective `group` in one condition.
    #[must_use]
    pub fn optimise(self, condition: usize, index: Index, group: usize, weight: f64) -> Self {
        self.optimise_from(condition, index, group, weight, 1.0)
    }

    /// Adds an index to objective `group`, its change counted from `origin`, SI: with several in
    /// one group the one that has gained least is improved.
    #[must_use]
    pub fn optimise_from(
        self,
        condition: usize,
        index: Index,
        group: usize,
        weight: f64,
        origin: f64,
    ) -> Self {
        let role = Role::Objective {
            group,
            weight,
            origin,
        };
        self.with(condition, index, role, None)
    }

    /// Demands that an index keeps a bound, SI, in one condition.
    #[must_use]
    pub fn demand(self, condition: usize, index: Index, bound: f64) -> Self {
        self.with(condition, index, Role::Constraint { bound }, None)
    }

    /// As [`Study::demand`], without which other demands cannot be assessed.
    #[must_use]
    pub fn imply(self, condition: usize, index: Index, bound: f64) -> Self {
        let mut study = self.demand(condition, index, bound);
        if let Some(term) = study.terms.last_mut() {
            term.implied = true;
        }
        study
    }

    /// As [`Study::demand`], of some pieces of the index only.
    #[must_use]
    pub fn demand_of(
        self,
        condition: usize,
        index: Index,
        bound: f64,
        pieces: &'static [usize],
    ) -> Self {
        self.with(condition, index, Role::Constraint { bound }, Some(pieces))
    }

    fn with(
        mut self,
        condition: usize,
        index: Index,
        role: Role,
        only: Option<&'static [usize]>,
    ) -> Self {
        let wanted = match (index, role) {
            // Damping over the range changes smoothly where the critical speed itself jumps.
            (Index::CriticalSpeed, Role::Constraint { bound }) => Wanted::DampingTo {
                speed: bound,
                below: AMPLE,
            },
            (Index::LeastDampingRatioToSpeed, Role::Constraint { bound }) => Wanted::DampingTo {
                speed: self.in_condition(&self.base, condition).service.speed,
                below: bound + AMPLE,
            },
            _ => Wanted::Index(index),
        };
        self.terms.push(Term {
            condition,
            index,
            role,
            only,
            implied: false,
            wanted,
        });
        self
    }

    /// The study with other roles for its terms; `None` leaves a term out.
    #[must_use]
    pub fn with_roles(&self, role: impl Fn(usize, &Term) -> Option<Role>) -> Self {
        let mut study = Self {
            terms: Vec::new(),
            ..self.clone()
        };
        for (i, term) in self.terms.iter().enumerate() {
            if let Some(role) = role(i, term) {
                study = study.with(term.condition, term.index, role, term.only);
                if let Some(last) = study.terms.last_mut() {
                    last.implied = term.implied;
                }
            }
        }
        study
    }

    /// The study with the terms of another on the same parameters behind its own.
    #[must_use]
    pub fn and_terms_of(mut self, other: &Self) -> Self {
        self.terms.extend(other.terms.iter().cloned());
        self
    }

    /// Numbers of the terms that are demands.
    pub fn demands(&self) -> impl Iterator<Item = usize> + '_ {
        let numbered = self.terms.iter().enumerate();
        numbered
            .filter(|(_, term)| matches!(term.role, Role::Constraint { .. }))
            .map(|(i, _)| i)
    }

    /// Whether a piece counts in its term.
    pub fn counts(&self, index: usize) -> bool {
        let only = self.terms[self.term_of(index)].only;
        only.is_none_or(|only| only.contains(&(index % PIECES)))
    }

    /// Its terms.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// The parameters that vary, in the order of the variables.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Number of conditions, the nominal one included.
    pub fn conditions(&self) -> usize {
        self.conditions.len()
    }

    /// Name of a condition; `None` for the nominal one.
    pub fn condition_name(&self, condition: usize) -> Option<&str> {
        self.conditions[condition].as_ref().map(|c| c.name.as_str())
    }

    /// Name of a piece, whatever its condition.
    pub fn piece_words(&self, index: usize) -> String {
        let term = &self.terms[self.term_of(index)];
        let name = term.index.words();
        let piece = piece_name(term.wanted, index % PIECES);
        match term.index {
            _ if piece.is_empty() => name.into(),
            Index::DegreeCurve | Index::FlangeLimitedCurve | Index::SlipLimitedCurve => piece,
            _ => format!("{name}, {piece}"),
        }
    }

    /// The nominal case of the design at scaled coordinates `x`.
    pub fn design(&self, x: &[f64]) -> Case {
        self.with_values(&self.values(x))
    }

    /// Values of the variables at scaled coordinates `x`, SI.
    fn values(&self, x: &[f64]) -> Vec<f64> {
        let pairs = self.variables.iter().zip(x);
        pairs.map(|(variable, x)| variable.value(*x)).collect()
    }

    /// The nominal case with such values of the parameters that vary, SI.
    fn with_values(&self, values: &[f64]) -> Case {
        let mut case = self.base.clone();
        // A rule may depend on what is set after it, and that on the next.
        for _ in 0..=self.rules.len().max(1) {
            for setting in &self.settings {
                match *setting {
                    Setting::Variable(i) => self.parameters[i].set(&mut case, values[i]),
                    Setting::Rule(i) => {
                        let (parameter, rule) = self.rules[i];
                        let value = match rule {
                            Rule::Fixed(value) => value,
                            Rule::Tied { to, ratio } => ratio * to.get(&case),
                        };
                        parameter.set(&mut case, value);
                    }
                }
            }
        }
        case
    }

    /// A case in a condition.
    pub fn in_condition(&self, case: &Case, condition: usize) -> Case {
        match &self.conditions[condition] {
            Some(c) => c.apply(case),
            None => case.clone(),
        }
    }

    /// Scaled coordinates of the design of a case.
    pub fn coordinates(&self, case: &Case) -> Vec<f64> {
        let pairs = self.parameters.iter().zip(&self.variables);
        pairs
            .map(|(parameter, variable)| variable.coordinate(parameter.get(case)))
            .collect()
    }

    /// The term to which a piece of objective or constraint belongs.
    pub fn term_of(&self, piece: usize) -> usize {
        piece / PIECES
    }
}

/// Digest of every value of a case and of its conditions.
fn identity(base: &Case, conditions: &[Condition]) -> String {
    let conditions: Vec<_> = conditions
        .iter()
        .map(|condition| (&condition.name, &condition.values, &condition.track))
        .collect();
    // Plain data with names of its own: writing it cannot fail.
    let bytes = serde_json::to_vec(&(base, conditions)).unwrap_or_default();
    format!("{:x}", Sha256::digest(&bytes))
}
