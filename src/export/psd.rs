//! `bogie psd`: power spectra of accelerations and strokes against frequency.

use serde_json::{Map, Value, json};

use super::{
    evaluation_json::{ride_status, ride_status_text},
    evaluation_text::title,
    sheet::Sheet,
    table::Table,
};
use crate::{
    case::Case,
    dynamics::{ForcedModel, LateralModel, VerticalModel, lateral, vertical},
    evaluate::ride::{NoRide, response::Response, stationary},
    numerics::{EigenError, Poles, elimination::LANES},
    units::number::significant,
};

/// A spectrum: name with unit, values.
type Column = (&'static str, Vec<f64>);

/// One-sided power spectral densities per Hz.
#[derive(Debug, Clone)]
pub struct Spectra {
    /// Hz.
    pub frequency: Vec<f64>,
    /// Lateral outputs, or why there is no stationary response.
    pub lateral: Result<Vec<Column>, NoRide>,
    /// Vertical outputs likewise.
    pub vertical: Result<Vec<Column>, NoRide>,
}

const LATERAL: [(&str, usize); 7] = [
    (
        "acceleration_cg_m2_per_s4_hz",
        lateral::output::ACCELERATION.start,
    ),
    (
        "acceleration_front_m2_per_s4_hz",
        lateral::output::ACCELERATION.start + 1,
    ),
    (
        "acceleration_rear_m2_per_s4_hz",
        lateral::output::ACCELERATION.start + 2,
    ),
    (
        "roll_acceleration_rad2_per_s4_hz",
        lateral::output::ROLL_ACCELERATION,
    ),
    (
        "secondary_stroke_leading_m2_per_hz",
        lateral::output::SECONDARY_STROKE.start,
    ),
    (
        "secondary_stroke_trailing_m2_per_hz",
        lateral::output::SECONDARY_STROKE.start + 1,
    ),
    (
        "wheelset_1_excursion_m2_per_hz",
        lateral::output::EXCURSION.start,
    ),
];

const VERTICAL: [(&str, usize); 7] = [
    (
        "acceleration_cg_m2_per_s4_hz",
        vertical::output::ACCELERATION.start,
    ),
    (
        "acceleration_front_m2_per_s4_hz",
        vertical::output::ACCELERATION.start + 1,
    ),
    (
        "acceleration_rear_m2_per_s4_hz",
        vertical::output::ACCELERATION.start + 2,
    ),
    (
        "roll_acceleration_rad2_per_s4_hz",
        vertical::output::ROLL_ACCELERATION,
    ),
    (
        "secondary_stroke_leading_m2_per_hz",
        vertical::output::SECONDARY_STROKE.start,
    ),
    (
        "secondary_stroke_trailing_m2_per_hz",
        vertical::output::SECONDARY_STROKE.start + 1,
    ),
    ("wheel_1_load_n2_per_hz", vertical::output::WHEEL_LOAD.start),
];

impl Spectra {
    /// Spectra at `points` frequencies, equally spaced on a logarithmic axis over the band of the
    /// case.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if it cannot be known whether there is a stationary response.
    pub fn new(case: &Case, points: usize) -> Result<Self, EigenError> {
        let [low, high] = case.model.frequency_band;
        let step = (high / low).ln() / (points.max(2) - 1) as f64;
        let frequency: Vec<f64> = (0..points.max(2))
            .map(|i| low * (step * i as f64).exp())
            .collect();
        let of = |model: &ForcedModel, wanted: &[(&'static str, usize)]| {
            let poles = Poles::at(model, case.service.speed)?;
            let stationary = stationary(model, &poles);
            Ok(stationary.map(|()| columns(model, case, &frequency, wanted)))
        };
        let lateral = of(&LateralModel::new(case).forced, &LATERAL)?;
        let vertical = of(&VerticalModel::new(case).forced, &VERTICAL)?;
        Ok(Self {
            frequency,
            lateral,
            vertical,
        })
    }

    /// As text: accelerations and strokes at every fourth frequency.
    pub fn text(&self, name: &str, case: &Case) -> String {
        let mut sheet = Sheet::new(&title(name, case));
        for (heading, columns) in [
            ("Lateral", self.lateral.as_ref()),
            ("Vertical", self.vertical.as_ref()),
        ] {
            let columns = match columns {
                Ok(columns) => columns,
                Err(reason) => {
                    sheet.heading(heading);
                    sheet.line(&format!("none: {reason}"));
                    continue;
                }
            };
            sheet.heading(&format!("{heading} power spectral density (one-sided)"));
            let rows: Vec<Vec<String>> = (0..self.frequency.len())
                .step_by(4)
                .map(|i| {
                    let mut row = vec![significant(self.frequency[i], 3)];
                    row.extend(
                        columns[..6]
                            .iter()
                            .map(|(_, values)| significant(values[i], 3)),
                    );
                    row
                })
                .collect();
            sheet.table(
                &[
                    "Hz",
                    "c.g. (m/s²)²/Hz",
                    "front",
                    "rear",
                    "roll (rad/s²)²/Hz",
                    "stroke 1 m²/Hz",
                    "stroke 2",
                ],
                &[],
                &rows,
            );
        }
        sheet.finish()
    }

    /// As JSON.
    pub fn json(&self, name: &str, case: &Case) -> Value {
        let object = |columns: &[Column]| {
            Value::Object(
                columns
                    .iter()
                    .map(|(n, v)| ((*n).to_string(), json!(v)))
                    .collect::<Map<_, _>>(),
            )
        };
        json!({
            "name": name,
            "speed_m_per_s": case.service.speed,
            "track": case.service.track.name,
            "frequency_hz": self.frequency,
            "lateral": self.lateral.as_deref().map(object).ok(),
            "lateral_status": ride_status(&self.lateral),
            "lateral_status_text": ride_status_text(&self.lateral),
            "vertical": self.vertical.as_deref().map(object).ok(),
            "vertical_status": ride_status(&self.vertical),
            "vertical_status_text": ride_status_text(&self.vertical),
        })
    }

    /// As a table, a row per frequency.
    pub fn table(&self) -> Table {
        let mut table = Table::new();
        table.number("frequency_hz", self.frequency.iter().copied());
        let lateral = self.lateral.iter().flatten().map(|c| ("lateral", c));
        let vertical = self.vertical.iter().flatten().map(|c| ("vertical", c));
        for (direction, (name, values)) in lateral.chain(vertical) {
            table.number(format!("{direction}_{name}"), values.iter().copied());
        }
        table
    }
}

fn columns(
    model: &ForcedModel,
    case: &Case,
    frequency: &[f64],
    wanted: &[(&'static str, usize)],
) -> Vec<Column> {
    let mut response = Response::new(model, &case.service.track, case.service.speed);
    let mut densities = vec![[0.0; LANES]; model.outputs.len()];
    let mut columns: Vec<Column> = wanted.iter().map(|(name, _)| (*name, Vec::new())).collect();
    for chunk in frequency.chunks(LANES) {
        let mut f = [chunk[0]; LANES];
        f[..chunk.len()].copy_from_slice(chunk);
        response.densities(&f, &mut densities);
        for ((_, values), (_, output)) in columns.iter_mut().zip(wanted) {
            values.extend(&densities[*output][..chunk.len()]);
        }
    }
    columns
}
