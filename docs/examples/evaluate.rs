//! Evaluates a vehicle: the report's prototype with a softer bending stiffness of its trucks.
//!
//! `cargo run --release --example evaluate`

use bogie::{Case, Evaluation, Parameter, units::Quantity};

/// Evaluates both and prints what differs.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let prototype = Case::prototype();
    let mut softer = prototype.clone();
    let stiffness = Quantity::RotationalStiffness.parse("1e6 lbf ft/rad")?;
    Parameter::PRIMARY_BENDING_STIFFNESS.set(&mut softer, stiffness);

    for (name, case) in [("prototype", &prototype), ("softer", &softer)] {
        let evaluation = Evaluation::new(case)?;
        match evaluation.stability.critical_speed() {
            Some(speed) => println!("{name}: critical speed {:.1} km/h", 3.6 * speed),
            None => println!("{name}: stable over the range searched"),
        }
        // What has no value has a reason.
        match &evaluation.lateral {
            Ok(ride) => println!("  lateral RMS {:.3} m/s²", ride.average_acceleration()),
            Err(reason) => println!("  no lateral ride: {reason}"),
        }
        let flange = evaluation.curving?.flange;
        let degree = flange.map_or("none".into(), |limit| format!("{:.2}°", limit.degree));
        println!("  curve of flange contact {degree}");
    }
    Ok(())
}
