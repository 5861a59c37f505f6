//! A second derivation of what a scene means: it judges the crates, and shares no code with them.
//!
//! Written from the contract of scene files alone: an own reader, own laws and an own start. Bodies have absolute coordinates, the place of
//! the centre of mass and a quaternion. The equations are those of Newton and Euler with constraints at the level of accelerations, solved
//! as one dense saddle system with full pivoting. Steps are of order 8, and each is brought back onto the constraints by the least
//! mass-weighted change. It is made to be right and plain, not fast. `trial` alone knows the crates: it runs what is judged.

mod advance;
mod coupled;
mod curvature;
mod curves;
mod dense;
mod drawn;
mod effect;
mod guided;
mod joints;
mod laws;
mod loads;
mod monotone;
mod motion;
mod names;
mod node;
mod outputs;
mod parts;
mod polynomial;
mod project;
mod quantity;
pub mod random;
mod rank;
mod read;
mod read_coupling;
mod read_curve;
mod read_effect;
mod read_guide;
mod read_output;
mod read_rolling;
mod read_signal;
mod rolling;
mod rows;
pub mod scene;
mod show;
mod signals;
mod start;
mod stops;
mod sums;
pub mod trial;
pub mod vector;
mod wheel;

pub use advance::Stop;
pub use motion::{Mechanism, Moved, State};
pub use node::Fault;
pub use read::read;
pub use rows::Frame;
pub use scene::Scene;
pub use start::NoStart;
