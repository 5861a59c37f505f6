//! What is recorded of a motion: points, joint coordinates and reactions, measured from a state of the model.
//!
//! Nothing here knows a formulation or an integrator: [`Measures`] reads positions, velocities and accelerations,
//! [`Reactions`] closes the balance of every body of the scene from them.

mod coordinate;
mod frame;
mod measure;

pub use measure::Measures;
