//! The fast method: sparse elimination without pivoting, several frequencies side by side. It steps
//! aside for the plain method at frequencies at which it loses digits.

mod response;
mod terms;

pub use response::Response;
