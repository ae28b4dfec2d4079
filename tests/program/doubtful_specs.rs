//! What the author of a lawful but odd spec gets to read: `problems/doubtful/`.

use bogie::{evaluate::Evaluation, evaluate::warnings::warnings, spec::Spec};

use crate::support::problem_files;

/// Each has something to say of the spec, of the vehicle's performance, or of both.
#[test]
fn warnings_of_spec_and_evaluation() {
    let files = problem_files("doubtful");
    assert!(files.len() >= 20);
    for (name, bytes) in files {
        let source = String::from_utf8(bytes).unwrap();
        let spec = Spec::parse(&source).expect(&name);
        let mut text = spec.doubts.render(&name, &source, false);
        let evaluation = Evaluation::new(&spec.case).unwrap();
        for warning in warnings(&spec.case, &evaluation) {
            text.extend(["warning on evaluation: ", &warning, "\n"]);
        }
        assert!(text.contains("warning"), "{name}");
        insta::assert_snapshot!(name.as_str(), text);
    }
}

/// The report's own problems are what the thresholds must let pass. Only the table's column of
/// λ = 0.25 asks for a critical speed (100 mph) below the speed that its vehicle runs (110 mph).
#[test]
fn the_reports_problems_are_not_doubtful() {
    for (name, bytes) in problem_files("") {
        let spec = Spec::read(&bytes).expect(&name);
        let doubts: Vec<String> = spec.doubts.sentences().collect();
        let expected = usize::from(name == "conicity-0.25.toml");
        assert_eq!(doubts.len(), expected, "{name}: {doubts:?}");
    }
}
