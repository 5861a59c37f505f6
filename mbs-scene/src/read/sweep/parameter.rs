//! Contents of a sweep: parameters, and how their values are combined.

use super::SweepFault;
use super::path::{self, Address};
use crate::read::SceneFile;
use crate::read::tree::Span;
use mbs_core::scene::Number;

/// Combination of the values of several parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Combine {
    /// Each value with each; the last parameter changes fastest.
    Grid,
    /// Values one to one.
    Zip,
    /// Samples of a Latin hypercube; their number.
    Latin(u32),
}

/// Parameter of a sweep, as `[[vary]]` or code gives it.
#[derive(Debug, Clone)]
pub(super) struct Parameter {
    pub(super) name: String,
    /// Bytes of the name, or of the path where there is none.
    pub(super) span: Span,
    /// Places that take the value, that of `path` first.
    pub(super) sets: Vec<(Address, Span)>,
    /// Places that move by as much as `path` does.
    pub(super) shifts: Vec<(Address, Span)>,
    pub(super) texts: Vec<String>,
    /// Bytes of each value, or of one entry for all.
    pub(super) value_spans: Vec<Span>,
    /// Ends of a range, with their bytes, tried beside its values.
    pub(super) ends: Vec<(String, Span)>,
    /// Is it given in code? Its bytes are then of no text, and its name is its path.
    pub(super) is_in_code: bool,
}

impl Parameter {
    /// Parameter that takes numbers of code at a path.
    pub(super) fn of_numbers(
        (path, numbers): (&str, &[Number]),
        scene: &SceneFile,
        combine: Combine,
    ) -> Result<Self, SweepFault> {
        let place = path::address(scene, path)?;
        if let Combine::Latin(_) = combine {
            return Err(SweepFault::NotSampled);
        }
        if numbers.is_empty() {
            return Err(SweepFault::NoValues);
        }
        Ok(Self {
            name: path.to_owned(),
            span: 0..0,
            sets: vec![(place, 0..0)],
            shifts: Vec::new(),
            texts: numbers.iter().map(Number::text).collect(),
            value_spans: vec![Span::default()],
            ends: Vec::new(),
            is_in_code: true,
        })
    }
}
