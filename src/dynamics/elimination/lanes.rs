//! Complex numbers side by side: the same operation on several systems at once.

use nalgebra::Complex;

/// Systems that are treated together: the width of the widest vector unit in use, or twice or four
/// times that of narrower ones.
pub const LANES: usize = 8;

/// [`LANES`] complex numbers, real and imaginary parts apart.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub struct Lanes {
    /// Real parts.
    pub re: [f64; LANES],
    /// Imaginary parts.
    pub im: [f64; LANES],
}

/// Applies a function lane by lane. Arguments are taken by value: what is read cannot then be what
/// is written, and the compiler keeps to whole vectors.
#[allow(clippy::inline_always)]
#[inline(always)]
pub fn each(f: impl FnMut(usize) -> f64) -> [f64; LANES] {
    std::array::from_fn(f)
}

// What works on lanes must be compiled into its caller, where the vector unit is known.
#[allow(clippy::inline_always)]
impl Lanes {
    /// Zero in all lanes.
    pub const ZERO: Self = Self {
        re: [0.0; LANES],
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

    /// The number in lane `l`.
    #[inline(always)]
    pub fn lane(&self, l: usize) -> Complex<f64> {
        Complex::new(self.re[l], self.im[l])
    }

    /// self + a b.
    #[inline(always)]
    #[must_use]
    pub fn plus_product(self, a: Self, b: Self) -> Self {
        Self {
            re: each(|l| (-a.im[l]).mul_add(b.im[l], a.re[l].mul_add(b.re[l], self.re[l]))),
            im: each(|l| a.im[l].mul_add(b.re[l], a.re[l].mul_add(b.im[l], self.im[l]))),
        }
    }

    /// self − a b.
    #[inline(always)]
    #[must_use]
    pub fn minus_product(self, a: Self, b: Self) -> Self {
        Self {
            re: each(|l| a.im[l].mul_add(b.im[l], (-a.re[l]).mul_add(b.re[l], self.re[l]))),
            im: each(|l| (-a.im[l]).mul_add(b.re[l], (-a.re[l]).mul_add(b.im[l], self.im[l]))),
        }
    }

    /// self + a b with real numbers.
    #[inline(always)]
    #[must_use]
    pub fn plus_scaled(self, a: [f64; LANES], b: Self) -> Self {
        Self {
            re: each(|l| a[l].mul_add(b.re[l], self.re[l])),
            im: each(|l| a[l].mul_add(b.im[l], self.im[l])),
        }
    }

    /// a self with real numbers.
    #[inline(always)]
    #[must_use]
    pub fn scaled(self, a: [f64; LANES]) -> Self {
        Self {
            re: each(|l| a[l] * self.re[l]),
            im: each(|l| a[l] * self.im[l]),
        }
    }

    /// self b.
    #[inline(always)]
    #[must_use]
    pub fn times(self, b: Self) -> Self {
        Self {
            re: each(|l| (-self.im[l]).mul_add(b.im[l], self.re[l] * b.re[l])),
            im: each(|l| self.im[l].mul_add(b.re[l], self.re[l] * b.im[l])),
        }
    }

    /// 1/self.
    #[inline(always)]
    #[must_use]
    pub fn inverse(self) -> Self {
        let norm = self.norm_sqr();
        let scale = each(|l| 1.0 / norm[l]);
        Self {
            re: each(|l| self.re[l] * scale[l]),
            im: each(|l| -self.im[l] * scale[l]),
        }
    }

    /// |self|².
    #[inline(always)]
    pub fn norm_sqr(self) -> [f64; LANES] {
        each(|l| self.im[l].mul_add(self.im[l], self.re[l] * self.re[l]))
    }
}
