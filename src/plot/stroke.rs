//! Looks of lines: colour, interruptions, width.

use serde::Serialize;

/// Colour of a line, from a palette that colour-blind readers can tell apart (Okabe and Ito); a
/// theme says what it looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Ink {
    /// Black on white paper.
    #[default]
    Black,
    /// Blue.
    Blue,
    /// Vermilion.
    Vermilion,
    /// Bluish green.
    Green,
    /// Reddish purple.
    Purple,
    /// Orange.
    Orange,
    /// Sky blue.
    Sky,
    /// Grey, for what is only there to compare with.
    Grey,
}

impl Ink {
    /// The `i`-th of a set that can be told apart. Vermilion is not among them: it is for the design and
    /// its limits.
    pub fn nth(i: usize) -> Self {
        const SET: [Ink; 6] = [
            Ink::Black,
            Ink::Blue,
            Ink::Green,
            Ink::Purple,
            Ink::Orange,
            Ink::Sky,
        ];
        SET[i % SET.len()]
    }

    /// All.
    pub const ALL: [Self; 8] = [
        Self::Black,
        Self::Blue,
        Self::Vermilion,
        Self::Green,
        Self::Purple,
        Self::Orange,
        Self::Sky,
        Self::Grey,
    ];

    /// Name of its style class.
    pub const fn class(self) -> &'static str {
        match self {
            Self::Black => "black",
            Self::Blue => "blue",
            Self::Vermilion => "vermilion",
            Self::Green => "green",
            Self::Purple => "purple",
            Self::Orange => "orange",
            Self::Sky => "sky",
            Self::Grey => "grey",
        }
    }
}

/// Interruptions of a line, which tell curves apart in black and white.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Dash {
    /// None.
    #[default]
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dashes and dots.
    DashDot,
    /// Long dashes.
    Long,
}

impl Dash {
    /// All, in the order in which curves take them.
    pub const ALL: [Self; 5] = [
        Self::Solid,
        Self::Dashed,
        Self::DashDot,
        Self::Long,
        Self::Dotted,
    ];

    /// Name of its style class.
    pub const fn class(self) -> &'static str {
        match self {
            Self::Solid => "solid",
            Self::Dashed => "dashed",
            Self::Dotted => "dotted",
            Self::DashDot => "dashdot",
            Self::Long => "long",
        }
    }
}

/// Width of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Weight {
    /// For what is only there to compare with.
    Thin,
    /// For curves.
    #[default]
    Normal,
    /// For what the chart is about.
    Bold,
}

impl Weight {
    /// Name of its style class.
    pub const fn class(self) -> &'static str {
        match self {
            Self::Thin => "thin",
            Self::Normal => "normal",
            Self::Bold => "bold",
        }
    }
}

/// Look of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Stroke {
    /// Colour.
    pub ink: Ink,
    /// Interruptions.
    pub dash: Dash,
    /// Width.
    pub weight: Weight,
}

impl Stroke {
    /// A line of normal width.
    pub const fn new(ink: Ink, dash: Dash) -> Self {
        Self {
            ink,
            dash,
            weight: Weight::Normal,
        }
    }

    /// The `i`-th look of a set that can be told apart in colour and in black and white.
    pub fn nth(i: usize) -> Self {
        Self::new(Ink::nth(i), Dash::ALL[i % Dash::ALL.len()])
    }

    /// The same line in another width.
    #[must_use]
    pub const fn weight(self, weight: Weight) -> Self {
        Self { weight, ..self }
    }
}
