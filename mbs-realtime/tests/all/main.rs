//! All tests of this crate in one program, so that the helpers are compiled once. `cargo test -p mbs-realtime pacing::` runs one module.

mod common;

mod allocation;
mod pacing;
