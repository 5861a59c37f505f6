//! Table of joints: each kind with the relative motions that it allows, in the plane and in space. The table needs no allocation.

mod dimension;
mod table;

pub use dimension::Dimension;
pub use table::{Axis, Freedom, JOINTS, JointForm, JointKind, Rotation, Translation};
