//! Faults of a scene that is asked for.

/// A scene that cannot be generated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum GenerateError {
    /// Nothing to make, or not enough of it to move.
    TooFew {
        /// Number that was asked for.
        given: usize,
        /// Least number that there must be.
        least: usize,
    },
    /// More bodies than a memory holds.
    TooMany {
        /// Bodies of the scene asked for.
        bodies: usize,
        /// Bodies there may be.
        most: usize,
    },
    /// The distance between vehicles is no positive number [m].
    Spacing(f64),
    /// The vehicle is no scene that can be read; reading it says why.
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
