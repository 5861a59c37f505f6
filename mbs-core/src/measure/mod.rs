//! Numbers that a mechanism has: joint coordinates and lengths, sums of them, and curves of them.
//!
//! Held, such a sum is a [coupling](crate::scene::Coupling). Here too: where something that rolls touches its plane.

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
