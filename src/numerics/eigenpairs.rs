//! Refinement of eigenpairs by Rayleigh quotient iteration, several side by side.

use nalgebra::{Complex, DVector};
use pulp::{Arch, Simd, WithSimd};

use super::{
    Eigenvalue,
    elimination::{
        ALL, Factors, LANES, Lanes, Reals, Stiffness,
        lanes::{add, div, sqrt},
    },
};

/// [`LANES`] eigenpairs D(s) x = 0, yᵀ D(s) = 0, each at a speed of its own.
#[derive(Debug, Clone)]
pub struct Eigenpairs {
    /// s, rad/s.
    pub s: Lanes,
    /// V, m/s.
    pub speed: Reals,
    /// ds/d ln V.
    pub slope: Lanes,
    /// Relative change of s in the last step.
    pub change: Reals,
    x: Vec<Lanes>,
    y: Vec<Lanes>,
    /// D′ x and D′ᵀ y.
    dx: Vec<Lanes>,
    dy: Vec<Lanes>,
}

impl Eigenpairs {
    /// Pairs from estimates of eigenvalues, with arbitrary vectors.
    pub fn near(s: Lanes, speed: Reals, order: usize) -> Self {
        // A start vector in no coordinate plane.
        let start: Vec<Lanes> = (0..order)
            .map(|i| Lanes::from_fn(|_| Complex::new(1.0, 0.3 + 0.1 * i as f64)))
            .collect();
        Self {
            s,
            speed,
            slope: Lanes::ZERO,
            change: [f64::INFINITY; LANES],
            x: start.clone(),
            y: start.clone(),
            dx: start.clone(),
            dy: start,
        }
    }

    /// Copies another set of eigenpairs without allocation.
    pub fn copy_from(&mut self, other: &Self) {
        self.s = other.s;
        self.speed = other.speed;
        self.slope = other.slope;
        self.change = other.change;
        self.x.copy_from_slice(&other.x);
        self.y.copy_from_slice(&other.y);
        self.dx.copy_from_slice(&other.dx);
        self.dy.copy_from_slice(&other.dy);
    }

    /// Copies the pair in lane `from` of `others` to lane `to`.
    pub fn take(&mut self, to: usize, others: &Self, from: usize) {
        let copy = |into: &mut [Lanes], of: &[Lanes]| {
            for (into, of) in into.iter_mut().zip(of) {
                (into.re[to], into.im[to]) = (of.re[from], of.im[from]);
            }
        };
        copy(&mut self.x, &others.x);
        copy(&mut self.y, &others.y);
        copy(&mut self.dx, &others.dx);
        copy(&mut self.dy, &others.dy);
        copy(
            std::slice::from_mut(&mut self.s),
            std::slice::from_ref(&others.s),
        );
        self.speed[to] = others.speed[from];
    }

    /// Copies the pair in lane `other` to lane `l`.
    pub fn repeat(&mut self, l: usize, other: usize) {
        let vectors = [&mut self.x, &mut self.y, &mut self.dx, &mut self.dy];
        let values = vectors.into_iter().flatten();
        for lanes in values.chain([&mut self.s, &mut self.slope]) {
            (lanes.re[l], lanes.im[l]) = (lanes.re[other], lanes.im[other]);
        }
        self.speed[l] = self.speed[other];
        self.change[l] = self.change[other];
    }

    /// True if the right vectors of two pairs are the same but for small errors.
    pub fn same_shape(a: (&Self, usize), b: (&Self, usize)) -> bool {
        Self::overlap(a, b) > SAME_SHAPE * SAME_SHAPE
    }

    /// True if the right vectors of two pairs overlap enough to be one mode's at two neighbouring speeds.
    pub fn similar_shape(a: (&Self, usize), b: (&Self, usize)) -> bool {
        Self::overlap(a, b) > SIMILAR_SHAPE * SIMILAR_SHAPE
    }

    /// |x̄ᵀ x′|² of right vectors, which are of length one.
    fn overlap((a, i): (&Self, usize), (b, j): (&Self, usize)) -> f64 {
        let products = a.x.iter().zip(&b.x);
        let product: Complex<f64> = products.map(|(a, b)| a.lane(i).conj() * b.lane(j)).sum();
        product.norm_sqr()
    }

    /// The eigenvalue in lane `l`.
    pub fn eigenvalue(&self, l: usize) -> Eigenvalue {
        Eigenvalue {
            speed: self.speed[l],
            s: self.s.lane(l),
            slope: self.slope.lane(l),
        }
    }

    /// x and y in lane `l`.
    pub fn vectors(&self, l: usize) -> [DVector<Complex<f64>>; 2] {
        [&self.x, &self.y].map(|v| DVector::from_fn(v.len(), |i, _| v[i].lane(l)))
    }
}

/// Two-sided Rayleigh quotient iteration on the eigenpairs of a system.
pub struct Refiner<'m> {
    stiffness: &'m Stiffness,
    factors: Factors,
    residual: Vec<Lanes>,
    arch: Arch,
}

/// Convergence tolerance: relative change of s in a step whose successor is at rounding level, because
/// the error falls with its third power.
pub const PAIR_CONVERGED: f64 = 1e-6;
/// Least overlap |x̄ᵀ x′| of two unit vectors of the same mode.
const SAME_SHAPE: f64 = 0.98;
/// Least overlap of a mode's unit vectors at two neighbouring speeds. Vectors of different modes are
/// nearly orthogonal unless their eigenvalues are about to meet.
const SIMILAR_SHAPE: f64 = 0.8;
/// Limit on Rayleigh quotient steps.
const MAX_STEPS: usize = 6;

impl<'m> Refiner<'m> {
    /// For a system with this dynamic stiffness.
    pub fn new(stiffness: &'m Stiffness) -> Self {
        Self {
            factors: stiffness.factors(),
            residual: vec![Lanes::ZERO; stiffness.order()],
            arch: Arch::new(),
            stiffness,
        }
    }

    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.stiffness.order()
    }

    /// Dynamic stiffness, work space for its factors, vector unit.
    pub fn parts(&mut self) -> (&Stiffness, &mut Factors, Arch) {
        (self.stiffness, &mut self.factors, self.arch)
    }

    /// Iterates until the relative change of s in each of the first `used` lanes is below `tolerance`.
    /// Returns false if it is not within the limit of steps.
    pub fn converge(&mut self, pairs: &mut Eigenpairs, used: usize, tolerance: f64) -> bool {
        for _ in 0..MAX_STEPS {
            self.step(pairs);
            let changes = &pairs.change[..used];
            // NaN counts as not converged.
            if changes.iter().all(|change| *change < tolerance) {
                return true;
            }
        }
        false
    }

    /// One step of two-sided Rayleigh quotient iteration (Ostrowski 1958; for dynamic stiffness:
    /// Lancaster 1961).
    ///
    /// ```math
    /// D(s) x⁺ = D′ x,   D(s)ᵀ y⁺ = D′ᵀ y,   s⁺ = s − y⁺ᵀ D x⁺ / (y⁺ᵀ D′ x⁺)
    /// ```
    pub fn step(&mut self, pairs: &mut Eigenpairs) {
        let arch = self.arch;
        arch.dispatch(Step {
            refiner: self,
            pairs,
        });
    }
}

struct Step<'r, 'm> {
    refiner: &'r mut Refiner<'m>,
    pairs: &'r mut Eigenpairs,
}

impl WithSimd for Step<'_, '_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Refiner {
            stiffness,
            factors,
            residual,
            ..
        } = self.refiner;
        let Eigenpairs {
            s,
            speed,
            slope,
            change,
            x,
            y,
            dx,
            dy,
        } = self.pairs;
        stiffness.set_speeds(simd, speed, factors);
        stiffness.factor(simd, s, factors);
        residual.copy_from_slice(dx);
        x.copy_from_slice(dx);
        y.copy_from_slice(dy);
        stiffness.solve(simd, factors, x, ALL);
        stiffness.solve_transposed(simd, factors, y);
        let scale = normalise(simd, x);
        normalise(simd, y);
        stiffness.derivative_times(simd, s, factors, [x, y], [dx, dy]);
        let (rest, weight) = (dot(simd, y, residual), dot(simd, y, dx).inverse(simd));
        let by_speed = stiffness.by_speed(simd, speed, x, y);
        let turn = s.times(simd, &by_speed).times(simd, &weight);
        *slope = turn.scaled(simd, &[-1.0; LANES]);
        let step = rest.times(simd, &weight).scaled(simd, &scale);
        *s = s.plus_scaled(simd, &[-1.0; LANES], &step);
        let (moved, size) = (step.norm_sqr(simd), s.norm_sqr(simd));
        *change = sqrt(simd, &div(simd, &moved, &size));
    }
}

/// Scales to length one; returns the factor.
#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
#[inline(always)]
fn normalise<S: Simd>(simd: S, x: &mut [Lanes]) -> Reals {
    let mut sum = [0.0; LANES];
    for x in x.iter() {
        sum = add(simd, &sum, &x.norm_sqr(simd));
    }
    let scale = div(simd, &[1.0; LANES], &sqrt(simd, &sum));
    for x in x {
        *x = x.scaled(simd, &scale);
    }
    scale
}

/// yᵀ x.
#[allow(clippy::inline_always)]
#[inline(always)]
fn dot<S: Simd>(simd: S, y: &[Lanes], x: &[Lanes]) -> Lanes {
    let mut sum = Lanes::ZERO;
    for (y, x) in y.iter().zip(x) {
        sum = sum.plus_product(simd, y, x);
    }
    sum
}
