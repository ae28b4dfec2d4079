//! What a design and a front promise. Each broken promise is a line that begins with its kind.

use bogie::{
    case::Case,
    design::{
        margin::{Margin, margins, value, worst_value},
        outcome::DesignResult,
        pareto::{Front, pareto},
        procedure::{DesignError, design},
    },
    export::{design_json, design_text, pareto as front_json},
    index::{Demand, Index, Scale, Sense},
    optimize::{
        archive::{Archive, Silent, Stop},
        local::{KKT_TOLERANCE, Status},
        problem::Failure,
    },
    parameter::Parameter,
    spec::{DesignSpace, Freedom, Spec},
};

/// Relative rounding of a value that goes through a frequency or a damping ratio and back.
const ROUNDING: f64 = 1e-9;

/// What a design of a study breaks.
pub fn of_design(spec: &Spec, budget: usize, twice: bool) -> Vec<String> {
    let archive = Archive::new(&Silent).with_budget(Some(budget));
    let mut broken = Vec::new();
    let result = match design(spec, &archive) {
        Ok(result) => result,
        Err(error) => return refusal(spec, &error).into_iter().collect(),
    };
    if archive.count() > budget || result.effort.evaluations != archive.count() {
        let count = result.effort.evaluations;
        broken.push(format!(
            "budget: {count} and {} of {budget}",
            archive.count()
        ));
    }
    if result.stopped != archive.stopped() || matches!(result.stopped, Some(Stop::Interrupted)) {
        broken.push(format!("how it ended: {:?}", result.stopped));
    }
    let whole = if result.stopped.is_none() {
        ""
    } else {
        " ended early,"
    };
    broken.extend(
        outside(&spec.design, &result.case).map(|p| format!("outside its bounds,{whole} {p}")),
    );
    broken.extend(moved(spec, &result.case).map(|p| format!("moved though not open: {p}")));
    if let Some(failure) = result.failure()
        && all_evaluate(spec, &wanted(spec))
    {
        broken.push(format!(
            "no design evaluated: though the one given can be: {failure}"
        ));
    }
    broken.extend(wrong_margins(spec, &result));
    broken.extend(wrong_statuses(&result));
    broken.extend(wrong_freedom(spec, &result));
    if let Some(why) = worse_than_given(spec, &result) {
        broken.push(why);
    }
    let text = design_text::design("study", &result, spec, None, &[]);
    if !is_number(&format!("{result:?}")) || !is_number(&text) {
        broken.push("no number: in the result".into());
    }
    if twice {
        let json = |result: &DesignResult| {
            design_json::design("study", result, spec, "", None, &[]).to_string()
        };
        let archive = Archive::new(&Silent).with_budget(Some(budget));
        let again = design(spec, &archive);
        if again.map(|again| json(&again)).ok() != Some(json(&result)) {
            broken.push("another result: of the same study".into());
        }
    }
    broken
}

/// What a front of a study breaks.
pub fn of_front(spec: &Spec, budget: usize, twice: bool) -> Vec<String> {
    let run = || {
        let archive = Archive::new(&Silent).with_budget(Some(budget));
        (pareto(spec, &archive), archive.count(), archive.stopped())
    };
    let (front, count, stopped) = run();
    let mut broken = Vec::new();
    if count > budget {
        broken.push(format!("budget: {count} of {budget}"));
    }
    if let Some(failure) = front.failure
        && all_evaluate(spec, &spec.front.indices)
    {
        broken.push(format!(
            "no design evaluated: though the one given can be: {failure}"
        ));
    }
    if front.stopped != stopped || front.evaluations != count {
        broken.push(format!("how it ended: {:?}", front.stopped));
    }
    if front.points.len() > spec.front.points.max(2) {
        let (n, asked) = (front.points.len(), spec.front.points);
        broken.push(format!("too many points: {n} of {asked}"));
    }
    if front.points.is_empty() && stopped.is_none() && keeps_the_rest(spec, &spec.case) {
        broken.push("no front: though the design given keeps the rest".into());
    }
    for point in &front.points {
        let outside = outside(&spec.design, &point.case);
        broken.extend(outside.map(|p| format!("a point outside its bounds, {p}")));
        if point.explained.status == Status::Infeasible || !keeps_the_rest(spec, &point.case) {
            let status = point.explained.status;
            broken.push(format!("a point that breaks a demand: {status:?}"));
        }
        for (index, shown) in front.indices.iter().zip(&point.values) {
            let has = worst_value(&point.case, &spec.conditions, *index);
            if has.as_ref() != Ok(shown) {
                broken.push(format!("a point's value: {index:?} {shown} is {has:?}"));
            }
        }
        if !is_number(&format!("{point:?}")) {
            broken.push("no number: in a point".into());
        }
    }
    if dominated(&front) {
        broken.push("a dominated point".into());
    }
    // Seconds are no part of the result in JSON.
    let json = |front: &Front| front_json::json("study", front, spec, "").to_string();
    if twice && json(&run().0) != json(&front) {
        broken.push("another result: of the same study".into());
    }
    broken
}

/// Indices that a spec makes as good as can be.
fn wanted(spec: &Spec) -> Vec<Index> {
    if spec.objective.is_empty() {
        vec![
            Index::CriticalSpeed,
            Index::DegreeCurve,
            Index::LateralAcceleration,
            Index::VerticalAcceleration,
        ]
    } else {
        spec.objective.iter().map(|goal| goal.index).collect()
    }
}

/// A refusal that is not true.
fn refusal(spec: &Spec, error: &DesignError) -> Option<String> {
    let open = |f: &Freedom| matches!(f, Freedom::Between(_) | Freedom::Choices(_));
    let is_open = spec.design.parameters.iter().any(|(_, f)| open(f));
    match error {
        DesignError::NothingOpen if is_open => Some("nothing open: though something is".into()),
        DesignError::NoRequirement if !spec.objective.is_empty() => {
            Some("no requirement: though there is an objective".into())
        }
        DesignError::Eigen(error) => Some(format!("no eigenvalues: {error}")),
        _ => None,
    }
}

/// Whether the design given may be chosen, and has all of `indices` and all on which there is a demand, in
/// all conditions.
fn all_evaluate(spec: &Spec, indices: &[Index]) -> bool {
    let demanded = margins(&spec.case, &spec.demands, &spec.conditions);
    outside(&spec.design, &spec.case).next().is_none()
        && demanded.iter().all(|margin| margin.reached.is_ok())
        && indices
            .iter()
            .all(|index| worst_value(&spec.case, &spec.conditions, *index).is_ok())
}

/// Parameters whose value is not one that the design may take.
fn outside(space: &DesignSpace, case: &Case) -> impl Iterator<Item = String> {
    space.parameters.iter().filter_map(|(parameter, freedom)| {
        let value = parameter.get(case);
        let is = |wanted: f64| (value - wanted).abs() <= ROUNDING * wanted.abs();
        let may = match freedom {
            Freedom::Between(bounds) => {
                let slack = ROUNDING * bounds.upper.abs();
                (bounds.lower - slack..=bounds.upper + slack).contains(&value)
            }
            Freedom::Choices(choices) => choices.contains(&value),
            Freedom::Fixed(fixed) => is(*fixed),
            Freedom::Tied { to, ratio } => is(ratio * to.get(case)),
        };
        let form = match freedom {
            Freedom::Between(_) => "open",
            Freedom::Choices(_) => "chosen",
            Freedom::Fixed(_) => "set",
            Freedom::Tied { .. } => "tied",
        };
        (!may).then(|| format!("{form}: {} {value:?} by {freedom:?}", parameter.name()))
    })
}

/// Constants that are another than the vehicle's own though nothing in `[design]` sets them. A frequency
/// keeps the damping ratio, so that the damping goes with it.
fn moved(spec: &Spec, case: &Case) -> impl Iterator<Item = &'static str> {
    let sets = |constant: Parameter| {
        let listed = spec.design.parameters.iter().map(|(p, _)| *p);
        let with = match constant {
            Parameter::SECONDARY_LATERAL_DAMPING => Parameter::SECONDARY_LATERAL_FREQUENCY,
            Parameter::SECONDARY_VERTICAL_DAMPING => Parameter::SECONDARY_VERTICAL_FREQUENCY,
            other => other,
        };
        listed
            .into_iter()
            .any(|p| p.constant() == constant || p == with)
    };
    Parameter::plain_of_table()
        .filter(move |constant| {
            // Nothing computes with it: the same bits.
            let same = constant.get(case).to_bits() == constant.get(&spec.case).to_bits();
            !sets(*constant) && !same
        })
        .map(Parameter::name)
}

/// The demands of a spec and its conditions, with what a case reaches, each by itself.
fn expected(spec: &Spec, case: &Case) -> Vec<(Option<String>, Index, f64, Option<f64>)> {
    let nominal = (None, case.clone(), spec.demands.clone());
    let further = spec.conditions.iter().map(|condition| {
        let demands = spec.demands.overridden(&condition.demands);
        (Some(condition.name.clone()), condition.apply(case), demands)
    });
    let all = std::iter::once(nominal).chain(further);
    all.flat_map(|(name, case, demands)| {
        let demand = |index: Index| {
            let bound = demands.get(index)?;
            let reached = value(&case, index);
            // Where there is no curve there is no demand in it.
            (reached != Err(Failure::NoServiceCurve))
                .then(|| (name.clone(), index, bound, reached.ok()))
        };
        Index::ALL
            .into_iter()
            .filter_map(demand)
            .collect::<Vec<_>>()
    })
    .collect()
}

/// Every demand has its margin, met or not as its numbers say, and all is met where each is.
fn wrong_margins(spec: &Spec, result: &DesignResult) -> Vec<String> {
    let mut broken = Vec::new();
    let expected = expected(spec, &result.case);
    let found = result.margins.iter();
    let found: Vec<_> = found
        .map(|m| {
            (
                m.condition.clone(),
                m.index,
                m.required,
                m.reached.as_ref().ok().copied(),
            )
        })
        .collect();
    if found != expected {
        broken.push(format!("margins: {found:?} for {expected:?}"));
    }
    let met = |(_, index, bound, reached): &(_, Index, f64, Option<f64>)| {
        let (index, bound) = (*index, *bound);
        reached.is_some_and(|reached| Demand { index, bound }.met_by(reached))
    };
    if result.met() != (expected.iter().all(met) && result.failure().is_none()) {
        broken.push(format!("met: {} by {expected:?}", result.met()));
    }
    broken
}

fn wrong_statuses(result: &DesignResult) -> Vec<String> {
    let mut broken = Vec::new();
    let mut wrong = |what: &str, status: Status| {
        broken.push(format!("{what}: {status:?}, {:?}", result.stopped));
    };
    for stage in result.stages.iter().map(|stage| &stage.explained) {
        let status = stage.status;
        match status {
            Status::Infeasible if result.met() => wrong("all met and infeasible", status),
            Status::BudgetSpent | Status::Interrupted if result.stopped.is_none() => {
                wrong("ended early though not stopped", status);
            }
            Status::Optimal if stage.kkt_residual.is_none_or(|r| r > KKT_TOLERANCE) => {
                wrong("optimal without a certificate", status);
            }
            Status::Optimal if stage.violation.is_none_or(|v| v > 1e-4) => {
                wrong("optimal with a violation", status);
            }
            _ => {}
        }
    }
    // One trade-off alone, or all at once: what is optimal keeps all that its study asks.
    if let ([stage], true) = (&result.stages[..], result.joint.is_none())
        && stage.trade_off.is_none()
        && stage.explained.status == Status::Optimal
        && !result.met()
    {
        wrong("optimal and not met", Status::Optimal);
    }
    if result.met() && result.conflict.is_some() {
        wrong("all met and in conflict", Status::Infeasible);
    }
    broken
}

/// What the design delivered and the ranges of the variables say that is not so.
fn wrong_freedom(spec: &Spec, result: &DesignResult) -> Vec<String> {
    let mut broken = Vec::new();
    let says = !result.free.is_empty() || !result.is_optimum();
    if says && !result.met() {
        broken.push("freedom: though demands are missed".into());
    }
    if result.is_optimum() && result.case != result.optimum {
        broken.push("delivered: not the optimum it is called".into());
    }
    for loss in &result.losses {
        let most = spec.design.deliver_within * (1.0 + ROUNDING.sqrt());
        let own = loss.index.map_or(loss.share, |index| {
            let has = |case| worst_value(case, &spec.conditions, index).unwrap_or(f64::NAN);
            let [own, best] = [has(&result.case), has(&result.optimum)];
            match (index.sense(), index.scale()) {
                (Sense::AtLeast, Scale::Logarithmic) => 1.0 - own / best,
                (Sense::AtMost, Scale::Logarithmic) => own / best - 1.0,
                (_, Scale::Linear) => (best - own) / best.abs(),
            }
        });
        let differs = (own - loss.share).abs() > ROUNDING.sqrt();
        if !own.is_finite() || own > most || loss.share > most || differs {
            broken.push(format!("loss: {} {own} told {}", loss.goal, loss.share));
        }
    }
    let small = spec.design.deliver_within <= spec.design.free_within;
    for free in &result.free {
        let Some(Freedom::Between(bounds)) = spec.design.freedom(free.parameter) else {
            broken.push(format!("free: {} is not open", free.parameter.name()));
            continue;
        };
        let slack = ROUNDING * bounds.upper;
        let [from, to] = free.ends.map(|end| end.value);
        if from < bounds.lower - slack || to > bounds.upper + slack {
            broken.push(format!("free: {} beyond its bounds", free.parameter.name()));
        }
        let designs = [Some(&result.optimum), Some(&result.case).filter(|_| small)];
        for case in designs.into_iter().flatten() {
            let value = free.parameter.get(case);
            if value < from - slack || value > to + slack {
                let name = free.parameter.name();
                broken.push(format!("free: {name} {value} outside {from} to {to}"));
            }
        }
    }
    broken
}

/// A design given that keeps all demands is not answered by one that does not.
fn worse_than_given(spec: &Spec, result: &DesignResult) -> Option<String> {
    let strictly = |margin: &Margin| {
        margin
            .reached
            .as_ref()
            .is_ok_and(|reached| match margin.index.sense() {
                Sense::AtLeast => *reached >= margin.required,
                Sense::AtMost => *reached <= margin.required,
            })
    };
    let given = margins(&spec.case, &spec.demands, &spec.conditions);
    let may_be_kept = outside(&spec.design, &spec.case).next().is_none();
    if may_be_kept && given.iter().all(strictly) && !result.met() {
        let unmet: Vec<String> = result.unmet().map(Margin::key).collect();
        let statuses = result.stages.iter().map(|s| s.explained.status);
        let statuses: Vec<Status> = statuses.collect();
        return Some(format!(
            "worse than given: {} by {statuses:?}, {:?}",
            unmet.join(", "),
            result.stopped
        ));
    }
    None
}

/// Whether a design keeps the demands on indices that the front does not trade off, and the front's bounds.
fn keeps_the_rest(spec: &Spec, case: &Case) -> bool {
    let margins = margins(case, &spec.demands, &spec.conditions);
    let mut rest = margins
        .iter()
        .filter(|margin| !spec.front.indices.contains(&margin.index));
    let within = |index: Index, bound: f64| {
        worst_value(case, &spec.conditions, index)
            .is_ok_and(|value| Demand { index, bound }.met_by(value))
    };
    let indices = &spec.front.indices;
    outside(&spec.design, case).next().is_none()
        && rest.all(Margin::met)
        && spec.front.bounds.iter().all(|d| within(d.index, d.bound))
        && indices
            .iter()
            .all(|index| worst_value(case, &spec.conditions, *index).is_ok())
}

/// Whether a point is as good as another in every index and better in one.
fn dominated(front: &Front) -> bool {
    let better = |index: Index, a: f64, b: f64| {
        let scale = match index.scale() {
            Scale::Logarithmic => b.abs(),
            Scale::Linear => 1.0,
        };
        let gain = match index.sense() {
            Sense::AtLeast => a - b,
            Sense::AtMost => b - a,
        };
        gain / scale
    };
    let gains = |a: &[f64], b: &[f64]| -> Vec<f64> {
        let pairs = front.indices.iter().zip(a.iter().zip(b));
        pairs
            .map(|(index, (a, b))| better(*index, *a, *b))
            .collect()
    };
    front.points.iter().any(|b| {
        front.points.iter().any(|a| {
            let gains = gains(&a.values, &b.values);
            gains.iter().all(|gain| *gain >= 0.0) && gains.iter().any(|gain| *gain > ROUNDING)
        })
    })
}

/// Whether no number in a text is none.
fn is_number(text: &str) -> bool {
    let mut words = text.split(|c: char| !c.is_alphanumeric());
    words.all(|word| !["NaN", "nan", "inf"].contains(&word))
}
