#![doc = include_str!("../README.md")]

mod dice;
pub mod format;
mod generate;
pub mod keys;
pub mod manual;
mod mesh;
mod read;
pub mod templates;
mod write;

pub use dice::Dice;
pub use generate::{Family, GenerateError, MOST_BODIES, generate};
pub use mbs_core::outputs::Component;
pub use mesh::{MESH_ENDINGS, MeshFault, TriangleMesh, mesh_ending};
pub use read::{Place, ReadError, ReadFault, SceneFile, SweepFault, SweepFile, nearest_name};
pub use write::{WriteError, quoted, to_toml};
