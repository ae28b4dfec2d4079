//! Requests that make no sense.

use crate::{index::Index, spec::FRONT_POINTS};

/// Why a request makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// No index has this name.
    #[error("unknown index `{0}`; known are {known}", known = Index::ALL.map(Index::name).join(", "))]
    UnknownIndex(String),
    /// An index is named twice.
    #[error("`{0}` stands twice")]
    IndexTwice(String),
    /// A front of one index, or of more than three.
    #[error("expected two or three indices")]
    FrontIndices,
    /// Fewer or more points than a front may have.
    #[error("expected {} to {}", FRONT_POINTS.start(), FRONT_POINTS.end())]
    FrontPoints,
    /// A relative range that is no share.
    #[error("expected a share from 0 to below 1, such as 0.1")]
    Spread,
    /// A sensitivity analysis without anything that varies.
    #[error("nothing varies: open [design] or give a spread above 0")]
    NothingVaries,
}
