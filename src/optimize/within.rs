//! Designs within a small loss of an optimum: their extent, and the best of them by another aim.
//!
//! ```math
//! minimise  Σ_i (l_i x_i + ½ w_i (x_i − z_i)²)
//! subject to  Σ_{k ∈ G} max_i f_ki(x) ≤ F_G for every goal G,   c_j(x) ≤ 0,   0 ≤ x ≤ 1
//! ```
//!
//! f_ki and c_j are the pieces of a problem ([`super::problem`]). A sum of largest pieces is at most
//! F_G where every sum of one piece of each group is: each of these sums is a smooth constraint.

use super::{
    archive::{Archive, Stop},
    evaluations::Evaluations,
    local::{self, Status},
    problem::{Detail, FEASIBLE, Failure, Key, Piece, Problem, Values, Variable, largest},
};

/// A bound on a sum of objectives.
#[derive(Debug, Clone, PartialEq)]
pub struct Goal {
    /// Numbers of the objectives that are added.
    pub groups: Vec<usize>,
    /// The greatest sum, scaled.
    pub most: f64,
}

/// Secondary objective: linear in the scaled coordinates plus quadratic around a centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Aim {
    /// l.
    pub slopes: Vec<f64>,
    /// w; not negative.
    pub weights: Vec<f64>,
    /// z.
    pub centre: Vec<f64>,
}

impl Aim {
    /// Coordinate `i` of `n` as small as can be.
    pub fn least(i: usize, n: usize) -> Self {
        let mut slopes = vec![0.0; n];
        slopes[i] = 1.0;
        Self {
            slopes,
            weights: vec![0.0; n],
            centre: vec![0.0; n],
        }
    }

    /// Coordinate `i` of `n` as large as can be.
    pub fn greatest(i: usize, n: usize) -> Self {
        let mut aim = Self::least(i, n);
        aim.slopes[i] = -1.0;
        aim
    }

    /// The value at scaled coordinates `x`.
    pub fn at(&self, x: &[f64]) -> f64 {
        let sum = |i: usize| {
            let off = x[i] - self.centre[i];
            self.slopes[i] * x[i] + 0.5 * self.weights[i] * off * off
        };
        (0..x.len()).map(sum).sum()
    }

    fn slope(&self, x: &[f64], i: usize) -> f64 {
        self.slopes[i] + self.weights[i] * (x[i] - self.centre[i])
    }
}

/// Result of a search within the goals.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    /// Its scaled coordinates. It keeps all goals and constraints.
    pub x: Vec<f64>,
    /// True if its first-order conditions hold: no design nearby is better by the aim.
    pub is_optimal: bool,
}

/// The designs of a problem that keep all goals.
pub struct Near<'a> {
    /// The problem.
    pub problem: &'a dyn Problem,
    /// The goals.
    pub goals: &'a [Goal],
    /// Measurements.
    pub archive: &'a Archive<'a>,
}

impl Near<'_> {
    /// The best design by an aim, searched from `start` with its `pinned` coordinates fixed. `None` if no
    /// design that keeps goals and constraints is found.
    ///
    /// # Errors
    ///
    /// [`Stop`] if the run is at its end.
    pub fn best(
        &self,
        aim: &Aim,
        start: &[f64],
        pinned: &[usize],
    ) -> Result<Option<Reached>, Stop> {
        let within = self.within(aim, start, pinned);
        let evaluations = Evaluations::new(&within, self.archive);
        let from = evaluations.graded_at(&within.open(start))?;
        if within.free.is_empty() {
            return Ok(from.feasible().then(|| Reached {
                x: start.to_vec(),
                is_optimal: true,
            }));
        }
        let found = local::search(&evaluations, from, local::WIDE, &[]);
        if let Some(stop) = self.archive.stopped() {
            return Err(stop);
        }
        // A search that ends without its first-order conditions may have passed a better design.
        let best = evaluations.best().filter(|best| {
            !found.point.feasible() || found.status != Status::Optimal && best.feasible()
        });
        let point = best.unwrap_or(found.point);
        Ok(point.feasible().then(|| Reached {
            x: within.whole(&point.x),
            is_optimal: found.status == Status::Optimal,
        }))
    }

    /// True if a design keeps all goals and constraints.
    ///
    /// # Errors
    ///
    /// [`Stop`] if the run is at its end.
    pub fn holds(&self, x: &[f64]) -> Result<bool, Stop> {
        let any = Aim::least(0, x.len());
        let within = self.within(&any, x, &[]);
        let evaluations = Evaluations::new(&within, self.archive);
        Ok(evaluations.graded_at(x)?.feasible())
    }

    fn within<'w>(&'w self, aim: &'w Aim, start: &[f64], pinned: &[usize]) -> Within<'w> {
        let all = self.problem.variables();
        let free: Vec<usize> = (0..all.len()).filter(|i| !pinned.contains(i)).collect();
        Within {
            problem: self.problem,
            goals: self.goals,
            aim,
            variables: free.iter().map(|i| all[*i].clone()).collect(),
            free,
            start: start.to_vec(),
        }
    }
}

/// The problem of an aim within the goals, over the coordinates that are not pinned.
struct Within<'a> {
    problem: &'a dyn Problem,
    goals: &'a [Goal],
    aim: &'a Aim,
    /// Numbers of the coordinates that are free, and their variables.
    free: Vec<usize>,
    variables: Vec<Variable>,
    /// A whole design: the pinned coordinates are its.
    start: Vec<f64>,
}

/// Index of the piece that is coordinate `i` of a design.
fn coordinate(i: usize) -> usize {
    usize::MAX - i
}

/// Distance below the largest sum of pieces at which a sum is left out: no step of a converging search
/// raises it to the top. Each design is judged with its own largest sums.
const IRRELEVANT_BELOW: f64 = 0.1;
/// Largest number of sums kept per goal.
const MOST_SUMS: usize = 64;

impl Within<'_> {
    /// A whole design from its free coordinates.
    fn whole(&self, x: &[f64]) -> Vec<f64> {
        let mut whole = self.start.clone();
        for (i, x) in self.free.iter().zip(x) {
            whole[*i] = *x;
        }
        whole
    }

    /// The free coordinates of a whole design.
    fn open(&self, whole: &[f64]) -> Vec<f64> {
        self.free.iter().map(|i| whole[*i]).collect()
    }

    fn opened(&self, piece: Piece) -> Piece {
        Piece {
            gradient: piece.gradient.map(|whole| self.open(&whole)),
            ..piece
        }
    }

    /// f − F of every sum of pieces that counts for goal number `number`.
    fn sums(&self, number: usize, objectives: &[Vec<Piece>]) -> Vec<Piece> {
        let goal = &self.goals[number];
        let zero = Piece {
            gradient: Some(vec![0.0; self.start.len()]),
            // Values within the tolerance of the search lie on the right side of the bound.
            ..Piece::single(number + 1, FEASIBLE - goal.most)
        };
        let far = if goal.groups.len() > 1 {
            IRRELEVANT_BELOW
        } else {
            f64::INFINITY
        };
        let mut sums = vec![(0.0, zero)];
        for pieces in goal
            .groups
            .iter()
            .filter_map(|group| objectives.get(*group))
        {
            let top = largest(pieces);
            let mut next: Vec<(f64, Piece)> = sums
                .iter()
                .flat_map(|(gap, sum)| pieces.iter().map(move |p| (gap + top - p.value, sum, p)))
                .filter(|(gap, ..)| *gap <= far)
                .map(|(gap, sum, piece)| (gap, added(sum, piece)))
                .collect();
            if goal.groups.len() > 1 {
                next.sort_by(|(a, _), (b, _)| a.total_cmp(b));
                next.truncate(MOST_SUMS);
            }
            sums = next;
        }
        sums.into_iter().map(|(_, sum)| sum).collect()
    }
}

/// A sum of pieces with one more. Its index and label say which pieces they are, at every design.
fn added(sum: &Piece, piece: &Piece) -> Piece {
    /// More than the pieces of one problem.
    const PIECES: usize = 1 << 20;
    let gradients = sum.gradient.as_ref().zip(piece.gradient.as_ref());
    Piece {
        value: sum.value + piece.value,
        index: sum.index.wrapping_mul(PIECES).wrapping_add(piece.index),
        label: sum.label + piece.label,
        gradient: gradients.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a + b).collect()),
    }
}

impl Problem for Within<'_> {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn piece_name(&self, index: usize) -> String {
        self.problem.piece_name(index)
    }

    /// The same for all aims, goals and pins: their searches share what is measured.
    fn key(&self, x: &[f64]) -> Key {
        let key = self.problem.key(&self.whole(x));
        Key {
            what: format!("near {}", key.what),
            at: key.at,
        }
    }

    fn has_gradients(&self) -> bool {
        self.problem.has_gradients()
    }

    fn measure(&self, x: &[f64], detail: Detail) -> Result<Vec<Piece>, Failure> {
        let whole = self.whole(x);
        let mut pieces = self.problem.measure(&whole, detail)?;
        let n = whole.len();
        for (i, x) in whole.into_iter().enumerate() {
            let unit = || (0..n).map(|j| f64::from(u8::from(i == j))).collect();
            pieces.push(Piece {
                gradient: (detail == Detail::Gradients).then(unit),
                ..Piece::single(coordinate(i), x)
            });
        }
        Ok(pieces)
    }

    fn judge(&self, measured: &[Piece]) -> Values {
        let (pieces, coordinates) = measured.split_at(measured.len() - self.start.len());
        let Values {
            objectives,
            constraints,
        } = self.problem.judge(pieces);
        let x: Vec<f64> = coordinates.iter().map(|piece| piece.value).collect();
        let graded = coordinates.iter().all(|piece| piece.gradient.is_some());
        let slopes = || (0..x.len()).map(|i| self.aim.slope(&x, i)).collect();
        let aim = Piece {
            gradient: graded.then(slopes),
            ..Piece::single(0, self.aim.at(&x))
        };
        let sums = (0..self.goals.len()).flat_map(|goal| self.sums(goal, &objectives));
        Values {
            objectives: vec![vec![self.opened(aim)]],
            constraints: constraints
                .into_iter()
                .chain(sums)
                .map(|piece| self.opened(piece))
                .collect(),
        }
    }
}
