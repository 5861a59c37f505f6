//! Models as tables: collected from a tree, then written as bytes or as Rust source. This module exists on the host only, with the feature
//! `export`.

mod bytes;
mod collect;
mod signals;
mod source;

pub use crate::format::Bytes;
pub use bytes::bytes;
pub use collect::{Collected, elements, needs};
pub use signals::MovingSignal;
pub use source::source;
