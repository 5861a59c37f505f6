//! Directions of a joint in the reference configuration, for each of its freedoms.

use super::Joint;
use crate::Real;
use crate::algebra::{Vector, across, along, cross, unit};
use crate::joint::{Axis, Dimension, Freedom, Rotation, Translation};

/// Two unit vectors perpendicular to `axis`. The second is the first, rotated by a quarter turn about the axis (right-hand rule).
pub fn transverse<T: Real>(axis: &Vector<T, 3>, dimension: Dimension) -> [Vector<T, 3>; 2] {
    let v = match dimension {
        Dimension::Planar => unit(0),
        Dimension::Spatial => across(axis),
    };
    [v, cross(axis, &v)]
}

impl<T: Real> Joint<T> {
    /// Freedoms of the joint in a scene of this dimension, in the order of the coordinates.
    #[must_use]
    pub fn freedoms(&self, dimension: Dimension) -> &'static [Freedom] {
        self.kind.freedoms(dimension)
    }

    /// Unit vector of an axis; global z if the joint does not have this axis.
    #[must_use]
    pub fn direction(&self, axis: Axis) -> Vector<T, 3> {
        let own = |i: usize| self.axes[i].map_or_else(|| unit(2), |a| along(&Vector::from(a)));
        match axis {
            Axis::First => own(0),
            Axis::Second if self.kind.slides_along(axis, Dimension::Spatial) => {
                let (n, d) = (own(0), own(1));
                along(&(d - n * n.dot(&d)))
            }
            Axis::Second => own(1),
            Axis::Third => cross(&own(0), &self.direction(Axis::Second)),
            Axis::X => unit(0),
            Axis::Y => unit(1),
            Axis::Z => unit(2),
        }
    }

    /// Directions of the first body perpendicular to all slides. Along these the two joint points coincide. Empty if the joint has
    /// no slide.
    pub fn across_slides(&self, dimension: Dimension) -> impl Iterator<Item = Vector<T, 3>> {
        let two = match (self.kind.translation(dimension), dimension) {
            (Translation::Along(axis), Dimension::Planar) => {
                let n = self.direction(axis);
                [Some(Vector::<T, 3>::new(-n[1], n[0], T::ZERO)), None]
            }
            (Translation::Along(axis), Dimension::Spatial) => {
                transverse(&self.direction(axis), dimension).map(Some)
            }
            (Translation::Across(axis), _) => [Some(self.direction(axis)), None],
            (Translation::Fixed | Translation::Free, _) => [None, None],
        };
        two.into_iter().flatten()
    }

    /// Direction that both bodies have in common; `None` if there is no such direction. A joint without rotation has many, and one
    /// is chosen.
    #[must_use]
    pub fn common_axis(&self, dimension: Dimension) -> Option<Vector<T, 3>> {
        let axis = match self.kind.rotation(dimension) {
            Rotation::About(axis) => axis,
            Rotation::Fixed => match (self.kind.translation(dimension), dimension) {
                (Translation::Along(axis), _) => axis,
                (_, Dimension::Planar) => Axis::X,
                (_, Dimension::Spatial) => Axis::First,
            },
            Rotation::Universal(_) | Rotation::Free => return None,
        };
        Some(self.direction(axis))
    }

    /// Direction of the first body and direction of the second whose angle is constant, besides the [common
    /// axis](Self::common_axis).
    #[must_use]
    pub fn kept_angle(&self, dimension: Dimension) -> Option<[Vector<T, 3>; 2]> {
        match (self.kind.rotation(dimension), dimension) {
            (Rotation::Universal(axes), _) => Some(axes.map(|axis| self.direction(axis))),
            (Rotation::Fixed, Dimension::Spatial) => {
                self.common_axis(dimension).map(|n| transverse(&n, dimension))
            }
            (Rotation::Fixed, Dimension::Planar) | (Rotation::About(_) | Rotation::Free, _) => None,
        }
    }

    /// Directions [x1, x2, y] whose angle atan2(x2.y, x1.y) is the rotation about `axis`: x1, x2 in the first body and y in the
    /// second. For the second of two axes, x1, x2 are in the second body and y in the first, and the angle is minus the rotation.
    #[must_use]
    pub fn turn_directions(&self, dimension: Dimension, axis: Axis) -> [Vector<T, 3>; 3] {
        let n = self.direction(axis);
        let Rotation::Universal(axes) = self.kind.rotation(dimension) else {
            let [v, w] = transverse(&n, dimension);
            return [v, w, v];
        };
        let other = self.direction(axes[usize::from(axis == axes[0])]);
        let v = along(&(other - n * n.dot(&other)));
        [v, cross(&n, &v), other]
    }

    /// Number of the body in which the axis of a rotation is fixed: 1 for the second of two axes, else 0.
    #[must_use]
    pub fn side_of_turn(&self, dimension: Dimension, axis: Axis) -> usize {
        match self.kind.rotation(dimension) {
            Rotation::Universal([_, second]) => usize::from(axis == second),
            Rotation::Fixed | Rotation::About(_) | Rotation::Free => 0,
        }
    }

    /// True if the joint is a link that is hinged at its first body.
    #[must_use]
    pub fn is_hinged_link(&self) -> bool {
        self.kind.is_link() && self.axes[0].is_some()
    }

    /// True if the joint, in space, holds only a point of this body (0 or 1), so that the body may have any orientation.
    #[must_use]
    pub fn is_ball_at(&self, side: usize) -> bool {
        if self.kind.is_link() {
            return side == 1 || self.axes[0].is_none();
        }
        let (translation, rotation) =
            (self.kind.translation(Dimension::Spatial), self.kind.rotation(Dimension::Spatial));
        rotation == Rotation::Free && (side == 1 || translation == Translation::Fixed)
    }
}
