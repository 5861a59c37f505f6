//! Rollings, as models take them: unit directions, the plane with two directions along it, the point of contact.

use crate::Real;
use crate::algebra::{Vector, along, cross, unit};
use crate::joint::Dimension;
use crate::measure::{lies_flat, lowest_place};
use crate::scene::{BodyId, Rolling, RollingKind, transverse};

/// An entry of a scene's rollings, reference configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingInput<T: Real> {
    /// The radius of a disc or ball; of a blade zero [m].
    pub radius: T,
    /// Is it a blade?
    pub is_blade: bool,
    /// The body, and what it rolls on.
    pub bodies: [BodyId; 2],
    /// The centre, or the point of a blade [m].
    pub center: Vector<T, 3>,
    /// The unit axis of a disc in space, or the unit direction of a blade; of a ball, and of a wheel in the plane, zero.
    pub axis: Vector<T, 3>,
    /// A point of the plane [m].
    pub base: Vector<T, 3>,
    /// The plane's unit normal, then two directions along it. In the plane the second is z.
    pub plane: [Vector<T, 3>; 3],
}

impl<T: Real> RollingInput<T> {
    /// Input of an entry that passed its scene's check.
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

    /// From the plane to the lowest point, along the normal [m]: zero where it touches.
    pub fn gap(&self) -> T {
        self.plane[0].dot(&(self.contact() - self.base))
    }

    /// Number of its rows.
    pub fn n_rows(&self, dimension: Dimension) -> usize {
        if self.is_blade { 1 } else { dimension.count() }
    }

    /// Is its axis, or the blade, along the normal, or within a thousandth of a radian of it?
    pub fn is_along_normal(&self) -> bool {
        lies_flat(&self.plane[0], &self.axis)
    }
}
