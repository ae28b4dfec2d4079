//! The rate of fused multiply–adds that a core reaches, with the vector unit that the program uses.

use pulp::{Arch, Simd, WithSimd};

/// Chains that do not wait for one another: latency times ports of present cores, and few enough
/// for the registers.
const CHAINS: usize = 12;
const STEPS: usize = 4000;
/// Operations of a run in lanes of eight numbers, a multiplication and an addition each.
pub const OPERATIONS: usize = 2 * 8 * CHAINS * STEPS;

struct Chains {
    factor: f64,
}

impl WithSimd for Chains {
    type Output = f64;

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (factor, term) = (simd.splat_f64s(self.factor), simd.splat_f64s(0.25));
        let mut sums = [simd.splat_f64s(1.0); CHAINS];
        // As many steps more as the vector unit is narrower than eight numbers.
        for _ in 0..STEPS * 8 / S::F64_LANES {
            for sum in &mut sums {
                *sum = simd.mul_add_f64s(*sum, factor, term);
            }
        }
        let total = sums
            .into_iter()
            .fold(simd.splat_f64s(0.0), |a, b| simd.add_f64s(a, b));
        simd.reduce_sum_f64s(total)
    }
}

/// [`OPERATIONS`] operations.
pub fn run(factor: f64) -> f64 {
    Arch::new().dispatch(Chains { factor })
}
