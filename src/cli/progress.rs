//! Progress on a terminal.

use std::time::Duration;

use bogie::design::{outcome::Stage, solve::Progress};
use indicatif::{ProgressBar, ProgressStyle};

/// A line on standard error with the trade-off at work and the evaluations done; `indicatif` shows
/// it on a terminal only.
pub struct Line(ProgressBar);

impl Line {
    pub fn new() -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) =
            ProgressStyle::with_template("{spinner} {msg}: {pos} evaluations, {per_sec}, {elapsed}")
        {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar)
    }

    pub fn finish(self) {
        self.0.finish_and_clear();
    }
}

impl Progress for Line {
    fn stage(&self, stage: Stage, round: usize) {
        self.0.set_message(format!("{stage}, round {}", round + 1));
    }

    fn evaluated(&self) {
        self.0.inc(1);
    }
}
