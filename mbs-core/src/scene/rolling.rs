//! Bodies that roll on a plane without slip, and blades that do not slip sideways.
//!
//! ```text
//! wheel   a disc: its lowest point is on the plane and has the velocity of the plane at that place
//! ball    a sphere, with the same constraints
//! blade   the velocity of a point relative to the plane has no component perpendicular to the blade; it may leave the plane
//! ```

use crate::scene::{BodyId, Number, Vector3};
use alloc::string::String;

/// Body that rolls without slip, or a blade.
#[derive(Debug, Clone, PartialEq)]
pub struct Rolling<T> {
    /// Unique name among the rollings.
    pub name: String,
    /// Kind of the rolling, with its sizes.
    pub kind: RollingKind<T>,
    /// Body that rolls, or to which the blade is fixed.
    pub body: BodyId,
    /// Centre of the wheel or ball, or point of the blade, in the reference configuration [m].
    pub at: [T; 3],
    /// Body or ground on which it rolls.
    pub on: BodyId,
    /// Plane on which it rolls, fixed in `on`. `None`: the horizontal plane through the lowest point, or through the point of a
    /// blade.
    pub plane: Option<RollingPlane<T>>,
}

/// Plane that is fixed in a body or in the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct RollingPlane<T> {
    /// Point of the plane, reference configuration [m].
    pub point: [T; 3],
    /// Normal of the plane, of any length, reference configuration. It points to the side of the rolling body.
    pub normal: [T; 3],
}

/// Kind of a rolling: wheel, ball or blade.
#[derive(Debug, Clone, PartialEq)]
pub enum RollingKind<T> {
    /// Thin disc that rolls without slip.
    Wheel {
        /// Axis of the wheel, of any length, reference configuration; not used in planar scenes.
        axis: [T; 3],
        /// Radius of the wheel [m].
        radius: T,
    },
    /// Sphere that rolls without slip.
    Ball {
        /// Radius of the ball [m].
        radius: T,
    },
    /// Blade: a point of a body whose velocity has no component perpendicular to the blade.
    Blade {
        /// Direction in which the blade may move, of any length, reference configuration.
        direction: [T; 3],
    },
}

impl<T> RollingKind<T> {
    /// Radius of a wheel or ball; `None` for a blade.
    #[must_use]
    pub const fn radius(&self) -> Option<&T> {
        match self {
            Self::Wheel { radius, .. } | Self::Ball { radius } => Some(radius),
            Self::Blade { .. } => None,
        }
    }

    /// Axis of a wheel, or direction in which a blade may move; `None` for a ball.
    #[must_use]
    pub const fn direction(&self) -> Option<&[T; 3]> {
        match self {
            Self::Wheel { axis: direction, .. } | Self::Blade { direction } => Some(direction),
            Self::Ball { .. } => None,
        }
    }
}

impl Rolling<Number> {
    fn on_ground(kind: RollingKind<Number>, body: BodyId, at: Vector3) -> Self {
        Self { name: String::new(), kind, body, at: at.0, on: BodyId::Ground, plane: None }
    }

    /// Wheel of a body, with this centre and radius [m] and this axis, on the level ground below it. Up is z in space, and y in the
    /// plane.
    #[must_use]
    pub fn wheel(
        body: BodyId,
        at: impl Into<Vector3>,
        axis: impl Into<Vector3>,
        radius: impl Into<Number>,
    ) -> Self {
        let kind = RollingKind::Wheel { axis: axis.into().0, radius: radius.into() };
        Self::on_ground(kind, body, at.into())
    }

    /// Ball: a body with this centre and radius [m] on the level ground below it. Up is z in space, and y in the plane.
    #[must_use]
    pub fn ball(body: BodyId, at: impl Into<Vector3>, radius: impl Into<Number>) -> Self {
        Self::on_ground(RollingKind::Ball { radius: radius.into() }, body, at.into())
    }

    /// Blade at a point of a body, which may move along a direction of the body on level ground. Up is z in space. In a planar
    /// scene the blade cuts the plane of the motion.
    #[must_use]
    pub fn blade(body: BodyId, at: impl Into<Vector3>, direction: impl Into<Vector3>) -> Self {
        Self::on_ground(RollingKind::Blade { direction: direction.into().0 }, body, at.into())
    }

    /// Sets the plane of the rolling, which is fixed in a body or in the ground: a point [m] and the normal.
    #[must_use]
    pub fn on(mut self, on: BodyId, point: impl Into<Vector3>, normal: impl Into<Vector3>) -> Self {
        let plane = RollingPlane { point: point.into().0, normal: normal.into().0 };
        (self.on, self.plane) = (on, Some(plane));
        self
    }
}
