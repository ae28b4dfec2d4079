//! `bogie modes`: modes at speed, and damping against speed.

use serde_json::{Value, json};

use super::{evaluation_json, evaluation_text::title, sheet::Sheet};
use crate::{
    case::Case,
    dynamics::{LateralModel, VerticalModel},
    evaluate::modes::{AtSpeed, LateralModes, VerticalMode, vertical_modes},
    numerics::{EigenError, Poles},
    units::{
        Quantity,
        number::{both, significant},
    },
};

/// Modes of both models of a case.
#[derive(Debug, Clone)]
pub struct Modes {
    /// Lateral, at the operating speed.
    pub lateral: LateralModes,
    /// Vertical.
    pub vertical: Vec<VerticalMode>,
    /// Lateral at other speeds, m/s.
    pub against_speed: Vec<(f64, LateralModes)>,
}

impl Modes {
    /// Computes them, and the lateral ones at `speeds`, m/s.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues cannot be had.
    pub fn new(case: &Case, speeds: &[f64]) -> Result<Self, EigenError> {
        let model = LateralModel::new(case);
        let at = |speed: f64| {
            let poles = Poles::at(&model.forced, speed)?;
            LateralModes::new(&model, case, &poles)
        };
        let vertical = VerticalModel::new(case);
        let poles = Poles::at(&vertical.forced, case.service.speed)?;
        Ok(Self {
            lateral: at(case.service.speed)?,
            vertical: vertical_modes(&vertical, &poles)?,
            against_speed: speeds
                .iter()
                .map(|&v| Ok((v, at(v)?)))
                .collect::<Result<_, EigenError>>()?,
        })
    }

    /// As text.
    pub fn text(&self, name: &str, case: &Case) -> String {
        let mut sheet = Sheet::new(&title(name, case));
        sheet.heading("Lateral model at the operating speed");
        let rows: Vec<Vec<String>> = self
            .lateral
            .oscillatory
            .iter()
            .map(|m| {
                vec![
                    m.shape.to_string(),
                    significant(m.frequency, 4),
                    significant(m.damping_ratio, 3),
                    percent(m.carbody_share),
                ]
            })
            .collect();
        sheet.table(&["mode", "Hz", "ζ", "% energy in carbody"], &[], &rows);
        let real: Vec<String> = self
            .lateral
            .real
            .iter()
            .map(|s| significant(*s, 4))
            .collect();
        if !real.is_empty() {
            sheet.line(&format!("real eigenvalues, 1/s: {}", real.join("  ")));
        }
        if self.lateral.status() != AtSpeed::Stable {
            sheet.line(&format!(
                "{}: {}",
                self.lateral.status().code(),
                self.lateral.status()
            ));
        }
        sheet.heading("Vertical model");
        let rows: Vec<Vec<String>> = self
            .vertical
            .iter()
            .map(|m| {
                vec![
                    m.shape.to_string(),
                    significant(m.frequency, 4),
                    significant(m.damping_ratio, 3),
                ]
            })
            .collect();
        sheet.table(&["mode", "Hz", "ζ"], &[], &rows);
        if !self.against_speed.is_empty() {
            sheet.heading("Damping against speed");
            let rows: Vec<Vec<String>> = self
                .against_speed
                .iter()
                .map(|(v, m)| speed_row(*v, m))
                .collect();
            sheet.table(
                &[
                    "km/h",
                    "mph",
                    "kinematic Hz",
                    "ζ",
                    "least-damped Hz",
                    "ζ",
                    "mode",
                ],
                &[6],
                &rows,
            );
        }
        sheet.finish()
    }

    /// As JSON.
    pub fn json(&self, name: &str, case: &Case) -> Value {
        json!({
            "name": name,
            "speed_m_per_s": case.service.speed,
            "modes_at_speed": evaluation_json::modes(&self.lateral),
            "real_eigenvalues_per_s": self.lateral.real,
            "stable_at_speed": self.lateral.stable(),
            "status": self.lateral.status().code(),
            "status_text": self.lateral.status().to_string(),
            "kinematic_mode": kinematic(&self.lateral),
            "vertical_modes": self.vertical.iter().map(evaluation_json::vertical_mode).collect::<Vec<_>>(),
            "against_speed": self.against_speed.iter().map(|(v, m)| json!({
                "speed_m_per_s": v,
                "modes": evaluation_json::modes(m),
                "status": m.status().code(),
                "kinematic_mode": kinematic(m),
            })).collect::<Vec<_>>(),
        })
    }
}

fn kinematic(modes: &LateralModes) -> Option<Value> {
    modes
        .kinematic
        .as_ref()
        .map(evaluation_json::kinematic_mode)
}

/// A share in whole per cent.
fn percent(share: f64) -> String {
    if share < 0.005 {
        "< 0.5".into()
    } else {
        format!("{:.0}", 100.0 * share)
    }
}

fn speed_row(v: f64, modes: &LateralModes) -> Vec<String> {
    let number = |text: &str| text.split(' ').next().unwrap_or_default().to_string();
    let [si, us] = both(Quantity::Speed, v).map(|t| number(&t));
    let mut row = vec![si, us];
    let kinematic = modes.kinematic.as_ref();
    let least = modes.least_damped();
    for mode in [
        kinematic.map(|m| (m.frequency, m.damping_ratio)),
        least.map(|m| (m.frequency, m.damping_ratio)),
    ] {
        row.extend(mode.map_or(
            ["–".into(), "–".into()],
            |(frequency, damping_ratio)| [significant(frequency, 4), significant(damping_ratio, 3)],
        ));
    }
    row.push(
        modes
            .least_damped()
            .map_or(String::new(), |m| m.shape.to_string()),
    );
    row
}
