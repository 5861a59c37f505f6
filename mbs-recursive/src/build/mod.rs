//! Construction of a tree of links with its tables from a scene, once before any step.

mod coordinate_links;
mod coupling_tables;
mod couplings;
mod curve_tables;
mod cut;
mod enough_inertia;
mod error;
pub(crate) mod graph;
mod joint_facts;
mod order;
pub(crate) mod own_tables;
mod owners;
pub(crate) mod tree;
mod weights;

pub use curve_tables::CurveTables;
pub use error::{LanesError, TreeError};
pub use tree::TreeModel;
