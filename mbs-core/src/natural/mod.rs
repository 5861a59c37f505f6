//! Natural coordinates: shared points and unit vectors with a constant mass matrix, made from a scene.
//!
//! The way down: [`cluster`](crate::cluster) (welds), `sharing` (what joints make common), `basis` (entities of each body), `build`,
//! `joints`, `effects` (rows and laws), `finish` (numbering and tables), `evaluate` (the numbers).

mod affine;
mod basis;
mod build;
mod coordinate;
mod draft;
mod effects;
mod element;
mod error;
mod evaluate;
mod finish;
mod forces;
mod from_scene;
mod group;
mod joints;
mod memory;
mod merge;
mod model;
mod motion;
mod near;
mod on_body;
mod parts;
mod reach;
mod rigid;
mod rods;
mod rotation;
mod sharing;
mod teamed;
mod touches;

pub use affine::Affine;
pub use basis::INDEPENDENCE;
pub(crate) use coordinate::{Coordinate, Places};
pub use error::ModelError;
pub(crate) use group::{add_squares, index, packed};
pub use model::NaturalModel;
pub use rotation::{unwrap, unwrap_rotation};
pub use sharing::TOLERANCE;
pub use teamed::Teamed;
