//! A spec of any bytes is read or refused with mistakes that can be shown.
#![no_main]

use bogie::spec::Spec;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match Spec::read(bytes) {
        Ok(spec) => {
            for condition in &spec.conditions {
                let _ = condition.apply(&spec.case);
            }
        }
        Err(mistakes) => assert!(mistakes.iter().count() > 0),
    }
});
