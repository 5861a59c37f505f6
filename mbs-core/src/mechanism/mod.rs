//! Scene of a mechanism with its effects and outputs, constructors for its parts, and quantities that follow from it.
//!
//! Meshing wheels, belt strands, rotors, acting points of forces and given coordinates follow from the scene alone, without a model.

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
