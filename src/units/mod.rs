//! Units at the boundary; SI inside.

pub mod us;
