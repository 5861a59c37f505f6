//! Joint equations that sharing leaves over, and guides.
//!
//! | joint | shared | rows left (p = point on second less point on first; v, w across the axis in the first body) |
//! |---|---|---|
//! | revolute | point, axis | none |
//! | spherical | point | none |
//! | universal | point | a.b = cos |
//! | cylindrical | axis | p.v = 0, p.w = 0 |
//! | prismatic | axis | p.v = 0, p.w = 0, v_1.w_2 = 0; plane: p.n = 0 |
//! | planar | normal | p.n = 0 |
//! | distance | nothing | (p.p - L^2) / 2L = 0; hinged: p.a = const |

use super::basis::Combination;
use super::build::Builder;
use super::draft::{RowDraft, difference};
use crate::Real;
use crate::algebra::{Vector, across, along, cross, norm, unit};
use crate::scene::{Dimension, Joint, JointKind};
use alloc::vec::Vec;

/// The unit vector along a joint's axis number `i`; +z for a planar revolute.
pub(crate) fn unit_axis<T: Real>(joint: &Joint<T>, i: usize) -> Vector<T, 3> {
    match joint.axes[i] {
        Some(a) => along(&Vector::from(a)),
        None => unit(2),
    }
}

/// Two directions across `axis`, the second a quarter turn after the first, right-handed about the axis.
pub fn transverse<T: Real>(axis: &Vector<T, 3>, dimension: Dimension) -> [Vector<T, 3>; 2] {
    let v = match dimension {
        Dimension::Planar => unit(0),
        Dimension::Spatial => across(axis),
    };
    [v, cross(axis, &v)]
}

impl<T: Real> Builder<'_, T> {
    /// Adds the rows of a joint between different clusters.
    pub(super) fn add_joint(&mut self, index: usize) {
        let scene = self.scene;
        let joint = &scene.joints[index];
        if self.clusters.of(joint.bodies[0]) == self.clusters.of(joint.bodies[1]) {
            return;
        }
        let n = unit_axis(joint, 0);
        let rows = match (joint.kind, scene.dimension) {
            (JointKind::Universal, _) => {
                let b = unit_axis(joint, 1);
                let (x, y) =
                    (self.direction(joint.bodies[0], n), self.direction(joint.bodies[1], b));
                alloc::vec![dot(x, y, n.dot(&b))]
            }
            (JointKind::Prismatic, Dimension::Planar) => {
                let across = Vector::<T, 3>::new(-n[1], n[0], T::ZERO);
                let y = self.direction(joint.bodies[0], across);
                alloc::vec![dot(self.gap(joint), y, T::ZERO)]
            }
            (JointKind::Prismatic, Dimension::Spatial) => {
                let [v, w] = transverse(&n, scene.dimension);
                let mut rows = self.on_line(joint, &n);
                let (x, y) =
                    (self.direction(joint.bodies[0], v), self.direction(joint.bodies[1], w));
                rows.push(dot(x, y, T::ZERO));
                rows
            }
            (JointKind::Cylindrical, _) => self.on_line(joint, &n),
            (JointKind::Planar, _) => {
                let y = self.direction(joint.bodies[0], n);
                alloc::vec![dot(self.gap(joint), y, T::ZERO)]
            }
            (JointKind::Distance, _) => self.link(joint),
            (JointKind::Revolute | JointKind::Spherical | JointKind::Weld | JointKind::Free, _) => {
                return;
            }
        };
        self.joint_group(index).rows.extend(rows);
    }

    /// Point on the second body less point on the first.
    pub(super) fn gap(&mut self, joint: &Joint<T>) -> Combination<T> {
        let second = self.point(joint.bodies[1], joint.points[1]);
        let first = self.point(joint.bodies[0], joint.points[0]);
        difference(&second, &first)
    }

    fn on_line(&mut self, joint: &Joint<T>, n: &Vector<T, 3>) -> Vec<RowDraft<T>> {
        let gap = self.gap(joint);
        transverse(n, Dimension::Spatial)
            .into_iter()
            .map(|v| dot(gap.clone(), self.direction(joint.bodies[0], v), T::ZERO))
            .collect()
    }

    fn link(&mut self, joint: &Joint<T>) -> Vec<RowDraft<T>> {
        let gap = self.gap(joint);
        let d = Vector::<T, 3>::from(joint.points[1]) - Vector::from(joint.points[0]);
        let length = norm(&d);
        let scale = T::HALF / length;
        let constant = length * T::HALF;
        let mut rows =
            alloc::vec![RowDraft::Dot { x: gap.clone(), y: gap.clone(), scale, constant }];
        if joint.axes[0].is_some() {
            let axis = unit_axis(joint, 0);
            rows.push(dot(gap, self.direction(joint.bodies[0], axis), d.dot(&axis)));
        }
        rows
    }

    /// The combinations that measure a joint's angle about its axis: x1, x2 in the first body, y in the second.
    pub(super) fn angle(&mut self, joint: &Joint<T>) -> [Combination<T>; 3] {
        let [v, w] = transverse(&unit_axis(joint, 0), self.scene.dimension);
        let [first, second] = joint.bodies;
        [self.direction(first, v), self.direction(first, w), self.direction(second, v)]
    }

    /// Adds the rows of the guides.
    pub(super) fn add_guides(&mut self) {
        let scene = self.scene;
        for (guide, law) in scene.guides.iter().enumerate() {
            let joint = &scene.joints[law.joint];
            let row = match joint.kind {
                JointKind::Prismatic => {
                    let y = self.direction(joint.bodies[0], unit_axis(joint, 0));
                    RowDraft::GuidedSlide { x: self.gap(joint), y, guide }
                }
                _ => {
                    let [x1, x2, y] = self.angle(joint);
                    RowDraft::GuidedAngle { x1, x2, y, guide }
                }
            };
            self.joint_group(law.joint.index()).rows.push(row);
        }
    }
}

fn dot<T: Real>(x: Combination<T>, y: Combination<T>, constant: T) -> RowDraft<T> {
    RowDraft::Dot { x, y, scale: T::ONE, constant }
}

/// Unit axes of a joint: the planar joint's direction is made perpendicular to its normal.
pub fn joint_axes<T: Real>(joint: &Joint<T>, dimension: Dimension) -> [[T; 3]; 2] {
    let n = unit_axis(joint, 0);
    let second = match joint.kind {
        JointKind::Planar => {
            let d = if joint.axes[1].is_some() {
                unit_axis(joint, 1)
            } else {
                transverse(&n, dimension)[0]
            };
            let d = d - n * n.dot(&d);
            along(&d)
        }
        _ => unit_axis(joint, 1),
    };
    [n.into(), second.into()]
}

/// Directions [x1, x2, y] whose angle atan2(x2.y, x1.y) is a joint coordinate: number 0 with x1, x2 in the first body and y in
/// the second; number 1 (universal, minus its second angle) with x1, x2 in the second body and y in the first.
pub fn angle_directions<T: Real>(
    joint: &Joint<T>,
    dimension: Dimension,
    number: usize,
) -> [[T; 3]; 3] {
    let [n, b] = joint_axes(joint, dimension).map(Vector::<T, 3>::from);
    if joint.kind != JointKind::Universal {
        let n = if matches!(joint.kind, JointKind::Free) { unit(2) } else { n };
        let [v, w] = transverse(&n, dimension);
        return [v.into(), w.into(), v.into()];
    }
    let (axis, other) = if number == 0 { (n, b) } else { (b, n) };
    let v = other - axis * axis.dot(&other);
    let v = along(&v);
    [v.into(), cross(&axis, &v).into(), other.into()]
}
