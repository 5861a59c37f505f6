//! Errors of a request for a generated scene.

/// A scene that cannot be generated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum GenerateError {
    /// The size is too small for the family of scenes.
    TooFew {
        /// Size that was requested.
        given: usize,
        /// Least size that the family allows.
        least: usize,
    },
    /// The scene would have more bodies than the limit.
    TooMany {
        /// Number of bodies that were requested.
        bodies: usize,
        /// Largest number of bodies.
        most: usize,
    },
    /// The distance between vehicles [m] is not a positive number.
    Spacing(f64),
    /// The vehicle's file is not a valid scene; reading it gives the reason.
    NoScene,
    /// The vehicle has no tire.
    NoTires,
}

impl GenerateError {
    /// Hint that says what to do.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::TooFew { .. } => "ask for more",
            Self::TooMany { .. } => "ask for fewer",
            Self::Spacing(_) => {
                "give the distance from one vehicle to the next in metres, such as 8"
            }
            Self::NoScene => {
                "read the vehicle's scene alone first: its faults are then reported with their places"
            }
            Self::NoTires => {
                "give the scene of a vehicle with an effect of kind \"tire\", such as scenes/iltis-stairs.toml"
            }
        }
    }
}

impl core::fmt::Display for GenerateError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooFew { given, least } => {
                write!(f, "there must be at least {least}, but {given} asked for")
            }
            Self::TooMany { bodies, most } => {
                write!(f, "there may be at most {most} bodies, but these would be {bodies}")
            }
            Self::Spacing(given) => {
                write!(f, "the distance between vehicles must be positive, but is {given} m")
            }
            Self::NoScene => write!(f, "the vehicle's scene cannot be read"),
            Self::NoTires => write!(f, "the vehicle's scene has no tire"),
        }
    }
}

impl core::error::Error for GenerateError {}
