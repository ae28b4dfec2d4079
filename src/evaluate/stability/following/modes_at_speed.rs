//! Modes at one speed, side by side.

use nalgebra::Complex;

use crate::numerics::{
    Eigenpairs, Eigenvalue, Refiner, damping_ratio,
    elimination::{LANES, Lanes},
    size,
};

/// Damping ratio above which a mode that cannot be distinguished from another is dropped. Should it
/// become lightly damped later, the count of modes shows that it is missing.
pub(super) const STRONGLY_DAMPED: f64 = 0.2;
/// Relative distance of two eigenvalues below which they are one found twice, if their vectors also have
/// the same shape.
const SAME_EIGENVALUE: f64 = 1e-2;
/// Largest relative distance of a refined eigenvalue from that of the spectrum it started from.
const LARGEST_CORRECTION: f64 = 1e-6;

/// Up to [`LANES`] modes at one speed. A lane without a mode of its own holds a copy of another's.
#[derive(Debug, Clone)]
pub(super) struct ModesAtSpeed {
    /// Eigenpairs, lane by lane.
    pub pairs: Eigenpairs,
    /// Lanes with a mode of their own.
    pub followed: [bool; LANES],
}

impl ModesAtSpeed {
    /// The least damped of some eigenvalues at `speed`, m/s. `None` if two of them cannot be
    /// distinguished.
    pub fn new(refiner: &mut Refiner, speed: f64, mut values: Vec<Complex<f64>>) -> Option<Self> {
        values.sort_by(|a, b| damping_ratio(*a).total_cmp(&damping_ratio(*b)));
        Self::of(
            refiner,
            speed,
            std::array::from_fn(|l| values.get(l).copied()),
        )
    }

    /// Eigenvalues at `speed`, m/s, each in its lane. `None` if two of them cannot be distinguished.
    pub fn of(
        refiner: &mut Refiner,
        speed: f64,
        values: [Option<Complex<f64>>; LANES],
    ) -> Option<Self> {
        let followed = values.map(|s| s.is_some());
        let first = values.into_iter().flatten().next();
        let values = values.map(|s| s.or(first).unwrap_or(Complex::ONE));
        // A shift off the eigenvalue keeps the factors regular.
        let shift = Complex::new(1.0 + 1e-8, 1e-8);
        let s = Lanes::from_fn(|l| shift * values[l]);
        let mut state = Self {
            pairs: Eigenpairs::near(s, [speed; LANES], refiner.order()),
            followed,
        };
        if first.is_none() {
            return Some(state);
        }
        refiner.step(&mut state.pairs);
        refiner.step(&mut state.pairs);
        let lost = |state: &Self, l: usize| {
            let apart = size(state.eigenvalue(l).s - values[l]);
            apart.is_nan()
                || apart > LARGEST_CORRECTION * size(values[l])
                || state.duplicates_another(l)
        };
        state.drop_modes(|state, l| damping_ratio(values[l]) > STRONGLY_DAMPED && lost(state, l));
        let fine = state.lanes().all(|l| !lost(&state, l));
        fine.then_some(state)
    }

    /// Copies other modes without allocation.
    pub fn copy_from(&mut self, other: &Self) {
        self.pairs.copy_from(&other.pairs);
        self.followed = other.followed;
    }

    /// Eigenvalue in a lane.
    pub fn eigenvalue(&self, l: usize) -> Eigenvalue {
        self.pairs.eigenvalue(l)
    }

    /// Eigenvalues of a mode at the lower and the higher of two speeds, if it is followed at both.
    pub fn from_to(before: &Self, after: &Self, l: usize) -> Option<[Eigenvalue; 2]> {
        let both = [before.eigenvalue(l), after.eigenvalue(l)];
        let ascending = if both[0].speed > both[1].speed {
            [both[1], both[0]]
        } else {
            both
        };
        (before.followed[l] && after.followed[l]).then_some(ascending)
    }

    /// V, m/s.
    pub fn speed(&self) -> f64 {
        self.pairs.speed[0]
    }

    /// Lanes with a mode of their own, ascending.
    pub fn lanes(&self) -> impl Iterator<Item = usize> + '_ {
        (0..LANES).filter(|&l| self.followed[l])
    }

    /// Number of lanes up to the last with a mode of its own.
    pub fn lanes_used(&self) -> usize {
        self.lanes().last().map_or(0, |l| l + 1)
    }

    /// Stops following the modes for which `leaves` holds; their lanes become copies of another.
    pub fn drop_modes(&mut self, mut leaves: impl FnMut(&Self, usize) -> bool) {
        for l in 0..LANES {
            if self.followed[l] && leaves(self, l) {
                self.followed[l] = false;
            }
        }
        let Some(other) = self.lanes().next() else {
            return;
        };
        for l in (0..LANES).filter(|&l| !self.followed[l]) {
            self.pairs.repeat(l, other);
        }
    }

    /// True if the mode in a lane is the same as one in a lower lane: two modes may have nearly equal
    /// eigenvalues, as the trucks' have, but not also the same shape.
    pub fn duplicates_another(&self, l: usize) -> bool {
        let mut before = self.lanes().take_while(|&b| b < l);
        before.any(|b| Self::is_same_mode((self, b), (self, l)))
    }

    /// True if two modes at one speed are the same.
    pub fn is_same_mode((a, i): (&Self, usize), (b, j): (&Self, usize)) -> bool {
        let (s, other) = (a.eigenvalue(i).s, b.eigenvalue(j).s);
        (other - s).norm_sqr() < SAME_EIGENVALUE * SAME_EIGENVALUE * s.norm_sqr()
            && Eigenpairs::same_shape((&a.pairs, i), (&b.pairs, j))
    }
}
