//! Text as it stands in a terminal, typeset: `K_px` with its subscript, `m/s^2` with its power,
//! `1.2e7` as a power of ten, minus signs.

use std::{collections::HashSet, sync::LazyLock};

use maud::{Markup, html};

use crate::{
    parameter::Parameter,
    plot::{Level, Text},
    spec::keys,
};

/// Symbols that stand in texts: those of parameters, of keys, and of weightings.
static SYMBOLS: LazyLock<HashSet<&str>> = LazyLock::new(|| {
    let parameters = Parameter::all().map(Parameter::symbol);
    let keys = keys::case().map(|key| key.symbol);
    let weightings = ["W_b", "W_d", "W_k", "W_z"];
    parameters.chain(keys).chain(weightings).collect()
});

/// A text, word by word.
pub fn typeset(text: &str) -> Markup {
    html! {
        @for (i, piece) in text.split(' ').enumerate() {
            @if i > 0 { " " }
            (word(piece))
        }
    }
}

/// A word with the punctuation around it.
fn word(piece: &str) -> Markup {
    let bare = piece.trim_start_matches('(');
    let (before, _) = piece.split_at(piece.len() - bare.len());
    let core = bare.trim_end_matches([',', ';', ':', ')', '.']);
    let (core, after) = bare.split_at(core.len());
    html! {
        (before)
        @if SYMBOLS.contains(core) { (symbol(core)) }
        @else if core.contains('^') && !core.contains('_') { (levels(core)) }
        @else if let Some((digits, power)) = scientific(core) {
            (minus(digits)) "·10" sup { (minus(power)) }
        }
        @else { (minus(core)) }
        (after)
    }
}

/// A symbol with its subscripts; digits at its end are some too, as in `f11`.
pub fn symbol(marked: &str) -> Markup {
    let letters = marked.trim_end_matches(|c: char| c.is_ascii_digit());
    if letters.is_empty() || letters.len() == marked.len() || marked.contains(['_', '^']) {
        return levels(marked);
    }
    let (_, digits) = marked.split_at(letters.len());
    html! { (letters) sub { (digits) } }
}

fn levels(marked: &str) -> Markup {
    html! {
        @for (piece, level) in &Text::new(marked).0 {
            @match level {
                Level::Base => (piece),
                Level::Lowered => sub { (piece) },
                Level::Raised => sup { (piece) },
            }
        }
    }
}

/// Digits and power of a number as in `1.2e-7`.
fn scientific(word: &str) -> Option<(&str, &str)> {
    let (digits, power) = word.split_once('e')?;
    let number = digits.starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c));
    (number && digits.parse::<f64>().is_ok() && power.parse::<i32>().is_ok())
        .then_some((digits, power))
}

/// A number's hyphen as the minus that it is.
fn minus(word: &str) -> String {
    match word.strip_prefix('-') {
        Some(number) if number.starts_with(|c: char| c.is_ascii_digit()) => format!("−{number}"),
        _ => word.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_powers_and_signs() {
        for (text, typed) in [
            (
                "K_px +12.0 %, λ -11.3 %",
                "K<sub>px</sub> +12.0 %, λ −11.3 %",
            ),
            ("0.4021 m/s^2", "0.4021 m/s<sup>2</sup>"),
            ("residual 2e-10;", "residual 2·10<sup>−10</sup>;"),
            (
                "limit secondary_static_deflection",
                "limit secondary_static_deflection",
            ),
            ("(1.158e7 lbf)", "(1.158·10<sup>7</sup> lbf)"),
            ("ride-stroke <b>", "ride-stroke &lt;b&gt;"),
            ("4e, e5, sea-level", "4e, e5, sea-level"),
        ] {
            assert_eq!(typeset(text).into_string(), typed);
        }
        assert_eq!(symbol("f11").into_string(), "f<sub>11</sub>");
        assert_eq!(symbol("ACC_L*").into_string(), "ACC<sub>L</sub>*");
    }
}
