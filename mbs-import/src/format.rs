//! Formats of models that are read.

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
    /// Short name of the format.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Urdf => "URDF",
            Self::Mjcf => "MJCF",
            Self::Sdf => "SDF",
        }
    }

    /// Names of the options that a reader of it takes, as Python and `mbs import` call them.
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
