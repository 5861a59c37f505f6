//! Examples of tables, each in a scene that has what it names.

/// An example of a table: a part of a scene file that is read and run by a test.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Example {
    /// The scene into which it is put.
    pub base: Base,
    /// Text of the example.
    pub text: &'static str,
}

/// The scene of an example.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// No base, since the example is whole.
    Whole,
    /// A planar scene with the bodies `arm`, `wheel` and `cart`, and the joints `pivot`, `hub` and `rail`.
    Planar,
    /// A spatial scene with the same, the bodies `ball` and `gear`, and the joints `socket` and `spindle`.
    Spatial,
    /// A planar scene with the bodies alone.
    PlanarBodies,
    /// A spatial scene with the bodies alone.
    SpatialBodies,
    /// A sweep file.
    Sweep,
}

impl Base {
    /// The scene, to which the example is added.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Whole | Self::Sweep => "",
            Self::Planar => include_str!("bases/planar.toml"),
            Self::Spatial => include_str!("bases/spatial.toml"),
            Self::PlanarBodies => include_str!("bases/planar-bodies.toml"),
            Self::SpatialBodies => include_str!("bases/spatial-bodies.toml"),
        }
    }
}

impl Base {
    /// The base of that name in the file of examples.
    pub(super) fn of_name(name: &str) -> Option<Self> {
        Some(match name {
            "whole" => Self::Whole,
            "planar" => Self::Planar,
            "spatial" => Self::Spatial,
            "planar bodies" => Self::PlanarBodies,
            "spatial bodies" => Self::SpatialBodies,
            "sweep" => Self::Sweep,
            _ => return None,
        })
    }
}
