//! Forces that a mechanism takes as inputs, by the names of frames or bodies.

use crate::error::usage;
use mbs::BodyId;
use mbs::core::scene::Dimension;
use pyo3::prelude::*;
use std::ops::Range;

/// Forces that a mechanism takes as inputs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Forces {
    /// Names of the frames or bodies with forces.
    pub(crate) names: Vec<String>,
    /// The first of their inputs, which stand in the order of the names.
    pub(crate) first: usize,
    /// Which numbers of a force and its moment are inputs.
    pub(crate) parts: &'static [usize],
}

/// Numbers of a force and its moment that there are in the plane, and in space.
pub(crate) const fn parts(dimension: Dimension) -> &'static [usize] {
    match dimension {
        Dimension::Planar => &[0, 1, 5],
        Dimension::Spatial => &[0, 1, 2, 3, 4, 5],
    }
}

impl Forces {
    /// Returns the range of the forces' numbers among all inputs.
    pub(crate) fn range(&self) -> Range<usize> {
        self.first..self.first + self.names.len() * self.parts.len()
    }

    /// Writes forces into a row of all inputs; those that are not named become zero.
    pub(crate) fn write(&self, given: &[External], row: &mut [f64]) {
        let n = self.parts.len();
        for (name, to) in self.names.iter().zip(row[self.range()].chunks_exact_mut(n)) {
            let external = given.iter().find(|external| external.name == *name);
            let part = |i: &usize| external.map_or(0.0, |external| external.wrench[*i]);
            to.iter_mut().zip(self.parts).for_each(|(to, i)| *to = part(i));
        }
    }

    /// Refuses a force on a frame that is no input.
    pub(crate) fn check(&self, py: Python<'_>, given: &[External]) -> PyResult<()> {
        let missing = given.iter().find(|external| !self.names.contains(&external.name));
        missing.map_or(Ok(()), |External { name, .. }| {
            let message = format!("this simulation takes no force on `{name}`");
            let hint = format!("simulate m.with_forces(\"{name}\"), which has its force as inputs");
            Err(usage(py, "usage", &message, &hint, "f_ext"))
        })
    }
}

/// A force and a moment on a body.
#[derive(Debug, Clone)]
pub(crate) struct External {
    pub(crate) name: String,
    pub(crate) body: BodyId,
    /// Point at which the force acts, in the reference configuration [m].
    pub(crate) at: [f64; 3],
    pub(crate) wrench: [f64; 6],
}
