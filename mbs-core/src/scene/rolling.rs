//! Bodies that roll without slipping on a plane, and blades that do not move sideways.
//!
//! ```text
//! wheel   a disc: its lowest point is on the plane and has the velocity of the plane there
//! ball    the same of a sphere
//! blade   the velocity of a point against the plane has no part across the blade; it may leave the plane
//! ```

use crate::scene::{BodyId, Number, Vector3};
use alloc::string::String;

/// A body that rolls without slipping, or a blade.
#[derive(Debug, Clone, PartialEq)]
pub struct Rolling<T> {
    /// Unique name among the rollings.
    pub name: String,
    /// Kind of the rolling, with its sizes.
    pub kind: RollingKind<T>,
    /// Body that rolls, or has the blade.
    pub body: BodyId,
    /// The centre of the wheel or ball, or the point of the blade, reference configuration [m].
    pub at: [T; 3],
    /// The body, or the ground, that it rolls on.
    pub on: BodyId,
    /// The plane that it rolls on, fixed in `on`; `None`: the level one through its lowest point, of a blade through its point.
    pub plane: Option<RollingPlane<T>>,
}

/// A plane, fixed in a body or in the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct RollingPlane<T> {
    /// One of its points, reference configuration [m].
    pub point: [T; 3],
    /// Normal of the plane towards what rolls, any length, reference configuration.
    pub normal: [T; 3],
}

/// Kind of a rolling: wheel, ball or blade.
#[derive(Debug, Clone, PartialEq)]
pub enum RollingKind<T> {
    /// A thin disc that rolls.
    Wheel {
        /// Axis of the wheel, any length, reference configuration; not used in the plane.
        axis: [T; 3],
        /// Radius of the wheel [m].
        radius: T,
    },
    /// A sphere that rolls.
    Ball {
        /// Radius of the ball [m].
        radius: T,
    },
    /// A point that does not move across a direction of its body.
    Blade {
        /// The direction along which it may move, any length, reference configuration.
        direction: [T; 3],
    },
}

impl<T> RollingKind<T> {
    /// The radius of what has one.
    #[must_use]
    pub const fn radius(&self) -> Option<&T> {
        match self {
            Self::Wheel { radius, .. } | Self::Ball { radius } => Some(radius),
            Self::Blade { .. } => None,
        }
    }

    /// The direction of its body that counts: of a wheel its axis, of a blade where it may move.
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

    /// A wheel of a body, with this centre and radius [m] and this axis, on the level ground under it: z points up, in the plane y.
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

    /// A ball, a body with this centre and radius [m], on the level ground under it: z points up, in the plane y.
    #[must_use]
    pub fn ball(body: BodyId, at: impl Into<Vector3>, radius: impl Into<Number>) -> Self {
        Self::on_ground(RollingKind::Ball { radius: radius.into() }, body, at.into())
    }

    /// A blade at a point of a body, that may move along a direction of it, on the level ground: z points up; in the plane it cuts that.
    #[must_use]
    pub fn blade(body: BodyId, at: impl Into<Vector3>, direction: impl Into<Vector3>) -> Self {
        Self::on_ground(RollingKind::Blade { direction: direction.into().0 }, body, at.into())
    }

    /// On a plane that is fixed in a body or in the ground: one of its points [m] and its normal.
    #[must_use]
    pub fn on(mut self, on: BodyId, point: impl Into<Vector3>, normal: impl Into<Vector3>) -> Self {
        let plane = RollingPlane { point: point.into().0, normal: normal.into().0 };
        (self.on, self.plane) = (on, Some(plane));
        self
    }
}
