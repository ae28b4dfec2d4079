//! A value of any text is read as a finite number or refused with a short message; what is read
//! matches the pattern of the schema.
#![no_main]

use std::sync::OnceLock;

use bogie::units::{Measure, Quantity, pattern};
use libfuzzer_sys::fuzz_target;
use regex_lite::Regex;

static PATTERN: OnceLock<Regex> = OnceLock::new();

fuzz_target!(|text: &str| {
    // What is no number and unit at all is that to every quantity.
    if let Err(error) = Measure::parse(text) {
        assert!(error.to_string().len() < 500, "{text:?}");
        assert!(Quantity::Mass.parse(text).is_err(), "{text:?}");
        return;
    }
    let mut is_read = false;
    for quantity in Quantity::ALL {
        match quantity.parse(text) {
            Ok(si) => {
                assert!(si.is_finite(), "{text:?}");
                is_read = true;
            }
            Err(error) => assert!(error.to_string().len() < 500, "{text:?}"),
        }
    }
    if is_read {
        let known =
            PATTERN.get_or_init(|| Regex::new(&pattern(true)).expect("a regular expression"));
        // Schemas know the same white space as we do; this library of expressions only that of ASCII.
        let spaced: String = text
            .chars()
            .map(|c| if c.is_whitespace() { ' ' } else { c })
            .collect();
        assert!(known.is_match(&spaced), "{text:?}");
    }
});
