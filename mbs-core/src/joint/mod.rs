//! The table of joints: each kind with what it lets move, in the plane and in space. The table needs no allocation.

mod dimension;
mod table;

pub use dimension::Dimension;
pub use table::{Axis, Freedom, JOINTS, JointForm, JointKind, Rotation, Translation};
