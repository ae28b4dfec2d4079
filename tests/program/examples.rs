//! The programs of `docs/examples/` run to their end.

#[path = "../../docs/examples/evaluate.rs"]
mod evaluate;
#[path = "../../docs/examples/objective.rs"]
mod objective;
#[path = "../../docs/examples/optimize.rs"]
mod optimize;

#[test]
fn evaluate_runs() {
    evaluate::main().unwrap();
}

#[test]
fn objective_runs() {
    objective::main().unwrap();
}

#[test]
fn optimize_runs() {
    optimize::main().unwrap();
}
