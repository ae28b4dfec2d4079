//! Börsch-Supan corrections: all eigenvalues at once, from estimates of them.

use nalgebra::Complex;
use pulp::{Arch, Simd, WithSimd};

use super::elimination::{Factors, LANES, Lanes, Stiffness};

/// Limit on the iterations; three are usual.
const MAX_ITERATIONS: usize = 12;
/// Residual after the last correction, as a share of the eigenvalue: rounding level.
const RESIDUAL: f64 = 1e-14;
/// Sum of two eigenvalues' corrections, as a share of their distance, above which both are corrected
/// jointly.
const JOINT_SHARE: f64 = 0.02;
/// Least distance of two estimates, as a share of their size: divisors of the corrections stay well
/// above rounding.
const LEAST_SPACING: f64 = 1e-10;

/// Eigenvalues at `speed`, m/s, from estimates of all of them, for a system whose coordinates all have
/// mass. `None` if the iteration does not converge, or if the error discs below overlap.
///
/// ```math
/// Wⱼ = det D(zⱼ)/(det M · Π_{k≠j} (zⱼ − zₖ)),   zⱼ⁺ = zⱼ − Wⱼ/(1 + Σ_{k≠j} Wₖ/(zⱼ − zₖ))
/// ```
///
/// W. Börsch-Supan, *Residuenabschätzung für Polynom-Nullstellen mittels Lagrange-Interpolation*,
/// Numer. Math. 14 (1970): corrections fall with the third power of those before. The discs about zⱼ
/// with radius N |Wⱼ|, N the number of eigenvalues, together hold all eigenvalues, and a disc that
/// overlaps no other holds exactly one (B. T. Smith, *Error bounds for zeros of a polynomial based upon Gerschgorin's theorems*,
/// J. ACM 17, 1970).
///
/// The eigenvalues are the roots of 1 + Σ Wₖ/(z − zₖ). The correction of zⱼ solves this equation with
/// the terms k ≠ j held at zⱼ. For two close estimates it keeps both terms and solves a quadratic: a
/// real pair can then become a complex one, and nearly equal eigenvalues converge as fast as others.
pub(super) fn refined(
    stiffness: &Stiffness,
    masses: &[f64],
    speed: f64,
    estimates: &[Complex<f64>],
) -> Option<Vec<Complex<f64>>> {
    let mut factors = stiffness.factors();
    stiffness.set_speed(speed, &mut factors);
    let upper = estimates.iter().copied().filter(|z| z.im >= 0.0);
    let mut roots = Roots::default();
    roots.set(upper.collect());
    let arch = Arch::new();
    for _ in 0..MAX_ITERATIONS {
        if roots.all.len() != 2 * masses.len() {
            return None;
        }
        arch.dispatch(Corrections {
            stiffness,
            masses,
            factors: &mut factors,
            roots: &mut roots,
        });
        roots.find_neighbours();
        let converged = roots.converged();
        if converged && !roots.apart() {
            return None;
        }
        arch.dispatch(Sums(&mut roots));
        let corrected = roots.corrected()?;
        if converged {
            let conjugates = corrected.iter().filter(|z| z.im > 0.0).map(Complex::conj);
            return Some(corrected.iter().copied().chain(conjugates).collect());
        }
        roots.set(corrected);
    }
    None
}

/// Estimates with their corrections and neighbours.
#[derive(Default)]
struct Roots {
    /// All estimates.
    all: Vec<Complex<f64>>,
    /// W of each.
    corrections: Vec<Complex<f64>>,
    /// Real estimates and those in the upper half plane; a conjugate follows its partner in `all`.
    upper: Vec<Upper>,
}

/// An estimate that is real or in the upper half plane.
#[derive(Clone, Copy)]
struct Upper {
    /// Index among all.
    place: usize,
    /// Index of the nearest other estimate, and the distances of the nearest and second nearest.
    nearest: usize,
    distances: [f64; 2],
    /// Index of the estimate with which it is corrected jointly.
    partner: Option<usize>,
    /// 1 + Σ Wₖ/(z − zₖ) without its own and its partner's term, at zⱼ or midway between the two.
    sum: Complex<f64>,
}

impl Roots {
    /// Replaces the estimates by real ones and ones in the upper half plane.
    fn set(&mut self, mut upper: Vec<Complex<f64>>) {
        for j in 0..upper.len() {
            let least = LEAST_SPACING * upper[j].norm_sqr().sqrt();
            if upper[j].im > 0.0 {
                upper[j].im = upper[j].im.max(least);
            }
            for k in 0..j {
                if (upper[j] - upper[k]).norm_sqr() < least * least {
                    upper[j].re += least;
                    upper[k].re -= least;
                }
            }
        }
        self.all.clear();
        self.upper.clear();
        for z in upper {
            self.upper.push(Upper {
                place: self.all.len(),
                nearest: self.all.len(),
                distances: [f64::INFINITY; 2],
                partner: None,
                sum: Complex::ONE,
            });
            self.all.push(z);
            if z.im > 0.0 {
                self.all.push(z.conj());
            }
        }
        self.corrections.resize(self.all.len(), Complex::ZERO);
    }

    /// Finds the nearest neighbours, and the pairs to be corrected jointly.
    fn find_neighbours(&mut self) {
        for one in &mut self.upper {
            let mut least = [(one.place, f64::INFINITY); 2];
            for (k, z) in self.all.iter().enumerate() {
                let apart = (self.all[one.place] - z).norm_sqr();
                if k != one.place && apart < least[1].1 {
                    least[1] = (k, apart);
                    if apart < least[0].1 {
                        least.swap(0, 1);
                    }
                }
            }
            one.nearest = least[0].0;
            one.distances = least.map(|(_, apart)| apart.sqrt());
        }
        for i in 0..self.upper.len() {
            let one = self.upper[i];
            let (j, k) = (one.place, one.nearest);
            let mutual = |other: usize| {
                let back = self.upper[other].nearest == j;
                back && (self.all[j].im > 0.0) == (self.all[k].im > 0.0)
            };
            let is_conjugate = self.all[k].im < 0.0 && k == j + 1;
            let of_place = self.upper.binary_search_by_key(&k, |other| other.place);
            let size = |k: usize| self.corrections[k].norm_sqr().sqrt();
            let together = (is_conjugate || of_place.is_ok_and(mutual))
                && size(j) + size(k) > JOINT_SHARE * one.distances[0];
            self.upper[i].partner = together.then_some(k);
        }
    }

    /// True if the residual is at rounding level.
    fn converged(&self) -> bool {
        self.upper.iter().all(|one| {
            let apart = one.distances[usize::from(one.partner.is_some())];
            let w = self.corrections[one.place].norm_sqr();
            let share = w / (apart * apart);
            w * share * share < RESIDUAL * RESIDUAL * self.all[one.place].norm_sqr()
        })
    }

    /// True if no two error discs overlap, but for pairs corrected jointly.
    fn apart(&self) -> bool {
        let count = self.all.len() as f64;
        let radius = |k: usize| count * self.corrections[k].norm_sqr().sqrt();
        self.upper.iter().all(|one| {
            let j = one.place;
            let is_other = |k: &usize| *k != j && Some(*k) != one.partner;
            (0..self.all.len()).filter(is_other).all(|k| {
                let within = radius(j) + radius(k);
                (self.all[j] - self.all[k]).norm_sqr() > within * within
            })
        })
    }

    /// Corrected estimates with Im z ≥ 0. `None` if one of them would leave the upper half plane.
    fn corrected(&self) -> Option<Vec<Complex<f64>>> {
        let mut corrected = Vec::with_capacity(self.all.len());
        for one in &self.upper {
            let j = one.place;
            let (z, w) = (self.all[j], self.corrections[j] / one.sum);
            match one.partner {
                None if z.im > 0.0 => corrected.push(z - w),
                None => corrected.push((z - w).re.into()),
                // Done with its partner.
                Some(k) if k < j => (),
                Some(k) => {
                    let other = (self.all[k], self.corrections[k] / one.sum);
                    let [middle, square] = together((z, w), other);
                    let root = square.sqrt();
                    if self.all[k].im > 0.0 {
                        corrected.extend([middle + root, middle - root]);
                    } else if square.re < 0.0 {
                        corrected.push(Complex::new(middle.re, root.im.abs()));
                    } else {
                        let both = [middle + root, middle - root];
                        corrected.extend(both.map(|z| Complex::from(z.re)));
                    }
                }
            }
        }
        let fine = |z: &Complex<f64>| z.is_finite() && z.im >= 0.0;
        corrected.iter().all(fine).then_some(corrected)
    }
}

/// Mean of two roots of 1 + w/(z − a) + w′/(z − a′), and the square of half their difference.
fn together(
    (a, w): (Complex<f64>, Complex<f64>),
    (b, v): (Complex<f64>, Complex<f64>),
) -> [Complex<f64>; 2] {
    let (half, mean) = ((a - b) / 2.0, (w + v) / 2.0);
    let square = mean * mean + half * (half - w + v);
    [(a + b) / 2.0 - mean, square]
}

/// Computation of the corrections W.
struct Corrections<'r> {
    stiffness: &'r Stiffness,
    masses: &'r [f64],
    factors: &'r mut Factors,
    roots: &'r mut Roots,
}

impl WithSimd for Corrections<'_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Roots {
            all,
            corrections,
            upper,
        } = self.roots;
        for some in upper.chunks(LANES) {
            let z = Lanes::from_fn(|l| all[some[l.min(some.len() - 1)].place]);
            self.stiffness.factor(simd, &z, self.factors);
            let mut inverse = Lanes::ONE;
            // A pivot, which goes with z², and two distances in turn: the product stays in range.
            let mut rest = 0..all.len();
            for (pivot, coordinate) in self.stiffness.inverse_pivots(self.factors) {
                let pivot = pivot.scaled(simd, &[self.masses[coordinate]; LANES]);
                inverse = inverse.times(simd, &pivot);
                for k in rest.by_ref().take(2) {
                    let own = (0..some.len()).filter(|l| some[*l].place == k);
                    let distance = distance(simd, &z, all[k], own);
                    inverse = inverse.times(simd, &distance);
                }
            }
            let w = inverse.inverse(simd);
            for (l, Upper { place, .. }) in some.iter().enumerate() {
                let w = w.lane(l);
                if all[*place].im > 0.0 {
                    corrections[*place] = w;
                    corrections[place + 1] = w.conj();
                } else {
                    corrections[*place] = w.re.into();
                }
            }
        }
    }
}

/// Computation of the sums 1 + Σ Wₖ/(z − zₖ).
struct Sums<'r>(&'r mut Roots);

impl WithSimd for Sums<'_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Roots {
            all,
            corrections,
            upper,
        } = self.0;
        for some in upper.chunks_mut(LANES) {
            let at = Lanes::from_fn(|l| {
                let one = &some[l.min(some.len() - 1)];
                let z = all[one.place];
                one.partner.map_or(z, |k| (z + all[k]) / 2.0)
            });
            let mut sum = Lanes::ONE;
            for (k, z) in all.iter().enumerate() {
                let is_left_out = |l: &usize| some[*l].place == k || some[*l].partner == Some(k);
                let left_out = (0..some.len()).filter(is_left_out);
                let distance = distance(simd, &at, *z, left_out.clone());
                let mut w = Lanes::from_fn(|_| corrections[k]);
                for l in left_out {
                    (w.re[l], w.im[l]) = (0.0, 0.0);
                }
                sum = sum.plus_product(simd, &w, &distance.inverse(simd));
            }
            for (l, one) in some.iter_mut().enumerate() {
                one.sum = sum.lane(l);
            }
        }
    }
}

/// z − zₖ of an estimate zₖ; 1 in the lanes `left_out`.
#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
#[inline(always)]
fn distance<S: Simd>(
    simd: S,
    z: &Lanes,
    one: Complex<f64>,
    left_out: impl Iterator<Item = usize>,
) -> Lanes {
    let mut distance = z.minus(simd, one);
    for l in left_out {
        (distance.re[l], distance.im[l]) = (1.0, 0.0);
    }
    distance
}
