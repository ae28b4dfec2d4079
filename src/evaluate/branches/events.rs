//! Where a mode loses its damping, and where it has least of it.

use nalgebra::Complex;

use super::{search::Search, state::State};
use crate::{
    evaluate::mode::Mode,
    numerics::{
        Eigenpairs, Eigenvalue, PAIR_CONVERGED, Refiner,
        cubic::Between,
        damping_ratio, damping_ratio_change,
        elimination::{LANES, Lanes},
        size,
    },
};

/// What to look for on a branch between two speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sought {
    /// Damping lost with rising speed: Re s = 0.
    Onset,
    /// A least damping ratio: dζ/d ln V = 0.
    Minimum,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Event {
    /// Which kind.
    pub sought: Sought,
    /// Where.
    pub at: Eigenvalue,
    /// Shape and left vector.
    pub mode: Option<Mode>,
}

/// Evaluations allowed; four are normal.
const STEPS: usize = 12;
/// Change of ln V at which a place is found. A minimum is right to the square of it, an onset ends
/// with a Newton step, of this length at most.
const FOUND: f64 = 1e-6;
const LAST: f64 = 10.0 * FOUND;
/// How far beyond an end to look first, in ln V, and how much further each time.
const REACH: f64 = 1e-3;
const FURTHER: f64 = 4.0;
/// The cubic and the mode found must agree to this share.
const AGREE: f64 = 0.2;

/// Events are the same if their speeds are this close, relative, and their vectors alike.
const SAME: f64 = 1e-6;

impl Sought {
    /// What vanishes, of s and ds/d ln V: negative below and positive above the place sought.
    fn function(self, [s, slope]: [Complex<f64>; 2]) -> f64 {
        match self {
            Self::Onset => s.re,
            Self::Minimum => damping_ratio_change(s, slope),
        }
    }
}

struct Bracket {
    lane: usize,
    sought: Sought,
    low: Eigenvalue,
    high: Eigenvalue,
    /// The lower end at first.
    low_end: Eigenvalue,
    /// Whether the ends have been looked at closely.
    exact: [bool; 2],
    /// Where it is expected.
    guess: Eigenvalue,
    /// How far to go beyond an end, in ln V.
    reach: f64,
    found: Option<Event>,
}

impl Bracket {
    fn new(sought: Sought, lane: usize, low: Eigenvalue, high: Eigenvalue) -> Self {
        Self {
            lane,
            sought,
            low,
            high,
            low_end: low,
            exact: [false; 2],
            guess: expected(sought, &low, &high),
            reach: REACH,
            found: None,
        }
    }

    /// Goes on from what is `known` where it was expected, having the mode's shape from `mode`. `None` if
    /// what is sought is not where the ends close in on: then they are not of the same mode.
    fn narrow(&mut self, known: Eigenvalue, mode: impl FnOnce() -> Option<Mode>) -> Option<()> {
        let is_below = self.sought.function([known.s, known.slope]) < 0.0;
        let (end, beyond) = if is_below {
            self.low = known;
            (self.high, self.reach)
        } else {
            self.high = known;
            (self.low, -self.reach)
        };
        self.exact[usize::from(!is_below)] = true;
        let apart = |speed: f64| (speed / known.speed).ln().abs();
        let next = expected(self.sought, &self.low, &self.high);
        if apart(next.speed) >= FOUND {
            self.guess = next;
        } else if !self.exact[usize::from(is_below)] && apart(end.speed) < 2.0 * FOUND {
            // The end was not quite right: it is beyond.
            self.reach *= FURTHER;
            self.guess = Eigenvalue {
                speed: known.speed * beyond.exp(),
                s: known.expected(beyond, None),
                slope: known.slope,
            };
        } else {
            self.found = Some(Event {
                sought: self.sought,
                at: finished(self.sought, &known)?,
                mode: mode(),
            });
        }
        Some(())
    }
}

/// What is sought between two speeds, on the cubic.
fn expected(sought: Sought, low: &Eigenvalue, high: &Eigenvalue) -> Eigenvalue {
    let between = Between::new(low, high);
    between.eigenvalue(between.root(|at| sought.function(at)))
}

/// Adds to a search what it seeks between two neighbouring speeds. Onsets are those at which a mode
/// is damped below and grows above, and those before a minimum that falls below zero. `None` if
/// something cannot be found where it must be.
pub(super) fn find(
    refiner: &mut Refiner,
    before: &State,
    after: &State,
    search: &mut Search,
) -> Option<()> {
    let Some(sought) = search.sought else {
        return Some(());
    };
    let mut brackets = Vec::new();
    let mut dips = Vec::new();
    for l in 0..LANES {
        let Some([low, high]) = State::from_to(before, after, l) else {
            continue;
        };
        let damped = [low, high].map(|known| known.s.re < 0.0);
        match (sought, damped) {
            (Sought::Onset, [true, false]) => {
                brackets.push(Bracket::new(Sought::Onset, l, low, high));
            }
            (Sought::Onset, [true, true]) if minimum(&low, &high, 0.0) => {
                dips.push(Bracket::new(Sought::Minimum, l, low, high));
            }
            (Sought::Minimum, _) if minimum(&low, &high, search.below) => {
                brackets.push(Bracket::new(Sought::Minimum, l, low, high));
            }
            _ => (),
        }
    }
    for dips in dips.chunks_mut(LANES) {
        close(refiner, before, dips)?;
        for dip in dips {
            let bottom = dip.found.as_ref()?.at;
            if bottom.s.re >= 0.0 {
                brackets.push(Bracket::new(Sought::Onset, dip.lane, dip.low_end, bottom));
            }
        }
    }
    for brackets in brackets.chunks_mut(LANES) {
        close(refiner, before, brackets)?;
        search
            .events
            .extend(brackets.iter_mut().filter_map(|b| b.found.take()));
    }
    Some(())
}

/// Closes up to [`LANES`] brackets together.
fn close(refiner: &mut Refiner, start: &State, brackets: &mut [Bracket]) -> Option<()> {
    let mut pairs = start.pairs.clone();
    let lane = |l: usize, brackets: &[Bracket]| l.min(brackets.len() - 1);
    for l in 0..LANES {
        pairs.take(l, &start.pairs, brackets[lane(l, brackets)].lane);
    }
    for _ in 0..STEPS {
        let guesses: [Eigenvalue; LANES] =
            std::array::from_fn(|l| brackets[lane(l, brackets)].guess);
        pairs.s = Lanes::from_fn(|l| guesses[l].s);
        pairs.speed = guesses.map(|guess| guess.speed);
        if !refiner.converge(&mut pairs, brackets.len(), PAIR_CONVERGED) {
            return None;
        }
        for (l, bracket) in brackets.iter_mut().enumerate() {
            let known = pairs.eigenvalue(l);
            let apart = size(known.s - guesses[l].s);
            if apart.is_nan() || apart > AGREE * size(known.s) {
                return None;
            }
            if bracket.found.is_some() {
                continue;
            }
            bracket.narrow(known, || Mode::of_pair(&pairs, l))?;
        }
        if brackets.iter().all(|bracket| bracket.found.is_some()) {
            return apart(&pairs, brackets).then_some(());
        }
    }
    None
}

/// Whether what was found on different branches is not the same.
fn apart(pairs: &Eigenpairs, brackets: &[Bracket]) -> bool {
    (0..brackets.len()).all(|i| {
        (0..i).all(|j| {
            let same = (pairs.speed[i] / pairs.speed[j] - 1.0).abs() < SAME;
            !(brackets[i].sought == brackets[j].sought
                && same
                && Eigenpairs::same_shape((pairs, i), (pairs, j)))
        })
    })
}

/// An onset is brought to Re s = 0 by a last Newton step, which must be short.
fn finished(sought: Sought, known: &Eigenvalue) -> Option<Eigenvalue> {
    if sought == Sought::Minimum {
        return Some(*known);
    }
    let step = -known.s.re / known.slope.re;
    (step.abs() < LAST).then(|| Eigenvalue {
        speed: known.speed * step.exp(),
        s: Complex::new(0.0, known.s.im + known.slope.im * step),
        slope: known.slope,
    })
}

/// Whether a branch has a minimum of damping between two speeds that may fall below a value.
fn minimum(low: &Eigenvalue, high: &Eigenvalue, below: f64) -> bool {
    let [falls, rises] = [low, high].map(|known| damping_ratio_change(known.s, known.slope));
    let ends = damping_ratio(low.s).min(damping_ratio(high.s));
    // Straight down and up again would be lowest of all.
    let lowest = ends - (high.speed / low.speed).ln() * rises.max(-falls);
    if !(falls < 0.0 && rises >= 0.0 && lowest < below) {
        return false;
    }
    let known = expected(Sought::Minimum, low, high);
    // The cubic may be off by as much as it is below its ends.
    let least = damping_ratio(known.s);
    least - (ends - least) < below
}
