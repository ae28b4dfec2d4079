//! Sensitivity as text.

use crate::{
    design::sensitivity::{
        Effects, Factor, IndexSensitivity, Method, Sensitivity, sobol::Estimate,
    },
    export::sheet::Sheet,
    index::Scale,
    units::number::{both, significant},
};

/// As text: for each index the factors ranked, then those that do not matter.
pub fn text(name: &str, sensitivity: &Sensitivity) -> String {
    let mut sheet = Sheet::new(&format!("Sensitivity of {name}"));
    about(&mut sheet, sensitivity);
    for index in &sensitivity.indices {
        one_index(&mut sheet, sensitivity, index);
    }
    let nowhere = sensitivity.negligible();
    if sensitivity.indices.len() > 1 && !nowhere.is_empty() {
        sheet.heading("Matters to none of these indices");
        sheet.line(&labels(&sensitivity.factors, &nowhere));
    }
    sheet.finish()
}

/// Rows of a small table for a screening around a finished design: each index with the factors that
/// matter most to it, at most `most`, and how it changes as they go through their range: in per
/// cent, a damping ratio by differences.
pub fn summary(sensitivity: &Sensitivity, most: usize) -> Vec<Vec<String>> {
    let row = |index: &IndexSensitivity| {
        let change = |i: &usize| -> Option<String> {
            let Effects::Morris(effects) = &index.effects else {
                return None;
            };
            let mu = effects[*i]?.mu;
            let change = match index.index.scale() {
                Scale::Logarithmic => format!("{:+.1} %", 100.0 * mu.exp_m1()),
                Scale::Linear => format!("{mu:+.3}"),
            };
            Some(format!("{} {change}", sensitivity.factors[*i].label()))
        };
        let matters = index.ranking().matters;
        let changes: Vec<String> = matters.iter().take(most).filter_map(change).collect();
        vec![index.index.words().into(), changes.join(", ")]
    };
    sensitivity.indices.iter().map(row).collect()
}

fn about(sheet: &mut Sheet, sensitivity: &Sensitivity) {
    let what = match sensitivity.settings.method {
        Method::Sobol { .. } => "Sobol' indices, rows",
        Method::Morris { .. } => "Morris's elementary effects, trajectories",
    };
    let asked = sensitivity.settings.method.groups();
    let groups = if sensitivity.interrupted() {
        format!("{} of {asked} (interrupted)", sensitivity.groups)
    } else {
        asked.to_string()
    };
    sheet.line(&format!(
        "{what}: {groups}; evaluations: {}; seed: {}",
        sensitivity.evaluations(),
        sensitivity.settings.seed
    ));
    let open = sensitivity.factors.iter().filter(|f| f.open).count();
    let inputs = sensitivity.factors.len() - open;
    sheet.line(&format!(
        "{open} design parameters between their bounds, {inputs} inputs within ± {} %",
        significant(100.0 * sensitivity.spread, 2)
    ));
    sheet.line(match sensitivity.settings.method {
        Method::Sobol { .. } => {
            "S1: share of the variance of ln(index), or of a damping ratio, that the factor \
             explains alone; ST: with its interactions"
        }
        Method::Morris { .. } => {
            "changes of ln(index), or of a damping ratio, over the factor's range: size μ*, \
             mean μ, standard deviation σ"
        }
    });
}

fn one_index(sheet: &mut Sheet, sensitivity: &Sensitivity, index: &IndexSensitivity) {
    sheet.heading(&heading(index));
    if !index.failures.is_empty() {
        let failures: Vec<String> = index
            .failures
            .iter()
            .map(|(failure, count)| format!("{failure}: {count}"))
            .collect();
        sheet.line(&format!(
            "left out: {}; the numbers are of the designs that remain",
            failures.join(", ")
        ));
        let lost: usize = index.failures.values().sum();
        if 2 * lost > sensitivity.evaluations() {
            sheet.line("more than half are left out: narrower bounds would tell more");
        }
    }
    let ranking = index.ranking();
    let header: &[&str] = match index.effects {
        Effects::Sobol(_) => &["", "factor", "S1", "95 %", "ST", "95 %"],
        Effects::Morris(_) => &["", "factor", "μ*", "μ", "σ"],
    };
    let rows: Vec<Vec<String>> = ranking
        .matters
        .iter()
        .map(|i| {
            let factor = &sensitivity.factors[*i];
            let mut row = vec![factor.variable.symbol.into(), factor.path.into()];
            row.extend(numbers(&index.effects, *i));
            row
        })
        .collect();
    if !rows.is_empty() {
        sheet.table(header, &[1], &rows);
    }
    if !ranking.negligible.is_empty() {
        let list = labels(&sensitivity.factors, &ranking.negligible);
        sheet.line(&format!("do not matter (together less than 1 %): {list}"));
    }
    if !ranking.unknown.is_empty() {
        let list = labels(&sensitivity.factors, &ranking.unknown);
        sheet.line(&format!("too few evaluations: {list}"));
    }
}

/// "critical speed: geometric mean 448.0 km/h (278.4 mph), standard deviation × 1.12".
fn heading(index: &IndexSensitivity) -> String {
    let (words, quantity) = (index.index.words(), index.index.quantity());
    let Some([mean, deviation]) = index.moments else {
        return words.into();
    };
    match index.index.scale() {
        Scale::Logarithmic => {
            let [si, us] = both(quantity, mean.exp());
            let us = if us.is_empty() {
                us
            } else {
                format!(" ({us})")
            };
            let factor = significant(deviation.exp(), 3);
            format!("{words}: geometric mean {si}{us}, standard deviation × {factor}")
        }
        Scale::Linear => {
            let [mean, deviation] = [mean, deviation].map(|x| significant(x, 3));
            format!("{words}: mean {mean}, standard deviation {deviation}")
        }
    }
}

fn numbers(effects: &Effects, factor: usize) -> Vec<String> {
    let two = |x: f64| format!("{x:.2}");
    let interval = |e: &Estimate| {
        let [low, high] = e.interval.map(two);
        format!("{low} – {high}")
    };
    match effects {
        Effects::Sobol(effects) => effects[factor].map_or(Vec::new(), |e| {
            vec![
                two(e.first.value),
                interval(&e.first),
                two(e.total.value),
                interval(&e.total),
            ]
        }),
        Effects::Morris(effects) => effects[factor].map_or(Vec::new(), |e| {
            [e.mu_star, e.mu, e.sigma]
                .map(|x| format!("{x:.3}"))
                .to_vec()
        }),
    }
}

fn labels(factors: &[Factor], which: &[usize]) -> String {
    let labels: Vec<&str> = which.iter().map(|i| factors[*i].label()).collect();
    labels.join(", ")
}
