//! Pattern of an elimination, and the elimination itself.

use pulp::Simd;

use super::lanes::{LANES, Lanes, Reals, abs, add, div, min, mul_subtracted};

/// Order of pivots and list of entries to be updated, for all matrices with the same nonzero entries.
///
/// Pivots are diagonal entries, chosen beforehand for the least fill (Markowitz 1957);
/// [`Pattern::factor`] reports lost digits afterwards.
#[derive(Debug, Clone)]
pub struct Pattern {
    order: usize,
    /// Slot of entry (i, j) at i·n + j.
    slots: Vec<Option<u16>>,
    pivots: Vec<Pivot>,
    /// Entries below and right of the pivots.
    lower: Vec<Entry>,
    upper: Vec<Entry>,
    /// Slots of the entries a in a −= l u, ordered by l and, for each l, by u.
    updates: Vec<u16>,
    count: usize,
}

/// A set of coordinates, as bits.
pub type CoordinateSet = u64;

/// Most coordinates that an elimination holds.
pub const MOST: usize = CoordinateSet::BITS as usize;

/// All coordinates, as bits.
pub const ALL: CoordinateSet = CoordinateSet::MAX;

/// Square of the ratio of a pivot to its original diagonal entry below which digits count as lost: ten of
/// sixteen remain.
const LEAST_PIVOT: f64 = 1e-12;
/// Number of inverse pivots that are multiplied before the product is scaled: inverse pivots are above
/// 1e-17, so that the product stays far above underflow.
const UNSCALED: usize = 5;

#[derive(Debug, Clone, Copy)]
struct Entry {
    /// Coordinate of the row below, or of the column to the right.
    coordinate: u16,
    slot: u16,
}

#[derive(Debug, Clone)]
struct Pivot {
    coordinate: usize,
    slot: usize,
    lower: std::ops::Range<usize>,
    upper: std::ops::Range<usize>,
    updates: std::ops::Range<usize>,
}

// Compiled into the caller, where the vector unit is known.
#[allow(clippy::inline_always)]
impl Pattern {
    /// The elimination of matrices of order `n`, at most [`MOST`], with nonzeros on the diagonal and at some
    /// rows and columns.
    pub fn new(n: usize, filled: impl Iterator<Item = (usize, usize)>) -> Self {
        // Columns of the nonzeros of each row, and rows of those of each column, as bits.
        let (mut rows, mut columns): ([CoordinateSet; MOST], [CoordinateSet; MOST]) =
            ([0; MOST], [0; MOST]);
        for (i, j) in filled.chain((0..n).map(|i| (i, i))) {
            rows[i] |= 1 << j;
            columns[j] |= 1 << i;
        }
        let mut rest = ALL >> (MOST - n);
        let mut steps = Vec::with_capacity(n);
        while rest != 0 {
            let others = |k: usize| rest & !(1 << k);
            let cost = |k: usize| {
                (rows[k] & others(k)).count_ones() * (columns[k] & others(k)).count_ones()
            };
            let Some(k) = bits(rest).min_by_key(|&k| (cost(k), k)) else {
                break;
            };
            let (below, right) = (columns[k] & others(k), rows[k] & others(k));
            for i in bits(below) {
                rows[i] |= right;
            }
            for j in bits(right) {
                columns[j] |= below;
            }
            rest = others(k);
            steps.push((k, below, right));
        }
        let mut pattern = Self {
            order: n,
            slots: vec![None; n * n],
            pivots: Vec::with_capacity(n),
            lower: Vec::with_capacity(4 * n),
            upper: Vec::with_capacity(4 * n),
            updates: Vec::with_capacity(16 * n),
            count: 0,
        };
        for (i, row) in rows.iter().enumerate().take(n) {
            for j in bits(*row) {
                pattern.slots[i * n + j] = u16::try_from(pattern.count).ok();
                pattern.count += 1;
            }
        }
        for (k, below, right) in steps {
            pattern.add_pivot(k, below, right);
        }
        pattern
    }

    fn add_pivot(&mut self, k: usize, below: CoordinateSet, right: CoordinateSet) {
        let n = self.order;
        let (l, u, x) = (self.lower.len(), self.upper.len(), self.updates.len());
        let slots = &self.slots;
        let entry = |coordinate: usize, i: usize, j: usize| {
            let coordinate = u16::try_from(coordinate).ok()?;
            slots[i * n + j].map(|slot| Entry { coordinate, slot })
        };
        self.lower
            .extend(bits(below).filter_map(|i| entry(i, i, k)));
        self.upper
            .extend(bits(right).filter_map(|j| entry(j, k, j)));
        for i in bits(below) {
            self.updates
                .extend(bits(right).filter_map(|j| slots[i * n + j]));
        }
        self.pivots.push(Pivot {
            coordinate: k,
            slot: usize::from(slots[k * n + k].unwrap_or_default()),
            lower: l..self.lower.len(),
            upper: u..self.upper.len(),
            updates: x..self.updates.len(),
        });
    }

    /// Order of the matrices.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Number of entries of a matrix, fill included.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Slot of entry (i, j); `None` if it is always zero.
    pub fn slot(&self, i: usize, j: usize) -> Option<usize> {
        self.slots[i * self.order + j].map(usize::from)
    }

    /// Slots and coordinates of the pivots.
    pub fn pivots(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.pivots
            .iter()
            .map(|pivot| (pivot.slot, pivot.coordinate))
    }

    /// Factors L U in place, the inverse pivots on the diagonal. `diagonal` gets the squares of the
    /// diagonal before. Returns false in lanes where a pivot has lost digits against it.
    #[inline(always)]
    pub fn factor<S: Simd>(
        &self,
        simd: S,
        a: &mut [Lanes],
        diagonal: &mut [Reals],
    ) -> [bool; LANES] {
        for (pivot, size) in self.pivots.iter().zip(diagonal.iter_mut()) {
            *size = a[pivot.slot].norm_sqr(simd);
        }
        let mut margin = [f64::INFINITY; LANES];
        for (pivot, size) in self.pivots.iter().zip(diagonal) {
            let left = a[pivot.slot].norm_sqr(simd);
            let above = mul_subtracted(simd, &[LEAST_PIVOT; LANES], size, &left);
            margin = min(simd, &margin, &above);
            let inverse = a[pivot.slot].inverse(simd);
            a[pivot.slot] = inverse;
            let upper = &self.upper[pivot.upper.clone()];
            let mut updates = self.updates[pivot.updates.clone()].iter();
            for entry in &self.lower[pivot.lower.clone()] {
                let slot = usize::from(entry.slot);
                let multiple = a[slot].times(simd, &inverse);
                a[slot] = multiple;
                for (right, target) in upper.iter().zip(&mut updates) {
                    let target = usize::from(*target);
                    let right = &a[usize::from(right.slot)];
                    a[target] = a[target].minus_product(simd, &multiple, right);
                }
            }
        }
        margin.map(|m| m > 0.0)
    }

    /// Direction of the determinant in the complex plane, from the factors.
    #[inline(always)]
    pub fn determinant<S: Simd>(&self, simd: S, a: &[Lanes]) -> Lanes {
        let mut product = Lanes::ONE;
        for pivots in self.pivots.chunks(UNSCALED) {
            for pivot in pivots {
                product = product.times(simd, &a[pivot.slot]);
            }
            let size = add(simd, &abs(simd, &product.re), &abs(simd, &product.im));
            product = product.scaled(simd, &div(simd, &[1.0; LANES], &size));
        }
        product.im = product.im.map(|im| -im);
        product
    }

    /// x ← A⁻¹ x with the factors of [`Pattern::factor`], where only coordinates whose bits are set in
    /// `moved` are not zero, before and after.
    #[inline(always)]
    pub fn solve<S: Simd>(&self, simd: S, a: &[Lanes], x: &mut [Lanes], moved: CoordinateSet) {
        let moves = |pivot: &&Pivot| moved & (1 << pivot.coordinate) != 0;
        for pivot in self.pivots.iter().filter(moves) {
            let known = x[pivot.coordinate];
            for entry in &self.lower[pivot.lower.clone()] {
                let i = usize::from(entry.coordinate);
                x[i] = x[i].minus_product(simd, &a[usize::from(entry.slot)], &known);
            }
        }
        for pivot in self.pivots.iter().rev().filter(moves) {
            let mut sum = x[pivot.coordinate];
            for entry in &self.upper[pivot.upper.clone()] {
                let other = &x[usize::from(entry.coordinate)];
                sum = sum.minus_product(simd, &a[usize::from(entry.slot)], other);
            }
            x[pivot.coordinate] = sum.times(simd, &a[pivot.slot]);
        }
    }

    /// x ← A⁻ᵀ x.
    #[inline(always)]
    pub fn solve_transposed<S: Simd>(&self, simd: S, a: &[Lanes], x: &mut [Lanes]) {
        for pivot in &self.pivots {
            let known = x[pivot.coordinate].times(simd, &a[pivot.slot]);
            x[pivot.coordinate] = known;
            for entry in &self.upper[pivot.upper.clone()] {
                let i = usize::from(entry.coordinate);
                x[i] = x[i].minus_product(simd, &a[usize::from(entry.slot)], &known);
            }
        }
        for pivot in self.pivots.iter().rev() {
            let mut sum = x[pivot.coordinate];
            for entry in &self.lower[pivot.lower.clone()] {
                let other = &x[usize::from(entry.coordinate)];
                sum = sum.minus_product(simd, &a[usize::from(entry.slot)], other);
            }
            x[pivot.coordinate] = sum;
        }
    }
}

/// Numbers of the bits that are set.
fn bits(mut mask: CoordinateSet) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (mask != 0).then(|| {
            let bit = mask.trailing_zeros();
            mask &= mask - 1;
            bit as usize
        })
    })
}
