//! Designs the suspension of a spec and prints what was chosen.
//!
//! `cargo run --release --example optimize`

use std::sync::atomic::AtomicBool;

use bogie::{
    Input, Run,
    run::{Progress, Silent},
};

const SPEC: &str = r#"
[service]
speed = "110 mph"
track = "fra-class-6"

[vehicle]
base = "prototype"

[design]
secondary_vertical_frequency = ["0.7 Hz", "2 Hz"]
secondary_vertical_damping_ratio = [0.1, 0.5]

[limits]
secondary_vertical_stroke = "2 in"
"#;

/// Designs and prints what was chosen.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let input = Input::read("coach", SPEC.as_bytes())?;
    // Another thread may set it: the run then ends with the best so far.
    let cancel = AtomicBool::new(false);
    let progress: &dyn Progress = &Silent;
    let run = Run::new(&input).watched(progress, &cancel);
    let answer = run.optimize(&run.archive(None))?;

    let design = &answer.result.design;
    println!("all met: {}", design.met());
    for parameter in input.spec.design.parameters.iter().map(|open| open.0) {
        println!(
            "{}: {:.4} (SI)",
            parameter.name(),
            parameter.get(&design.case)
        );
    }
    // Everything else: as text, or as JSON with SI units in the keys.
    println!("{}", answer.json()["status"]);
    Ok(())
}
