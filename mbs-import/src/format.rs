//! The formats.

/// A format of models.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelFormat {
    /// Unified Robot Description Format.
    Urdf,
    /// The format of MuJoCo.
    Mjcf,
    /// Simulation Description Format.
    Sdf,
}

impl ModelFormat {
    /// Its short name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Urdf => "URDF",
            Self::Mjcf => "MJCF",
            Self::Sdf => "SDF",
        }
    }
}
