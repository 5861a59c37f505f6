#![doc = include_str!("../README.md")]

mod beside;
mod closing;
mod context;
mod coordinates;
mod element;
mod files;
mod findings;
mod format;
mod gravity;
mod import;
mod inertia;
mod laws;
mod lump;
mod mesh;
mod mjcf;
mod motors;
mod options;
mod pose;
mod robot;
mod sdf;
mod shell;
mod solid;
mod source;
mod table;
mod unread;
mod urdf;
mod usd;
mod visual;
mod write;
mod xml;

pub use coordinates::{FileCoordinate, FileMotion};
pub use files::{read, scene_file};
pub use findings::{FindingKind, ModelFinding};
pub use format::ModelFormat;
pub use import::{Imported, ModelSizes, import, is_model, model_format};
pub use options::{BaseKind, ImportOptions, Stops};
