//! Operations of an elimination that goes from the wheelsets to the carbody.

use bogie::numerics::LinearSystem;

/// What an elimination works on: entries of the matrix and of its factors.
pub struct Elimination {
    order: f64,
    /// Entries before.
    entries: f64,
    /// Entries left of and above the pivots afterwards.
    lower: f64,
    upper: f64,
    /// a −= l u.
    updates: f64,
}

/// Of complex numbers: a product added to a third, a product, an inverse.
const PRODUCT_ADDED: f64 = 8.0;
const PRODUCT: f64 = 6.0;
const INVERSE: f64 = 6.0;

impl Elimination {
    /// Of the dynamic stiffness of a system, pivots chosen for the least fill (Markowitz 1957).
    pub fn of(system: &LinearSystem) -> Self {
        let n = system.order();
        let filled = |i: usize, j: usize| {
            let mut all = system.damping.iter().chain([&system.stiffness]);
            i == j || all.any(|matrix| matrix[(i, j)] != 0.0)
        };
        let mut rows: Vec<Vec<bool>> = (0..n)
            .map(|i| (0..n).map(|j| filled(i, j)).collect())
            .collect();
        let entries = rows.iter().flatten().filter(|filled| **filled).count();
        let mut rest: Vec<usize> = (0..n).collect();
        let (mut lower, mut upper, mut updates) = (0, 0, 0);
        while !rest.is_empty() {
            let reach = |k: usize| {
                let others = rest.iter().copied().filter(|i| *i != k);
                let below: Vec<usize> = others.clone().filter(|&i| rows[i][k]).collect();
                let right: Vec<usize> = others.filter(|&j| rows[k][j]).collect();
                (k, below, right)
            };
            let pivots = rest.iter().map(|&k| reach(k));
            let Some((k, below, right)) = pivots.min_by_key(|(k, b, r)| (b.len() * r.len(), *k))
            else {
                break;
            };
            lower += below.len();
            upper += right.len();
            updates += below.len() * right.len();
            for i in below {
                for &j in &right {
                    rows[i][j] = true;
                }
            }
            rest.retain(|i| *i != k);
        }
        Self {
            order: n as f64,
            entries: entries as f64,
            lower: lower as f64,
            upper: upper as f64,
            updates: updates as f64,
        }
    }

    /// D(s) from M, C and K, and its factors.
    fn factor(&self) -> f64 {
        3.0 * self.entries
            + 4.0 * self.order
            + INVERSE * self.order
            + PRODUCT * self.lower
            + PRODUCT_ADDED * self.updates
    }

    /// A solution with the factors.
    fn solve(&self) -> f64 {
        PRODUCT_ADDED * (self.lower + self.upper) + PRODUCT * self.order
    }

    /// The response at one frequency to some excitations.
    pub fn response(&self, excitations: usize) -> f64 {
        self.factor() + excitations as f64 * self.solve()
    }

    /// A correction of one of all eigenvalues at once: factors, the pivots' and the distances' product,
    /// and the sum over the others.
    pub fn correction(&self) -> f64 {
        let distances = 2.0 * self.order;
        let sum = distances * (2.0 + INVERSE + PRODUCT_ADDED);
        self.factor() + PRODUCT * self.order + distances * (2.0 + PRODUCT) + sum
    }

    /// A step of two-sided Rayleigh quotient iteration: factors, both solutions, D′ applied to both
    /// vectors, their lengths and products.
    pub fn rayleigh_step(&self) -> f64 {
        let derivative = 4.0 * self.entries + PRODUCT_ADDED * self.order;
        let products = 4.0 * PRODUCT_ADDED * self.order;
        self.factor() + 2.0 * self.solve() + 2.0 * derivative + products
    }
}
