//! What couplings are drawn as.

/// A coupling whose sum follows from what is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Drawn {
    /// What is drawn.
    pub kind: DrawnKind,
    /// Does the scene say that it is meant as drawn?
    pub is_stated: bool,
    /// How the sum was found; [`Sense::Same`] before the scene is resolved.
    pub sense: Sense,
}

/// How the sum of a drawn coupling compares with that of the joints' coordinates as they are written, which version 0.1 took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// The same.
    Same,
    /// Another: wheels turn the other way, or joints between their carriers count.
    Changed,
    /// Places and axes do not decide; the coordinates are taken as they are written.
    Undecided,
}

/// What places and axes do not say of a drawn coupling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotDrawn {
    /// Its axes are not parallel.
    Parallel,
    /// On which side of the pinion the rack's pitch line is.
    PitchLine,
}

/// Why places and axes do not say where the strands of a belt are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotStrands {
    /// It is no belt of two wheels that turn about parallel axes in one body.
    Wheels,
    /// The joints stand this far apart along their axes [m].
    Planes(f64),
    /// The wheels are too large for the distance of their axes [m]: they have no common tangent.
    Inside(f64),
}

/// What is drawn. Sizes are the factors of the first terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnKind {
    /// Two wheels in mesh: the first, the second.
    Gear {
        /// Does one stand inside the other?
        is_internal: bool,
        /// Are its sizes radii? Otherwise they count teeth.
        has_radii: bool,
    },
    /// Two wheels by their ratio, which is as it is written: the second, the first.
    Ratio,
    /// A belt on two wheels: the first, the second.
    Belt {
        /// Is it crossed?
        is_crossed: bool,
    },
    /// The slide of a rack, the turn of its pinion.
    Rack,
    /// The slide of a nut, the turn of a screw.
    Screw,
    /// Two wheels, and the cage.
    Differential,
}

impl DrawnKind {
    /// The word for it in scene files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gear { .. } | Self::Ratio => "gear",
            Self::Belt { .. } => "belt",
            Self::Rack => "rack",
            Self::Screw => "screw",
            Self::Differential => "differential",
        }
    }

    /// As a scene has it that does not say more.
    #[must_use]
    pub const fn drawn(self) -> Drawn {
        Drawn { kind: self, is_stated: false, sense: Sense::Same }
    }
}
