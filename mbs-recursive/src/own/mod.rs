//! Freedoms in the joints' own order and sense, as columns of motion: mass matrices, Jacobians and derivatives by them.
//!
//! ```text
//! one number                       n about the joint, or a slide
//! ball, own                        axes of the child, about its place: R eₖ
//! ball, reversed                   axes of the parent: −Rₚ eₖ
//! free, own                        slides along the ground's axes, then a ball of the child's axes about the body's point
//! free, reversed                   a ball of the ground's axes about the ground's point, then slides along −R eₖ
//! ```
//!
//! A column is the motion of a link at unit rate of one freedom, all others at rest. By columns of its own a joint of several
//! freedoms needs no change of coordinates, whichever body it was written from.

mod columns;
mod derivatives;
mod factors;
mod jacobian;
mod mass;
mod moving;
mod rows;
mod six;
mod sums;
mod weights;

pub use columns::{LinkFreedoms, OwnFreedoms};
pub use derivatives::EffortSlopes;
pub use moving::MovingColumns;
