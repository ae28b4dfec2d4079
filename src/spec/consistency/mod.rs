//! Whether values that are right one by one go together: what cannot hold at once is a mistake,
//! what is lawful but hardly meant a doubt.

mod bodies;
mod contradictions;
mod demands;
mod design_space;
mod effects;
mod secondary;
mod service_curve;
mod situation;
mod usual;

pub(super) use contradictions::contradictions;
pub(super) use service_curve::without_curve;
pub(super) use situation::Situation;

use super::Spec;
use super::diagnostic::{Diagnostic, Doubts};
use super::document::Document;

/// Doubts about a spec without mistakes.
pub(super) fn doubts(spec: &Spec, document: &Document, situations: &[Situation]) -> Doubts {
    let mut doubts: Vec<Diagnostic> = Vec::new();
    for situation in situations {
        usual::unusual(situation, &mut doubts);
        bodies::strange_bodies(situation, &mut doubts);
        secondary::odd_secondary(situation, &spec.design, &mut doubts);
        secondary::two_vertical_springs(situation, &mut doubts);
        demands::odd_demands(situation, &spec.design, &mut doubts);
    }
    design_space::odd_freedoms(spec, document, &mut doubts);
    effects::without_effect(spec, document, situations, &mut doubts);
    Doubts::new(doubts)
}
