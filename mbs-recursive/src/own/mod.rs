//! Freedoms in the order and with the signs of the joints, as columns of motion. The module computes mass matrices, Jacobians and
//! derivatives over these freedoms.
//!
//! ```text
//! one number                       n about the joint, or a slide
//! ball                             axes of the child, about its place: R eₖ
//! ball, reversed                   axes of the parent: −Rₚ eₖ
//! free                             slides along the ground's axes, then a ball of the child's axes about the body's point
//! free, reversed                   a ball of the ground's axes about the ground's point, then slides along −R eₖ
//! ```
//!
//! A joint is reversed if its parent in the tree is its second body.
//!
//! A column is the motion of a link for unit rate of one freedom, with all other freedoms at rest. The columns of a joint with several
//! freedoms follow the definition of the joint. A change of coordinates is therefore not needed, whichever body is the parent.

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
