//! Secondary suspensions that no truck has in this form, by their natural frequency and damping ratio
//! (4.6-8, 9, 14, 15).

use super::natural_frequencies::secondary_damping_ratio;
use crate::vehicle::Vehicle;

/// Damping ratios of the carbody on its secondary suspension outside which something is amiss: the
/// report looks at 0.1 to 0.6 (4.3, 4.4).
const DAMPING_RATIO: [f64; 2] = [0.05, 1.0];

/// Static deflection beyond what coil springs of a passenger truck have, m. The prototype's springs
/// settle by 0.32 m (0.89 Hz); at 0.7 Hz, the lowest that the report looks at, it is 0.51 m.
const COIL_DEFLECTION: f64 = 0.35;

/// Direction of a secondary suspension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// K_sy and C_sy.
    Lateral,
    /// K_sz and C_sz.
    Vertical,
}

/// An odd value, with its remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Oddity {
    /// Which springs and dampers.
    pub direction: Direction,
    /// The oddity, in words.
    pub message: String,
    /// Why, or what to do.
    pub advice: &'static str,
}

/// Oddities of the secondary suspension of a vehicle.
pub fn secondary_oddities(vehicle: &Vehicle) -> Vec<Oddity> {
    let mass = vehicle.carbody.mass;
    let s = &vehicle.suspension.secondary;
    let mut list = Vec::new();
    let mut odd = |direction, message, advice| {
        list.push(Oddity {
            direction,
            message,
            advice,
        });
    };
    let mut damping = |direction, name: &str, k: f64, c: f64| {
        let ratio = secondary_damping_ratio(mass, k, c);
        let what = format!("the damping ratio of the secondary {name} suspension is");
        if ratio > DAMPING_RATIO[1] {
            let advice = "above 1 the dampers hold carbody and trucks together rather than apart";
            odd(direction, format!("{what} {ratio:.2}"), advice);
        } else if ratio < DAMPING_RATIO[0] {
            let advice = "its resonance is hardly damped";
            odd(direction, format!("{what} {ratio:.3}"), advice);
        }
    };
    damping(
        Direction::Lateral,
        "lateral",
        s.lateral_stiffness,
        s.lateral_damping,
    );
    // An air spring has its own constants in the vertical model.
    if s.air_spring.is_none() {
        damping(
            Direction::Vertical,
            "vertical",
            s.vertical_stiffness,
            s.vertical_damping,
        );
        let deflection = vehicle.secondary_static_deflection();
        if deflection > COIL_DEFLECTION {
            odd(
                Direction::Vertical,
                format!("the secondary springs settle by {deflection:.2} m under the carbody"),
                "more than coil springs can, so think of air springs, or limit \
                 secondary_static_deflection",
            );
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_prototype_is_not_odd_and_what_is_is_said() {
        let mut vehicle = Vehicle::prototype();
        assert_eq!(secondary_oddities(&vehicle), []);
        let s = &mut vehicle.suspension.secondary;
        // 0.7 Hz: g / (2π 0.7 Hz)² = 0.507 m.
        s.vertical_stiffness *= (0.7_f64 / 0.8868).powi(2);
        s.lateral_damping *= 3.0 / 0.1448;
        let said: Vec<String> = secondary_oddities(&vehicle)
            .into_iter()
            .map(|oddity| oddity.message)
            .collect();
        assert_eq!(said.len(), 2);
        assert!(said[0].ends_with("lateral suspension is 3.00"), "{said:?}");
        assert!(said[1].contains("0.51 m"), "{said:?}");
    }
}
