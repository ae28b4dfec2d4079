//! The verdict on a finished design: whether everything is met; if not, what is not.

use super::sheet::Sheet;
use crate::{
    design::{
        margin::{Margin, Verdict},
        outcome::{Delivered, DesignResult},
    },
    units::number::value,
};

/// The verdict in words.
pub(crate) fn verdict(sheet: &mut Sheet, result: &DesignResult) {
    if let Some(stop) = result.stopped {
        sheet.heading(&format!(
            "Ended early, {stop}: this is the best found so far."
        ));
    }
    sheet.heading(&match (result.stopped, result.failure()) {
        _ if result.met() && result.margins.is_empty() => {
            "The spec sets no requirement and no limit.".into()
        }
        _ if result.met() => "All requirements and limits are met.".into(),
        (Some(_), _) => "Not everything is met yet:".into(),
        (None, Some(failure)) => {
            format!("No design within the bounds could be evaluated ({failure}); left as given:")
        }
        (None, None) if all_assessed_are_met(result) => {
            "All that the model covers is met; the rest is not assessed:".into()
        }
        (None, None) => "Not everything can be met; this is the best compromise:".to_owned(),
    });
    if let Some(choice) = choice(result) {
        sheet.line(choice);
    }
    for unmet in result.unmet() {
        sheet.line(&shortfall(unmet));
    }
    if !result.settled && result.stopped.is_none() {
        sheet.line(&format!(
            "The coupling loop still changed the design after {} rounds.",
            result.rounds
        ));
    }
}

/// Why the design delivered is another than that of the trade-offs in turn.
fn choice(result: &DesignResult) -> Option<&'static str> {
    match result.delivered {
        Delivered::AsGiven if result.stopped.is_some() => Some(
            "The design as given stands better to the demands than the one found so far: it is \
             delivered.",
        ),
        Delivered::AsGiven => Some(
            "The design as given stands better to the demands than those found: it is delivered.",
        ),
        Delivered::AllAtOnce if result.joint.is_none() => None,
        Delivered::AllAtOnce if result.met() => Some(
            "The trade-offs in turn miss some of them; all at once meets them: its design is \
             delivered.",
        ),
        Delivered::AllAtOnce => {
            Some("All at once comes closer than the trade-offs in turn: its design is delivered.")
        }
        Delivered::InTurn => None,
    }
}

fn all_assessed_are_met(result: &DesignResult) -> bool {
    result
        .unmet()
        .all(|margin| margin.verdict() == Verdict::NotAssessed)
}

/// As in "limits.wheel_l_over_v: asked 0.8, not assessed (outside-model: …)".
fn shortfall(unmet: &Margin) -> String {
    let quantity = unmet.index.quantity();
    let asked = value(quantity, unmet.required);
    let reached = match (&unmet.reached, unmet.curve) {
        (_, Some(curve)) => format!("not assessed ({curve})"),
        (Ok(si), None) => format!("reached {}", value(quantity, *si)),
        (Err(failure), None) => format!("reached none: {failure}"),
    };
    format!("{}: asked {asked}, {reached}", unmet.key())
}
