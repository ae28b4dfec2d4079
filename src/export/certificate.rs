//! Certificate of a design, in words: how the search ended, what each limit costs, which
//! demands conflict, what the joint optimisation gained.

use super::{design_text::trade_off, sheet::Sheet, status};
use crate::{
    design::{
        explain::Explained,
        margin::{Margin, Verdict},
        outcome::DesignResult,
        price::Price,
    },
    index::{Index, Scale, Sense},
    optimize::{certificate::Curvature, local::Status, problem::Failure},
    units::{
        DisplayUnit,
        number::{both, in_unit, signed_percent, significant, value},
    },
};

/// How the search ended, and what the limits cost.
pub(crate) fn certificate(sheet: &mut Sheet, explained: &Explained) {
    for price in &explained.prices {
        sheet.line(&price_line(explained, price));
    }
    for chosen in explained.chosen.iter().filter(|_| !explained.is_relaxed) {
        if chosen.at_bound.is_some() && explained.bound_gain(chosen) > 1e-4 {
            sheet.line(&format!(
                "10 % beyond the bound on {} would gain about {} %",
                chosen.variable.symbol,
                significant(10.0 * explained.bound_gain(chosen), 2)
            ));
        }
    }
    let effort = &explained.effort;
    let mut parts = vec![status::words(explained.status)];
    if let Some(residual) = explained.kkt_residual {
        parts.push(format!("first-order residual {residual:.0e}"));
    }
    if let Some(curvature) = explained.curvature {
        parts.push(
            match curvature {
                Curvature::Vertex => "as many active limits as variables",
                Curvature::Minimum(_) => "a minimum to second order",
                Curvature::Flat(_) => "flat to second order in some direction",
                Curvature::Saddle(_) => "not a minimum to second order",
            }
            .into(),
        );
    }
    parts.push(format!("{} evaluations", effort.evaluations));
    sheet.line(&parts.join("; "));
    if explained.status != Status::Infeasible {
        optima(sheet, explained);
    }
    if effort.failed() > 0 {
        let failures: Vec<String> = effort
            .failures
            .iter()
            .map(|(failure, count)| format!("{count} × {failure}"))
            .collect();
        sheet.line(&format!("without a result: {}", failures.join("; ")));
    }
}

/// How many local optima were found and how far was looked for others; with several, where they are.
fn optima(sheet: &mut Sheet, explained: &Explained) {
    /// Local optima in the table; all are in the JSON result.
    const SHOWN: usize = 6;
    let Some(coverage) = explained.coverage else {
        return;
    };
    let found = &explained.optima;
    let count = match found.len() {
        1 => "1 local optimum".into(),
        n => format!("{n} local optima"),
    };
    let share = significant(100.0 * coverage.unseen, 2);
    let bound = if coverage.is_enough() {
        String::new()
    } else {
        format!(", more than {} %", significant(100.0 * coverage.bound, 2))
    };
    sheet.line(&format!(
        "{count} from {} uniform starts and {} others; basins not yet seen: about {share} % of the \
         space{bound}",
        coverage.uniform,
        explained.effort.starts - coverage.uniform
    ));
    if found.len() < 2 {
        return;
    }
    let rows: Vec<Vec<String>> = found
        .iter()
        .take(SHOWN)
        .map(|optimum| {
            let objective = match (optimum.value, explained.objective, optimum.merit) {
                (Some(si), Some(objective), _) => value(objective.index.quantity(), si),
                (_, _, Some(merit)) => format!("{merit:.4}"),
                (_, _, None) => "not feasible".into(),
            };
            let at = explained.chosen.iter().zip(&optimum.at);
            let at = at.map(|(chosen, si)| value(chosen.variable.quantity, *si));
            [objective, optimum.searches.to_string()]
                .into_iter()
                .chain(at)
                .collect()
        })
        .collect();
    let objective = match explained.objective {
        Some(objective) => objective.index.words(),
        None => "sum (smaller is better)",
    };
    let symbols = explained.chosen.iter().map(|chosen| chosen.variable.symbol);
    let header: Vec<&str> = [objective, "searches"].into_iter().chain(symbols).collect();
    sheet.table(&header, &[], &rows);
    if found.len() > SHOWN {
        sheet.line(&format!("{} more local optima", found.len() - SHOWN));
    }
}

/// As in "critical speed: 1 km/h more costs 0.0068° (1 mph more: 0.011°)".
fn price_line(explained: &Explained, price: &Price) -> String {
    let more = match price.index.sense() {
        Sense::AtLeast => "more",
        Sense::AtMost => "less",
    };
    let name = if price.conditions == [None] {
        price.index.words().into()
    } else {
        let conditions = price.conditions.iter();
        let list: Vec<&str> = conditions
            .map(|c| c.as_deref().unwrap_or("nominal"))
            .collect();
        format!("{} ({})", price.index.words(), list.join(", "))
    };
    let change = explained.price(price).abs();
    let quantity = price.index.quantity();
    let costs = |unit: DisplayUnit, us: bool| {
        // Damping ratios and other plain numbers by the hundredth.
        let (step, size) = match (unit.label, price.index.scale()) {
            ("", Scale::Linear) => ("0.01".into(), 0.01),
            ("", Scale::Logarithmic) => ("0.1".into(), 0.1),
            ("in" | "deg" | "m/s^2", _) => (format!("0.1 {}", unit.label), 0.1 * unit.factor),
            ("g", _) => ("0.01 g".into(), 0.01 * unit.factor),
            (label, _) => (format!("1 {label}"), unit.factor),
        };
        let cost = match explained.objective {
            Some(found) => objective(found.index, change * size, us),
            None => format!("{} % of the sum", significant(100.0 * change * size, 2)),
        };
        (step, cost)
    };
    let (si_step, si) = costs(quantity.si(), false);
    let (us_step, us) = costs(quantity.us(), true);
    if si_step == us_step && si == us {
        format!("{name}: {si_step} {more} costs {si}")
    } else {
        format!("{name}: {si_step} {more} costs {si} ({us_step} {more}: {us})")
    }
}

fn objective(index: Index, si: f64, us: bool) -> String {
    let quantity = index.quantity();
    let unit = if us { quantity.us() } else { quantity.si() };
    format!("{} of {}", in_unit(unit, si, 2), index.words())
}

/// Every demand and what is reached.
pub(crate) fn margins(sheet: &mut Sheet, result: &DesignResult) {
    let (margins, range) = (&result.margins, result.case.model.speed_range);
    if margins.is_empty() {
        return;
    }
    sheet.heading("Requirements and limits");
    let rows: Vec<Vec<String>> = margins
        .iter()
        .map(|margin| margin_row(margin, range))
        .collect();
    sheet.table(
        &["", "", "asked", "", "reached", "", "margin", ""],
        &[1, 7],
        &rows,
    );
}

/// Value reached, in SI and US units, or the reason why there is none. A critical speed at an end of the
/// `range` searched, m/s, lies beyond it.
pub(crate) fn reached(
    index: Index,
    reached: &Result<f64, Failure>,
    range: [f64; 2],
) -> [String; 2] {
    let si = match reached {
        Ok(si) => *si,
        Err(failure) => return ["none".into(), failure.to_string()],
    };
    let beyond = match index {
        Index::CriticalSpeed if si <= range[0] => "below ",
        Index::CriticalSpeed if si >= range[1] => "over ",
        _ => "",
    };
    both(index.quantity(), si).map(|cell| {
        if cell.is_empty() {
            cell
        } else {
            format!("{beyond}{cell}")
        }
    })
}

/// Index, condition, asked in SI and US units, reached likewise, margin, verdict; `range` as in
/// [`reached`].
pub(crate) fn margin_row(margin: &Margin, range: [f64; 2]) -> Vec<String> {
    let quantity = margin.index.quantity();
    let [asked_si, asked_us] = both(quantity, margin.required);
    let [si, us] = reached(margin.index, &margin.reached, range);
    let share = match &margin.reached {
        Ok(reached) => {
            let better = match margin.index.sense() {
                Sense::AtLeast => reached - margin.required,
                Sense::AtMost => margin.required - reached,
            };
            match margin.index.scale() {
                Scale::Logarithmic => {
                    let share = 100.0 * better / margin.required;
                    format!("{:.1} %", if share.abs() < 0.05 { 0.0 } else { share })
                }
                Scale::Linear => significant(better, 2),
            }
        }
        Err(_) => String::new(),
    };
    vec![
        margin.index.words().into(),
        margin.condition.clone().unwrap_or_default(),
        asked_si,
        asked_us,
        si,
        us,
        share,
        match margin.verdict() {
            Verdict::Met => "met",
            Verdict::NotMet => "NOT MET",
            Verdict::NotAssessed => "not assessed",
        }
        .into(),
    ]
}

/// Which demands conflict, and what each alone would have to become.
pub(crate) fn conflict(sheet: &mut Sheet, result: &DesignResult) {
    let Some(conflict) = &result.conflict else {
        return;
    };
    if conflict.demands.is_empty() {
        return;
    }
    sheet.heading(if conflict.demands.len() == 1 {
        "Out of reach"
    } else {
        "In conflict"
    });
    let groups = conflict.demands.iter().map(|opposed| opposed.group);
    let alone = match groups.max() {
        Some(0) => "feasible if it alone became",
        _ => "feasible in its group if it alone became",
    };
    let rows: Vec<Vec<String>> = conflict
        .demands
        .iter()
        .map(|opposed| {
            let quantity = opposed.index.quantity();
            let name = match &opposed.condition {
                Some(condition) => format!("{} ({condition})", opposed.index.words()),
                None => opposed.index.words().into(),
            };
            vec![
                name,
                value(quantity, opposed.required),
                format!("{:.0} %", 100.0 * opposed.share),
                match opposed.alone {
                    _ if !opposed.influenced => "no design variable changes it".into(),
                    Some(bound) => value(quantity, bound),
                    None => "not enough alone".into(),
                },
            ]
        })
        .collect();
    sheet.table(&["", "asked", "share", alone], &[], &rows);
}

/// The joint optimisation beside the sequential design.
pub(crate) fn joint(sheet: &mut Sheet, result: &DesignResult) {
    let Some(joint) = &result.joint else { return };
    trade_off(sheet, &joint.stage);
    let range = result.case.model.speed_range;
    let cell = |index: Index, value: &Result<f64, Failure>| reached(index, value, range);
    let rows: Vec<Vec<String>> = joint
        .indices
        .iter()
        .map(|compared| {
            let (index, before, after) = (compared.index, &compared.sequential, &compared.joint);
            let [before_si, before_us] = cell(index, before);
            let [after_si, after_us] = cell(index, after);
            let change = match (before, after) {
                (Ok(b), Ok(a)) => signed_percent(100.0 * (a / b - 1.0)),
                _ => String::new(),
            };
            vec![
                index.words().into(),
                before_si,
                before_us,
                after_si,
                after_us,
                change,
            ]
        })
        .collect();
    sheet.table(
        &["", "in turn", "", "all at once", "", "change"],
        &[],
        &rows,
    );
    let Some(gain) = joint.gain else { return };
    sheet.line(&if gain > 1e-4 {
        format!(
            "All at once gains {} % in sum over the trade-offs taken in turn.",
            significant(100.0 * gain, 3)
        )
    } else {
        "All at once gains nothing over the trade-offs taken in turn.".into()
    });
}
