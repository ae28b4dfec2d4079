//! Ctrl-C ends a run with what it has.

use std::sync::atomic::{AtomicBool, Ordering};

use super::output;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Exit code of a process ended by Ctrl-C.
const SIGINT: i32 = 130;

/// The flag that Ctrl-C sets. A second Ctrl-C ends the process at once.
pub fn flag() -> &'static AtomicBool {
    // Without a handler Ctrl-C ends the process as usual: nothing is lost but the summary.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(SIGINT);
        }
        output::say("ending with what is there; Ctrl-C again ends at once");
    });
    &INTERRUPTED
}
