//! Response of a forced model to the irregularities of the track, frequency by frequency.
//!
//! ```math
//! D(iω) q = −(iω C_u + K_u) Σᵢ uᵢ e^{−iωτᵢ},   D = −ω² M + iω C + K
//! ```
//!
//! Input reaches wheelset i delayed by its distance behind the first wheelset over V, exactly.

use std::f64::consts::TAU;

use faer::{
    Mat, Par, Spec,
    dyn_stack::{MemBuffer, MemStack},
    linalg::lu::partial_pivoting::{factor, solve},
};
use nalgebra::{Complex, DMatrix};

use crate::{dynamics::ForcedModel, track::Track};

/// A forced model at one speed, ready to be evaluated at many frequencies without allocation.
///
/// Coordinates that nothing couples are solved apart: bounce and pitch of the vertical model know
/// nothing of roll.
pub struct Response<'a> {
    model: &'a ForcedModel,
    track: &'a Track,
    speed: f64,
    /// C at the speed, over [q, u].
    damping: DMatrix<f64>,
    blocks: Vec<Block>,
    /// q of each excitation for unit irregularity, n per excitation.
    q: Vec<Complex<f64>>,
    /// u likewise.
    u: Vec<Complex<f64>>,
}

/// Coordinates that are coupled with one another, and the excitations that reach them.
struct Block {
    coordinates: Vec<usize>,
    excitations: Vec<usize>,
    lu: Mat<Complex<f64>>,
    /// One right-hand side per excitation.
    q: Mat<Complex<f64>>,
    permutation: [Vec<usize>; 2],
    scratch: MemBuffer,
}

impl Block {
    fn new(coordinates: Vec<usize>, excitations: Vec<usize>) -> Self {
        let (n, m) = (coordinates.len(), excitations.len());
        let scratch =
            factor::lu_in_place_scratch::<usize, Complex<f64>>(n, n, Par::Seq, Spec::default()).or(
                solve::solve_in_place_scratch::<usize, Complex<f64>>(n, m, Par::Seq),
            );
        Self {
            coordinates,
            excitations,
            lu: Mat::zeros(n, n),
            q: Mat::zeros(n, m),
            permutation: [vec![0; n], vec![0; n]],
            scratch: MemBuffer::new(scratch),
        }
    }

    fn solve(&mut self) {
        let stack = MemStack::new(&mut self.scratch);
        let [forward, backward] = &mut self.permutation;
        let (_, permutation) = factor::lu_in_place(
            self.lu.as_mut(),
            forward,
            backward,
            Par::Seq,
            stack,
            Spec::default(),
        );
        let lu = self.lu.as_ref();
        solve::solve_in_place(lu, lu, permutation, self.q.as_mut(), Par::Seq, stack);
    }
}

/// Groups of coordinates that K or C couple.
fn coupled(stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) -> Vec<Vec<usize>> {
    let n = stiffness.nrows();
    let couples = |i: usize, j: usize| stiffness[(i, j)] != 0.0 || damping[(i, j)] != 0.0;
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for i in 0..n {
        let (joined, mut apart): (Vec<_>, Vec<_>) = groups
            .into_iter()
            .partition(|group| group.iter().any(|&j| couples(i, j) || couples(j, i)));
        let mut group: Vec<usize> = joined.into_iter().flatten().chain([i]).collect();
        group.sort_unstable();
        apart.push(group);
        groups = apart;
    }
    groups
}

impl<'a> Response<'a> {
    /// The model on a track at `speed`, m/s.
    pub fn new(model: &'a ForcedModel, track: &'a Track, speed: f64) -> Self {
        let system = &model.system;
        let damping = system.damping_at(speed);
        let reached = |group: &[usize], inputs: &[usize; 4]| {
            group.iter().any(|&i| {
                inputs
                    .iter()
                    .any(|&j| system.stiffness[(i, j)] != 0.0 || damping[(i, j)] != 0.0)
            })
        };
        let blocks = coupled(&system.stiffness, &damping)
            .into_iter()
            .map(|group| {
                let excitations = (0..model.excitations.len())
                    .filter(|&p| reached(&group, &model.excitations[p].inputs))
                    .collect();
                Block::new(group, excitations)
            })
            .collect();
        Self {
            model,
            track,
            speed,
            blocks,
            q: vec![Complex::ZERO; system.order() * model.excitations.len()],
            u: vec![Complex::ZERO; system.inputs * model.excitations.len()],
            damping,
        }
    }

    /// Power spectral density of every output at frequency `f` in Hz, one-sided, per Hz.
    pub fn densities(&mut self, f: f64, densities: &mut [f64]) {
        let omega = TAU * f;
        self.solve(omega);
        densities.fill(0.0);
        for (p, excitation) in self.model.excitations.iter().enumerate() {
            // S in time frequency: S(Ω) dΩ/df with Ω = 2πf/V (3.4.2-5, 6).
            let input = self
                .track
                .spectrum(excitation.irregularity)
                .density(omega / self.speed)
                * TAU
                / self.speed;
            for (k, density) in densities.iter_mut().enumerate() {
                *density += self.transfer(k, p, omega).norm_sqr() * input;
            }
        }
    }

    /// Transfer function from excitation `p` to output `k` at the frequency solved last.
    fn transfer(&self, k: usize, p: usize, omega: f64) -> Complex<f64> {
        let n = self.model.system.order();
        let inputs = self.model.system.inputs;
        let sum = |row: &crate::dynamics::Row| -> Complex<f64> {
            row.terms()
                .iter()
                .map(|&(i, c)| {
                    let x = if i < n {
                        self.q[p * n + i]
                    } else {
                        self.u[p * inputs + i - n]
                    };
                    x * c
                })
                .sum()
        };
        let output = &self.model.outputs[k];
        sum(&output.displacement) + sum(&output.velocity) * Complex::new(0.0, omega)
            - sum(&output.acceleration) * (omega * omega)
    }

    /// Fills q and u for angular frequency ω.
    fn solve(&mut self, omega: f64) {
        let system = &self.model.system;
        let n = system.order();
        let entry = |i: usize, j: usize| {
            Complex::new(system.stiffness[(i, j)], omega * self.damping[(i, j)])
        };
        for (p, excitation) in self.model.excitations.iter().enumerate() {
            for (&input, &lag) in excitation.inputs.iter().zip(&self.model.lags) {
                self.u[p * system.inputs + input - n] =
                    Complex::from_polar(excitation.scale, -omega * lag / self.speed);
            }
        }
        for block in &mut self.blocks {
            for (col, &j) in block.coordinates.iter().enumerate() {
                for (row, &i) in block.coordinates.iter().enumerate() {
                    block.lu[(row, col)] = entry(i, j);
                }
                block.lu[(col, col)].re -= omega * omega * system.mass[j];
            }
            for (column, &p) in block.excitations.iter().enumerate() {
                for (row, &i) in block.coordinates.iter().enumerate() {
                    block.q[(row, column)] = -self.model.excitations[p]
                        .inputs
                        .iter()
                        .map(|&j| entry(i, j) * self.u[p * system.inputs + j - n])
                        .sum::<Complex<f64>>();
                }
            }
            block.solve();
            for (column, &p) in block.excitations.iter().enumerate() {
                for (row, &i) in block.coordinates.iter().enumerate() {
                    self.q[p * n + i] = block.q[(row, column)];
                }
            }
        }
    }
}
