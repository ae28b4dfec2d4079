//! The modes followed, at one speed.

use nalgebra::Complex;

use crate::numerics::{
    Eigenpairs, Eigenvalue, Refiner, damping_ratio,
    elimination::{LANES, Lanes},
    size,
};

/// Damping ratio above which a mode is let go where it cannot be told apart from another: it
/// matters only if it turns up among the little damped ones later, and then the count tells.
pub(super) const STRONG: f64 = 0.2;
/// Eigenvalues this close, as a share of their size, may be the same one found twice, and are if
/// their vectors are alike.
const CLOSE: f64 = 1e-2;
/// How far an eigenvalue may be from where it was expected, as a share of its size.
const EXPECTED: f64 = 1e-6;

/// Up to [`LANES`] modes at one speed. Lanes without a mode of their own repeat another's.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub pairs: Eigenpairs,
    pub alive: [bool; LANES],
}

impl State {
    /// The least damped of some eigenvalues known at `speed`, m/s. `None` if they cannot be told
    /// apart.
    pub fn new(refiner: &mut Refiner, speed: f64, mut values: Vec<Complex<f64>>) -> Option<Self> {
        values.sort_by(|a, b| damping_ratio(*a).total_cmp(&damping_ratio(*b)));
        Self::of(
            refiner,
            speed,
            std::array::from_fn(|l| values.get(l).copied()),
        )
    }

    /// Some eigenvalues known at `speed`, m/s, each in its lane. `None` if they cannot be told
    /// apart.
    pub fn of(
        refiner: &mut Refiner,
        speed: f64,
        values: [Option<Complex<f64>>; LANES],
    ) -> Option<Self> {
        let alive = values.map(|s| s.is_some());
        let first = values.into_iter().flatten().next();
        let values = values.map(|s| s.or(first).unwrap_or(Complex::ONE));
        // A shift off the eigenvalue keeps the factors regular.
        let shift = Complex::new(1.0 + 1e-8, 1e-8);
        let s = Lanes::from_fn(|l| shift * values[l]);
        let mut state = Self {
            pairs: Eigenpairs::near(s, [speed; LANES], refiner.order()),
            alive,
        };
        if first.is_none() {
            return Some(state);
        }
        refiner.step(&mut state.pairs);
        refiner.step(&mut state.pairs);
        let lost = |state: &Self, l: usize| {
            let apart = size(state.eigenvalue(l).s - values[l]);
            apart.is_nan() || apart > EXPECTED * size(values[l]) || state.repeats(l)
        };
        state.bury(|state, l| damping_ratio(values[l]) > STRONG && lost(state, l));
        let fine = state.living().all(|l| !lost(&state, l));
        fine.then_some(state)
    }

    /// Takes what another holds, in the room that is there.
    pub fn copy_from(&mut self, other: &Self) {
        self.pairs.copy_from(&other.pairs);
        self.alive = other.alive;
    }

    pub fn eigenvalue(&self, l: usize) -> Eigenvalue {
        self.pairs.eigenvalue(l)
    }

    /// A mode at the lower and the higher of two speeds, if it is followed at both.
    pub fn from_to(before: &Self, after: &Self, l: usize) -> Option<[Eigenvalue; 2]> {
        let both = [before.eigenvalue(l), after.eigenvalue(l)];
        let ascending = if both[0].speed > both[1].speed {
            [both[1], both[0]]
        } else {
            both
        };
        (before.alive[l] && after.alive[l]).then_some(ascending)
    }

    pub fn speed(&self) -> f64 {
        self.pairs.speed[0]
    }

    pub fn living(&self) -> impl Iterator<Item = usize> + '_ {
        (0..LANES).filter(|&l| self.alive[l])
    }

    /// Lanes to be worked on.
    pub fn used(&self) -> usize {
        self.living().last().map_or(0, |l| l + 1)
    }

    /// Gives up modes that are no longer worth following.
    pub fn bury(&mut self, mut dies: impl FnMut(&Self, usize) -> bool) {
        for l in 0..LANES {
            if self.alive[l] && dies(self, l) {
                self.alive[l] = false;
            }
        }
        let Some(other) = self.living().next() else {
            return;
        };
        for l in (0..LANES).filter(|&l| !self.alive[l]) {
            self.pairs.repeat(l, other);
        }
    }

    /// Whether a mode has come to one before it: eigenvalues may be close, as those of the two
    /// trucks are, but not the shapes too.
    pub fn repeats(&self, l: usize) -> bool {
        let mut before = self.living().take_while(|&b| b < l);
        before.any(|b| Self::same((self, b), (self, l)))
    }

    /// Whether two modes at one speed are the same.
    pub fn same((a, i): (&Self, usize), (b, j): (&Self, usize)) -> bool {
        let (s, other) = (a.eigenvalue(i).s, b.eigenvalue(j).s);
        (other - s).norm_sqr() < CLOSE * CLOSE * s.norm_sqr()
            && Eigenpairs::same_shape((&a.pairs, i), (&b.pairs, j))
    }
}
