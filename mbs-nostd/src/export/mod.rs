//! Models as tables: gathered from a tree, written as bytes or as Rust. On the host, with the feature `export`.

mod bytes;
mod gather;
mod source;

pub use crate::record::Bytes;
pub use bytes::bytes;
pub use gather::{Gathered, needs};
pub use source::source;
pub(crate) use source::{Source, close, name, open};
