//! Assembly: positions, velocities and accelerations made consistent from what a scene's `[[initial]]` entries say.
//!
//! ```text
//! q:  min (q - q_ref)^T M (q - q_ref)   s.t.  phi(q, 0) = 0,  held coordinates
//! v:  min v^T M v                       s.t.  J v + phi_t = 0,  held rates
//! a:  M a + J^T lambda = Q,  J a + bias = 0
//! ```
//!
//! Large held values are reached by continuation from the reference configuration, so that the assembly branch is the one
//! that leads there continuously. The change is measured from the reference, whatever the stages were. Open trees need no
//! continuation: they are placed joint by joint.

mod accelerations;
mod assemble;
mod error;
mod hold;
mod moved_mass;
mod place;
mod positions;
mod problem;
pub(crate) mod rank;
pub(crate) mod sparse_rank;
mod sweeps;
mod velocities;
mod weak;

pub use accelerations::accelerations;
pub use assemble::{Assembled, assemble, restart, start_at};
pub use error::AssemblyError;
pub use moved_mass::moved_mass;
pub use problem::Problem;
pub use rank::constraint_rank;
