//! Dynamic stiffness of a system, factored for several frequencies at once.

use pulp::Simd;

use super::{
    lanes::{LANES, Lanes, Reals, div, mul, mul_add},
    pattern::{CoordinateSet, Pattern},
};
use crate::numerics::LinearSystem;

/// D(s) = s² M + s C(V) + K of the coordinates of a system.
#[derive(Debug, Clone)]
pub struct Stiffness {
    pattern: Pattern,
    entries: Vec<Entry>,
    /// Slots of fill.
    empty: Vec<usize>,
    /// Numbers of the entries with mass.
    massive: Vec<usize>,
    /// Numbers of the entries with damping but no mass, row by row.
    damped: Vec<Vec<usize>>,
    /// Numbers of the entries whose damping depends on the speed.
    by_speed: Vec<usize>,
}

/// One entry of K, of C0, C1 and C2, and of M.
#[derive(Debug, Clone, Copy)]
struct Entry {
    row: usize,
    column: usize,
    slot: usize,
    k: f64,
    c: [f64; 3],
    m: f64,
}

/// Work space for the factors.
#[derive(Debug, Clone)]
pub struct Factors {
    a: Vec<Lanes>,
    /// C at the speeds set, entry by entry.
    damping: Vec<Reals>,
    diagonal: Vec<Reals>,
    /// True for lanes in which no digits were lost.
    pub sound: [bool; LANES],
}

// Compiled into the caller, where the vector unit is known.
#[allow(clippy::inline_always)]
impl Stiffness {
    /// Dynamic stiffness of a system.
    pub fn new(system: &LinearSystem) -> Self {
        let n = system.order();
        let [c0, c1, c2] = &system.damping;
        let mut entries = Vec::with_capacity(8 * n);
        for row in 0..n {
            for column in 0..n {
                let at = (row, column);
                let (k, c) = (system.stiffness[at], [c0[at], c1[at], c2[at]]);
                if row == column || k != 0.0 || c.iter().any(|c| *c != 0.0) {
                    let m = if row == column { system.mass[row] } else { 0.0 };
                    let slot = 0;
                    entries.push(Entry {
                        row,
                        column,
                        slot,
                        k,
                        c,
                        m,
                    });
                }
            }
        }
        let pattern = Pattern::new(n, entries.iter().map(|e: &Entry| (e.row, e.column)));
        for entry in &mut entries {
            entry.slot = pattern.slot(entry.row, entry.column).unwrap_or_default();
        }
        let mut filled = vec![false; pattern.count()];
        for entry in &entries {
            filled[entry.slot] = true;
        }
        let which = |of: &dyn Fn(&Entry) -> bool| -> Vec<usize> {
            (0..entries.len()).filter(|&k| of(&entries[k])).collect()
        };
        let damped = which(&|entry| entry.m == 0.0 && entry.c.iter().any(|c| *c != 0.0));
        Self {
            massive: which(&|entry| entry.m != 0.0),
            damped: damped
                .chunk_by(|&k, &l| entries[k].row == entries[l].row)
                .map(|row| row.to_vec())
                .collect(),
            by_speed: which(&|entry| entry.c[1..].iter().any(|c| *c != 0.0)),
            empty: (0..pattern.count()).filter(|&slot| !filled[slot]).collect(),
            pattern,
            entries,
        }
    }

    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.pattern.order()
    }

    /// Degree of det D(s): the number of first-order states, two of a coordinate with mass and one of a massless
    /// one.
    pub fn degree(&self) -> usize {
        self.order() + self.massive.len()
    }

    /// Work space for its factors.
    pub fn factors(&self) -> Factors {
        Factors {
            a: vec![Lanes::ZERO; self.pattern.count()],
            damping: self.entries.iter().map(|e| [e.c[0]; LANES]).collect(),
            diagonal: vec![[0.0; LANES]; self.order()],
            sound: [false; LANES],
        }
    }

    /// Sets C at a speed `v`, m/s, in all lanes.
    pub fn set_speed(&self, v: f64, factors: &mut Factors) {
        for &k in &self.by_speed {
            let [c0, c1, c2] = self.entries[k].c;
            factors.damping[k] = [c0 + c1 / v + c2 * v; LANES];
        }
    }

    /// Sets C at speeds `v`, m/s.
    #[inline(always)]
    pub fn set_speeds<S: Simd>(&self, simd: S, v: &Reals, factors: &mut Factors) {
        let slowness = div(simd, &[1.0; LANES], v);
        for &k in &self.by_speed {
            let [c0, c1, c2] = self.entries[k].c;
            let slow = mul_add(simd, &[c1; LANES], &slowness, &[c0; LANES]);
            factors.damping[k] = mul_add(simd, &[c2; LANES], v, &slow);
        }
    }

    /// Estimate of the largest |s| of an eigenvalue at the speed set in the first lane, rad/s: that of a
    /// single coordinate.
    pub fn fastest(&self, factors: &Factors) -> f64 {
        let massive = self.massive.iter().map(|&k| {
            let (
                Entry {
                    k: stiffness, m, ..
                },
                [c, ..],
            ) = (self.entries[k], factors.damping[k]);
            (c / m).max((stiffness / m).max(0.0).sqrt())
        });
        let massless = self.entries.iter().enumerate().filter_map(|(i, entry)| {
            let c = factors.damping[i][0];
            (entry.row == entry.column && entry.m == 0.0 && c > 0.0).then(|| entry.k / c)
        });
        massive.chain(massless).fold(0.0, f64::max)
    }

    /// Factors D(s) at the speeds set.
    #[inline(always)]
    pub fn factor<S: Simd>(&self, simd: S, s: &Lanes, factors: &mut Factors) {
        let square = s.times(simd, s);
        for &slot in &self.empty {
            factors.a[slot] = Lanes::ZERO;
        }
        for (entry, c) in self.entries.iter().zip(&factors.damping) {
            factors.a[entry.slot] = Lanes {
                re: mul_add(simd, c, &s.re, &[entry.k; LANES]),
                im: mul(simd, c, &s.im),
            };
        }
        for &k in &self.massive {
            let Entry { slot, m, .. } = self.entries[k];
            factors.a[slot] = factors.a[slot].plus_scaled(simd, &[m; LANES], &square);
        }
        let Factors { a, diagonal, .. } = factors;
        factors.sound = self.pattern.factor(simd, a, diagonal);
    }

    /// Coordinates that move when those in `by` do, all as bits.
    pub fn moved(&self, by: CoordinateSet) -> CoordinateSet {
        let (mut moved, mut before) = (by, 0);
        while moved != before {
            before = moved;
            for entry in &self.entries {
                if moved & (1 << entry.column) != 0 {
                    moved |= 1 << entry.row;
                }
            }
        }
        moved
    }

    /// x ← D⁻¹ x, where only coordinates whose bits are set in `moved` move.
    #[inline(always)]
    pub fn solve<S: Simd>(
        &self,
        simd: S,
        factors: &Factors,
        x: &mut [Lanes],
        moved: CoordinateSet,
    ) {
        self.pattern.solve(simd, &factors.a, x, moved);
    }

    /// x ← D⁻ᵀ x.
    #[inline(always)]
    pub fn solve_transposed<S: Simd>(&self, simd: S, factors: &Factors, x: &mut [Lanes]) {
        self.pattern.solve_transposed(simd, &factors.a, x);
    }

    /// Direction of det D in the complex plane, of length about one.
    #[inline(always)]
    pub fn determinant<S: Simd>(&self, simd: S, factors: &Factors) -> Lanes {
        self.pattern.determinant(simd, &factors.a)
    }

    /// Inverse pivots of the factors, each with its coordinate.
    pub fn inverse_pivots<'f>(
        &'f self,
        factors: &'f Factors,
    ) -> impl Iterator<Item = (&'f Lanes, usize)> {
        self.pattern
            .pivots()
            .map(|(slot, coordinate)| (&factors.a[slot], coordinate))
    }

    /// D′ x and D′ᵀ y at the speeds set, with D′ = ∂D/∂s = 2 s M + C(V).
    #[inline(always)]
    pub fn derivative_times<S: Simd>(
        &self,
        simd: S,
        s: &Lanes,
        factors: &Factors,
        [x, y]: [&[Lanes]; 2],
        [dx, dy]: [&mut [Lanes]; 2],
    ) {
        dx.fill(Lanes::ZERO);
        dy.fill(Lanes::ZERO);
        for &k in &self.massive {
            let (Entry { row, m, .. }, c) = (self.entries[k], factors.damping[k]);
            let damping = Lanes {
                re: c,
                im: [0.0; LANES],
            };
            let d = damping.plus_scaled(simd, &[2.0 * m; LANES], s);
            dx[row] = dx[row].plus_product(simd, &d, &x[row]);
            dy[row] = dy[row].plus_product(simd, &d, &y[row]);
        }
        for row in &self.damped {
            let i = self.entries[row[0]].row;
            let mut sum = dx[i];
            for &k in row {
                let (j, c) = (self.entries[k].column, &factors.damping[k]);
                sum = sum.plus_scaled(simd, c, &x[j]);
                dy[j] = dy[j].plus_scaled(simd, c, &y[i]);
            }
            dx[i] = sum;
        }
    }

    /// yᵀ V ∂D/∂V x / s = yᵀ (C2 V − C1/V) x.
    #[inline(always)]
    pub fn by_speed<S: Simd>(&self, simd: S, v: &Reals, x: &[Lanes], y: &[Lanes]) -> Lanes {
        let slowness = div(simd, &[-1.0; LANES], v);
        let mut sum = Lanes::ZERO;
        for &k in &self.by_speed {
            let Entry { row, column, c, .. } = self.entries[k];
            let slow_part = mul(simd, &[c[1]; LANES], &slowness);
            let c = mul_add(simd, &[c[2]; LANES], v, &slow_part);
            sum = sum.plus_scaled(simd, &c, &y[row].times(simd, &x[column]));
        }
        sum
    }
}
