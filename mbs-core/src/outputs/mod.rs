//! What is recorded of a motion: points, joint coordinates and reactions, measured from a state of the model.
//!
//! Nothing here knows a formulation or an integrator: [`Measures`] reads positions, velocities and accelerations,
//! [`Reactions`] closes the balance of every body of the scene from them, [`Contacts`] lists when one-sided effects touch.

mod contact;
mod coordinate;
mod error;
mod frame;
mod load;
mod measure;
mod minimum_norm;
mod motion;
mod peel;
mod reaction;
mod wrench;

pub use contact::{Contacts, Instant, MOST_INSTANTS};
pub use error::ReactionError;
pub use measure::{Measures, start_values};
pub use reaction::{LARGEST_BLOCK, Reactions};
