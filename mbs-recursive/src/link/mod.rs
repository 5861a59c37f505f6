//! Links with the joints to their parents, and the indexing, tables and options that the other modules use.

pub mod curves;
pub(crate) mod indexing;
pub mod joint;
mod links;
pub(crate) mod options;
pub mod plan;

pub use links::{ArticulatedInertia, Link, LinkKind, LinkMotion, LinkRotor};
