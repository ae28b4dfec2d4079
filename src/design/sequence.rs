//! Points that cover a cube evenly, each to be had by its number.
//!
//! A Sobol' sequence with Owen's scrambling (`sobol_burley`: seeded, without dependencies, any point
//! by its number). It covers the cube more evenly than random or Latin hypercube samples; its 24
//! bits a coordinate are ample.

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

/// Points of one scrambling. After them the sequence goes on with another.
pub const BLOCK: usize = 1 << 16;

/// The scrambled sequence.
#[derive(Debug, Clone, Copy)]
pub struct Sequence {
    seed: u64,
}

impl Sequence {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// Point number `number` in so many dimensions, each coordinate from 0 to below 1.
    pub fn point(self, number: usize, dimensions: usize) -> Vec<f64> {
        const DIMENSIONS: usize = sobol_burley::NUM_DIMENSIONS as usize;
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream((number / BLOCK) as u64);
        let seed = random.next_u32();
        let row = low(number % BLOCK);
        let coordinate = |dimension: usize| {
            // Beyond the dimensions that the sequence has, another one goes on.
            let seed = seed.wrapping_add(low(dimension / DIMENSIONS));
            f64::from(sobol_burley::sample(row, low(dimension % DIMENSIONS), seed))
        };
        (0..dimensions).map(coordinate).collect()
    }
}

fn low(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sequence is balanced: 2^m points put one into each of 2^m equal intervals, in every
    /// dimension and with every scrambling.
    #[test]
    fn every_coordinate_is_covered_evenly() {
        let sequence = Sequence::new(7);
        for block in [0, 1, 20] {
            let points: Vec<Vec<f64>> = (0..64)
                .map(|row| sequence.point(block * BLOCK + row, 301))
                .collect();
            for dimension in [0, 1, 57, 255, 256, 300] {
                let mut hit = [false; 64];
                for point in &points {
                    let x = 64.0 * point[dimension];
                    let cell = (0..64).find(|i| x < f64::from(*i) + 1.0).unwrap_or(63);
                    hit[usize::try_from(cell).unwrap()] = true;
                }
                assert!(hit.iter().all(|h| *h), "dimension {dimension}");
            }
            assert!((points[5][3] - points[5][259]).abs() > 0.0);
        }
        assert_ne!(sequence.point(0, 2), sequence.point(BLOCK, 2));
        assert_ne!(sequence.point(0, 2), Sequence::new(8).point(0, 2));
    }
}
