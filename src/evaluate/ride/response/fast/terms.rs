//! Forces and outputs of an excitation, gathered term by term.

use std::ops::Range;

use pulp::Simd;

use crate::{
    dynamics::{Excitation, ForcedModel, Output, Row, SystemTangent},
    numerics::{
        LinearSystem,
        elimination::{
            CoordinateSet, LANES, Lanes, Reals,
            lanes::{mul, neg},
        },
    },
};

/// −(K_u + iω C_u) per unit of irregularity at one wheelset, on one coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Force {
    pub coordinate: usize,
    pub wheelset: usize,
    pub k: f64,
    pub c: f64,
}

/// All forces of an excitation at a speed, m/s.
pub(super) fn forces(system: &LinearSystem, excitation: &Excitation, speed: f64) -> Vec<Force> {
    let [c0, c1, c2] = &system.damping;
    let mut forces = Vec::new();
    for coordinate in 0..system.order() {
        for (wheelset, &j) in excitation.inputs.iter().enumerate() {
            let at = (coordinate, j);
            let k = -excitation.scale * system.stiffness[at];
            let c = -excitation.scale * (c0[at] + c1[at] / speed + c2[at] * speed);
            if k != 0.0 || c != 0.0 {
                forces.push(Force {
                    coordinate,
                    wheelset,
                    k,
                    c,
                });
            }
        }
    }
    forces
}

/// −(∂K + iω ∂C − ω² ∂M) on one coordinate, per unit of another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coupling {
    pub row: usize,
    pub column: usize,
    pub k: f64,
    pub c: f64,
    pub m: f64,
}

/// Terms of a tangent of the system on the right side, at a speed, m/s: forces of the irregularity of an
/// excitation, and couplings between the coordinates.
pub(super) fn tangents(
    tangent: &SystemTangent,
    order: usize,
    excitation: &Excitation,
    speed: f64,
) -> (Vec<Force>, Vec<Coupling>) {
    let (mut forces, mut couplings) = (Vec::new(), Vec::new());
    for entry in &tangent.entries {
        let (k, c) = (-entry.k, -entry.damping_at(speed));
        if entry.column < order {
            couplings.push(Coupling {
                row: entry.row,
                column: entry.column,
                k,
                c,
                m: -entry.m,
            });
        } else if let Some(wheelset) = excitation.inputs.iter().position(|&j| j == entry.column) {
            forces.push(Force {
                coordinate: entry.row,
                wheelset,
                k: excitation.scale * k,
                c: excitation.scale * c,
            });
        }
    }
    (forces, couplings)
}

/// Source of a term of an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Source {
    /// A coordinate.
    Coordinate(usize),
    /// The irregularity at a wheelset.
    Wheelset(usize),
}

/// An output in terms of one excitation's response.
#[derive(Debug, Clone, Default)]
pub(super) struct OutputTerms {
    displacement: Vec<(Source, f64)>,
    velocity: Vec<(Source, f64)>,
    acceleration: Vec<(Source, f64)>,
}

/// Coordinates on which forces act, as bits.
pub(super) fn coordinates(forces: &[Force]) -> CoordinateSet {
    forces
        .iter()
        .fold(0, |all, force| all | 1 << force.coordinate)
}

/// Some outputs of a model of which only some coordinates are moved.
pub(super) fn outputs(
    model: &ForcedModel,
    excitation: &Excitation,
    range: Range<usize>,
    moved: CoordinateSet,
) -> Vec<OutputTerms> {
    let n = model.system.order();
    let outputs = model.outputs[range].iter();
    outputs
        .map(|output| OutputTerms::new(output, excitation, n, moved))
        .collect()
}

impl OutputTerms {
    /// Terms of an output of a model with `n` coordinates, of which only some are moved.
    pub fn new(output: &Output, excitation: &Excitation, n: usize, moved: CoordinateSet) -> Self {
        let terms = |row: &Row| {
            let mut terms: Vec<(Source, f64)> = Vec::with_capacity(row.terms().len());
            for &(i, c) in row.terms() {
                let (source, c) = if i < n {
                    if moved & (1 << i) == 0 {
                        continue;
                    }
                    (Source::Coordinate(i), c)
                } else {
                    let Some(wheelset) = excitation.inputs.iter().position(|&j| j == i) else {
                        continue;
                    };
                    (Source::Wheelset(wheelset), c * excitation.scale)
                };
                match terms.iter_mut().find(|(s, _)| *s == source) {
                    Some((_, sum)) => *sum += c,
                    None => terms.push((source, c)),
                }
            }
            terms
        };
        Self {
            displacement: terms(&output.displacement),
            velocity: terms(&output.velocity),
            acceleration: terms(&output.acceleration),
        }
    }
}

#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
impl OutputTerms {
    /// p·x + iω v·x − ω² a·x, of a response x.
    #[inline(always)]
    pub fn transfer<S: Simd>(&self, simd: S, omega: &Reals, x: Moving<'_>) -> Lanes {
        let mut transfer = sum(simd, &self.displacement, x);
        if !self.velocity.is_empty() {
            let rate = Lanes {
                re: [0.0; LANES],
                im: *omega,
            };
            transfer = transfer.plus_product(simd, &rate, &sum(simd, &self.velocity, x));
        }
        if !self.acceleration.is_empty() {
            let square = mul(simd, &neg(simd, omega), omega);
            transfer = transfer.plus_scaled(simd, &square, &sum(simd, &self.acceleration, x));
        }
        transfer
    }
}

/// Motion of the coordinates, and of the rails under the wheelsets.
#[derive(Clone, Copy)]
pub(super) struct Moving<'x> {
    pub coordinates: &'x [Lanes],
    pub rails: &'x [Lanes; 4],
}

#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
#[inline(always)]
fn sum<S: Simd>(simd: S, terms: &[(Source, f64)], x: Moving<'_>) -> Lanes {
    let mut sum = Lanes::ZERO;
    for &(source, c) in terms {
        let value = match source {
            Source::Coordinate(i) => &x.coordinates[i],
            Source::Wheelset(i) => &x.rails[i],
        };
        sum = sum.plus_scaled(simd, &[c; LANES], value);
    }
    sum
}
