//! A spec with what its results carry.

use sha2::{Digest, Sha256};

use super::RunError;
use crate::{
    index::Index,
    optimize::solve::UNSEEN_THOROUGH,
    spec::{Diagnostics, FRONT_POINTS, Spec},
};

/// A spec that was read, with what its results carry of it.
#[derive(Debug, Clone)]
pub struct Input {
    /// Name in results.
    pub name: String,
    /// The spec.
    pub spec: Spec,
    /// The spec's text.
    pub source: String,
    /// SHA-256 of the text, hexadecimal.
    pub digest: String,
    /// Doubts about the spec, a sentence each.
    pub doubts: Vec<String>,
    /// Whether [`Input::search_thoroughly`] was called: a journal belongs to one or the other.
    pub(super) thorough: bool,
}

impl Input {
    /// Reads a spec from the bytes of a file.
    ///
    /// # Errors
    ///
    /// All mistakes of the spec, see [`Spec::read`].
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, Diagnostics> {
        let spec = Spec::read(bytes)?;
        Ok(Self {
            name: name.into(),
            doubts: spec.doubts.sentences().collect(),
            source: String::from_utf8_lossy(bytes).into_owned(),
            digest: format!("{:x}", Sha256::digest(bytes)),
            thorough: false,
            spec,
        })
    }

    /// Lets searches go on until basins not yet seen are estimated to be at most 1 % of the space.
    pub fn search_thoroughly(&mut self) {
        self.thorough = true;
        let design = &mut self.spec.design;
        design.unseen = design.unseen.min(UNSEEN_THOROUGH);
    }

    /// Puts other indices in place of those whose front the spec asks for.
    ///
    /// # Errors
    ///
    /// [`RunError::FrontIndices`] if they are not two or three.
    pub fn trade_off(&mut self, indices: Vec<Index>) -> Result<(), RunError> {
        if !(2..=3).contains(&indices.len()) {
            return Err(RunError::FrontIndices);
        }
        self.spec.front.indices = indices;
        Ok(())
    }

    /// Puts another number of points in place of that which the spec gives its front.
    ///
    /// # Errors
    ///
    /// [`RunError::FrontPoints`] if it is outside [`FRONT_POINTS`].
    pub fn front_points(&mut self, points: usize) -> Result<(), RunError> {
        if !FRONT_POINTS.contains(&points) {
            return Err(RunError::FrontPoints);
        }
        self.spec.front.points = points;
        Ok(())
    }

    /// Indices by name, none twice.
    ///
    /// # Errors
    ///
    /// [`RunError::UnknownIndex`] or [`RunError::IndexTwice`] for the first name that is wrong.
    pub fn indices(names: &[impl AsRef<str>]) -> Result<Vec<Index>, RunError> {
        let mut indices = Vec::new();
        for name in names {
            let name = name.as_ref();
            let index = Index::named(name.trim());
            let index = index.ok_or_else(|| RunError::UnknownIndex(name.into()))?;
            if indices.contains(&index) {
                return Err(RunError::IndexTwice(name.into()));
            }
            indices.push(index);
        }
        Ok(indices)
    }
}
