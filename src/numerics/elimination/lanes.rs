//! Complex numbers side by side: the same operation on several systems at once.

use std::f64::consts::TAU;

use nalgebra::Complex;
use pulp::Simd;

/// Systems that are treated together: the width of the widest vector unit in use, or twice or four
/// times that of narrower ones.
pub const LANES: usize = 8;

/// [`LANES`] real numbers.
pub type Reals = [f64; LANES];

/// [`LANES`] complex numbers, real and imaginary parts apart.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub struct Lanes {
    /// Real parts.
    pub re: Reals,
    /// Imaginary parts.
    pub im: Reals,
}

/// Operations on real numbers lane by lane, in whole vectors. Without closures, which are compiled for
/// no vector unit unless they are inlined.
macro_rules! lane_by_lane {
    ($($(#[$doc:meta])+ $name:ident($($of:ident),+) $operation:ident)+) => {$(
        $(#[$doc])+
        #[allow(clippy::inline_always)]
        #[inline(always)]
        pub fn $name<S: Simd>(simd: S, $($of: &Reals),+) -> Reals {
            $(let $of = S::as_simd_f64s($of).0;)+
            let mut values = [0.0; LANES];
            let vectors = S::as_mut_simd_f64s(&mut values).0;
            for k in 0..vectors.len() {
                vectors[k] = simd.$operation($($of[k]),+);
            }
            values
        }
    )+};
}

lane_by_lane! {
    /// a + b.
    add(a, b) add_f64s
    /// a b.
    mul(a, b) mul_f64s
    /// a b + c.
    mul_add(a, b, c) mul_add_f64s
    /// c − a b.
    mul_subtracted(a, b, c) negate_mul_add_f64s
    /// a/b.
    div(a, b) div_f64s
    /// The smaller of two.
    min(a, b) min_f64s
    /// −a.
    neg(a) neg_f64s
    /// |a|.
    abs(a) abs_f64s
    /// √a.
    sqrt(a) sqrt_f64s
}

// Methods are inlined, because the vector unit is known in the caller.
#[allow(clippy::inline_always)]
impl Lanes {
    /// Zero in all lanes.
    pub const ZERO: Self = Self {
        re: [0.0; LANES],
        im: [0.0; LANES],
    };

    /// One in all lanes.
    pub const ONE: Self = Self {
        re: [1.0; LANES],
        im: [0.0; LANES],
    };

    /// One number each.
    #[inline(always)]
    pub fn from_fn(mut f: impl FnMut(usize) -> Complex<f64>) -> Self {
        let mut lanes = Self::ZERO;
        for l in 0..LANES {
            let z = f(l);
            (lanes.re[l], lanes.im[l]) = (z.re, z.im);
        }
        lanes
    }

    /// e^{iθ} of angles up to 1e9, to 1e-15 and the error of the angle itself.
    ///
    /// By Taylor's series at an eighth of the angle, less its whole turns, squared three times.
    #[inline(always)]
    #[must_use]
    pub fn on_unit_circle<S: Simd>(simd: S, angle: &Reals) -> Self {
        // Adding this leaves no room for digits after the point.
        const TO_WHOLE: f64 = 1.5 * (1_u64 << 52) as f64;
        // 2π less its double-precision value.
        const REST: f64 = 2.449_293_598_294_706_4e-16;
        let turns = mul_add(simd, angle, &[1.0 / TAU; LANES], &[TO_WHOLE; LANES]);
        let turns = add(simd, &turns, &[-TO_WHOLE; LANES]);
        let rest = mul_subtracted(simd, &turns, &[TAU; LANES], angle);
        let rest = mul_subtracted(simd, &turns, &[REST; LANES], &rest);
        let eighth = mul(simd, &rest, &[0.125; LANES]);
        let square = mul(simd, &eighth, &eighth);
        // cos x = 1 − x²/2 (1 − x²/12 (1 − …)), sin x = x (1 − x²/6 (1 − x²/20 (1 − …))).
        let (mut cos, mut sin) = ([1.0; LANES], [1.0; LANES]);
        for k in (1..=7).rev() {
            let k = 2.0 * f64::from(k);
            let [even, odd] = [k * (k - 1.0), k * (k + 1.0)].map(|d| [1.0 / d; LANES]);
            cos = mul_subtracted(simd, &mul(simd, &square, &even), &cos, &[1.0; LANES]);
            sin = mul_subtracted(simd, &mul(simd, &square, &odd), &sin, &[1.0; LANES]);
        }
        let mut unit = Self {
            re: cos,
            im: mul(simd, &eighth, &sin),
        };
        for _ in 0..3 {
            unit = unit.times(simd, &unit);
        }
        unit
    }

    /// The number in lane `l`.
    #[inline(always)]
    pub fn lane(&self, l: usize) -> Complex<f64> {
        Complex::new(self.re[l], self.im[l])
    }

    /// self + a b.
    #[inline(always)]
    #[must_use]
    pub fn plus_product<S: Simd>(&self, simd: S, a: &Self, b: &Self) -> Self {
        let re = mul_add(simd, &a.re, &b.re, &self.re);
        let im = mul_add(simd, &a.re, &b.im, &self.im);
        Self {
            re: mul_subtracted(simd, &a.im, &b.im, &re),
            im: mul_add(simd, &a.im, &b.re, &im),
        }
    }

    /// self − a b.
    #[inline(always)]
    #[must_use]
    pub fn minus_product<S: Simd>(&self, simd: S, a: &Self, b: &Self) -> Self {
        let re = mul_subtracted(simd, &a.re, &b.re, &self.re);
        let im = mul_subtracted(simd, &a.re, &b.im, &self.im);
        Self {
            re: mul_add(simd, &a.im, &b.im, &re),
            im: mul_subtracted(simd, &a.im, &b.re, &im),
        }
    }

    /// self + a b with real numbers.
    #[inline(always)]
    #[must_use]
    pub fn plus_scaled<S: Simd>(&self, simd: S, a: &Reals, b: &Self) -> Self {
        Self {
            re: mul_add(simd, a, &b.re, &self.re),
            im: mul_add(simd, a, &b.im, &self.im),
        }
    }

    /// self − a, the same number in all lanes.
    #[inline(always)]
    #[must_use]
    pub fn minus<S: Simd>(&self, simd: S, a: Complex<f64>) -> Self {
        Self {
            re: add(simd, &self.re, &[-a.re; LANES]),
            im: add(simd, &self.im, &[-a.im; LANES]),
        }
    }

    /// a self with real numbers.
    #[inline(always)]
    #[must_use]
    pub fn scaled<S: Simd>(&self, simd: S, a: &Reals) -> Self {
        Self {
            re: mul(simd, a, &self.re),
            im: mul(simd, a, &self.im),
        }
    }

    /// self b.
    #[inline(always)]
    #[must_use]
    pub fn times<S: Simd>(&self, simd: S, b: &Self) -> Self {
        let re = mul(simd, &self.re, &b.re);
        let im = mul(simd, &self.re, &b.im);
        Self {
            re: mul_subtracted(simd, &self.im, &b.im, &re),
            im: mul_add(simd, &self.im, &b.re, &im),
        }
    }

    /// 1/self.
    #[inline(always)]
    #[must_use]
    pub fn inverse<S: Simd>(&self, simd: S) -> Self {
        let scale = div(simd, &[1.0; LANES], &self.norm_sqr(simd));
        Self {
            re: mul(simd, &self.re, &scale),
            im: mul(simd, &neg(simd, &self.im), &scale),
        }
    }

    /// |self|².
    #[inline(always)]
    pub fn norm_sqr<S: Simd>(&self, simd: S) -> Reals {
        mul_add(simd, &self.im, &self.im, &mul(simd, &self.re, &self.re))
    }
}

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;

    #[test]
    fn unit_circle() {
        for start in [0.0, 3.0, -40.0, 1e3, 1e6] {
            let angles: Reals = std::array::from_fn(|l| start + 0.9 * l as f64);
            let unit = Lanes::on_unit_circle(Scalar::new(), &angles);
            for (l, angle) in angles.into_iter().enumerate() {
                let error = (unit.lane(l) - Complex::cis(angle)).norm();
                assert!(error < 2e-15, "{angle}: {error}");
            }
        }
    }
}
