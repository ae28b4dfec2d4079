//! Variables that change no term of a study.

use super::study::Study;
use crate::optimize::{
    archive::Archive,
    problem::{Detail, Piece, Problem},
    solve::halton,
};

/// Designs at which a variable that seems to be without influence is moved.
const DESIGNS: usize = 4;
/// Scaled coordinates to which it is moved: both ends, and a value that is no simple fraction.
const PLACES: [f64; 3] = [0.0, 0.37, 1.0];

/// Numbers of the variables of a study without influence: derivatives of all terms are zero at the
/// design `now`, and moving the variable over its range there and at designs spread over the box
/// leaves every value as it is, to the bit. None if no design looked at can be evaluated.
pub fn unused(study: &Study, now: &[f64], archive: &Archive) -> Vec<usize> {
    let n = study.variables().len();
    let spread = (1..=DESIGNS).map(|i| halton(i, n));
    let designs: Vec<Vec<f64>> = std::iter::once(now.to_vec()).chain(spread).collect();
    let measure = |x: &[f64], detail| {
        let measured = archive.measure(study, &[x.to_vec()], detail).ok()?;
        measured.into_iter().next()?.ok()
    };
    let graded = designs.iter().find_map(|x| measure(x, Detail::Gradients));
    let Some(graded) = graded else {
        return Vec::new();
    };
    let is_flat = |i: &usize| {
        graded.iter().all(|piece| {
            let gradient = piece.gradient.as_ref();
            gradient.is_some_and(|slopes| slopes[*i] == 0.0)
        })
    };
    let stays = |i: &usize| {
        designs.iter().all(|x| {
            let Some(here) = measure(x, Detail::Values) else {
                return true;
            };
            PLACES.iter().all(|place| {
                let mut moved = x.clone();
                moved[*i] = *place;
                measure(&moved, Detail::Values).is_some_and(|there| same(&here, &there))
            })
        })
    };
    (0..n).filter(|i| is_flat(i) && stays(i)).collect()
}

fn same(a: &[Piece], b: &[Piece]) -> bool {
    let pairs = || a.iter().zip(b);
    a.len() == b.len()
        && pairs().all(|(a, b)| a.index == b.index && a.value.to_bits() == b.value.to_bits())
}
