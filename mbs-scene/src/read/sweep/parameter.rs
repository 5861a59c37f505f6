//! Data of a sweep: parameters, and the combination of their values.

use super::SweepFault;
use super::path::{self, Address};
use crate::read::SceneFile;
use crate::read::tree::Span;
use mbs_core::scene::Number;

/// Combination of the values of several parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Combine {
    /// Every combination of values; the last parameter changes fastest.
    Grid,
    /// The first values of all parameters together, then the second ones, and so on.
    Zip,
    /// Samples of a Latin hypercube, with their number.
    Latin(u32),
}

/// Parameter of a sweep, from `[[vary]]` or from code.
#[derive(Debug, Clone)]
pub(super) struct Parameter {
    pub(super) name: String,
    /// Bytes of the name, or of the path when the parameter has no name.
    pub(super) span: Span,
    /// Places that get the value, with the place of `path` first.
    pub(super) sets: Vec<(Address, Span)>,
    /// Places that are shifted by the same amount as the place of `path`.
    pub(super) shifts: Vec<(Address, Span)>,
    pub(super) texts: Vec<String>,
    /// Bytes of each value, or a single entry for all values.
    pub(super) value_spans: Vec<Span>,
    /// Ends of a range, with their bytes. `SceneSweep::check` tries them as well as the values.
    pub(super) ends: Vec<(String, Span)>,
    /// True if the parameter is given in code. Its spans then refer to no text, and its name is its path.
    pub(super) is_in_code: bool,
}

impl Parameter {
    /// A parameter that gets numbers from code at a path.
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
