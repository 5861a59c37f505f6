//! Numbers that a mechanism has: joint coordinates and lengths, sums of them, and curves of them.
//!
//! Held, such a sum is a [coupling](crate::scene::Coupling). Here too: where something that rolls touches its plane.

#[cfg(feature = "alloc")]
mod acting;
mod arguments;
mod contact;
#[cfg(feature = "alloc")]
mod coupling;
mod curve;
#[cfg(feature = "alloc")]
mod given;
#[cfg(feature = "alloc")]
mod mesh;
#[cfg(feature = "alloc")]
mod monotone;
#[cfg(feature = "alloc")]
mod rolling;
#[cfg(feature = "alloc")]
mod rotor;
#[cfg(feature = "alloc")]
mod strands;
#[cfg(feature = "alloc")]
mod term;

#[cfg(feature = "alloc")]
pub(crate) use acting::Acting;
pub use arguments::Arguments;
pub use contact::{Moving, lies_flat, lowest_place, lowest_point};
#[cfg(feature = "alloc")]
pub use coupling::CouplingInput;
#[cfg(feature = "alloc")]
pub use curve::PreparedCurve;
#[cfg(feature = "alloc")]
pub(crate) use curve::{knots, within};
pub use curve::{polynomial, polynomial_change, spline_change, spline_curve};
#[cfg(feature = "alloc")]
pub use given::given_values;
#[cfg(feature = "alloc")]
pub(crate) use mesh::MeshedWheels;
#[cfg(feature = "alloc")]
pub use rolling::RollingInput;
#[cfg(feature = "alloc")]
pub use rotor::RotorInput;
#[cfg(feature = "alloc")]
pub(crate) use strands::Strands;
#[cfg(feature = "alloc")]
pub use term::TermInput;
