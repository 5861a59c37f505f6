//! Directions of a joint in the reference configuration, by its freedoms.

use super::Joint;
use crate::Real;
use crate::algebra::{Vector, across, along, cross, unit};
use crate::joint::{Axis, Dimension, Freedom, Rotation, Translation};

/// Two directions across `axis`, the second a quarter turn after the first, right-handed about the axis.
pub fn transverse<T: Real>(axis: &Vector<T, 3>, dimension: Dimension) -> [Vector<T, 3>; 2] {
    let v = match dimension {
        Dimension::Planar => unit(0),
        Dimension::Spatial => across(axis),
    };
    [v, cross(axis, &v)]
}

impl<T: Real> Joint<T> {
    /// Freedoms of the joint in a scene of that dimension, in the order of its coordinates.
    #[must_use]
    pub fn freedoms(&self, dimension: Dimension) -> &'static [Freedom] {
        self.kind.freedoms(dimension)
    }

    /// The unit vector of an axis; global z for one that the joint has not.
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

    /// Directions of the first body across all slides: the points keep together along these. None where the joint has no slide.
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

    /// The direction that both bodies have in common; of what does not turn at all, one of many.
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

    /// A direction of the first body and one of the second that keep their angle, beside the [common axis](Self::common_axis).
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

    /// Directions [x1, x2, y] whose angle atan2(x2.y, x1.y) is the turn about `axis`: x1, x2 in the first body and y in the second. About
    /// the second of two axes x1, x2 are in the second body and y in the first, and the angle is minus the turn.
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

    /// Number of the joint's body that has the axis of a turn: 1 for the second of two axes, else 0.
    #[must_use]
    pub fn side_of_turn(&self, dimension: Dimension, axis: Axis) -> usize {
        match self.kind.rotation(dimension) {
            Rotation::Universal([_, second]) => usize::from(axis == second),
            Rotation::Fixed | Rotation::About(_) | Rotation::Free => 0,
        }
    }

    /// Is it a link that is hinged at its first body?
    #[must_use]
    pub fn is_hinged_link(&self) -> bool {
        self.kind.is_link() && self.axes[0].is_some()
    }

    /// Does it hold its first or second body (0 or 1) in space at a point alone, whatever way that turns?
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
