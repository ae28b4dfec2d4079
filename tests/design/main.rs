//! Is a design the best within its limits, and is what is said of it true?

mod every_number;
mod freedom;
mod fronts;
mod many_conditions;
mod procedure;
mod random_designs;
mod random_studies;
mod sensitivity;
#[path = "../support/mod.rs"]
mod support;
mod verdicts;
mod whole_designs;
