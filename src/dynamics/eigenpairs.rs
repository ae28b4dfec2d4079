//! Eigenvalues with right and left vectors, several side by side.

use nalgebra::{Complex, DVector};
use pulp::{Arch, Simd, WithSimd};

use super::elimination::{
    ALL, Factors, LANES, Lanes, Reals, Stiffness,
    lanes::{add, div, sqrt},
};

/// An eigenvalue and its slope at a speed.
#[derive(Debug, Clone, Copy)]
pub struct Known {
    /// V, m/s.
    pub speed: f64,
    /// s, rad/s.
    pub s: Complex<f64>,
    /// ds/d ln V.
    pub slope: Complex<f64>,
}

impl Known {
    /// Where s is expected at h further in ln V, from here and, if it is known, from `before`. In
    /// ln s: at low speed the kinematic modes go with V itself.
    pub fn expected(&self, h: f64, before: Option<&Self>) -> Complex<f64> {
        let rate = self.slope / self.s;
        let bend = before.map_or(Complex::ZERO, |before| {
            (rate - before.slope / before.s) / (self.speed / before.speed).ln()
        });
        self.s * (rate * h + bend * (h * h / 2.0)).exp()
    }
}

/// [`LANES`] eigenpairs D(s) x = 0, yᵀ D(s) = 0, each at a speed of its own.
#[derive(Debug, Clone)]
pub struct Pairs {
    /// s, rad/s.
    pub s: Lanes,
    /// V, m/s.
    pub speed: Reals,
    /// ds/d ln V.
    pub slope: Lanes,
    /// Change of s in the last step, relative.
    pub change: Reals,
    x: Vec<Lanes>,
    y: Vec<Lanes>,
    /// D′ x and D′ᵀ y.
    dx: Vec<Lanes>,
    dy: Vec<Lanes>,
}

impl Pairs {
    /// Estimates of eigenvalues without vectors.
    pub fn near(s: Lanes, speed: Reals, order: usize) -> Self {
        // Any start that is in no coordinate plane.
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

    /// Takes what another holds, in the room that is there.
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

    /// Takes the pair in lane `from` of others into lane `to`.
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

    /// Repeats the pair in lane `other` in lane `l`.
    pub fn repeat(&mut self, l: usize, other: usize) {
        let vectors = [&mut self.x, &mut self.y, &mut self.dx, &mut self.dy];
        let values = vectors.into_iter().flatten();
        for lanes in values.chain([&mut self.s, &mut self.slope]) {
            (lanes.re[l], lanes.im[l]) = (lanes.re[other], lanes.im[other]);
        }
        self.speed[l] = self.speed[other];
        self.change[l] = self.change[other];
    }

    /// Whether the right vectors of two pairs are nearly the same.
    pub fn alike(a: (&Self, usize), b: (&Self, usize)) -> bool {
        Self::overlap(a, b) > ALIKE * ALIKE
    }

    /// Whether the right vector of one pair can have become that of another on the way from a speed
    /// to the next.
    pub fn related(a: (&Self, usize), b: (&Self, usize)) -> bool {
        Self::overlap(a, b) > RELATED * RELATED
    }

    /// |x̄ᵀ x′|² of right vectors, which are of length one.
    fn overlap((a, i): (&Self, usize), (b, j): (&Self, usize)) -> f64 {
        let products = a.x.iter().zip(&b.x);
        let product: Complex<f64> = products.map(|(a, b)| a.lane(i).conj() * b.lane(j)).sum();
        product.norm_sqr()
    }

    /// The eigenvalue in lane `l`.
    pub fn known(&self, l: usize) -> Known {
        Known {
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

/// Refines eigenpairs of a system.
pub struct Refiner<'m> {
    stiffness: &'m Stiffness,
    factors: Factors,
    residual: Vec<Lanes>,
    arch: Arch,
}

/// Relative change of s below which the next step would change nothing: its error falls with the
/// cube of the one before.
pub const SETTLED: f64 = 1e-6;
/// |x̄ᵀ x′| above which two vectors of length one are nearly the same.
const ALIKE: f64 = 0.98;
/// And above which they have something in common: those of different modes are nearly orthogonal
/// where these are not about to meet.
const RELATED: f64 = 0.8;
/// Steps allowed.
const STEPS: usize = 6;

impl<'m> Refiner<'m> {
    /// Of a system with this stiffness.
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

    /// The stiffness and room for its factors.
    pub fn parts(&mut self) -> (&Stiffness, &mut Factors, Arch) {
        (self.stiffness, &mut self.factors, self.arch)
    }

    /// Steps until s in all lanes below `used` changes by less than `settled`, relative; whether
    /// it does.
    pub fn settle(&mut self, pairs: &mut Pairs, used: usize, settled: f64) -> bool {
        for _ in 0..STEPS {
            self.step(pairs);
            let changes = &pairs.change[..used];
            // NaN counts as not settled.
            if changes.iter().all(|change| *change < settled) {
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
    pub fn step(&mut self, pairs: &mut Pairs) {
        let arch = self.arch;
        arch.dispatch(Step {
            refiner: self,
            pairs,
        });
    }
}

struct Step<'r, 'm> {
    refiner: &'r mut Refiner<'m>,
    pairs: &'r mut Pairs,
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
        let Pairs {
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
