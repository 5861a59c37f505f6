//! Element kernels of natural coordinates: constraint rows with value, gradient, bias and curvature.
//!
//! All coordinates are in one *extended* array: first the n unknowns, then constants (ground points, fixed directions, a zero
//! vector). Velocities of constants are zero, so that an end on the ground needs no special case.
//!
//! | element | equation | gradient | bias |
//! |---|---|---|---|
//! | [`Distance`] | (d.d - L^2) / 2L | +-d / L | d'.d' / L |
//! | [`Dot`] | s x.y - c | s (A^T y + B^T x) | 2 s x'.y' |
//! | [`Linear`] | sum_k a_k e_k - c | constant | 0 |
//! | [`Coupled`] | (sum_k c_k m_k - s) / c, or a function of m_k | see there | see there |
//! | [`RollingRows`] | n.(r - p), and rows of velocities | see there | see there |
//! | [`Guided`] | (cos f x2 - sin f x1).y, or s x.y - f, or (z_j.y_i - z_i.y_j)/2 with z = exp(f) x | as `Dot` | with f', f'' |

pub(crate) mod ball;
mod combination;
mod coupled;
mod distance;
mod dot;
mod guided;
mod linear;
#[cfg(feature = "alloc")]
mod related;
#[cfg(feature = "alloc")]
mod rolling;

pub use ball::ball_directions;
#[cfg(feature = "alloc")]
pub(crate) use combination::add_gradient;
pub use combination::{Span, Term, combine};
pub use coupled::{
    Coupled, CoupledForm, CoupledTables, CoupledTerm, Curves, Measurand, NONE, Signed,
    add_measure_gradient, has_collapsed, is_open, rate_and_bias, value as measured_value,
};
pub use distance::Distance;
pub use dot::Dot;
pub use guided::{Guided, GuidedMotion};
pub use linear::Linear;
#[cfg(feature = "alloc")]
pub use rolling::{RollingFrame, RollingRows};
