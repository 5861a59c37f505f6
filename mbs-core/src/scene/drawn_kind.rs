//! Kinds of drawn couplings, whose sums follow from places and axes.

/// Drawn coupling: its sum follows from the places and axes of its joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Drawn {
    /// Kind of the drawn coupling.
    pub kind: DrawnKind,
    /// True if the scene states that the coupling is intended as drawn.
    pub is_stated: bool,
    /// Result of the comparison of both sums; [`Sense::Same`] before the scene is resolved.
    pub sense: Sense,
}

/// Comparison of the sum of a drawn coupling with the sum of the joint coordinates as written, which version 0.1 used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// The sum equals the sum of the coordinates as written.
    Same,
    /// The sum differs: wheels turn in the other sense, or joints between their carriers contribute.
    Changed,
    /// Places and axes do not determine the sum, and the coordinates are used as written.
    Undecided,
}

/// Reason why places and axes do not determine the sum of a drawn coupling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotDrawn {
    /// The axes of the coupling are not parallel.
    Parallel,
    /// The rack is on the axis of the pinion, so that the side of its pitch line is unknown.
    PitchLine,
}

/// Reason why places and axes do not determine the strands of a belt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotStrands {
    /// The coupling is no belt on two wheels that turn about parallel axes in one body.
    Wheels,
    /// The joints are this distance apart along their axes [m].
    Planes(f64),
    /// The axes are this distance apart [m], too close for the radii: the wheels have no common tangent.
    Inside(f64),
}

/// Kind of a drawn coupling. The factors of its first terms are its sizes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnKind {
    /// Two wheels in mesh. Terms: first wheel, second wheel.
    Gear {
        /// True if one wheel is inside the other.
        is_internal: bool,
        /// True if the sizes are radii. Otherwise they are numbers of teeth.
        has_radii: bool,
    },
    /// Two wheels by their ratio, which is used as written. Terms: second wheel, first wheel.
    Ratio,
    /// Belt on two wheels. Terms: first wheel, second wheel.
    Belt {
        /// True if the belt is crossed.
        is_crossed: bool,
    },
    /// Rack and pinion; terms: slide of the rack, angle of the pinion.
    Rack,
    /// Screw and nut; terms: slide of the nut, angle of the screw.
    Screw,
    /// Differential; terms: two wheels, then the carrier of the planet wheels.
    Differential,
}

impl DrawnKind {
    /// Name of the kind in scene files.
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

    /// Returns a drawn coupling of this kind, with the defaults of a scene.
    #[must_use]
    pub const fn drawn(self) -> Drawn {
        Drawn { kind: self, is_stated: false, sense: Sense::Same }
    }
}
