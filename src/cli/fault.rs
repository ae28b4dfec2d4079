//! A fault of the program: a panic, caught at the top and told in words.

use std::{
    any::Any,
    panic::{self, AssertUnwindSafe},
    sync::{Mutex, PoisonError},
};

use bogie::{export::origin::PROGRAM, spec::printable};

use super::arguments::Command;

/// Where in the source the first panic happened.
static PLACE: Mutex<Option<String>> = Mutex::new(None);

/// A panic of this thread, or of one that worked for it.
#[derive(Debug)]
pub struct Fault {
    /// Message of the panic.
    what: String,
    /// Where in the source it happened, if [`keep_silent`] was called before.
    place: Option<String>,
}

/// Keeps panics from writing to standard error, and notes where they happen. With `RUST_BACKTRACE` they
/// write as usual.
pub fn keep_silent() {
    let usual = panic::take_hook();
    let loud = std::env::var_os("RUST_BACKTRACE").is_some_and(|value| value != "0");
    panic::set_hook(Box::new(move |info| {
        let mut place = PLACE.lock().unwrap_or_else(PoisonError::into_inner);
        if place.is_none() {
            *place = info.location().map(ToString::to_string);
        }
        drop(place);
        if loud {
            usual(info);
        }
    }));
}

/// Runs something, with a panic as an error. Rayon hands panics of its threads to the thread that waits
/// for them.
///
/// # Errors
///
/// [`Fault`] if it panics.
pub fn catch<T>(run: impl FnOnce() -> T) -> Result<T, Fault> {
    // After a panic the process does nothing but say so: no broken state is looked at.
    panic::catch_unwind(AssertUnwindSafe(run)).map_err(|payload| Fault {
        what: what(payload.as_ref()),
        place: PLACE.lock().unwrap_or_else(PoisonError::into_inner).take(),
    })
}

/// The words of a panic.
fn what(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("no reason given")
        .to_owned()
}

impl Fault {
    /// Message to the user.
    pub fn message(&self, command: &Command) -> String {
        let place = self.place.as_deref();
        let place = place.map_or_else(String::new, |place| format!(" ({place})"));
        let spec = command.spec().map_or_else(String::new, |spec| {
            format!(" on {}", printable(&spec.to_string_lossy()))
        });
        let journal = command.journal().map_or_else(String::new, |folder| {
            format!(
                "\nthe journal in {} is kept so far: --resume goes on from it",
                printable(&folder.to_string_lossy())
            )
        });
        format!(
            "a fault of {PROGRAM}{spec}: {}{place}\n\
             this is a fault of the program, not of the spec; please report it with the spec{journal}",
            self.what
        )
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use rayon::prelude::*;

    use super::super::arguments::Arguments;
    use super::*;

    fn command(words: &[&str]) -> Command {
        Arguments::parse_from([&["bogie"], words].concat()).command
    }

    #[test]
    fn a_panic_here_or_in_a_worker_is_told_with_program_spec_and_journal() {
        keep_silent();
        let nothing: Vec<usize> = Vec::new();
        let here = || nothing[3];
        let in_a_worker = || {
            let many: Vec<usize> = (0..64).into_par_iter().map(|i| nothing[i]).collect();
            many[0]
        };
        let beside = || rayon::join(|| 1, || nothing[3]).1;
        let calls = [
            command(&["optimize", "a.toml", "--out", "results"]),
            command(&["evaluate", "a.toml"]),
        ];
        for fault in [catch(here), catch(in_a_worker), catch(beside)] {
            let fault = fault.expect_err("a panic");
            for call in &calls {
                let message = fault.message(call);
                assert!(message.starts_with(&format!("a fault of {PROGRAM} on a.toml: ")));
                assert!(message.contains("index out of bounds"), "{message}");
                assert!(message.contains("src/cli/fault.rs:"), "{message}");
                let resumes = message.contains("the journal in results");
                assert_eq!(resumes, call.journal().is_some(), "{message}");
            }
        }
        assert_eq!(catch(|| 7).expect("no panic"), 7);
    }
}
