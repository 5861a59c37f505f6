//! D dimensions as a type, and the algebra of relative coordinates there.

use mbs_core::Real;
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial};

/// D dimensions as a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plane<const D: usize>;

/// The algebra of relative coordinates in D dimensions.
pub trait InSpace<T: Real> {
    /// Plane or space.
    type Space: Space<T>;
}

impl<T: Real> InSpace<T> for Plane<2> {
    type Space = Planar;
}

impl<T: Real> InSpace<T> for Plane<3> {
    type Space = Spatial;
}
