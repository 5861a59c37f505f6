//! An independent simulator of scene files, against which the crates are checked: it shares no code with them.
//!
//! The judge is written from the contract of scene files alone, with a reader, laws of force and a start of its own. Each body has absolute
//! coordinates: the place of its centre of mass and a quaternion. The equations are those of Newton and Euler with constraints at the level
//! of accelerations. They are solved as one dense saddle system with full pivoting. Steps have order 8. After each step the state is
//! projected onto the constraints by the least mass-weighted change. The judge is made to be right and simple, not fast. Only the module
//! `trial` uses the crates: it runs them beside the judge.

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
