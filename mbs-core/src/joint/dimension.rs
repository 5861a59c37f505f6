//! Dimension of a scene: the plane or space.

/// Dimension of a scene: planar or spatial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// Motion in the x-y plane; rotations about z.
    Planar,
    /// Motion in space; rotations about any axis.
    Spatial,
}

impl Dimension {
    /// Number of dimensions: 2 or 3.
    #[must_use]
    pub const fn count(self) -> usize {
        match self {
            Self::Planar => 2,
            Self::Spatial => 3,
        }
    }
}
