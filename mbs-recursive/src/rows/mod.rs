//! The equations of loops: of cut joints, of what rolls, and of couplings, with their gradients.

mod ball;
pub mod closed_loop;
pub mod coupled;
mod coupled_lines;
#[cfg(feature = "alloc")]
pub(crate) mod related;
pub mod rolling;
mod row;

pub use row::{Row, RowValue};
