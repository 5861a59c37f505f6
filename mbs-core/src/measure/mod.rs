//! Numbers that a mechanism has: joint coordinates and lengths, sums of them, and curves of them.
//!
//! Held, such a sum is a [coupling](crate::scene::Coupling). Here too: where something that rolls touches its plane.

mod arguments;
mod contact;
mod curve;
#[cfg(feature = "alloc")]
mod monotone;
#[cfg(feature = "alloc")]
mod rolling;
#[cfg(feature = "alloc")]
mod term;

#[cfg(feature = "alloc")]
pub use crate::inputs::CouplingInput;
#[cfg(feature = "alloc")]
pub use crate::mechanism::{RotorInput, given_values};
pub use arguments::Arguments;
pub use contact::{Moving, lies_flat, lowest_place, lowest_point};
#[cfg(feature = "alloc")]
pub use curve::PreparedCurve;
#[cfg(feature = "alloc")]
pub(crate) use curve::{knots, within};
pub use curve::{polynomial, polynomial_change, spline_change, spline_curve};
#[cfg(feature = "alloc")]
pub use rolling::RollingInput;
#[cfg(feature = "alloc")]
pub use term::TermInput;
