//! Equations of loops, with gradients: of cut joints, of rolling bodies and of couplings.

mod ball;
pub mod closed_loop;
pub mod coupled;
mod coupled_lines;
#[cfg(feature = "alloc")]
pub(crate) mod related;
pub mod rolling;
mod row;

pub use row::{Row, RowValue};
