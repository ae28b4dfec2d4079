//! Whole random numbers.

use rand_chacha::{ChaCha8Rng, rand_core::RngCore};

/// A whole number from 0 to below `n`, all equally likely.
pub(super) fn below(rng: &mut ChaCha8Rng, n: usize) -> usize {
    let wide = u128::from(rng.next_u64()) * n as u128;
    usize::try_from(wide >> 64).unwrap_or(0)
}

/// The numbers from 0 to below `n` in random order (Durstenfeld 1964).
pub(super) fn permutation(rng: &mut ChaCha8Rng, n: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, below(rng, i + 1));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn every_number_comes_up_as_often() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut counts = [0_u32; 5];
        for _ in 0..50_000 {
            counts[below(&mut rng, 5)] += 1;
        }
        // Four standard deviations of a binomial count: 4 √(50000 · 0.2 · 0.8) = 358.
        assert!(
            counts.iter().all(|c| c.abs_diff(10_000) < 358),
            "{counts:?}"
        );
        assert_eq!(below(&mut rng, 1), 0);
    }

    #[test]
    fn a_permutation_has_every_number_once() {
        let mut order = permutation(&mut ChaCha8Rng::seed_from_u64(2), 20);
        assert_ne!(order, (0..20).collect::<Vec<_>>());
        order.sort_unstable();
        assert_eq!(order, (0..20).collect::<Vec<_>>());
    }
}
