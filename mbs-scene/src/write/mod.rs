//! Writing of scenes: as TOML text, and as data of serde in both directions.

mod edited;
mod scene;
mod serde;
pub(crate) mod toml;

pub use scene::{WriteError, to_toml};
pub use toml::quoted;
