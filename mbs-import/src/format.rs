//! Formats of models that the import can read.

/// A format of models.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelFormat {
    /// Unified Robot Description Format.
    Urdf,
    /// Format of the simulator MuJoCo.
    Mjcf,
    /// Simulation Description Format of Gazebo.
    Sdf,
}

impl ModelFormat {
    /// Short name of the format.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Urdf => "URDF",
            Self::Mjcf => "MJCF",
            Self::Sdf => "SDF",
        }
    }

    /// Names of the options that a reader of the format supports, as in Python and in `mbs import`.
    #[must_use]
    pub const fn options(self) -> &'static [&'static str] {
        match self {
            Self::Urdf | Self::Sdf => &[
                "balance",
                "base",
                "keep_fixed",
                "limits",
                "massless_meshes",
                "motors",
                "no_outside",
                "packages",
            ],
            Self::Mjcf => {
                &["balance", "key", "limits", "massless_meshes", "motors", "no_outside", "packages"]
            }
        }
    }
}
