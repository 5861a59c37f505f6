//! Kinds of drawn couplings.

/// A coupling whose sum follows from what is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Drawn {
    /// Kind of the drawn coupling.
    pub kind: DrawnKind,
    /// Does the scene say that it is meant as drawn?
    pub is_stated: bool,
    /// Sense of the sum that was found; [`Sense::Same`] before the scene is resolved.
    pub sense: Sense,
}

/// Comparison of a drawn coupling's sum with that of the joints' coordinates as they are written, which version 0.1 took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// Sum equal to that of the coordinates as they are written.
    Same,
    /// Sum unlike that of the coordinates: wheels turn the other way, or joints between their carriers count.
    Changed,
    /// Places and axes do not decide; the coordinates are taken as they are written.
    Undecided,
}

/// Reason why places and axes do not determine a drawn coupling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotDrawn {
    /// The axes of the coupling are not parallel.
    Parallel,
    /// Places do not say on which side of the pinion the rack's pitch line is.
    PitchLine,
}

/// Reason why places and axes do not say where the strands of a belt are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotStrands {
    /// The coupling is no belt of two wheels that turn about parallel axes in one body.
    Wheels,
    /// The joints stand this far apart along their axes [m].
    Planes(f64),
    /// The wheels are too large for the distance of their axes [m]: they have no common tangent.
    Inside(f64),
}

/// Kind of a drawn coupling. Its sizes are the factors of the first terms.
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
        /// Is the belt crossed?
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

    /// Returns a drawn coupling of this kind, as a scene has it that does not say more.
    #[must_use]
    pub const fn drawn(self) -> Drawn {
        Drawn { kind: self, is_stated: false, sense: Sense::Same }
    }
}
