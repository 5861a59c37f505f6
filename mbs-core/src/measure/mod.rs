//! Measured numbers of a mechanism: joint coordinates and lengths, their sums, and curves of them.
//!
//! A [coupling](crate::scene::Coupling) holds such a sum constant or guides it. This module also has the contact point of rolling bodies.

mod arguments;
mod contact;
mod curve;
#[cfg(feature = "alloc")]
mod prepared;

#[cfg(feature = "alloc")]
pub use crate::{
    inputs::CouplingInput,
    mechanism::{RotorInput, given_values},
};
pub use arguments::Arguments;
pub use contact::{Moving, lies_flat, lowest_place, lowest_point};
#[cfg(feature = "alloc")]
pub(crate) use curve::within;
pub use curve::{polynomial, polynomial_change, spline_change, spline_curve};
#[cfg(feature = "alloc")]
pub(crate) use prepared::knots;
#[cfg(feature = "alloc")]
pub use prepared::{PreparedCurve, RollingInput, TermInput};
