//! Rolling bodies as models need them: unit directions, the plane with two directions in it, and the contact point.

use crate::Real;
use crate::algebra::{Vector, along, cross, unit};
use crate::joint::Dimension;
use crate::measure::{lies_flat, lowest_place};
use crate::scene::{BodyId, Rolling, RollingKind, transverse};

/// Rolling contact of a scene, in the reference configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingInput<T: Real> {
    /// Radius of the disc or ball [m]; zero for a blade.
    pub radius: T,
    /// True if the rolling body is a blade.
    pub is_blade: bool,
    /// Rolling body, and the body on which it rolls.
    pub bodies: [BodyId; 2],
    /// Centre of the disc or ball, or point of the blade [m].
    pub center: Vector<T, 3>,
    /// Unit axis of a disc in space, or unit direction of a blade. Zero for a ball and for a wheel in a planar scene.
    pub axis: Vector<T, 3>,
    /// Point of the plane [m].
    pub base: Vector<T, 3>,
    /// Unit normal of the plane, then two directions in the plane. In a planar scene the second direction is z.
    pub plane: [Vector<T, 3>; 3],
}

impl<T: Real> RollingInput<T> {
    /// Prepares a rolling contact of a checked scene.
    pub fn new(rolling: &Rolling<T>, dimension: Dimension) -> Self {
        let is_planar = dimension == Dimension::Planar;
        let radius = rolling.kind.radius().copied().unwrap_or(T::ZERO);
        let is_blade = matches!(rolling.kind, RollingKind::Blade { .. });
        let up = unit(if is_planar && !is_blade { 1 } else { 2 });
        let normal = match &rolling.plane {
            Some(plane) if !(is_planar && is_blade) => along(&Vector::from(plane.normal)),
            _ => up,
        };
        let axis = match &rolling.kind {
            RollingKind::Wheel { .. } if is_planar => Vector::zeros(),
            kind => kind.direction().map_or_else(Vector::zeros, |d| along(&Vector::from(*d))),
        };
        let [first, second] = match dimension {
            Dimension::Planar => [cross(&normal, &unit(2)), unit(2)],
            Dimension::Spatial => transverse(&normal, dimension),
        };
        let center = Vector::from(rolling.at);
        let bodies = [rolling.body, rolling.on];
        let plane = [normal, first, second];
        let mut new = Self { radius, is_blade, bodies, center, axis, base: center, plane };
        new.base = match &rolling.plane {
            Some(plane) if !(is_planar && is_blade) => Vector::from(plane.point),
            _ => new.contact(),
        };
        new
    }

    /// Lowest point of the disc or ball, or the point of the blade [m].
    pub fn contact(&self) -> Vector<T, 3> {
        if self.is_blade {
            return self.center;
        }
        self.center + lowest_place(self.radius, self.plane[0], self.axis)
    }

    /// Distance from the plane to the lowest point, along the normal [m]. It is zero in contact.
    pub fn gap(&self) -> T {
        self.plane[0].dot(&(self.contact() - self.base))
    }

    /// Number of constraint rows of the contact.
    pub fn n_rows(&self, dimension: Dimension) -> usize {
        if self.is_blade { 1 } else { dimension.count() }
    }

    /// True if the axis of the disc, or the blade, is within a thousandth of a radian of the normal.
    pub fn is_along_normal(&self) -> bool {
        lies_flat(&self.plane[0], &self.axis)
    }
}
