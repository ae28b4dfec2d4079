//! Critical speed against stiffnesses (Figures 4.5.8, 4.5.9, 4.5.10 and 4.6.5).

use std::sync::atomic::{AtomicBool, Ordering};

use super::{
    Entry,
    performance::critical_speed,
    sampling::sample,
    workbook::{CONICITIES, Workbook},
};
use crate::{
    case::Case,
    index::Index,
    parameter::Parameter,
    plot::{Axis, Curve, Direction, Family, Figure, Mark, Panel, Stroke},
    units::{
        Quantity,
        us::{FOOT, LBF},
    },
};

/// Over a primary stiffness, by conicity.
pub(super) fn by_conicity(book: &Workbook, entry: &Entry, over: Parameter) -> Figure {
    let [bending, lateral] = book.stiffness_axes();
    let (x, fixed) = if over == Parameter::PRIMARY_BENDING_STIFFNESS {
        (bending, Parameter::PRIMARY_LATERAL_STIFFNESS)
    } else {
        (lateral, Parameter::PRIMARY_BENDING_STIFFNESS)
    };
    let parameters: Vec<(String, f64)> = CONICITIES
        .into_iter()
        .map(|conicity| (format!("λ = {conicity}"), conicity))
        .collect();
    let (panel, everywhere) = panel(book, x, &parameters, &|case, conicity, value| {
        Parameter::CONICITY.set(case, conicity);
        over.set(case, value);
    });
    let mut figure = entry
        .figure(format!(
            "Influence of {} on the critical speed",
            over.words()
        ))
        .panel(marked(book, panel, over))
        .described(format!(
            "Critical speed over the {}, a curve for each of five wheel conicities; the design is \
             marked.",
            over.words()
        ));
    figure.subtitle = book.subtitle(None, &[fixed, Parameter::SECONDARY_YAW_STIFFNESS]);
    noted(book, figure, everywhere)
}

/// Factors on the primary stiffnesses.
const FACTORS: [f64; 3] = [0.5, 1.0, 2.0];

/// Over the secondary yaw stiffness, by a factor on the primary stiffnesses.
pub(super) fn by_primary(book: &Workbook, entry: &Entry) -> Figure {
    let over = Parameter::SECONDARY_YAW_STIFFNESS;
    let range = [1e5 * LBF * FOOT, 1e8 * LBF * FOOT];
    let x = book.parameter_axis(over, range);
    let parameters: Vec<(String, f64)> = FACTORS
        .into_iter()
        .map(|factor| {
            let label = if (factor - 1.0).abs() < 1e-9 {
                "design’s primary stiffnesses".into()
            } else {
                format!("{factor} × primary stiffnesses")
            };
            (label, factor)
        })
        .collect();
    let (panel, everywhere) = panel(book, x, &parameters, &|case, factor, value| {
        for primary in [
            Parameter::PRIMARY_LONGITUDINAL_STIFFNESS,
            Parameter::PRIMARY_LATERAL_STIFFNESS,
        ] {
            let stiffness = factor * primary.get(case);
            primary.set(case, stiffness);
        }
        over.set(case, value);
    });
    let mut figure = entry
        .figure("Influence of secondary yaw stiffness on the critical speed")
        .panel(marked(book, panel, over))
        .described(
            "Critical speed over the secondary yaw stiffness, a curve for each of three factors \
             on the primary longitudinal and lateral stiffnesses; the design is marked.",
        );
    figure.subtitle = book.subtitle(
        None,
        &[
            Parameter::CONICITY,
            Parameter::PRIMARY_BENDING_STIFFNESS,
            Parameter::PRIMARY_LATERAL_STIFFNESS,
        ],
    );
    noted(book, figure, everywhere)
}

/// A panel of critical speeds, and whether some vehicle is stable over the whole range searched.
fn panel(
    book: &Workbook,
    x: Axis,
    parameters: &[(String, f64)],
    set: &(impl Fn(&mut Case, f64, f64) + Sync),
) -> (Panel, bool) {
    let everywhere = AtomicBool::new(false);
    let curves: Vec<Curve> = parameters
        .iter()
        .enumerate()
        .map(|(i, (label, parameter))| {
            let points = sample(book, x.scale, x.range, |value| {
                let mut case = book.case().clone();
                set(&mut case, *parameter, value);
                let found = critical_speed(&case).ok()?;
                everywhere.fetch_or(found.is_none(), Ordering::Relaxed);
                found
            });
            Curve::line(label.clone(), points)
                .at(*parameter)
                .stroke(Stroke::nth(i))
        })
        .collect();
    let family = Family::new("parameter", "", Stroke::default()).curves(curves);
    let most = family.curves.iter().flat_map(Curve::points).map(|p| p[1]);
    let y = book
        .critical_speed_axis([0.0, 0.0])
        .holding(most.chain([book.case().service.speed]));
    let panel = Panel::new("", x, y)
        .with(family)
        .limit(book.required(Index::CriticalSpeed, Direction::Y));
    (panel, everywhere.into_inner())
}

fn marked(book: &Workbook, panel: Panel, over: Parameter) -> Panel {
    let own = critical_speed(book.case()).ok().flatten();
    panel.mark(own.map(|speed| Mark::design([over.get(book.case()), speed])))
}

fn noted(book: &Workbook, figure: Figure, everywhere: bool) -> Figure {
    if !everywhere {
        return figure;
    }
    let end = book.value(Quantity::Speed, book.case().model.speed_range[1], 3);
    figure.note(format!(
        "No curve where the vehicle is stable up to {end}, the end of the range searched."
    ))
}
