//! Adaptive Gauss integration of several functions at once, band by band.

use pulp::{Arch, Simd, WithSimd};

use super::elimination::{LANES, Reals, lanes::mul_add};

/// Points of the rule: two groups of points that are evaluated together.
const POINTS: usize = 2 * LANES;

/// Positive abscissae and weights of the 16-point Gauss–Legendre rule on [−1, 1], innermost first
/// (Abramowitz, Stegun: *Handbook of Mathematical Functions*, 1964, table 25.4).
const RULE: [(f64, f64); LANES] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_5),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_7),
    (0.755_404_408_355_003, 0.124_628_971_255_533_9),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_8),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_9),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_1),
];

/// Degrees of the Legendre coefficients from which the error is estimated: the two highest that the
/// points determine, an odd and an even one.
const DEGREES: [usize; 2] = [POINTS - 1, POINTS - 2];
/// Weighted sums per function: the integral and the two coefficients.
const SUMS: usize = 1 + DEGREES.len();

/// Error of the integral as a share of these coefficients. Of a pole on an ellipse whose axes sum to
/// 2ρ, foci at the ends of the panel, both fall with ρ: the error is 2π ρ^−33 for a residue of one, a
/// sixth of ρ^−18 of the coefficients. Panels are laid so that ρ is at least 1.78
/// ([`super::panels`]), for which that is 5e-6; this is six times as much.
const FALL: f64 = 3e-5;

/// One group of points with their weights in each sum.
#[derive(Clone, Copy)]
struct Group {
    nodes: Reals,
    weights: [Reals; SUMS],
}

/// The rule's points, the negative ones first.
fn rule() -> [Group; 2] {
    [-1.0, 1.0].map(|sign| {
        let mut group = Group {
            nodes: [0.0; LANES],
            weights: [[0.0; LANES]; SUMS],
        };
        for (l, (node, weight)) in RULE.into_iter().enumerate() {
            let x = sign * node;
            group.nodes[l] = x;
            group.weights[0][l] = weight;
            for (degree, weights) in DEGREES.into_iter().zip(&mut group.weights[1..]) {
                weights[l] = weight * (2 * degree + 1) as f64 * legendre(degree, x);
            }
        }
        group
    })
}

/// P_n(x).
fn legendre(n: usize, x: f64) -> f64 {
    let (mut before, mut p) = (1.0, x);
    for k in 1..n {
        let k = k as f64;
        (before, p) = (p, ((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0));
    }
    p
}

/// Adds a group's shares of the sums of each function.
struct Weighing<'s> {
    group: &'s Group,
    values: &'s [Reals],
    sums: &'s mut [[Reals; SUMS]],
}

impl WithSimd for Weighing<'_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (values, sums) in self.values.iter().zip(self.sums) {
            for (sum, weights) in sums.iter_mut().zip(&self.group.weights) {
                *sum = mul_add(simd, weights, values, sum);
            }
        }
    }
}

/// Limit on the panels: a resonance of damping ratio 1e-4 needs about a hundred.
const MAX_PANELS: usize = 4000;

/// Integrals of several functions over adjoining bands.
#[derive(Debug, Clone)]
pub struct Integrals {
    functions: usize,
    /// Integral of function k over band b at b·functions + k.
    bands: Vec<f64>,
    /// True if every function met the tolerance.
    pub converged: bool,
}

impl Integrals {
    /// Integral of function `k` over band `b`.
    pub fn band(&self, b: usize, k: usize) -> f64 {
        self.bands[b * self.functions + k]
    }

    /// Integral of function `k` over the bands between two of the `edges`.
    pub fn between(&self, edges: &[f64], [low, high]: [f64; 2], k: usize) -> f64 {
        let bands = edges.windows(2).enumerate();
        bands
            .filter(|(_, ends)| ends[0] >= low && ends[1] <= high)
            .map(|(band, _)| self.band(band, k))
            .sum()
    }

    /// Integral of function `k` over all bands.
    pub fn total(&self, k: usize) -> f64 {
        self.bands.iter().skip(k).step_by(self.functions).sum()
    }
}

struct Panel {
    band: usize,
    ends: [f64; 2],
}

/// Integrates `functions` functions, evaluated together at several points by `f(x, values)`, over
/// the bands between consecutive `edges`, until the estimated error of each of the first `checked` is
/// below `tolerance` of its total.
pub fn integrate(
    edges: &[f64],
    [functions, checked]: [usize; 2],
    tolerance: f64,
    mut f: impl FnMut(&Reals, &mut [Reals]),
) -> Integrals {
    let arch = Arch::new();
    let rule = rule();
    let mut values = vec![[0.0; LANES]; functions];
    let mut sums = vec![[[0.0; LANES]; SUMS]; functions];
    let mut evaluate = |panel: &Panel, integral: &mut [f64], error: &mut [f64]| {
        let [low, high] = panel.ends;
        let (centre, half) = (f64::midpoint(low, high), (high - low) / 2.0);
        sums.fill([[0.0; LANES]; SUMS]);
        for group in &rule {
            f(&group.nodes.map(|node| centre + half * node), &mut values);
            arch.dispatch(Weighing {
                group,
                values: &values,
                sums: &mut sums,
            });
        }
        let sum = |lanes: &Reals| half * lanes.iter().sum::<f64>();
        for (value, [integral, ..]) in integral.iter_mut().zip(&sums) {
            *value = sum(integral);
        }
        for (k, [_, odd, even]) in sums.iter().enumerate().take(checked) {
            error[k] = FALL * (sum(odd).abs() + sum(even).abs());
        }
    };

    let mut panels: Vec<Panel> = edges
        .windows(2)
        .enumerate()
        .map(|(band, w)| Panel {
            band,
            ends: [w[0], w[1]],
        })
        .collect();
    let mut integrals = vec![0.0; functions * panels.len()];
    let mut errors = integrals.clone();
    for (p, panel) in panels.iter().enumerate() {
        let range = functions * p..functions * (p + 1);
        evaluate(panel, &mut integrals[range.clone()], &mut errors[range]);
    }
    let mut converged = false;
    loop {
        let total = |v: &[f64], k: usize| v.iter().skip(k).step_by(functions).sum::<f64>();
        let allowed: Vec<f64> = (0..checked)
            .map(|k| tolerance * total(&integrals, k))
            .collect();
        if (0..checked).all(|k| total(&errors, k) <= allowed[k]) {
            converged = true;
            break;
        }
        // Halve every panel whose share of the error is more than its share of the allowance.
        let share = panels.len() as f64;
        let refine: Vec<usize> = (0..panels.len())
            .filter(|p| (0..checked).any(|k| errors[p * functions + k] * share > allowed[k]))
            .collect();
        if refine.is_empty() || panels.len() + refine.len() > MAX_PANELS {
            break;
        }
        for p in refine {
            let Panel {
                band,
                ends: [low, high],
            } = panels[p];
            let middle = f64::midpoint(low, high);
            let [first, second] = [[low, middle], [middle, high]].map(|ends| Panel { band, ends });
            let range = functions * p..functions * (p + 1);
            evaluate(&first, &mut integrals[range.clone()], &mut errors[range]);
            let start = integrals.len();
            integrals.resize(start + functions, 0.0);
            errors.resize(start + functions, 0.0);
            evaluate(&second, &mut integrals[start..], &mut errors[start..]);
            panels[p] = first;
            panels.push(second);
        }
    }
    let mut bands = vec![0.0; functions * (edges.len() - 1)];
    for (p, panel) in panels.iter().enumerate() {
        for k in 0..functions {
            bands[panel.band * functions + k] += integrals[p * functions + k];
        }
    }
    Integrals {
        functions,
        bands,
        converged,
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;

    use super::*;

    #[test]
    fn resonance_peak_and_polynomial() {
        // ∫ c/((x−1)² + c²) over (0, 3) = atan(2/c) + atan(1/c)
        let c: f64 = 1e-3;
        let result = integrate(&[0.0, 0.5, 1.7, 3.0], [2, 2], 1e-10, |x, v| {
            v[0] = x.map(|x| c / ((x - 1.0).powi(2) + c * c));
            v[1] = x.map(|x| x.powi(5));
        });
        assert!(result.converged);
        assert!((result.total(0) / ((2.0 / c).atan() + (1.0 / c).atan()) - 1.0).abs() < 1e-10);
        assert!((result.total(1) / 121.5 - 1.0).abs() < 1e-13);
        assert!((result.band(0, 1) / (0.5_f64.powi(6) / 6.0) - 1.0).abs() < 1e-13);
    }

    /// ∫ dx/(z − x) over (−1, 1) = ln((z + 1)/(z − 1)), with z on the smallest ellipse that panels leave free
    /// of poles.
    #[test]
    fn the_error_of_a_pole_is_within_its_estimate() {
        for angle in [0.1, 0.7, 1.3, 1.57] {
            let u: Complex<f64> = Complex::from_polar(1.78, angle);
            let z: Complex<f64> = (u + u.inv()) / 2.0;
            let exact: Complex<f64> = Complex::ln((z + 1.0) / (z - 1.0));
            let [integral, odd, even]: [Complex<f64>; SUMS] = std::array::from_fn(|k| {
                let groups = rule().into_iter();
                let terms =
                    groups.flat_map(|g| (0..LANES).map(move |l| (g.nodes[l], g.weights[k][l])));
                terms.map(|(x, weight)| (z - x).inv() * weight).sum()
            });
            let (error, estimate) = ((integral - exact).norm(), FALL * (odd.norm() + even.norm()));
            assert!(
                error < estimate && estimate < 10.0 * error,
                "{error} {estimate}"
            );
        }
    }

    #[test]
    fn what_cannot_be_integrated_is_said() {
        // Far faster than the panels allowed can follow.
        let noise = |x: &Reals, v: &mut [Reals]| v[0] = x.map(|x| (1e9 * x).sin());
        assert!(!integrate(&[0.0, 1.0], [1, 1], 1e-6, noise).converged);
        assert!(!integrate(&[0.0, 1.0], [1, 1], 1e-6, |_, v| v[0] = [f64::NAN; LANES]).converged);
    }
}
