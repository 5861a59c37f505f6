//! Contents of a sweep file: parameters, and how their values are combined.

use super::path::Address;
use crate::read::tree::Span;

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

/// Parameter of a sweep, as `[[vary]]` gives it.
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
}
