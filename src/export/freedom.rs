//! The design delivered beside the optimum, and the ranges over which its variables are free.

use super::sheet::Sheet;
use crate::{
    design::{
        explain::Chosen,
        freedom::{EndKind, Free, Loss},
        outcome::DesignResult,
    },
    spec::{DesignSpace, Prefer},
    units::{
        DisplayUnit,
        number::{significant, unsigned_percent},
    },
};

/// A share in per cent, as in "0.1 %".
fn percent(share: f64) -> String {
    format!("{} %", significant_plain(100.0 * share))
}

/// A number without zeros behind it.
fn significant_plain(x: f64) -> String {
    let text = significant(x, 3);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Which design is delivered.
pub(crate) fn delivered(result: &DesignResult, space: &DesignSpace) -> String {
    let which = match space.prefer {
        Prefer::AsGiven if !result.is_optimum() => "the one nearest to that as given",
        Prefer::Softest if !result.is_optimum() => "the softest",
        _ => return "Design delivered: the optimum".into(),
    };
    let within = percent(space.deliver_within);
    format!("Design delivered: {which} within {within} of the optimum")
}

/// Loss of the design delivered against the optimum, goal by goal.
pub(crate) fn losses(result: &DesignResult) -> Option<String> {
    let name = |loss: &Loss| format!("{} {}", loss.goal, unsigned_percent(100.0 * loss.share));
    let names: Vec<String> = result.losses.iter().map(name).collect();
    (!names.is_empty()).then(|| format!("loss against the optimum: {}", names.join(", ")))
}

/// Meaning of the ranges, in words.
pub(crate) fn meaning(space: &DesignSpace) -> String {
    format!(
        "free: where a design keeps all demands and loses at most {} of each goal, the other variables \
         chosen anew",
        percent(space.free_within)
    )
}

/// Which ends of a range are bounds of the design space.
pub(crate) fn bounds_met(free: &Free) -> &'static str {
    match free.ends.map(|end| end.kind == EndKind::Bound) {
        [true, true] => "all of its bounds",
        [true, false] => "from its lower bound",
        [false, true] => "to its upper bound",
        [false, false] => "",
    }
}

/// The ends of a range in a unit; one that is only known to be reached as in "≥ 12.0".
pub(crate) fn ends(free: &Free, unit: DisplayUnit) -> [String; 2] {
    [("≤ ", free.ends[0]), ("≥ ", free.ends[1])].map(|(sign, end)| {
        let sign = if end.kind == EndKind::AtLeast {
            sign
        } else {
            ""
        };
        format!("{sign}{}", significant(unit.of(end.value), 4))
    })
}

/// The variables that led to the design delivered.
pub(crate) fn variables(result: &DesignResult) -> impl Iterator<Item = &Chosen> {
    let stages = result.delivered_stages();
    stages.flat_map(|stage| stage.explained.chosen.iter())
}

/// The section; none where the optimum is delivered and nothing is known of its surroundings.
pub(crate) fn freedom(sheet: &mut Sheet, result: &DesignResult, space: &DesignSpace) {
    if result.is_optimum() && result.free.is_empty() {
        return;
    }
    sheet.heading(&delivered(result, space));
    let rows: Vec<Vec<String>> = variables(result)
        .flat_map(|chosen| rows(chosen, result))
        .collect();
    sheet.table(
        &["", "", "optimum", "delivered", "free from", "to", ""],
        &[1, 6],
        &rows,
    );
    if let Some(losses) = losses(result) {
        sheet.line(&losses);
    }
    if !result.free.is_empty() {
        sheet.line(&meaning(space));
    }
}

/// A row in SI and, where they differ, one in US units.
fn rows(chosen: &Chosen, result: &DesignResult) -> Vec<Vec<String>> {
    let quantity = chosen.variable.quantity;
    let (si, us) = (quantity.si(), quantity.us());
    let mut units = vec![si];
    if us.label != si.label {
        units.push(us);
    }
    let free = result.free(chosen.parameter);
    let delivered = chosen.parameter.get(&result.case);
    let row = |(k, unit): (usize, DisplayUnit)| {
        let [from, to] = free.map_or([String::new(), String::new()], |free| ends(free, unit));
        let first = |text: &str| {
            if k == 0 {
                text.to_owned()
            } else {
                String::new()
            }
        };
        vec![
            first(chosen.variable.symbol),
            unit.label.into(),
            significant(unit.of(chosen.value), 4),
            significant(unit.of(delivered), 4),
            from,
            to,
            first(free.map_or("", bounds_met)),
        ]
    };
    units.into_iter().enumerate().map(row).collect()
}
