//! The influence of the yaw breakaway torque on curving (Figure A.2).

use super::{
    Entry, curving::degree_axis, performance::degree_curve, sampling::sample, workbook::Workbook,
};
use crate::{
    index::Index,
    parameter::Parameter,
    plot::{Curve, Direction, Family, Figure, Mark, Panel, Scale, Stroke},
    units::us::{FOOT, LBF},
};

/// Yaw stiffnesses of Figure A.2, lbf ft/rad: the report names neither them nor its curves; these
/// are the one that it adopts, half of it, and its highest.
const YAW: [f64; 3] = [0.5e6, 1e6, 6e6];

/// Degree curve over the yaw breakaway torque for three yaw stiffnesses.
pub(super) fn draw(book: &Workbook, entry: &Entry) -> Figure {
    let torque = Parameter::SECONDARY_YAW_BREAKAWAY_TORQUE;
    let yaw = Parameter::SECONDARY_YAW_STIFFNESS;
    let x = book
        .axis(
            torque.words(),
            torque.symbol(),
            &torque.column(),
            torque.quantity(),
            Scale::Linear,
            [0.0, 20_000.0 * LBF * FOOT],
        )
        .holding([torque.get(book.case())]);
    let curves: Vec<Curve> = YAW
        .into_iter()
        .enumerate()
        .map(|(i, stiffness)| {
            let stiffness = stiffness * LBF * FOOT;
            let points = sample(book, x.scale, x.range, |t| {
                degree_curve(&book.with(&[(torque, t), (yaw, stiffness)]))
            });
            let label = format!("K_sψ = {}", book.value(yaw.quantity(), stiffness, 2));
            Curve::line(label, points)
                .at(stiffness)
                .stroke(Stroke::nth(i))
        })
        .collect();
    let own = degree_curve(book.case());
    let values = curves
        .iter()
        .flat_map(Curve::points)
        .map(|p| p[1])
        .chain(own);
    let y = degree_axis([0.0, 0.0]).holding(values.collect::<Vec<_>>());
    let panel = Panel::new("", x, y)
        .with(Family::new("yaw-stiffness", "", Stroke::default()).curves(curves))
        .mark(own.map(|degree| Mark::design([torque.get(book.case()), degree])))
        .limit(book.required(Index::DegreeCurve, Direction::Y));
    let mut figure = entry
        .figure("Degree curve against secondary yaw breakaway torque")
        .panel(panel)
        .described(
            "Degree curve over the secondary yaw breakaway torque, for three secondary yaw \
             stiffnesses; the design is marked.",
        )
        .note(
            "The figure in the report is lost, and its three yaw stiffnesses with it; those here \
             are values that its text names or adopts.",
        );
    figure.subtitle = book.subtitle(
        None,
        &[
            Parameter::CONICITY,
            Parameter::PRIMARY_BENDING_STIFFNESS,
            Parameter::PRIMARY_LATERAL_STIFFNESS,
            yaw,
        ],
    );
    figure
}
