//! Progress on a terminal.

use std::time::Duration;

use bogie::optimize::archive::Progress;
use indicatif::{ProgressBar, ProgressStyle};

/// A line on standard error with what is at work, the evaluations done, their rate and the time
/// left; `indicatif` shows it on a terminal only.
pub struct Line(ProgressBar);

impl Line {
    pub fn new() -> Self {
        let bar = ProgressBar::new(0);
        let template = "{spinner} {msg}: {pos} evaluations, {per_sec}, {elapsed}, about {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar)
    }

    /// A line for so many charts.
    pub fn charts(count: usize) -> Self {
        let line = Self::new();
        let template = format!("{{spinner}} {{msg}} of {count}: {{pos}} evaluations, {{elapsed}}");
        if let Ok(style) = ProgressStyle::with_template(&template) {
            line.0.set_style(style);
        }
        line
    }

    /// Says which chart is drawn.
    pub fn chart(&self, number: &str) {
        self.0.set_message(format!("figure {number}"));
    }

    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}

impl bogie::chart::Progress for Line {
    fn done(&self, count: usize) {
        self.0.inc(count as u64);
    }
}

impl Progress for Line {
    fn stage(&self, what: &str) {
        self.0.set_message(what.to_owned());
    }

    fn expected(&self, evaluations: usize) {
        self.0.set_length(evaluations as u64);
    }

    fn evaluated(&self) {
        self.0.inc(1);
    }
}
