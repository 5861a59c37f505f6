//! Natural coordinates: shared points and unit vectors with a constant mass matrix, made from a scene.
//!
//! Steps of construction:
//!
//! - [`cluster`](crate::cluster): welded bodies;
//! - `sharing`: common points and directions of joints;
//! - `basis`: entities of each body;
//! - `build`, `joints`, `effects`: rows and laws;
//! - `layout`: numbering and tables;
//! - `evaluate`: constraints, forces, blocks and residuals.

mod affine;
mod angle_memory;
mod basis;
mod build;
mod coordinate;
pub(crate) mod coordinate_sets;
mod coupled_layout;
mod couplings;
mod effect_layout;
mod effects;
mod element;
mod element_ranges;
mod error;
mod evaluate;
mod feedback;
mod forces;
mod from_scene;
pub(crate) mod group;
mod incidence;
mod joints;
mod layout;
mod lines;
mod merge;
mod model;
mod motion;
mod on_body;
mod rigid;
mod rollings;
mod rotation;
mod rotors;
mod row_builder;
mod sharing;
pub(crate) mod spatial_index;
mod thin_rods;
mod threaded;

pub use crate::cluster::TOLERANCE;
pub use affine::Affine;
pub(crate) use affine::Shape;
pub use angle_memory::RememberedAngle;
pub use basis::INDEPENDENCE;
pub(crate) use coordinate::{Coordinate, Places};
pub use error::ModelError;
pub(crate) use group::{add_squares, index, packed};
pub use model::{NaturalModel, NaturalRotor};
pub use rotation::{unwrap, unwrap_rotation};
pub use threaded::Threaded;
