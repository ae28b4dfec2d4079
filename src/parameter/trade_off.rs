//! The trade-offs of the report, and the parameters that each of them chooses.

use super::Parameter;

/// Trade-off of the report that a parameter belongs to (Figure 4.2.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TradeOff {
    /// Vertical ride against stroke (4.3).
    Vertical,
    /// Stability against curving (4.5).
    StabilityCurving,
    /// Lateral ride against stroke (4.4).
    Lateral,
}

impl std::fmt::Display for TradeOff {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Vertical => "vertical ride–stroke",
            Self::StabilityCurving => "stability–curving",
            Self::Lateral => "lateral ride–stroke",
        })
    }
}

/// Parts of names by which a parameter is one of the vertical trade-off.
const VERTICAL: [&str; 6] = [
    "vertical",
    "air_spring",
    "pitch",
    "bending.",
    "torsion_",
    "passenger.lateral",
];
/// The same of the lateral trade-off.
const LATERAL: [&str; 5] = [
    "secondary_lateral",
    "secondary.lateral",
    "passenger.height",
    "roll_inertia",
    "_roll_",
];

impl Parameter {
    /// Trade-off that it belongs to: that of the element that it is a constant of. A number of the whole
    /// vehicle acts on all three; it belongs to stability and curving, which is settled between the others.
    pub fn trade_off(self) -> TradeOff {
        let name = self.name();
        let has = |parts: &[&str]| parts.iter().any(|part| name.contains(part));
        if has(&VERTICAL) {
            TradeOff::Vertical
        } else if has(&LATERAL) {
            TradeOff::Lateral
        } else {
            TradeOff::StabilityCurving
        }
    }
}
