//! Figures: the content of a chart, without its layout.

use serde::Serialize;

use super::{Axis, Family, Field, Limit, Mark, Shade};

/// A chart of one or more panels.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// Figure number, or several.
    pub number: String,
    /// Name, as commands and files have it.
    pub name: String,
    /// Title.
    pub title: String,
    /// Case and conditions shown.
    pub subtitle: String,
    /// Content in words, for readers who cannot see it.
    pub description: String,
    /// Side by side from the left, then downwards.
    pub panels: Vec<Panel>,
    /// Panels side by side.
    pub columns: usize,
    /// Height of a panel over that of the usual one.
    pub height: f64,
    /// Note below the chart.
    pub notes: Vec<String>,
}

impl Figure {
    /// A figure without panels.
    pub fn new(
        number: impl Into<String>,
        name: impl Into<String>,
        title: impl Into<String>,
    ) -> Self {
        Self {
            number: number.into(),
            name: name.into(),
            title: title.into(),
            subtitle: String::new(),
            description: String::new(),
            panels: Vec::new(),
            columns: 1,
            height: 1.0,
            notes: Vec::new(),
        }
    }

    /// Number and title.
    pub fn heading(&self) -> String {
        if self.number.is_empty() {
            return self.title.clone();
        }
        let figures = if self.number.contains(',') || self.number.contains(" and ") {
            "Figures"
        } else {
            "Figure"
        };
        format!("{figures} {}: {}", self.number, self.title)
    }

    /// With one more panel.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// With panels side by side.
    #[must_use]
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }

    /// With panels lower or higher than usual.
    #[must_use]
    pub fn height(mut self, height: f64) -> Self {
        self.height = height;
        self
    }

    /// With a description in words.
    #[must_use]
    pub fn described(mut self, description: impl Into<String>) -> Self {
        self.description = description.into();
        self
    }

    /// With one more note.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }
}

/// Two axes and what is drawn between them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Panel {
    /// Name within the figure, in files and identifiers; empty for a panel alone.
    pub id: String,
    /// Title; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Shaded ranges, below everything.
    pub shades: Vec<Shade>,
    /// Curves.
    pub families: Vec<Family>,
    /// Required values.
    pub limits: Vec<Limit>,
    /// Points.
    pub marks: Vec<Mark>,
    /// Symbols that the legend explains; where they stand does not matter.
    pub keys: Vec<Mark>,
    /// Field behind the contour lines.
    pub field: Option<Field>,
}

impl Panel {
    /// An empty panel.
    pub fn new(id: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            id: id.into(),
            title: String::new(),
            x,
            y,
            shades: Vec::new(),
            families: Vec::new(),
            limits: Vec::new(),
            marks: Vec::new(),
            keys: Vec::new(),
            field: None,
        }
    }

    /// With a title.
    #[must_use]
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// With one more family of curves.
    #[must_use]
    pub fn with(mut self, family: Family) -> Self {
        self.families.push(family);
        self
    }

    /// With one more point.
    #[must_use]
    pub fn mark(mut self, mark: impl Into<Option<Mark>>) -> Self {
        self.marks.extend(mark.into());
        self
    }

    /// The family of that name.
    pub fn family(&self, id: &str) -> Option<&Family> {
        self.families.iter().find(|family| family.id == id)
    }

    /// With one more limit.
    #[must_use]
    pub fn limit(mut self, limit: impl Into<Option<Limit>>) -> Self {
        self.limits.extend(limit.into());
        self
    }

    /// With one more shaded range.
    #[must_use]
    pub fn shade(mut self, shade: Shade) -> Self {
        self.shades.push(shade);
        self
    }
}
