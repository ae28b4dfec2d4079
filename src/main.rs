//! The `bogie` command.

fn main() {}
