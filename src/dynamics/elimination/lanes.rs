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
    pub fn add_product(&mut self, a: &Self, b: &Self) {
        for l in 0..LANES {
            self.re[l] += a.re[l] * b.re[l] - a.im[l] * b.im[l];
            self.im[l] += a.re[l] * b.im[l] + a.im[l] * b.re[l];
        }
    }

    /// self − a b.
    #[inline(always)]
    pub fn subtract_product(&mut self, a: &Self, b: &Self) {
        for l in 0..LANES {
            self.re[l] -= a.re[l] * b.re[l] - a.im[l] * b.im[l];
            self.im[l] -= a.re[l] * b.im[l] + a.im[l] * b.re[l];
        }
    }

    /// self + a b with a real number.
    #[inline(always)]
    pub fn add_scaled(&mut self, a: f64, b: &Self) {
        for l in 0..LANES {
            self.re[l] += a * b.re[l];
            self.im[l] += a * b.im[l];
        }
    }

    /// a b.
    #[inline(always)]
    #[must_use]
    pub fn times(&self, b: &Self) -> Self {
        let mut product = Self::ZERO;
        product.add_product(self, b);
        product
    }

    /// 1/self.
    #[inline(always)]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let mut inverse = Self::ZERO;
        let norm = self.norm_sqr();
        for l in 0..LANES {
            let scale = 1.0 / norm[l];
            inverse.re[l] = self.re[l] * scale;
            inverse.im[l] = -self.im[l] * scale;
        }
        inverse
    }

    /// |self|².
    #[inline(always)]
    pub fn norm_sqr(&self) -> [f64; LANES] {
        let mut norm = [0.0; LANES];
        for l in 0..LANES {
            norm[l] = self.re[l] * self.re[l] + self.im[l] * self.im[l];
        }
        norm
    }
}
