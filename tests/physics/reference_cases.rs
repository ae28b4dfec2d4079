//! Twelve vehicles with results from an independent program.
//!
//! Tolerances: 1e-5 for critical speeds, curves and modes (g differs by 1.5e-6, which acts through
//! the gravitational terms); 1e-4 for RMS values, which that program has from a finite frequency
//! grid.

use crate::support::{assert_ratio, reference_cases};
use bogie::evaluate::Evaluation;
use serde_json::Value;

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

#[test]
fn critical_speeds_and_curves() {
    for (name, case, expected) in reference_cases() {
        let evaluation = Evaluation::new(&case).unwrap();
        let curving = evaluation.curving.unwrap();
        let ours = [
            (
                "critical_speed_m_per_s",
                evaluation.stability.critical_speed(),
            ),
            ("flange_limited_curve_deg", curving.flange.map(|l| l.degree)),
            ("slip_limited_curve_deg", curving.slip.map(|l| l.degree)),
        ];
        for (key, ours) in ours {
            match expected[key].as_f64() {
                Some(theirs) => assert_ratio(&format!("{name} {key}"), ours.unwrap(), theirs, 1e-5),
                None => assert!(ours.is_none(), "{name} {key}"),
            }
        }
    }
}

#[test]
fn modes_at_speed() {
    for (name, case, expected) in reference_cases() {
        let modes = Evaluation::new(&case).unwrap().modes.oscillatory;
        for theirs in expected["modes_at_speed"].as_array().unwrap() {
            let f = theirs["frequency_hz"].as_f64().unwrap();
            let zeta = theirs["damping_ratio"].as_f64().unwrap();
            // A pair this close to critical damping may as well come out as two real roots.
            if zeta > 0.999 {
                continue;
            }
            let nearest = modes
                .iter()
                .map(|m| {
                    (
                        (m.frequency / f - 1.0).abs(),
                        (m.damping_ratio - zeta).abs(),
                    )
                })
                .map(|(f, zeta)| f.max(zeta))
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-5, "{name}: {f} Hz, ζ {zeta}: off by {nearest}");
        }
    }
}

#[test]
fn random_response() {
    for (name, case, expected) in reference_cases() {
        let evaluation = Evaluation::new(&case).unwrap();
        let check = |key: &str, ours: &[f64], theirs: &Value| {
            for (ours, theirs) in ours.iter().zip(numbers(theirs)) {
                assert_ratio(&format!("{name} {key}"), *ours, theirs, 1e-4);
            }
        };
        let lateral = &expected["lateral"];
        assert_eq!(lateral.is_null(), evaluation.lateral.is_err(), "{name}");
        if let Ok(ride) = &evaluation.lateral {
            check(
                "acceleration",
                &ride.acceleration,
                &lateral["acceleration_rms_m_per_s2"],
            );
            check(
                "secondary stroke",
                &ride.secondary_stroke,
                &lateral["secondary_stroke_rms_m"],
            );
            check(
                "primary stroke",
                &ride.primary_stroke,
                &lateral["primary_stroke_rms_m"],
            );
            check(
                "excursion",
                &ride.excursion,
                &lateral["wheelset_excursion_rms_m"],
            );
        }
        let (ride, vertical) = (evaluation.vertical.unwrap(), &expected["vertical"]);
        check(
            "vertical acceleration",
            &ride.acceleration,
            &vertical["acceleration_rms_m_per_s2"],
        );
        check(
            "vertical stroke",
            &ride.secondary_stroke,
            &vertical["secondary_stroke_rms_m"],
        );
    }
}
