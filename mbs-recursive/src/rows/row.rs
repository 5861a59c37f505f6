//! The equations of loops: of cut joints, of what rolls, and of couplings.

use crate::rows::coupled::CoupledRow;
use crate::space::Space;
use mbs_core::Real;

/// One equation of a cut joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Row<T: Real, S: Space<T>> {
    /// The points coincide along a world axis.
    Coincidence {
        /// Number of the axis.
        axis: u32,
    },
    /// The gap keeps its part along a direction of the first body.
    Gap {
        /// Unit direction, reference axes.
        direction: S::Point,
        /// Part of the gap that is kept [m].
        constant: T,
    },
    /// Two directions keep their angle.
    Dot {
        /// In the first body, reference axes.
        x: S::Point,
        /// In the second body, reference axes.
        y: S::Point,
        /// Cosine of the angle.
        constant: T,
    },
    /// The points keep their distance.
    Length {
        /// Distance of the points [m].
        length: T,
    },
    /// The lowest point of a disc or ball stays on a plane of the second body: the first row of a body that rolls.
    Height {
        /// Radius of the disc or ball [m].
        radius: T,
        /// The disc's unit axis, reference axes of the first body; of a ball, and in the plane, zero.
        axis: S::Point,
        /// The plane's unit normal, reference axes of the second body.
        normal: S::Point,
    },
    /// The body that rolls does not slip along a direction of the second body: a row of velocities.
    NoSlip {
        /// Unit direction, reference axes.
        direction: S::Point,
    },
    /// A point does not move across a blade: a row of velocities.
    Blade {
        /// The unit direction along which it may move, reference axes of the first body.
        direction: S::Point,
        /// The plane's unit normal, reference axes of the second body; in the plane not used.
        normal: S::Point,
    },
    /// A coupling, which is a loop of one row.
    Coupled(CoupledRow<T>),
}

impl<T: Real, S: Space<T>> Row<T, S> {
    /// Is its value an angle (otherwise a length)?
    #[must_use]
    pub fn is_angle(&self) -> bool {
        match self {
            Self::Coupled(row) => row.is_angle,
            _ => self.is_cut_angle(),
        }
    }

    /// Is it the first row of a rolling?
    #[must_use]
    pub fn begins_rolling(&self) -> bool {
        matches!(self, Self::Height { .. } | Self::Blade { .. })
    }

    /// Is it the equation of a cut joint, and its value an angle?
    pub(crate) fn is_cut_angle(&self) -> bool {
        matches!(self, Self::Dot { .. })
    }

    /// Does it hold points together along this world axis?
    pub(crate) fn is_along(&self, world_axis: usize) -> bool {
        matches!(self, Self::Coincidence { axis } if *axis as usize == world_axis)
    }
}

/// Gradients, value, rate and bias of an equation at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowValue<T: Real, S: Space<T>> {
    /// Gradients K₁ and K₂ by the motions of both bodies.
    pub gradient: [S::Motion; 2],
    /// Φ [m or rad].
    pub value: T,
    /// Rate Φ̇ of the equation.
    pub rate: T,
    /// Bias: Φ̈ without accelerations.
    pub bias: T,
}
