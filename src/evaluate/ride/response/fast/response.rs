//! Spectral densities of a response and their derivatives, several frequencies side by side.

use std::{f64::consts::TAU, ops::Range};

use pulp::{Arch, Simd, WithSimd};

use super::{
    super::plain,
    terms::{self, Coupling, Force, Moving, OutputTerms},
};
use crate::{
    dynamics::{ForcedModel, ForcedTangent},
    numerics::elimination::{
        ALL, CoordinateSet, Factors, LANES, Lanes, Reals, Stiffness,
        lanes::{add, mul, mul_add},
    },
    track::Track,
};

/// A forced model at one speed, ready to be evaluated at many frequencies, [`LANES`] at a time,
/// without allocation.
pub struct Response<'a> {
    model: &'a ForcedModel,
    track: &'a Track,
    speed: f64,
    /// Whether wheelset 4 is as far behind 3 as 2 behind 1.
    is_regular: bool,
    outputs: Range<usize>,
    arch: Arch,
    stiffness: &'a Stiffness,
    factors: Factors,
    excitations: Vec<Excited>,
}

/// One excitation: its forces on the coordinates, the outputs, and the response.
struct Excited {
    forces: Vec<Force>,
    /// Coordinates that it moves, as bits: in a symmetric model not all.
    moved: CoordinateSet,
    outputs: Vec<OutputTerms>,
    q: Vec<Lanes>,
    /// Changes by each design constant; `None`: no change.
    tangents: Vec<Option<Tangent>>,
    /// Derivative of q, and the outputs.
    dq: Vec<Lanes>,
    transfers: Vec<Lanes>,
}

/// Changes by a design constant in the response to an excitation.
struct Tangent {
    forces: Vec<Force>,
    couplings: Vec<Coupling>,
    outputs: Vec<Option<OutputTerms>>,
    rails: Option<RailsTangent>,
}

/// Change of the input at each wheelset, relative: scale − iω lag, the lag in s.
struct RailsTangent {
    scale: f64,
    lags: [f64; 4],
}

impl Tangent {
    /// Coordinates on which it acts, as bits, where some are moved.
    fn coordinates(&self, moved: CoordinateSet) -> CoordinateSet {
        let couplings = self.couplings.iter();
        couplings
            .filter(|coupling| moved & (1 << coupling.column) != 0)
            .fold(terms::coordinates(&self.forces), |all, coupling| {
                all | 1 << coupling.row
            })
    }

    fn is_zero(&self) -> bool {
        let none = self.forces.is_empty() && self.couplings.is_empty() && self.rails.is_none();
        none && self.outputs.iter().all(Option::is_none)
    }
}

impl<'a> Response<'a> {
    /// All outputs of the model on a track at `speed`, m/s.
    pub fn new(model: &'a ForcedModel, track: &'a Track, speed: f64) -> Self {
        Self::of(model, track, speed, 0..model.outputs.len())
    }

    /// Some of its outputs.
    pub fn of(model: &'a ForcedModel, track: &'a Track, speed: f64, outputs: Range<usize>) -> Self {
        let system = &model.system;
        let stiffness = model.stiffness();
        let mut factors = stiffness.factors();
        stiffness.set_speed(speed, &mut factors);
        let excitations = model.excitations.iter().map(|excitation| {
            let forces = terms::forces(system, excitation, speed);
            let moved = stiffness.moved(terms::coordinates(&forces));
            Excited {
                outputs: terms::outputs(model, excitation, outputs.clone(), moved),
                forces,
                moved,
                q: vec![Lanes::ZERO; system.order()],
                tangents: Vec::new(),
                dq: vec![Lanes::ZERO; system.order()],
                transfers: vec![Lanes::ZERO; outputs.len()],
            }
        });
        Self {
            excitations: excitations.collect(),
            factors,
            arch: Arch::new(),
            stiffness,
            is_regular: is_regular(&model.lags),
            model,
            track,
            speed,
            outputs,
        }
    }

    /// Adds the derivatives of all densities by design constants.
    #[must_use]
    pub fn with_tangents(mut self, tangents: &[ForcedTangent]) -> Self {
        let order = self.model.system.order();
        let pairs = self.excitations.iter_mut().zip(&self.model.excitations);
        for (number, (excited, excitation)) in pairs.enumerate() {
            let of = |tangent: &ForcedTangent| {
                let (scale, lags) = (tangent.scales[number], tangent.lags);
                let moves = scale != 0.0 || lags.iter().any(|lag| *lag != 0.0);
                let (forces, couplings) =
                    terms::tangents(&tangent.system, order, excitation, self.speed);
                let outputs = tangent.outputs[self.outputs.clone()].iter();
                let terms = |output| OutputTerms::new(output, excitation, order, ALL);
                let tangent = Tangent {
                    forces,
                    couplings,
                    outputs: outputs.map(|output| output.as_ref().map(terms)).collect(),
                    rails: moves.then(|| RailsTangent {
                        scale,
                        lags: lags.map(|lag| lag / self.speed),
                    }),
                };
                (!tangent.is_zero()).then_some(tangent)
            };
            excited.tangents = tangents.iter().map(of).collect();
            // A change that breaks the symmetry moves more.
            let tangents = excited.tangents.iter().flatten();
            let by = tangents.map(|tangent| tangent.coordinates(excited.moved));
            let by = by.fold(excited.moved, |all, some| all | some);
            if by != excited.moved {
                excited.moved = self.stiffness.moved(by);
                let range = self.outputs.clone();
                excited.outputs = terms::outputs(self.model, excitation, range, excited.moved);
            }
        }
        self
    }

    /// Number of design constants by which it is differentiated.
    pub fn constants(&self) -> usize {
        let tangents = self.excitations.first().map(|excited| &excited.tangents);
        tangents.map_or(0, Vec::len)
    }

    /// The model.
    pub fn model(&self) -> &'a ForcedModel {
        self.model
    }

    /// Range of the model's outputs.
    pub fn range(&self) -> Range<usize> {
        self.outputs.clone()
    }

    /// Number of its outputs.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Power spectral densities of the outputs at frequencies `f` in Hz, one-sided, per Hz.
    pub fn densities(&mut self, f: &Reals, densities: &mut [Reals]) {
        self.with_derivatives(f, densities, &mut []);
    }

    /// As [`Response::densities`], with the derivatives of all of them by the first design constant, by
    /// the second, and so on; as many as there is room for.
    pub fn with_derivatives(
        &mut self,
        f: &Reals,
        densities: &mut [Reals],
        derivatives: &mut [Reals],
    ) {
        let arch = self.arch;
        arch.dispatch(Batch {
            response: self,
            f,
            densities,
            derivatives,
        });
        if self.factors.sound != [true; LANES] {
            self.mend(f, densities);
        }
    }

    /// Replaces the densities at frequencies at which the elimination lost digits by the plain ones;
    /// derivatives stay.
    #[cold]
    fn mend(&self, f: &Reals, densities: &mut [Reals]) {
        let mut plain = vec![0.0; self.model.outputs.len()];
        for l in (0..LANES).filter(|&l| !self.factors.sound[l]) {
            plain::densities(self.model, self.track, self.speed, f[l], &mut plain);
            let outputs = plain[self.outputs.clone()].iter();
            for (density, value) in densities.iter_mut().zip(outputs) {
                density[l] = *value;
            }
        }
    }
}

struct Batch<'r, 'a> {
    response: &'r mut Response<'a>,
    f: &'r Reals,
    densities: &'r mut [Reals],
    derivatives: &'r mut [Reals],
}

impl WithSimd for Batch<'_, '_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Response {
            model,
            track,
            speed,
            is_regular,
            stiffness,
            factors,
            excitations,
            ..
        } = self.response;
        let omega = self.f.map(|f| TAU * f);
        let s = Lanes {
            re: [0.0; LANES],
            im: omega,
        };
        stiffness.factor(simd, &s, factors);
        let phases = phases(simd, &omega, &model.lags, *speed, *is_regular);
        self.densities.fill([0.0; LANES]);
        self.derivatives.fill([0.0; LANES]);
        for (excited, excitation) in excitations.iter_mut().zip(&model.excitations) {
            let Excited {
                forces,
                moved,
                outputs,
                q,
                tangents,
                dq,
                transfers,
            } = excited;
            q.fill(Lanes::ZERO);
            add_forces(simd, q, forces, &omega, &phases);
            stiffness.solve(simd, factors, q, *moved);
            // S in time frequency: S(Ω) dΩ/df with Ω = 2πf/V (3.4.2-5, 6).
            let spectrum = track.spectrum(excitation.irregularity);
            let input = omega.map(|omega| spectrum.density(omega / *speed) * TAU / *speed);
            let x = Moving {
                coordinates: q,
                rails: &phases,
            };
            let all = transfers.iter_mut().zip(outputs.iter());
            for (density, (kept, output)) in self.densities.iter_mut().zip(all) {
                let transfer = output.transfer(simd, &omega, x);
                *kept = transfer;
                *density = mul_add(simd, &transfer.norm_sqr(simd), &input, density);
            }
            let derivatives = self.derivatives.chunks_exact_mut(outputs.len());
            for (tangent, derivatives) in tangents.iter().zip(derivatives) {
                let Some(tangent) = tangent else {
                    continue;
                };
                // D ∂q = −∂D q − (iω ∂C_u + ∂K_u) u
                dq.fill(Lanes::ZERO);
                add_forces(simd, dq, &tangent.forces, &omega, &phases);
                for coupling in &tangent.couplings {
                    let mut transmitted = transmitted(simd, coupling.k, coupling.c, &omega);
                    if coupling.m != 0.0 {
                        let square = mul(simd, &omega, &omega);
                        let inertia = mul(simd, &square, &[-coupling.m; LANES]);
                        transmitted.re = add(simd, &transmitted.re, &inertia);
                    }
                    let (row, from) = (coupling.row, &q[coupling.column]);
                    dq[row] = dq[row].plus_product(simd, &transmitted, from);
                }
                let mut rails = [Lanes::ZERO; 4];
                if let Some(tangent) = &tangent.rails {
                    for (rail, (phase, lag)) in
                        rails.iter_mut().zip(phases.iter().zip(tangent.lags))
                    {
                        let change = transmitted(simd, tangent.scale, -lag, &omega);
                        *rail = change.times(simd, phase);
                    }
                    add_forces(simd, dq, forces, &omega, &rails);
                }
                stiffness.solve(simd, factors, dq, *moved);
                let dx = Moving {
                    coordinates: dq,
                    rails: &rails,
                };
                for (k, sum) in derivatives.iter_mut().enumerate() {
                    let mut change = outputs[k].transfer(simd, &omega, dx);
                    if let Some(output) = &tangent.outputs[k] {
                        let own = output.transfer(simd, &omega, x);
                        change = change.plus_scaled(simd, &[1.0; LANES], &own);
                    }
                    // ∂|H|² = 2 Re(H̄ ∂H)
                    let h = &transfers[k];
                    let product = mul(simd, &h.re, &change.re);
                    let product = mul_add(simd, &h.im, &change.im, &product);
                    *sum = mul_add(simd, &mul(simd, &[2.0; LANES], &input), &product, sum);
                }
            }
        }
    }
}

/// k + iω c.
#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
#[inline(always)]
fn transmitted<S: Simd>(simd: S, k: f64, c: f64, omega: &Reals) -> Lanes {
    Lanes {
        re: [k; LANES],
        im: mul(simd, omega, &[c; LANES]),
    }
}

/// Adds the forces of the irregularity under the wheelsets on the coordinates.
#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
#[inline(always)]
fn add_forces<S: Simd>(
    simd: S,
    q: &mut [Lanes],
    forces: &[Force],
    omega: &Reals,
    phases: &[Lanes; 4],
) {
    for force in forces {
        let transmitted = transmitted(simd, force.k, force.c, omega);
        let q = &mut q[force.coordinate];
        *q = q.plus_product(simd, &transmitted, &phases[force.wheelset]);
    }
}

/// Share of the longest distance by which distances between wheelsets may differ and yet be the same.
const SAME_DISTANCE: f64 = 1e-12;

/// Whether wheelset 4 is as far behind 3 as 2 behind 1.
fn is_regular(lags: &[f64; 4]) -> bool {
    let [leading, trailing] = [lags[1] - lags[0], lags[3] - lags[2]];
    (leading - trailing).abs() <= SAME_DISTANCE * lags[3].abs()
}

/// e^{−iωτ} of the four wheelsets; of regular ones two directions are enough.
#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
#[inline(always)]
fn phases<S: Simd>(
    simd: S,
    omega: &Reals,
    lags: &[f64; 4],
    speed: f64,
    is_regular: bool,
) -> [Lanes; 4] {
    // A closure around the whole would be compiled on its own, without the vector unit.
    let angle = |lag: f64| mul(simd, omega, &[-lag / speed; LANES]);
    let wheelbase = Lanes::on_unit_circle(simd, &angle(lags[1] - lags[0]));
    let trucks = Lanes::on_unit_circle(simd, &angle(lags[2] - lags[0]));
    let trailing = if is_regular {
        wheelbase
    } else {
        Lanes::on_unit_circle(simd, &angle(lags[3] - lags[2]))
    };
    [Lanes::ONE, wheelbase, trucks, trucks.times(simd, &trailing)]
}
