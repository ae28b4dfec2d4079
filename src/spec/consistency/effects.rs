//! Values that change nothing.

use toml::de::DeValue;

use super::situation::Situation;
use crate::index::Index;
use crate::parameter::Parameter;
use crate::spec::diagnostic::{Diagnostic, word};
use crate::spec::document::Document;
use crate::spec::keys::{self, CaseKey};
use crate::spec::{Freedom, Spec};

type Doubts = Vec<Diagnostic>;

/// Indices of the service curve.
const IN_CURVE: [Index; 6] = [
    Index::SecondaryLateralStrokeInCurve,
    Index::WheelLOverV,
    Index::TruckSideLOverV,
    Index::NetAxleLOverV,
    Index::AdhesionUsed,
    Index::CurveLimitRatio,
];

/// Doubts about values without effect, or with less than their author may think.
pub fn without_effect(
    spec: &Spec,
    document: &Document,
    situations: &[Situation],
    doubts: &mut Doubts,
) {
    profiles(spec, document, situations, doubts);
    air_spring(spec, document, doubts);
    service_curve(spec, document, situations, doubts);
    order(spec, document, doubts);
    tracks(document, situations, doubts);
    for situation in situations {
        replaced(spec, situation, doubts);
    }
}

/// Coefficients that the spec gives stay as they are, whatever the conicity; those that a condition
/// gives beside its conicity are meant for it.
fn profiles(spec: &Spec, document: &Document, situations: &[Situation], doubts: &mut Doubts) {
    let given: Vec<&CaseKey> = keys::coefficients()
        .filter(|key| document.get(key.path).is_some())
        .collect();
    let mut doubt = |place, kept: &[&str]| {
        let what = match kept.len() {
            0 => return,
            n if n == keys::coefficients().count() => "creep and contact geometry",
            _ => "some coefficients",
        };
        doubts.push(
            Diagnostic::at(
                place,
                format!("the conicity changes, but {what} do not follow it"),
                format!("[wheel_rail] gives: {}", kept.join(", ")),
            )
            .help("leave them out to take each profile from Table 4.1.1".to_owned()),
        );
    };
    let open = spec.design.freedom(Parameter::CONICITY);
    if matches!(open, Some(Freedom::Between(_) | Freedom::Choices(_)))
        && let Some(value) = document.get(Parameter::CONICITY.path())
    {
        let kept: Vec<&str> = given.iter().map(|key| key.name()).collect();
        doubt(value.span(), &kept);
    }
    for situation in situations.iter().filter(|s| s.condition.is_some()) {
        if let Some(place) = situation.place(&["wheel_rail.conicity"]) {
            let kept = given
                .iter()
                .filter(|key| situation.document.get(key.path).is_none());
            let kept: Vec<&str> = kept.map(|key| key.name()).collect();
            doubt(place, &kept);
        }
    }
}

/// An air spring takes the place of K_sz and C_sz in the vertical model.
fn air_spring(spec: &Spec, document: &Document, doubts: &mut Doubts) {
    if spec.case.vehicle.suspension.secondary.air_spring.is_none() {
        return;
    }
    for (parameter, _) in &spec.design.parameters {
        let vertical = matches!(
            parameter.constant(),
            Parameter::SECONDARY_VERTICAL_STIFFNESS | Parameter::SECONDARY_VERTICAL_DAMPING
        );
        if vertical && let Some(value) = document.get(parameter.path()) {
            doubts.push(
                Diagnostic::at(
                    value.span(),
                    format!("`{}` does not act on the vertical ride", parameter.name()),
                    "[suspension.secondary.air_spring] takes its place there",
                )
                .help(
                    "it still is the carbody's roll stiffness or damping in the lateral model"
                        .to_owned(),
                ),
            );
        }
    }
}

/// A design heeds the service curve only where something is asked in it.
fn service_curve(spec: &Spec, document: &Document, situations: &[Situation], doubts: &mut Doubts) {
    let asked = IN_CURVE.iter().any(|index| {
        situations.iter().any(|s| s.demands.get(*index).is_some())
            || spec.objective.iter().any(|goal| goal.index == *index)
            || spec.front.indices.contains(index)
    });
    let is_designed = !spec.design.parameters.is_empty();
    let paths = ["service.curve", "service.cant_deficiency"];
    if is_designed
        && !asked
        && let Some(value) = paths.iter().find_map(|path| document.get(path))
    {
        let names = IN_CURVE.map(Index::name).join(", ");
        doubts.push(
            Diagnostic::at(
                value.span(),
                "nothing is asked in the service curve: the design does not heed it",
                format!("asked with one of: {names}"),
            )
            .help("`bogie evaluate` and `bogie curve` show the vehicle in it".to_owned()),
        );
    }
}

/// An objective is reached with all parameters at once.
fn order(spec: &Spec, document: &Document, doubts: &mut Doubts) {
    if spec.objective.is_empty() {
        return;
    }
    if let Some(value) = document.get(keys::ORDER)
        && value.get_ref().as_str() == Some("sequential")
    {
        doubts.push(Diagnostic::at(
            value.span(),
            "with an [objective] all parameters are chosen at once",
            "no effect",
        ));
    }
}

/// A track that nothing runs on.
fn tracks(document: &Document, situations: &[Situation], doubts: &mut Doubts) {
    let Some(DeValue::Table(tracks)) = document.get(keys::TRACKS).map(|t| t.get_ref()) else {
        return;
    };
    for (name, _) in tracks {
        let used = |s: &Situation| s.case.service.track.name == **name.get_ref();
        if !situations.iter().any(used) {
            doubts.push(
                Diagnostic::at(
                    name.span(),
                    format!("nothing runs on the track `{}`", word(name.get_ref())),
                    "no effect",
                )
                .help(format!(
                    "name it: track = \"{}\" in [service]",
                    word(name.get_ref())
                )),
            );
        }
    }
}

/// In a condition its own values stand, also where the design chooses another.
fn replaced(spec: &Spec, situation: &Situation, doubts: &mut Doubts) {
    if situation.condition.is_none() {
        return;
    }
    for (parameter, _) in &spec.design.parameters {
        // Worn wheels are what conditions are for.
        if *parameter == Parameter::CONICITY {
            continue;
        }
        let key = parameter.key_of_constant();
        if let Some(place) = situation.place(&[key.path]) {
            doubts.push(Diagnostic::at(
                place,
                format!("`{}` is chosen in [design]", parameter.name()),
                format!(
                    "whatever is chosen, this value stands{}",
                    situation.suffix()
                ),
            ));
        }
    }
}
