//! The page of a design.

use super::{Answer, Archive, Designed, Run};
use crate::{
    chart::{Entry, Progress as Drawing},
    design::{
        doubts::warnings,
        outcome::DesignResult,
        pareto::{self, Front},
        sensitivity::Sensitivity,
    },
    numerics::EigenError,
    report::{Report, charts, page},
};

/// Contents of a page besides the spec.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The design.
    pub design: &'a DesignResult,
    /// Parameters that matter to a design that was searched for; `None`: it is the spec's as it stands.
    pub matters: Option<&'a Sensitivity>,
    /// The front that the spec asks for.
    pub front: Option<&'a Front>,
}

impl<'a> Page<'a> {
    /// Of a design that was searched for.
    pub fn designed(answer: &'a Answer<Designed>, front: Option<&'a Front>) -> Self {
        Self {
            design: &answer.result.design,
            matters: Some(&answer.result.matters),
            front,
        }
    }
}

impl Run<'_> {
    /// The design as it stands, with margins to all that the spec asks for.
    ///
    /// # Errors
    ///
    /// As [`Run::evaluate`].
    pub fn as_given(&self) -> Result<DesignResult, EigenError> {
        DesignResult::as_given(&self.input.spec)
    }

    /// The front of a page, where the spec asks for one and something is open to trace it with.
    pub fn front(&self, archive: &Archive) -> Option<Front> {
        let spec = &self.input.spec;
        let is_asked = spec.front.asked && !spec.design.parameters.is_empty();
        is_asked.then(|| pareto::pareto(spec, archive))
    }

    /// Charts that a page of a design shows.
    pub fn charts(&self, design: &DesignResult) -> usize {
        charts::entries(&design.case).len()
    }

    /// A page with all results and charts (HTML). `command` is the call that makes it again;
    /// `shown` is told of each chart before it is drawn, `drawing` of the work.
    pub fn page(
        &self,
        Page {
            design,
            matters,
            front,
        }: Page,
        command: &str,
        drawing: &dyn Drawing,
        shown: impl Fn(&Entry),
    ) -> String {
        let input = self.input;
        let doubtful = Answer {
            input,
            result: (),
            warnings: warnings(&design.case, &design.evaluation, &input.spec.demands),
        };
        let figures = charts::figures(&input.spec, &input.name, &design.case, drawing, shown);
        page(&Report {
            name: &input.name,
            source: &input.source,
            digest: &input.digest,
            command,
            spec: &input.spec,
            result: design,
            designed: matters.is_some(),
            matters,
            front,
            figures: &figures,
            warnings: &doubtful.doubts(),
        })
    }
}
