//! A simulation whose scalar and dimension are hidden, and the quantities that can be read by name.

pub mod clock;
pub mod error;
pub mod failure;
pub mod function;
pub mod inner;
pub mod input_table;
pub mod inputs;
pub mod read;
pub mod readings;
pub mod scene_run;
pub mod seen;
pub mod values;
pub mod view;

pub use error::{Error, PathError, SceneError, UnknownName};
pub use failure::SimulationError;
pub use view::View;
