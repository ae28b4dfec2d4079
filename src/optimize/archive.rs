//! The archive of measurements: every full-model evaluation of a run, counted, kept for reuse, and
//! recorded in a journal from which the run can be resumed.
//!
//! A resumed run searches from the start again and takes from the journal what it has measured
//! before; as the search is deterministic, it goes the same way and ends at the same bits.

use std::{
    collections::{BTreeMap, HashMap},
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicBool, Ordering},
    },
};

use rayon::prelude::*;

use super::{
    journal::{Entry, Journal},
    problem::{Detail, Failure, Key, Piece, Problem},
};

/// Result of a measurement.
pub type Measured = Result<Vec<Piece>, Failure>;

/// Reason for an early end of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    /// The budget of evaluations is spent.
    #[error("the budget of evaluations is spent")]
    Budget,
    /// The user interrupted the run.
    #[error("interrupted")]
    Interrupted,
}

impl Stop {
    /// Code in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::Budget => "budget-spent",
            Self::Interrupted => "interrupted",
        }
    }
}

/// Observer of a long search, called from several threads.
pub trait Progress: Sync {
    /// Called when a new part of the work begins.
    fn stage(&self, what: &str);

    /// Called with the expected number of evaluations.
    fn expected(&self, evaluations: usize);

    /// Called after every full-model evaluation.
    fn evaluated(&self);
}

/// Observer that does nothing.
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _: &str) {}

    fn expected(&self, _: usize) {}

    fn evaluated(&self) {}
}

/// All measurements of a run.
pub struct Archive<'a> {
    budget: usize,
    interrupt: Option<&'a AtomicBool>,
    progress: &'a dyn Progress,
    kept: Arc<Mutex<Kept>>,
    own: Mutex<Spent>,
}

/// Evaluations that were asked for through one handle of an archive.
#[derive(Debug, Clone, Default)]
pub struct Spent {
    /// Number of evaluations.
    pub evaluations: usize,
    /// Number of them without values, by reason.
    pub failures: BTreeMap<Failure, usize>,
}

impl Spent {
    /// Difference from an earlier account `before`.
    #[must_use]
    pub fn since(mut self, before: &Self) -> Self {
        self.evaluations -= before.evaluations;
        for (failure, count) in &before.failures {
            self.failures
                .entry(*failure)
                .and_modify(|all| *all -= count);
        }
        self.failures.retain(|_, count| *count > 0);
        self
    }

    fn add(&mut self, measured: &Measured) {
        self.evaluations += 1;
        if let Err(failure) = measured {
            *self.failures.entry(*failure).or_default() += 1;
        }
    }
}

#[derive(Default)]
struct Kept {
    known: HashMap<Bits, Measured>,
    /// Measurements from the journal of an earlier run, not yet asked for in this one.
    recorded: HashMap<Bits, Measured>,
    journal: Option<Journal>,
    /// Number of measurements asked for in this run, including those from the journal.
    spent: Spent,
    /// Evaluations expected in all.
    expected: usize,
    stopped: Option<Stop>,
    /// The journal could not be written; the run goes on without it.
    journal_error: Option<String>,
}

/// A key whose numbers are compared by their bits.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Bits(String, Vec<u64>);

impl From<&Key> for Bits {
    fn from(key: &Key) -> Self {
        Self(
            key.what.clone(),
            key.at.iter().map(|x| x.to_bits()).collect(),
        )
    }
}

impl<'a> Archive<'a> {
    /// An empty archive without a budget.
    pub fn new(progress: &'a dyn Progress) -> Self {
        Self {
            budget: usize::MAX,
            interrupt: None,
            progress,
            kept: Arc::default(),
            own: Mutex::default(),
        }
    }

    /// The same archive with an account of its own, for one of several searches side by side.
    #[must_use]
    pub fn branch(&self) -> Self {
        Self {
            kept: Arc::clone(&self.kept),
            own: Mutex::default(),
            ..*self
        }
    }

    /// Account of this handle.
    pub fn spent(&self) -> Spent {
        locked(&self.own).clone()
    }

    /// Allows at most `budget` evaluations in all.
    #[must_use]
    pub fn with_budget(self, budget: Option<usize>) -> Self {
        Self {
            budget: budget.unwrap_or(usize::MAX),
            ..self
        }
    }

    /// Stops as soon as `interrupt` is set.
    #[must_use]
    pub fn with_interrupt(self, interrupt: &'a AtomicBool) -> Self {
        Self {
            interrupt: Some(interrupt),
            ..self
        }
    }

    /// Records measurements in a journal, and takes from it what an earlier run recorded.
    #[must_use]
    pub fn with_journal(self, journal: Journal, recorded: Vec<Entry>) -> Self {
        {
            let mut kept = self.lock();
            kept.journal = Some(journal);
            kept.recorded = recorded
                .into_iter()
                .map(|entry| (Bits::from(&entry.key), entry.measured))
                .collect();
        }
        self
    }

    /// Measures designs side by side; known measurements are taken from the archive.
    ///
    /// # Errors
    ///
    /// [`Stop`] if the budget does not allow all of them (those that it allows are measured), or
    /// if the run was interrupted.
    pub fn measure(
        &self,
        problem: &dyn Problem,
        designs: &[Vec<f64>],
        detail: Detail,
    ) -> Result<Vec<Measured>, Stop> {
        let key = |x: &Vec<f64>| self.in_detail(problem.key(x), detail);
        let keys: Vec<Key> = designs.iter().map(key).collect();
        let bits: Vec<Bits> = keys.iter().map(Bits::from).collect();
        // New measurements are counted, in order, before they run side by side: count, budget and
        // journal never depend on the threads.
        let mut new: Vec<(usize, Option<Measured>)> = Vec::new();
        let mut over_budget = false;
        {
            let mut kept = self.lock();
            if let Some(stop) = kept.stopped {
                return Err(stop);
            }
            for (i, key) in bits.iter().enumerate() {
                if kept.known.contains_key(key) || new.iter().any(|(j, _)| bits[*j] == *key) {
                    continue;
                }
                if kept.spent.evaluations + new.len() == self.budget {
                    over_budget = true;
                    break;
                }
                let recorded = kept.recorded.remove(key);
                new.push((i, recorded));
            }
        }
        let measured: Vec<Option<(usize, Measured, bool)>> = new
            .into_par_iter()
            .map(|(i, recorded)| {
                if self.interrupted() {
                    return None;
                }
                let fresh = recorded.is_none();
                let measured =
                    recorded.unwrap_or_else(|| finite(problem.measure(&designs[i], detail)));
                self.progress.evaluated();
                Some((i, measured, fresh))
            })
            .collect();
        let mut kept = self.lock();
        for entry in measured {
            let Some((i, measured, fresh)) = entry else {
                kept.stopped = Some(Stop::Interrupted);
                continue;
            };
            // Another search may have measured the same design meanwhile.
            if kept.known.contains_key(&bits[i]) {
                continue;
            }
            kept.spent.add(&measured);
            locked(&self.own).add(&measured);
            if fresh {
                kept.record(&keys[i], &measured);
            }
            kept.known.insert(bits[i].clone(), measured);
        }
        if kept.stopped.is_none() && over_budget {
            kept.stopped = Some(Stop::Budget);
        }
        if let Some(stop) = kept.stopped {
            return Err(stop);
        }
        Ok(bits.iter().map(|key| kept.known[key].clone()).collect())
    }

    /// Known measurement of a design, in any detail.
    pub fn known(&self, key: &Key) -> Option<Measured> {
        let kept = self.lock();
        let known = |key: &Key| kept.known.get(&Bits::from(key)).cloned();
        known(&graded(key)).or_else(|| known(key))
    }

    /// The key under which a measurement in some detail is kept; one with gradients serves for values.
    fn in_detail(&self, key: Key, detail: Detail) -> Key {
        let more = graded(&key);
        if detail == Detail::Gradients || self.lock().known.contains_key(&Bits::from(&more)) {
            more
        } else {
            key
        }
    }

    /// True if the number of evaluations is limited.
    pub fn has_budget(&self) -> bool {
        self.budget < usize::MAX
    }

    /// Evaluations so far.
    pub fn count(&self) -> usize {
        self.lock().spent.evaluations
    }

    /// Failures so far by kind.
    pub fn failures(&self) -> BTreeMap<Failure, usize> {
        self.lock().spent.failures.clone()
    }

    /// Reason for an early end of the run.
    pub fn stopped(&self) -> Option<Stop> {
        self.lock().stopped
    }

    /// Error that left the journal incomplete.
    pub fn journal_error(&self) -> Option<String> {
        self.lock().journal_error.clone()
    }

    /// Announces work of about so many evaluations.
    pub fn announce(&self, evaluations: usize) {
        let mut kept = self.lock();
        kept.expected = kept.expected.max(kept.spent.evaluations) + evaluations;
        self.progress.expected(kept.expected);
    }

    /// Announced work of `evaluations` is done, with however many it took.
    pub fn settle(&self, evaluations: usize, taken: usize) {
        let mut kept = self.lock();
        kept.expected = (kept.expected + taken)
            .saturating_sub(evaluations)
            .max(kept.spent.evaluations);
        self.progress.expected(kept.expected);
    }

    /// Tells the observer that a new part of the work begins.
    pub fn stage(&self, what: &str) {
        self.progress.stage(what);
    }

    fn interrupted(&self) -> bool {
        self.interrupt
            .is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        locked(&self.kept)
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // No code panics while it holds a lock.
    mutex
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// The key of a measurement with gradients.
fn graded(key: &Key) -> Key {
    Key {
        what: format!("∇ {}", key.what),
        at: key.at.clone(),
    }
}

impl Kept {
    fn record(&mut self, key: &Key, measured: &Measured) {
        if let Some(journal) = &mut self.journal
            && let Err(error) = journal.write(key, measured)
        {
            self.journal_error = Some(error.to_string());
            self.journal = None;
        }
    }
}

fn finite_gradient(piece: &Piece) -> bool {
    let gradient = piece.gradient.iter().flatten();
    gradient.into_iter().all(|slope| slope.is_finite())
}

/// A measurement with a value that is not finite becomes a failure.
fn finite(measured: Measured) -> Measured {
    let pieces = measured?;
    if pieces
        .iter()
        .all(|p| p.value.is_finite() && p.label.is_finite() && finite_gradient(p))
    {
        Ok(pieces)
    } else {
        Err(Failure::NotFinite)
    }
}
