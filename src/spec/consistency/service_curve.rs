//! Demands in the service curve where no condition gives one.

use super::situation::Situation;
use crate::index::Index;
use crate::spec::diagnostic::Diagnostic;
use crate::spec::{Front, Goal, keys};

/// Finds demands, goals and fronts of an index that exists only in a given curve.
pub fn without_curve(
    situations: &[Situation],
    objective: &[Goal],
    front: &Front,
    mistakes: &mut Vec<Diagnostic>,
) {
    const CURVE: &str = "service.curve";
    if situations.iter().any(|s| s.case.service.curve.is_some()) {
        return;
    }
    for index in Index::ALL.into_iter().filter(|i| i.needs_service_curve()) {
        let demands = situations
            .iter()
            .filter(|s| s.demands.get(index).is_some())
            .filter_map(|s| s.place(&[index.path(), CURVE]));
        let nominal = situations.first();
        let is_goal = objective.iter().any(|goal| goal.index == index);
        let goals = nominal.filter(|_| is_goal);
        let goals = goals.and_then(|s| s.place(&[keys::MINIMIZE, CURVE]));
        let is_traded = front.indices.contains(&index);
        let fronts = nominal.filter(|_| is_traded);
        let fronts = fronts.and_then(|s| s.place(&[keys::FRONT_INDICES, CURVE]));
        for place in demands.take(1).chain(goals).chain(fronts) {
            mistakes.push(
                Diagnostic::at(
                    place,
                    format!("`{}` needs a curve", index.name()),
                    "no condition gives `service.curve`",
                )
                .help("give it in [service] or in a condition: curve = \"1.5 deg\"".to_owned()),
            );
        }
    }
}
