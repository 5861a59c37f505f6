//! Data of one equation of a cut joint, a rolling body or a coupling.

use crate::rows::coupled::CoupledRow;
use crate::space::Space;
use mbs_core::Real;

/// One equation of a closed loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Row<T: Real, S: Space<T>> {
    /// The points coincide along a world axis.
    Coincidence {
        /// Index of the axis.
        axis: u32,
    },
    /// The component of the gap between the points along a direction of the first body is constant.
    Gap {
        /// Unit direction, in the axes of the reference configuration.
        direction: S::Point,
        /// Constant component of the gap [m].
        constant: T,
    },
    /// The angle between two directions is constant.
    Dot {
        /// Direction in the first body, in the axes of the reference configuration.
        x: S::Point,
        /// Direction in the second body, in the axes of the reference configuration.
        y: S::Point,
        /// Cosine of the constant angle.
        constant: T,
    },
    /// The distance of the points is constant.
    Length {
        /// Distance of the points [m].
        length: T,
    },
    /// The lowest point of a disc or ball remains on a plane of the second body. This is the first row of a rolling body.
    Height {
        /// Radius of the disc or ball [m].
        radius: T,
        /// Unit axis of the disc, in the first body's axes of the reference configuration. It is zero for a ball and in the plane.
        axis: S::Point,
        /// Unit normal of the plane, in the second body's axes of the reference configuration.
        normal: S::Point,
    },
    /// The rolling body does not slip along a direction of the second body: a constraint on velocities.
    NoSlip {
        /// Unit direction, in the axes of the reference configuration.
        direction: S::Point,
    },
    /// A point does not move across a blade: a constraint on velocities.
    Blade {
        /// Unit direction along which the point may move, in the first body's axes of the reference configuration.
        direction: S::Point,
        /// Unit normal of the plane, in the second body's axes of the reference configuration. It is not used by plane mechanisms.
        normal: S::Point,
    },
    /// A coupling, which is a loop of one row.
    Coupled(CoupledRow<T>),
}

impl<T: Real, S: Space<T>> Row<T, S> {
    /// True if the value of the row is an angle; false if it is a length.
    #[must_use]
    pub fn is_angle(&self) -> bool {
        match self {
            Self::Coupled(row) => row.is_angle,
            _ => self.is_cut_angle(),
        }
    }

    /// True if this is the first row of a rolling.
    #[must_use]
    pub fn begins_rolling(&self) -> bool {
        matches!(self, Self::Height { .. } | Self::Blade { .. })
    }

    /// True if this is an equation of a cut joint and its value is an angle.
    pub(crate) fn is_cut_angle(&self) -> bool {
        matches!(self, Self::Dot { .. })
    }

    /// True if this equation makes points coincide along the given world axis.
    pub(crate) fn is_along(&self, world_axis: usize) -> bool {
        matches!(self, Self::Coincidence { axis } if *axis as usize == world_axis)
    }
}

/// Gradients, value, rate and bias of an equation at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowValue<T: Real, S: Space<T>> {
    /// Gradients K₁ and K₂ by the motions of both bodies.
    pub gradient: [S::Motion; 2],
    /// Value Φ [m or rad].
    pub value: T,
    /// Rate Φ̇ of the equation.
    pub rate: T,
    /// Bias: the part of Φ̈ that remains for zero accelerations.
    pub bias: T,
}
