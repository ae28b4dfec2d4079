//! Questions that a user asks of a spec, from its text to a result in any form, without terminal.
//!
//! [`Input::read`] reads the spec and notes its doubts. A [`Run`] answers one request: it evaluates
//! the design as given, designs and then screens what matters to the design, traces a front. Long
//! runs tell a [`Progress`] how they get on and end when a flag is set. Each [`Answer`] can be
//! written as text, as JSON (it is [`serde::Serialize`]) and, where it is one, as a table.
//!
//! ```
//! use bogie::run::{Input, Run};
//!
//! let input = Input::read("prototype", b"[vehicle]\nbase = \"prototype\"")?;
//! let answer = Run::new(&input).evaluate()?;
//! assert!(answer.result.stability.critical_speed().is_some());
//! assert!(answer.json()["critical_speed_m_per_s"].is_number());
//! assert!(answer.text().contains("critical speed"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answer;
mod error;
mod input;
mod long;
mod page;
mod short;

pub use answer::{Answer, Written};
pub use error::RunError;
pub use input::Input;
pub use long::{Designed, Journaled};
pub use page::Page;

use std::sync::atomic::AtomicBool;

pub use crate::{
    design::sensitivity::Watch,
    optimize::archive::{Archive, Progress, Silent},
};

/// A request for something about a spec, with who watches and who may end it.
#[derive(Clone, Copy)]
pub struct Run<'a> {
    input: &'a Input,
    watch: Watch<'a>,
}

impl<'a> Run<'a> {
    /// A run that nobody watches.
    pub fn new(input: &'a Input) -> Self {
        Self {
            input,
            watch: Watch::default(),
        }
    }

    /// Tells `progress` how it gets on, and ends with what there is as soon as `cancel` is set.
    #[must_use]
    pub fn watched(self, progress: &'a dyn Progress, cancel: &'a AtomicBool) -> Self {
        let watch = Watch {
            interrupt: Some(cancel),
            progress,
        };
        Self { watch, ..self }
    }
}
