//! The tests of this crate, in one program. `cargo test -p mbs-scene keys::` runs one module.

mod format;
mod generate;
mod keys;
mod manual;
mod mesh;
mod read;
mod templates;
mod toml;
mod write;
