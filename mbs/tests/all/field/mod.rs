//! Situations that users met, each the smallest scene found that shows it (`mbs/tests/field`), against values from closed forms or other
//! programs. Each stands for a kind: the tests beside it are others of the kind.

mod analyses;
mod couplings;
mod formulations;
mod laws;
mod outputs;
mod start;

pub(crate) use mbs_testkit::repository::{field, read, text, tilted};
