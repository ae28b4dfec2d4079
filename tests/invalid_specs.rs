//! What the author of a wrong spec gets to read, for every kind of mistake.

use std::fs;

use bogie::spec::Spec;

#[test]
fn messages() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/problems/invalid");
    let mut files: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    assert!(files.len() >= 15);
    for file in files {
        let name = file.file_name().unwrap().to_str().unwrap();
        let source = fs::read_to_string(&file).unwrap();
        let mistakes = Spec::parse(&source).expect_err(name);
        insta::assert_snapshot!(name, mistakes.render(name, &source, false));
    }
}
