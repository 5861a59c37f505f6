//! The scene of a mechanism: its data with effects and outputs, the parts of it that are built in code, and what follows from it.
//!
//! Wheels in mesh, strands, rotors, the places of forces and given coordinates follow from a scene alone, before there is a model.

mod acting;
pub mod align;
mod build;
mod build_signal;
mod given;
mod joint_limits;
mod map;
mod mesh;
mod on_terms;
mod rotor;
mod scene;
mod strands;

pub(crate) use acting::Acting;
pub use build::StartedJoint;
pub use given::given_values;
pub(crate) use mesh::MeshedWheels;
pub use rotor::RotorInput;
pub use scene::{Effect, Output, Scene};
pub(crate) use strands::Strands;
