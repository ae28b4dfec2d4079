//! RMS values of a response with resonances of any damping: against closed forms, and values from an
//! independent program.

use crate::support::{assert_ratio, numerics};
use bogie::{
    case::Case,
    dynamics::{Excitation, ForcedModel, Output, Row, VerticalModel},
    evaluate::{
        Evaluation,
        ride::{NoRide, VerticalRide, panels::response_panels, response::Response},
    },
    numerics::{LinearSystem, Poles, quadrature::integrate},
    track::Irregularity,
};
use nalgebra::Complex;
use std::f64::consts::TAU;

/// A mass on a spring and damper over the first wheelset.
struct OneMass {
    /// rad/s.
    frequency: f64,
    damping_ratio: f64,
}

impl OneMass {
    /// Its acceleration over the vertical irregularity.
    fn model(&self, case: &Case) -> ForcedModel {
        let mut system = LinearSystem::new(vec![1.0], 4);
        let stretch = Row::unit(0) - Row::unit(1);
        let (k, c) = (
            self.frequency.powi(2),
            2.0 * self.damping_ratio * self.frequency,
        );
        system.add_element(&Row::unit(0), &stretch, k, c);
        let mut model = VerticalModel::new(case).forced;
        model.system = system;
        model.outputs = vec![Output::acceleration(Row::unit(0))];
        model.excitations = vec![Excitation {
            irregularity: Irregularity::Vertical,
            inputs: [1, 2, 3, 4],
            scale: 1.0,
        }];
        model
    }

    /// Mean square of its acceleration over a band, Hz, by partial fractions: with ω₀, ζ, ω_c = Ω_c V,
    ///
    /// ω⁴|H|² S = A V³ Ω_c² ω² (ω₀⁴ + 4ζ²ω₀²ω²) / [(ω² + ω_c²) Π (ω − p)],  p = ±ω₀√(1−ζ²) ± iζω₀
    ///
    /// per rad/s, of which each simple pole gives its residue times ln (b − p)/(a − p).
    fn mean_square(&self, [a, b]: [f64; 2], [amplitude, corner, speed]: [f64; 3]) -> f64 {
        let (w, z) = (self.frequency, self.damping_ratio);
        let own = [1.0, -1.0].map(|sign| {
            let real = sign * w * (1.0 - z * z).sqrt();
            [Complex::new(real, z * w), Complex::new(real, -z * w)]
        });
        let wc = corner * speed;
        let of_track = [Complex::new(0.0, wc), Complex::new(0.0, -wc)];
        let poles: Vec<Complex<f64>> = own.into_iter().flatten().chain(of_track).collect();
        let above = |x: Complex<f64>| {
            let x2 = x * x;
            x2 * (x2 * (4.0 * z * z * w * w) + w.powi(4))
                * (amplitude * corner.powi(2) * speed.powi(3))
        };
        let terms = poles.iter().enumerate().map(|(i, &p)| {
            let others = poles.iter().enumerate().filter(|(j, _)| *j != i);
            let below: Complex<f64> = others.map(|(_, q)| p - q).product();
            // The principal branches of b − p and a − p: a straight way between passes no cut.
            above(p) / below
                * ((Complex::from(b * TAU) - p).ln() - (Complex::from(a * TAU) - p).ln())
        });
        terms.sum::<Complex<f64>>().re
    }
}

/// To 1e-6, the tolerance of the integration, and three roundings of the stiffness over the width of
/// the peak.
#[test]
fn one_mass_of_any_damping() {
    let case = Case::prototype();
    let speed = case.service.speed;
    // Class 6 (3.4.2-2): A = 0.00159 in² rad/ft, Ω_c = 2π/25 rad/ft.
    let foot = 0.3048;
    let track = [
        0.00159 * 0.0254_f64.powi(2) / foot,
        TAU / (25.0 * foot),
        speed,
    ];
    for exponent in 1..=9 {
        for hertz in [0.7, 7.1, 31.0] {
            let mass = OneMass {
                frequency: TAU * hertz,
                damping_ratio: 10_f64.powi(-exponent),
            };
            let model = mass.model(&case);
            let poles = Poles::at(&model, speed).unwrap();
            let edges = response_panels(&model, &case, &poles);
            let mut response = Response::new(&model, &case.service.track, speed);
            let found = integrate(&edges, [1, 1], 1e-6, |f, v| response.densities(f, v));
            assert!(found.converged);
            let exact = mass.mean_square(case.model.frequency_band, track);
            let tolerance = 1e-6 + 3.0 * f64::EPSILON / mass.damping_ratio;
            let what = format!("{hertz} Hz, damping ratio {}", mass.damping_ratio);
            assert_ratio(&what, found.total(0), exact, tolerance);
            // Walking towards the pole costs few panels.
            assert!(edges.len() < 80, "{what}: {} panels", edges.len());
        }
    }
}

/// Values of an independent program, noted to five digits.
#[test]
fn hardly_damped_carbodies() {
    let undamped = Evaluation::new(&numerics("undamped-bending-missed").case).unwrap();
    let ride = undamped.vertical.as_ref().unwrap();
    assert_ratio("c.g.", ride.acceleration[0], 0.26743, 2e-5);
    let random = Evaluation::new(&numerics("lightly-damped-random-26").case).unwrap();
    let ride = random.vertical.as_ref().unwrap();
    assert_ratio("front point", ride.acceleration[1], 11.026, 5e-5);
    for evaluation in [&undamped, &random] {
        let ride = evaluation.vertical.as_ref().unwrap();
        let passengers = evaluation.vertical_passengers.as_ref().unwrap();
        for (passenger, acceleration) in passengers.iter().zip(ride.acceleration) {
            // The same integral over other panels, each good to 1e-6.
            assert_ratio("passenger", passenger.acceleration, acceleration, 2e-6);
        }
    }
}

/// One-third-octave bands that are adjoining and cover the whole range add up to it, whatever resonances
/// there are.
#[test]
fn bands_add_up() {
    for name in ["undamped-bending-missed", "lightly-damped-random-26"] {
        let mut case = numerics(name).case;
        // From the lower edge of the 0.5 Hz band to the upper one of the 40 Hz band.
        case.model.frequency_band = [10_f64.powf(-0.35), 10_f64.powf(1.65)];
        let evaluation = Evaluation::new(&case).unwrap();
        for passenger in evaluation.vertical_passengers.unwrap() {
            let squares = passenger.bands.iter().map(|band| band.acceleration.powi(2));
            let whole = squares.sum::<f64>().sqrt();
            // Sums of the same integrals over the same panels.
            assert_ratio(name, whole, passenger.acceleration, 1e-12);
        }
    }
}

/// Each panel halved and the tolerance a hundred thousandth: mean squares stay within the tolerance.
#[test]
fn halved_panels_change_nothing() {
    for name in ["undamped-bending-missed", "lightly-damped-random-26"] {
        let case = numerics(name).case;
        let model = VerticalModel::new(&case).forced;
        let speed = case.service.speed;
        let edges = response_panels(&model, &case, &Poles::at(&model, speed).unwrap());
        let mut halved = edges.clone();
        halved.extend(edges.windows(2).map(|ends| f64::midpoint(ends[0], ends[1])));
        halved.sort_by(f64::total_cmp);
        let outputs = model.outputs.len();
        let [coarse, fine] = [(edges, 1e-6), (halved, 1e-11)].map(|(edges, tolerance)| {
            let mut response = Response::new(&model, &case.service.track, speed);
            integrate(&edges, [outputs; 2], tolerance, |f, v| {
                response.densities(f, v);
            })
        });
        assert!(coarse.converged);
        for k in 0..outputs {
            assert_ratio(name, coarse.total(k), fine.total(k), 1e-6);
        }
    }
}

/// A carbody whose first bending mode has its nodes nearer and nearer to the secondary springs: these damp
/// it less and less, and excite it less, so that its part of the response stays. Where rounding decides
/// what damping is left the status says so.
#[test]
fn what_rounding_decides_has_no_number() {
    let mut case = numerics("undamped-bending-missed").case;
    // The length at which w = 0 at the trucks: the mode of a free beam has its nodes at 0.224157 of it.
    let node = nodes();
    let l_s = case.vehicle.carbody.half_truck_spacing;
    let (mut converged, mut refused) = (0, 0);
    let mut last: Option<f64> = None;
    for halves in 0..32 {
        let off = 1e-3 * 10_f64.powf(-0.5 * f64::from(halves));
        case.vehicle.carbody.length = l_s / node * (1.0 + off);
        let model = VerticalModel::new(&case);
        match VerticalRide::new(&model, &case) {
            Ok(ride) => {
                assert_eq!(refused, 0, "no number once rounding decides");
                let rms = ride.acceleration[0];
                if let Some(last) = last {
                    // The rest of the response moves with the length.
                    assert_ratio("c.g.", rms, last, 20.0 * off + 1e-4);
                }
                last = Some(rms);
                converged += 1;
            }
            Err(reason) => {
                assert_eq!(reason, NoRide::NotConverged, "{off}");
                refused += 1;
            }
        }
    }
    assert!(converged >= 4 && refused >= 4, "{converged} {refused}");
}

/// Where the first bending mode of a free beam has its nodes, from the middle over the length.
fn nodes() -> f64 {
    let beta = 4.730_040_744_862_704_f64;
    let shape =
        |x: f64| (beta * x).cosh() / (beta / 2.0).cosh() + (beta * x).cos() / (beta / 2.0).cos();
    let (mut low, mut high) = (0.2, 0.35);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if (shape(middle) > 0.0) == (shape(low) > 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
