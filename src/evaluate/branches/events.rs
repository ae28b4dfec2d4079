//! Where a mode loses its damping, and where it has least of it.

use nalgebra::Complex;

use super::{
    pairs::{Known, Pairs, Refiner, SETTLED},
    search::Search,
    state::State,
};
use crate::{
    dynamics::elimination::{LANES, Lanes},
    evaluate::mode::{Mode, damping_ratio, damping_ratio_change},
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
    pub at: Known,
    /// Shape and left vector.
    pub mode: Option<Mode>,
}

/// Evaluations allowed; four are normal.
const STEPS: usize = 12;
/// Change of ln V at which a place is found. A minimum is right to the square of it, an onset ends
/// with a Newton step.
const FOUND: f64 = 1e-6;
/// Halvings in which the cubic's root is found.
const HALVINGS: usize = 40;
/// The cubic and the mode found must agree to this share.
const AGREE: f64 = 0.2;

/// Events are the same if their speeds are this close, relative, and their vectors alike.
const SAME: f64 = 1e-6;

/// dζ/d ln V.
fn damping_slope(known: &Known) -> f64 {
    damping_ratio_change(known.s, known.slope)
}

impl Sought {
    /// What vanishes, negative below and positive above the place sought.
    fn function(self, known: &Known) -> f64 {
        match self {
            Self::Onset => known.s.re,
            Self::Minimum => damping_slope(known),
        }
    }
}

/// The cubic in ln V with the values and slopes at two speeds.
fn between(low: &Known, high: &Known, u: f64) -> Known {
    let (a, b) = (low.speed.ln(), high.speed.ln());
    let h = b - a;
    let t = (u - a) / h;
    let (d0, d1) = (low.slope * h, high.slope * h);
    let change = high.s - low.s;
    let (c2, c3) = (3.0 * change - 2.0 * d0 - d1, d0 + d1 - 2.0 * change);
    Known {
        speed: u.exp(),
        s: low.s + t * (d0 + t * (c2 + t * c3)),
        slope: (d0 + t * (2.0 * c2 + 3.0 * t * c3)) / h,
    }
}

/// Root of the sought function on the cubic, ln V.
fn root(sought: Sought, low: &Known, high: &Known) -> f64 {
    let (mut a, mut b) = (low.speed.ln(), high.speed.ln());
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(a, b);
        if sought.function(&between(low, high, middle)) < 0.0 {
            a = middle;
        } else {
            b = middle;
        }
    }
    f64::midpoint(a, b)
}

struct Bracket {
    lane: usize,
    sought: Sought,
    low: Known,
    high: Known,
    /// The lower end at first.
    low_end: Known,
    at: f64,
    found: Option<Event>,
}

impl Bracket {
    fn new(sought: Sought, lane: usize, low: Known, high: Known) -> Self {
        Self {
            lane,
            sought,
            at: root(sought, &low, &high),
            low,
            high,
            low_end: low,
            found: None,
        }
    }
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
    for l in before.living().filter(|&l| after.alive[l]) {
        let (mut low, mut high) = (before.known(l), after.known(l));
        if low.speed > high.speed {
            std::mem::swap(&mut low, &mut high);
        }
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
        let guesses: [Known; LANES] = std::array::from_fn(|l| {
            let bracket = &brackets[lane(l, brackets)];
            between(&bracket.low, &bracket.high, bracket.at)
        });
        pairs.s = Lanes::from_fn(|l| guesses[l].s);
        pairs.speed = guesses.map(|guess| guess.speed);
        if !refiner.settle(&mut pairs, brackets.len(), SETTLED) {
            return None;
        }
        for (l, bracket) in brackets.iter_mut().enumerate() {
            let known = pairs.known(l);
            let apart = (known.s - guesses[l].s).norm();
            if apart.is_nan() || apart > AGREE * known.s.norm() {
                return None;
            }
            if bracket.found.is_some() {
                continue;
            }
            if bracket.sought.function(&known) < 0.0 {
                bracket.low = known;
            } else {
                bracket.high = known;
            }
            let next = root(bracket.sought, &bracket.low, &bracket.high);
            if (next - bracket.at).abs() < FOUND {
                bracket.found = Some(Event {
                    sought: bracket.sought,
                    at: finished(bracket.sought, &known),
                    mode: pairs.mode(l),
                });
            } else {
                bracket.at = next;
            }
        }
        if brackets.iter().all(|bracket| bracket.found.is_some()) {
            return apart(&pairs, brackets).then_some(());
        }
    }
    None
}

/// Whether what was found on different branches is not the same.
fn apart(pairs: &Pairs, brackets: &[Bracket]) -> bool {
    (0..brackets.len()).all(|i| {
        (0..i).all(|j| {
            let same = (pairs.speed[i] / pairs.speed[j] - 1.0).abs() < SAME;
            !(brackets[i].sought == brackets[j].sought
                && same
                && Pairs::alike((pairs, i), (pairs, j)))
        })
    })
}

/// An onset is brought to Re s = 0 by a last Newton step.
fn finished(sought: Sought, known: &Known) -> Known {
    let step = -known.s.re / known.slope.re;
    if sought == Sought::Minimum || step.abs() > 10.0 * FOUND {
        return *known;
    }
    Known {
        speed: known.speed * step.exp(),
        s: Complex::new(0.0, known.s.im + known.slope.im * step),
        slope: known.slope,
    }
}

/// Whether a branch has a minimum of damping between two speeds that may fall below a value.
fn minimum(low: &Known, high: &Known, below: f64) -> bool {
    if !(damping_slope(low) < 0.0 && damping_slope(high) >= 0.0) {
        return false;
    }
    let known = between(low, high, root(Sought::Minimum, low, high));
    // The cubic may be off by as much as it is below its ends.
    let ends = damping_ratio(low.s).min(damping_ratio(high.s));
    let least = damping_ratio(known.s);
    least - (ends - least) < below
}
