//! Laws as pure functions of numbers and slices: no allocation, no knowledge of scenes.
//!
//! Each effect has one file. [`scalar`] collects the laws along a length or about an angle, [`body`] the laws on one body, which
//! depend on its place, velocity and spin. A law is not compiled if its Cargo feature is off. Springs, dampers and prescribed
//! forces are always compiled.

pub mod body;
pub mod bumper;
pub mod calspan;
#[cfg(feature = "alloc")]
pub mod code;
pub mod corner;
pub mod entry;
pub(crate) mod feature;
pub mod guide;
mod law_inputs;
pub mod operations;
mod part;
pub mod polynomial;
pub mod relation;
pub mod road;
pub mod road_contact;
pub mod scalar;
pub mod slip;
pub mod spin;
pub mod tire;
pub mod user;

pub use crate::effects::apart;
pub use law_inputs::{CurvatureEntry, FeatureEntry, KnotEntry, LawInputs, LawTables, PieceEntry};
pub use part::Part;
