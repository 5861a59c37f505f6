//! Equations of cut joints, rolling bodies and couplings, with their gradients.

mod ball;
pub mod closed_loop;
pub mod coupled;
mod coupled_lines;
#[cfg(feature = "alloc")]
pub(crate) mod related;
pub mod rolling;
mod row;

pub use row::{Row, RowValue};
