//! A scene as text: TOML, and serde both ways.

mod edited;
mod scene;
mod serde;
pub(crate) mod toml;

pub use scene::{WriteError, to_toml};
pub use toml::quoted;
