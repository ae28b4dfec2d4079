//! What the author of a wrong spec gets to read, for every kind of mistake: `problems/invalid/`.

use std::fs;

use bogie::spec::Spec;

use crate::support::problem_files;

#[test]
fn messages() {
    let files = problem_files("invalid");
    assert!(files.len() >= 65);
    for (name, bytes) in files {
        let mistakes = Spec::read(&bytes).expect_err(&name);
        let source = String::from_utf8_lossy(&bytes);
        insta::assert_snapshot!(name.as_str(), mistakes.render(&name, &source, false));
    }
}

/// A spec that is taken away takes its message along.
#[test]
fn every_message_has_its_spec() {
    for (folder, prefix) in [
        ("invalid", "program__invalid_specs__"),
        ("doubtful", "program__doubtful_specs__"),
    ] {
        let files = problem_files(folder);
        let snapshots = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/program/snapshots");
        let mut count = 0;
        for entry in fs::read_dir(snapshots).unwrap() {
            let file_name = entry.unwrap().file_name().into_string().unwrap();
            if let Some(rest) = file_name.strip_prefix(prefix) {
                let name = rest.trim_end_matches(".snap");
                assert!(files.iter().any(|(file, _)| file == name), "{file_name}");
                count += 1;
            }
        }
        assert_eq!(count, files.len(), "{folder}");
    }
}
