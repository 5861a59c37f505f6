//! placeholder
mod wrapper;
pub use wrapper::as_compiler;
