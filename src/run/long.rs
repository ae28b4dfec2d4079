//! Answers that take many evaluations: a design, a front, a sensitivity analysis, many designs.

use std::path::Path;

use super::{Answer, Archive, Input, Run, RunError};
use crate::{
    design::{
        doubts::warnings,
        outcome::DesignResult,
        pareto::{self, Front},
        procedure::{self, DesignError},
        sensitivity::{self, Factors, Method, Sensitivity, Settings, analysis::indices_of},
        sweep::Sweep,
    },
    export::origin::PROGRAM,
    index::Index,
    optimize::journal::{Entry, Header, Journal, JournalError},
};

/// A design with what matters to it.
#[derive(Debug, Clone)]
pub struct Designed {
    /// The design.
    pub design: DesignResult,
    /// Sensitivity of the design's indices to all inputs.
    pub matters: Sensitivity,
}

impl Designed {
    /// Whether the budget was spent or the run interrupted.
    pub fn ended_early(&self) -> bool {
        self.design.stopped.is_some() || self.matters.interrupted()
    }
}

/// A request that keeps a journal in a folder while it runs.
#[derive(Debug, Clone, Copy)]
pub enum Journaled<'a> {
    /// [`Run::optimize`].
    Optimize,
    /// [`Run::pareto`].
    Pareto,
    /// [`Run::sweep`] with a seed, its lines in some form.
    Sweep {
        /// The indices evaluated.
        indices: &'a [Index],
        /// The seed.
        seed: u64,
        /// Name of the form.
        form: &'a str,
    },
}

impl Journaled<'_> {
    /// Name of the command and of its files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Optimize => "optimize",
            Self::Pareto => "pareto",
            Self::Sweep { .. } => "sweep",
        }
    }

    /// Identity of a run, to which a journal must belong: all that decides the run but the budget, which may be raised.
    fn header(self, input: &Input) -> Header {
        let Input { spec, digest, .. } = input;
        let names = |indices: &[Index]| {
            let names: Vec<&str> = indices.iter().map(|index| index.name()).collect();
            names.join(",")
        };
        let thorough = if input.thorough { " --thorough" } else { "" };
        let rest = match self {
            Self::Optimize => thorough.to_owned(),
            Self::Pareto => {
                let traded = names(&spec.front.indices);
                format!(" {traded} {}{thorough}", spec.front.points)
            }
            Self::Sweep {
                indices,
                seed,
                form,
            } => format!(" {seed} {} {form}", names(indices)),
        };
        Header {
            program: PROGRAM.into(),
            digest: format!("{} {digest}{rest}", self.name()),
        }
    }
}

impl<'a> Run<'a> {
    /// A new archive for the evaluations of this run, which ends after `budget` of them (`None`: no
    /// limit) or when the run is to end.
    pub fn archive(&self, budget: Option<usize>) -> Archive<'a> {
        let archive = Archive::new(self.watch.progress).with_budget(budget);
        match self.watch.interrupt {
            Some(cancel) => archive.with_interrupt(cancel),
            None => archive,
        }
    }

    /// The journal of a request at a path, new or gone on with, and what it holds.
    ///
    /// # Errors
    ///
    /// [`JournalError`] if it cannot be written or read, belongs to another request, or is in use.
    pub fn journal(
        &self,
        request: Journaled,
        path: &Path,
        resume: bool,
    ) -> Result<(Journal, Vec<Entry>), JournalError> {
        let header = request.header(self.input);
        if resume {
            Journal::resume(path, &header)
        } else {
            Journal::create(path, &header).map(|journal| (journal, Vec::new()))
        }
    }

    /// The suspension that is best within the spec's limits, and what matters to it. A budget spent
    /// or an interruption is no error: the answer is the best so far.
    ///
    /// # Errors
    ///
    /// [`DesignError`] where there is nothing to choose or nothing to choose by.
    pub fn optimize(&self, archive: &Archive) -> Result<Answer<'a, Designed>, DesignError> {
        let spec = &self.input.spec;
        let (design, matters) = procedure::design_beside(spec, archive, |case| {
            sensitivity::screen(case, &indices_of(spec), spec.design.seed, &self.watch)
        })?;
        Ok(Answer {
            input: self.input,
            warnings: warnings(&design.case, &design.evaluation, &spec.demands),
            result: Designed { design, matters },
        })
    }

    /// The front between the indices that the spec names. One without points says why.
    ///
    /// # Errors
    ///
    /// [`DesignError::NothingOpen`] if nothing varies.
    pub fn pareto(&self, archive: &Archive) -> Result<Answer<'a, Front>, DesignError> {
        self.has_choice()?;
        Ok(self.answer(pareto::pareto(&self.input.spec, archive)))
    }

    /// Factors of a sensitivity analysis: parameters that the spec leaves open, between their bounds, and the
    /// other inputs by `spread` either way, relative.
    ///
    /// # Errors
    ///
    /// [`RunError::Spread`] or [`RunError::NothingVaries`].
    pub fn factors(&self, spread: f64) -> Result<Factors, RunError> {
        if !(0.0..1.0).contains(&spread) {
            return Err(RunError::Spread);
        }
        let spec = &self.input.spec;
        let factors = Factors::new(&spec.case, &spec.design, spread);
        if factors.list().is_empty() {
            return Err(RunError::NothingVaries);
        }
        Ok(factors)
    }

    /// Which of some factors matter to some indices; no indices: those of [`indices_of`].
    pub fn sensitivity(
        &self,
        factors: &Factors,
        indices: &[Index],
        method: Method,
    ) -> Answer<'a, Sensitivity> {
        let seed = self.input.spec.design.seed;
        let settings = Settings { method, seed };
        let indices = self.asked(indices);
        self.answer(Sensitivity::new(factors, &indices, settings, &self.watch))
    }

    /// Many designs, evenly spread over what the spec leaves open.
    ///
    /// # Errors
    ///
    /// [`DesignError::NothingOpen`] if nothing varies.
    pub fn sweep(&self, indices: &[Index], seed: u64) -> Result<Sweep<'a>, DesignError> {
        Sweep::new(&self.input.spec, indices, seed).ok_or(DesignError::NothingOpen)
    }

    /// Whether the spec leaves something to choose.
    ///
    /// # Errors
    ///
    /// [`DesignError::NothingOpen`] if it does not.
    pub fn has_choice(&self) -> Result<(), DesignError> {
        if self.input.spec.design.parameters.is_empty() {
            return Err(DesignError::NothingOpen);
        }
        Ok(())
    }

    /// These indices, or if there are none those of [`indices_of`].
    pub fn asked(&self, indices: &[Index]) -> Vec<Index> {
        if indices.is_empty() {
            indices_of(&self.input.spec)
        } else {
            indices.to_vec()
        }
    }
}
