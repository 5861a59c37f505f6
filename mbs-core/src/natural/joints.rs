//! Joint equations that remain after sharing, and guides.
//!
//! | freedoms | shared | remaining rows (p = point on second less point on first; v, w across the axis, all in the first body) |
//! |---|---|---|
//! | no slide; slides | point; nothing | none; p.u = 0 for each u across the slides |
//! | no turn | axis | space: v_1.w_2 = 0 |
//! | one turn | space: axis | none |
//! | two turns | nothing | a.b = cos |
//! | ball | nothing | none |
//! | link | nothing | (p.p - L^2) / 2L = 0; hinged: p.a = const |

use super::basis::Combination;
use super::build::Builder;
use super::coordinate::{Coordinate, Places};
use super::row_builder::{RowDraft, difference};
use crate::Real;
use crate::algebra::{Vector, norm, unit};
use crate::joint::{Axis, Rotation};
use crate::scene::Joint;
use alloc::vec::Vec;

impl<T: Real> Builder<'_, T> {
    /// Adds the rows of a joint between different clusters.
    pub(super) fn add_joint(&mut self, index: usize) {
        let scene = self.scene;
        let joint = &scene.joints[index];
        if self.clusters.of(joint.bodies[0]) == self.clusters.of(joint.bodies[1]) {
            return;
        }
        let mut rows = Vec::new();
        for u in joint.across_slides(scene.dimension) {
            let gap = self.gap(joint);
            rows.push(dot(gap, self.direction(joint.bodies[0], u), T::ZERO));
        }
        if let Some([x, y]) = joint.kept_angle(scene.dimension) {
            // two directions of a joint without rotation are perpendicular
            let is_fixed = joint.kind.rotation(scene.dimension) == Rotation::Fixed;
            let constant = if is_fixed { T::ZERO } else { x.dot(&y) };
            let [first, second] = joint.bodies;
            rows.push(dot(self.direction(first, x), self.direction(second, y), constant));
        }
        if joint.kind.is_link() {
            rows.extend(self.link(joint));
        }
        if !rows.is_empty() {
            self.joint_group(index).rows.extend(rows);
        }
    }

    fn link(&mut self, joint: &Joint<T>) -> Vec<RowDraft<T>> {
        let gap = self.gap(joint);
        let d = Vector::<T, 3>::from(joint.points[1]) - Vector::from(joint.points[0]);
        let length = norm(&d);
        let scale = T::HALF / length;
        let constant = length * T::HALF;
        let mut rows =
            alloc::vec![RowDraft::Dot { x: gap.clone(), y: gap.clone(), scale, constant }];
        if joint.is_hinged_link() {
            let axis = joint.direction(Axis::First);
            rows.push(dot(gap, self.direction(joint.bodies[0], axis), d.dot(&axis)));
        }
        rows
    }

    /// Adds the rows of the guides.
    pub(super) fn add_guides(&mut self) {
        let scene = self.scene;
        for (guide, law) in scene.guides.iter().enumerate() {
            let joint = &scene.joints[law.joint];
            // the scene's check refuses guides of coordinates that the joint does not have
            let row = match joint.kind.freedom(scene.dimension, law.number) {
                None => self.guided_rotation(joint, law.number, guide),
                Some(freedom) => match self.coordinate(joint, scene.dimension, freedom) {
                    Coordinate::Slide { x, y } => RowDraft::GuidedSlide { x, y, guide },
                    Coordinate::Angle { x1, x2, y, sign } => {
                        let is_turned = sign < T::ZERO;
                        let x2 = if is_turned { difference(&Vec::new(), &x2) } else { x2 };
                        RowDraft::GuidedAngle { x1, x2, y, guide }
                    }
                    Coordinate::Rotation => continue,
                },
            };
            self.joint_group(law.joint.index()).rows.push(row);
        }
    }

    /// Row of a component of a rotation vector, whose guides follow each other.
    fn guided_rotation(&mut self, joint: &Joint<T>, number: usize, guide: usize) -> RowDraft<T> {
        let first = joint.kind.ball(self.scene.dimension).unwrap_or(number);
        let k = number - first;
        let [one, two] = joint.bodies;
        let x = [0, 1, 2].map(|a| self.direction(one, unit(a)));
        let y = [1, 2].map(|n| self.direction(two, unit((k + n) % 3)));
        RowDraft::GuidedRotation { x, y, number: k, guide: guide - k }
    }
}

fn dot<T: Real>(x: Combination<T>, y: Combination<T>, constant: T) -> RowDraft<T> {
    RowDraft::Dot { x, y, scale: T::ONE, constant }
}
