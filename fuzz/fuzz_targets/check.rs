//! `bogie check` in whole: what it prints is short and free of what a terminal would obey, and the
//! numbers of a right spec are finite.
#![no_main]

use bogie::{
    export::check::{json, text},
    spec::{Spec, inputs_si, printable},
};
use libfuzzer_sys::fuzz_target;

/// Longest answer for one mistake, bytes: title, source line, label and help.
const LONGEST: usize = 10_000;

fuzz_target!(|bytes: &[u8]| {
    let source = String::from_utf8_lossy(bytes);
    let read = Spec::read(bytes);
    let answer = json("fuzz", &source, &read);
    let shown = match &read {
        Ok(spec) => {
            assert!(inputs_si(&spec.case).iter().all(|(_, si)| si.is_finite()));
            for condition in &spec.conditions {
                let case = condition.apply(&spec.case);
                assert!(inputs_si(&case).iter().all(|(_, si)| si.is_finite()));
            }
            text("fuzz", spec) + &spec.doubts.render("fuzz", &source, false)
        }
        Err(mistakes) => mistakes.render("fuzz", &source, false),
    };
    let is_plain = shown.lines().all(|line| printable(line) == line);
    assert!(is_plain, "{shown:?}");
    let entries = ["mistakes", "warnings"].map(|key| answer[key].as_array().map_or(0, Vec::len));
    assert!(shown.len() < LONGEST * entries.iter().sum::<usize>().clamp(1, 20) + LONGEST);
});
