//! Events on a followed mode: loss of damping, and least damping ratio.

use nalgebra::Complex;

use super::{modes_at_speed::ModesAtSpeed, search::EventSearch};
use crate::{
    evaluate::modes::Mode,
    numerics::{
        Eigenpairs, Eigenvalue, PAIR_CONVERGED, Refiner,
        cubic::Between,
        damping_ratio, damping_ratio_change,
        elimination::{LANES, Lanes},
        size,
    },
};

/// Kind of event on a mode between two speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// Onset of instability: Re s = 0, rising with the speed.
    Onset,
    /// Minimum of the damping ratio: dζ/d ln V = 0.
    Minimum,
}

/// An event found.
#[derive(Debug, Clone)]
pub struct Event {
    /// Eigenvalue and speed.
    pub at: Eigenvalue,
    /// Shape and left vector; `None` if they are not finite.
    pub mode: Option<Mode>,
}

/// Limit on the evaluations of a bracket; four are usual.
const MAX_EVALUATIONS: usize = 12;
/// Width in ln V at which a bracket is closed: ζ at a minimum is then accurate to its square, and an
/// onset is finished by a Newton step.
const BRACKET_WIDTH: f64 = 1e-6;
/// Largest last Newton step of an onset, in ln V.
const LARGEST_NEWTON_STEP: f64 = 10.0 * BRACKET_WIDTH;
/// First extension of a bracket beyond an inexact end, in ln V.
const FIRST_REACH: f64 = 1e-3;
/// Factor on each further extension.
const REACH_GROWTH: f64 = 4.0;
/// Largest relative distance of a refined eigenvalue from the cubic.
const LARGEST_DISAGREEMENT: f64 = 0.2;

/// Relative distance in speed below which two events of one kind and shape are the same.
const SAME_SPEED: f64 = 1e-6;

impl EventKind {
    /// Function of s and ds/d ln V whose root is the event: negative below and positive above it.
    fn function(self, [s, slope]: [Complex<f64>; 2]) -> f64 {
        match self {
            Self::Onset => s.re,
            Self::Minimum => damping_ratio_change(s, slope),
        }
    }
}

/// Interval of speeds that holds one event of one mode.
struct Bracket {
    lane: usize,
    kind: EventKind,
    low: Eigenvalue,
    high: Eigenvalue,
    /// The lower end of the original interval.
    low_end: Eigenvalue,
    /// True for ends that were refined, not taken from the step.
    exact: [bool; 2],
    /// Estimate of the event on the cubic.
    guess: Eigenvalue,
    /// Extension beyond an inexact end, in ln V.
    reach: f64,
    found: Option<Event>,
}

impl Bracket {
    fn new(kind: EventKind, lane: usize, low: Eigenvalue, high: Eigenvalue) -> Self {
        Self {
            lane,
            kind,
            low,
            high,
            low_end: low,
            exact: [false; 2],
            guess: expected(kind, &low, &high),
            reach: FIRST_REACH,
            found: None,
        }
    }

    /// Narrows the bracket with the eigenvalue refined at the estimate, `known`; `mode` gives its shape.
    /// `None` if the function does not vanish where the ends meet: then they are not of one mode.
    fn narrow(&mut self, known: Eigenvalue, mode: impl FnOnce() -> Option<Mode>) -> Option<()> {
        let is_below = self.kind.function([known.s, known.slope]) < 0.0;
        let (end, beyond) = if is_below {
            self.low = known;
            (self.high, self.reach)
        } else {
            self.high = known;
            (self.low, -self.reach)
        };
        self.exact[usize::from(!is_below)] = true;
        let distance = |speed: f64| (speed / known.speed).ln().abs();
        let next = expected(self.kind, &self.low, &self.high);
        if distance(next.speed) >= BRACKET_WIDTH {
            self.guess = next;
        } else if !self.exact[usize::from(is_below)] && distance(end.speed) < 2.0 * BRACKET_WIDTH {
            // The unrefined end was inexact and the event is beyond it.
            self.reach *= REACH_GROWTH;
            self.guess = Eigenvalue {
                speed: known.speed * beyond.exp(),
                s: known.expected(beyond, None),
                slope: known.slope,
            };
        } else {
            self.found = Some(Event {
                at: finished(self.kind, &known)?,
                mode: mode(),
            });
        }
        Some(())
    }
}

/// Event between two speeds, on the cubic.
fn expected(kind: EventKind, low: &Eigenvalue, high: &Eigenvalue) -> Eigenvalue {
    let between = Between::new(low, high);
    between.eigenvalue(between.root(|at| kind.function(at)))
}

/// Adds the events between two neighbouring speeds to a search. An onset is bracketed by a speed at
/// which the mode is damped and a higher one at which it grows: the end of the step, or a minimum of
/// the damping ratio below zero. `None` if a bracket cannot be closed.
pub(super) fn find_events(
    refiner: &mut Refiner,
    before: &ModesAtSpeed,
    after: &ModesAtSpeed,
    search: &mut EventSearch,
) -> Option<()> {
    let Some(kind) = search.kind else {
        return Some(());
    };
    let mut brackets = Vec::new();
    let mut dips = Vec::new();
    for l in 0..LANES {
        let Some([low, high]) = ModesAtSpeed::from_to(before, after, l) else {
            continue;
        };
        let damped = [low, high].map(|known| known.s.re < 0.0);
        match (kind, damped) {
            (EventKind::Onset, [true, false]) => {
                brackets.push(Bracket::new(EventKind::Onset, l, low, high));
            }
            (EventKind::Onset, [true, true]) if may_dip_below(&low, &high, 0.0) => {
                dips.push(Bracket::new(EventKind::Minimum, l, low, high));
            }
            (EventKind::Minimum, _) if may_dip_below(&low, &high, search.below) => {
                brackets.push(Bracket::new(EventKind::Minimum, l, low, high));
            }
            _ => (),
        }
    }
    for dips in dips.chunks_mut(LANES) {
        narrow_together(refiner, before, dips)?;
        for dip in dips {
            let bottom = dip.found.as_ref()?.at;
            if bottom.s.re >= 0.0 {
                brackets.push(Bracket::new(
                    EventKind::Onset,
                    dip.lane,
                    dip.low_end,
                    bottom,
                ));
            }
        }
    }
    for brackets in brackets.chunks_mut(LANES) {
        narrow_together(refiner, before, brackets)?;
        search
            .events
            .extend(brackets.iter_mut().filter_map(|b| b.found.take()));
    }
    Some(())
}

/// Narrows up to [`LANES`] brackets side by side until their events are found.
fn narrow_together(
    refiner: &mut Refiner,
    start: &ModesAtSpeed,
    brackets: &mut [Bracket],
) -> Option<()> {
    let mut pairs = start.pairs.clone();
    let lane = |l: usize, brackets: &[Bracket]| l.min(brackets.len() - 1);
    for l in 0..LANES {
        pairs.take(l, &start.pairs, brackets[lane(l, brackets)].lane);
    }
    for _ in 0..MAX_EVALUATIONS {
        let guesses: [Eigenvalue; LANES] =
            std::array::from_fn(|l| brackets[lane(l, brackets)].guess);
        pairs.s = Lanes::from_fn(|l| guesses[l].s);
        pairs.speed = guesses.map(|guess| guess.speed);
        if !refiner.converge(&mut pairs, brackets.len(), PAIR_CONVERGED) {
            return None;
        }
        for (l, bracket) in brackets.iter_mut().enumerate() {
            let known = pairs.eigenvalue(l);
            let error = size(known.s - guesses[l].s);
            if error.is_nan() || error > LARGEST_DISAGREEMENT * size(known.s) {
                return None;
            }
            if bracket.found.is_some() {
                continue;
            }
            bracket.narrow(known, || Mode::of_pair(&pairs, l))?;
        }
        if brackets.iter().all(|bracket| bracket.found.is_some()) {
            return are_distinct(&pairs, brackets).then_some(());
        }
    }
    None
}

/// True if no two brackets found the same event of the same mode.
fn are_distinct(pairs: &Eigenpairs, brackets: &[Bracket]) -> bool {
    (0..brackets.len()).all(|i| {
        (0..i).all(|j| {
            let same = (pairs.speed[i] / pairs.speed[j] - 1.0).abs() < SAME_SPEED;
            !(brackets[i].kind == brackets[j].kind
                && same
                && Eigenpairs::same_shape((pairs, i), (pairs, j)))
        })
    })
}

/// Last Newton step of an onset to Re s = 0. `None` if it is not short.
fn finished(kind: EventKind, known: &Eigenvalue) -> Option<Eigenvalue> {
    if kind == EventKind::Minimum {
        return Some(*known);
    }
    let step = -known.s.re / known.slope.re;
    (step.abs() < LARGEST_NEWTON_STEP).then(|| Eigenvalue {
        speed: known.speed * step.exp(),
        s: Complex::new(0.0, known.s.im + known.slope.im * step),
        slope: known.slope,
    })
}

/// True if the damping ratio of a mode has a minimum between two speeds that may fall below a value.
fn may_dip_below(low: &Eigenvalue, high: &Eigenvalue, below: f64) -> bool {
    let [falls, rises] = [low, high].map(|known| damping_ratio_change(known.s, known.slope));
    let ends = damping_ratio(low.s).min(damping_ratio(high.s));
    // Straight down and up again would be lowest of all.
    let lowest = ends - (high.speed / low.speed).ln() * rises.max(-falls);
    if !(falls < 0.0 && rises >= 0.0 && lowest < below) {
        return false;
    }
    let known = expected(EventKind::Minimum, low, high);
    // The cubic may be off by as much as it is below its ends.
    let least = damping_ratio(known.s);
    least - (ends - least) < below
}
