//! What a sweep file says: parameters, and how their values are combined.

use super::path::Address;
use crate::read::tree::Span;

/// How values of several parameters are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Combine {
    /// Each with each; the last parameter changes fastest.
    Grid,
    /// One to one.
    Zip,
    /// So many samples.
    Latin(u32),
}

/// What `[[vary]]` says.
#[derive(Debug, Clone)]
pub(super) struct Parameter {
    pub(super) name: String,
    /// Of the name, or of the path where there is none.
    pub(super) span: Span,
    /// Places that take the value, that of `path` first.
    pub(super) sets: Vec<(Address, Span)>,
    /// Places that move by as much as `path` does.
    pub(super) shifts: Vec<(Address, Span)>,
    pub(super) texts: Vec<String>,
    /// Of each value, or one for all.
    pub(super) value_spans: Vec<Span>,
    /// Of a range, tried beside its values.
    pub(super) ends: Vec<(String, Span)>,
}
