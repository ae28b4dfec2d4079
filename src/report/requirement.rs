//! The task: service, requirements and limits, objective, what may vary, conditions.

use maud::{Markup, html};

use super::{
    Report,
    table::{Column, table},
};
use crate::{
    index::{Demands, Sense},
    spec::{Condition, Freedom, Order, keys},
    units::{
        Quantity,
        number::{both, significant, value},
    },
};

/// The section.
pub fn requirement(report: &Report) -> Markup {
    let spec = report.spec;
    let case = &spec.case;
    html! {
        section #requirement aria-labelledby="requirement-title" {
            h2 #requirement-title { "The requirement" }
            dl {
                dt { "operating speed" }
                dd { (value(Quantity::Speed, case.service.speed)) }
                dt { "track" }
                dd { (case.service.track.name) }
                dt { "wheel conicity as given" }
                dd { (significant(case.wheel_rail.conicity, 3)) }
                dt { "objective" }
                dd { (objective(report)) }
                dt { "order of the design" }
                dd {
                    @match spec.design.order {
                        Order::Sequential if spec.objective.is_empty() => {
                            "the three trade-offs in turn, then all at once"
                        }
                        Order::Sequential | Order::Joint => "all parameters at once",
                    }
                }
            }
            (demands("Requirements and limits asked for", &spec.demands))
            (freedom(report))
            @for condition in &spec.conditions { (further(condition)) }
        }
    }
}

fn objective(report: &Report) -> String {
    let goals = &report.spec.objective;
    if goals.is_empty() {
        return "the methodology's own, one for each trade-off".into();
    }
    let goals = goals.iter().map(|goal| {
        let verb = match goal.index.sense() {
            Sense::AtLeast => "greatest",
            Sense::AtMost => "least",
        };
        let weight = significant(goal.weight, 3);
        format!("{verb} {} (weight {weight})", goal.index.words())
    });
    goals.collect::<Vec<_>>().join("; ")
}

fn demands(caption: &str, demands: &Demands) -> Markup {
    let rows: Vec<Vec<String>> = demands
        .iter()
        .map(|demand| {
            let [si, us] = both(demand.index.quantity(), demand.bound);
            let relation = match demand.index.sense() {
                Sense::AtLeast => "at least",
                Sense::AtMost => "at most",
            };
            let words = demand.index.words().into();
            vec![words, relation.into(), si, us]
        })
        .collect();
    if rows.is_empty() {
        return html! {};
    }
    let columns = [
        ("index", Column::Head),
        ("relation", Column::Text),
        ("SI", Column::Number),
        ("US", Column::Number),
    ];
    table(caption, &columns, &rows)
}

/// Variables with their bounds.
fn freedom(report: &Report) -> Markup {
    let mut rows = Vec::new();
    for (parameter, freedom) in &report.spec.design.parameters {
        let quantity = parameter.quantity();
        let [si, us] = match freedom {
            Freedom::Between(interval) => {
                let [low, high] = [interval.lower, interval.upper].map(|v| both(quantity, v));
                [0, 1].map(|k| {
                    if low[k].is_empty() {
                        String::new()
                    } else {
                        format!("{} to {}", low[k], high[k])
                    }
                })
            }
            Freedom::Choices(choices) => {
                let list: Vec<String> = choices.iter().map(|c| significant(*c, 3)).collect();
                [format!("one of {}", list.join(", ")), String::new()]
            }
            Freedom::Tied { to, ratio } => {
                let text = format!("{} × {}", significant(*ratio, 3), to.words());
                [text, String::new()]
            }
            Freedom::Fixed(fixed) => both(quantity, *fixed),
        };
        rows.push(vec![
            parameter.words().into(),
            parameter.symbol().into(),
            si,
            us,
        ]);
    }
    if rows.is_empty() {
        return html! { p { "Nothing is open to design." } };
    }
    let columns = [
        ("parameter", Column::Head),
        ("symbol", Column::Symbol),
        ("SI", Column::Number),
        ("US", Column::Number),
    ];
    table("What may vary", &columns, &rows)
}

/// A further condition: what differs in it.
fn further(condition: &Condition) -> Markup {
    let mut rows = Vec::new();
    if let Some(track) = &condition.track {
        rows.push(vec!["track".into(), track.name.clone(), String::new()]);
    }
    for (path, si) in &condition.values {
        if let Some(key) = keys::at(path) {
            let [si, us] = both(key.quantity, *si);
            rows.push(vec![(*path).into(), si, us]);
        }
    }
    let caption = format!("Condition “{}”", condition.name);
    let columns = [
        ("key", Column::Head),
        ("SI", Column::Number),
        ("US", Column::Number),
    ];
    html! {
        (table(&caption, &columns, &rows))
        (demands(&format!("Asked for in “{}”", condition.name), &condition.demands))
    }
}
