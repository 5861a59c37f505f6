//! Assembly of the start: consistent positions, velocities and accelerations from a scene's `[[initial]]` entries.
//!
//! ```text
//! q:  min (q - q_ref)^T M (q - q_ref)   s.t.  phi(q, 0) = 0,  prescribed coordinates
//! v:  min v^T M v                       s.t.  J v + phi_t = 0,  prescribed rates
//! a:  M a + J^T lambda = Q,  J a + bias = 0
//! ```
//!
//! q_ref is the reference configuration, M the mass matrix, lambda the multipliers. Large prescribed values are approached by continuation
//! from the reference configuration. The mechanism thereby stays on the branch of positions that is continuous from the reference
//! configuration. The change of q is relative to the reference configuration and does not depend on the stages. Open trees need no
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
