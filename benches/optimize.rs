//! Time of the whole design procedure for the two design examples: `cargo bench --bench optimize`.

use bogie::{
    design::procedure::design,
    optimize::archive::{Archive, Silent},
    spec::Spec,
};
use divan::Bencher;

fn main() {
    divan::main();
}

#[divan::bench(args = ["intercity-130mph", "urban-80mph"], sample_count = 5)]
fn design_example(bencher: Bencher, name: &str) {
    let path = format!("{}/problems/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let source = std::fs::read_to_string(path).unwrap();
    let spec = Spec::parse(&source).ok().unwrap();
    bencher.bench(|| design(&spec, &Archive::new(&Silent)));
}
