//! Curves, and families of curves that mean the same at different values of a parameter.

use serde::Serialize;

use super::Stroke;

/// Where the labels of a family's curves stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Labels {
    /// On the curves, along them; in the legend where there is no place.
    #[default]
    Inline,
    /// In the legend.
    Legend,
    /// Nowhere.
    None,
}

/// A curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curve {
    /// Label, with subscripts as in `K_py`; may be empty.
    pub label: String,
    /// Value of the family's parameter, SI.
    pub value: Option<f64>,
    /// Its look, where it is not that of the family.
    pub stroke: Option<Stroke>,
    /// Points (x, y), SI, in pieces: between pieces there is no curve.
    pub pieces: Vec<Vec<[f64; 2]>>,
    /// Whether its points are marked, being all that is known.
    pub dots: bool,
}

impl Curve {
    /// A curve through points; where one is not finite the curve is interrupted.
    pub fn line(label: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut pieces = vec![Vec::new()];
        for point in points {
            if point.iter().all(|x| x.is_finite()) {
                if let Some(piece) = pieces.last_mut() {
                    piece.push(point);
                }
            } else {
                pieces.push(Vec::new());
            }
        }
        pieces.retain(|piece| !piece.is_empty());
        Self::pieces(label, pieces)
    }

    /// A curve in pieces.
    pub fn pieces(label: impl Into<String>, pieces: Vec<Vec<[f64; 2]>>) -> Self {
        Self {
            label: label.into(),
            value: None,
            stroke: None,
            pieces,
            dots: false,
        }
    }

    /// The same curve at a value of the family's parameter, SI.
    #[must_use]
    pub fn at(self, value: f64) -> Self {
        Self {
            value: Some(value),
            ..self
        }
    }

    /// The same curve with another look than its family.
    #[must_use]
    pub fn stroke(self, stroke: Stroke) -> Self {
        Self {
            stroke: Some(stroke),
            ..self
        }
    }

    /// The same curve with its points marked.
    #[must_use]
    pub fn dotted(self) -> Self {
        Self { dots: true, ..self }
    }

    /// All points.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.pieces.iter().flatten().copied()
    }
}

/// Curves that mean the same.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Family {
    /// Name in style classes and files.
    pub id: String,
    /// Entry of the family in the legend; empty: none.
    pub title: String,
    /// Look of its curves.
    pub stroke: Stroke,
    /// Where the curves' labels stand.
    pub labels: Labels,
    /// The curves.
    pub curves: Vec<Curve>,
}

impl Family {
    /// A family without curves.
    pub fn new(id: impl Into<String>, title: impl Into<String>, stroke: Stroke) -> Self {
        Self {
            id: id.into(),
            title: title.into(),
            stroke,
            labels: Labels::Inline,
            curves: Vec::new(),
        }
    }

    /// With one more curve.
    #[must_use]
    pub fn curve(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// With more curves.
    #[must_use]
    pub fn curves(mut self, curves: impl IntoIterator<Item = Curve>) -> Self {
        self.curves.extend(curves);
        self
    }

    /// With its curves' labels elsewhere.
    #[must_use]
    pub fn labelled(mut self, labels: Labels) -> Self {
        self.labels = labels;
        self
    }

    /// The curve at a value of the parameter, SI.
    pub fn at(&self, value: f64) -> Option<&Curve> {
        let same = |v: f64| (v - value).abs() <= 1e-9 * value.abs();
        self.curves.iter().find(|c| c.value.is_some_and(same))
    }

    /// Look of one of its curves.
    pub fn stroke_of(&self, curve: &Curve) -> Stroke {
        curve.stroke.unwrap_or(self.stroke)
    }
}
