//! From effects as data to effect elements. Effects that are switched off are not built.

use super::build::Builder;
use super::draft::{EffectDraft, GroupDraft, difference};
use super::error::ModelError;
use crate::Real;
use crate::algebra::Vector;
use crate::inputs::CourseInput;
use crate::laws::scalar::Law;
use crate::model::Owner;
use crate::scene::{AxisFrame, BodyRef, Course, Dimension, EffectKind};
use alloc::vec::Vec;

impl<T: Real> Builder<'_, T> {
    /// Adds one group for each enabled effect.
    pub(super) fn add_effects(&mut self) -> Result<(), ModelError> {
        let scene = self.scene;
        for (index, effect) in scene.effects.iter().enumerate().filter(|(_, e)| e.enabled) {
            let mut group = GroupDraft::new(Owner::Effect(index));
            match &effect.kind {
                EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length } => {
                    let second = self.point(bodies[1], points[1]);
                    let x = difference(&second, &self.point(bodies[0], points[0]));
                    let law = Law::SpringDamper {
                        stiffness: *stiffness,
                        damping: *damping,
                        free: *free_length,
                    };
                    group.effect = Some(EffectDraft::Length { x, law });
                }
                EffectKind::TorsionSpring { joint, stiffness, damping, free_value } => {
                    let law = Law::SpringDamper {
                        stiffness: *stiffness,
                        damping: *damping,
                        free: *free_value,
                    };
                    group.effect = Some(self.angle_effect(*joint, law));
                }
                EffectKind::JointTorque { joint, course } => {
                    let law = Law::Torque { course: self.course(course) };
                    group.effect = Some(self.angle_effect(*joint, law));
                }
                EffectKind::Force { body, at, course, frame } => {
                    self.point_force(&mut group, (*body, *at), course, *frame);
                }
                EffectKind::BodyTorque { body, course } => {
                    group.effect = self.body_torque(*body, course)?;
                }
            }
            self.groups.push(group);
        }
        Ok(())
    }

    fn course(&mut self, course: &Course<T>) -> u32 {
        self.courses.push(CourseInput::new(course));
        super::finish::index(self.courses.len() - 1)
    }

    fn angle_effect(&mut self, joint: usize, law: Law<T>) -> EffectDraft<T> {
        let [x1, x2, y] = self.angle(&self.scene.joints[joint]);
        EffectDraft::Angle { x1, x2, y, law }
    }

    fn point_force(
        &mut self,
        group: &mut GroupDraft<T>,
        (body, at): (usize, [T; 3]),
        course: &Course<T>,
        frame: AxisFrame,
    ) {
        if self.clusters.of_body[body].is_none() {
            return;
        }
        let point = self.point(BodyRef::Body(body), at);
        match (course, frame) {
            // A constant force has a potential, -F.r: it joins gravity.
            (Course::Constant(f), AxisFrame::Global) => {
                let f = Vector::<T, 3>::from(*f);
                group
                    .forces
                    .extend(point.into_iter().map(|(e, c)| (e, super::finish::lifted(c, &f))));
            }
            _ => {
                let frame = (frame == AxisFrame::Body).then(|| self.frame(body));
                let course = self.course(course) as usize;
                group.effect = Some(EffectDraft::Force { point, frame, course });
            }
        }
    }

    fn body_torque(
        &mut self,
        body: usize,
        course: &Course<T>,
    ) -> Result<Option<EffectDraft<T>>, ModelError> {
        let Some(cluster) = self.clusters.of_body[body] else { return Ok(None) };
        if !self.bases[cluster].is_full() {
            return Err(ModelError::NoRotation { body });
        }
        Ok(Some(match self.scene.dimension {
            Dimension::Planar => {
                let [x, y, _] = axes::<T>();
                let law = Law::Torque { course: self.course(course) };
                EffectDraft::Angle {
                    x1: self.direction(BodyRef::Ground, x),
                    x2: self.direction(BodyRef::Ground, y),
                    y: self.direction(BodyRef::Body(body), x),
                    law,
                }
            }
            Dimension::Spatial => {
                let frame = self.frame(body);
                EffectDraft::Torque { frame, course: self.course(course) as usize }
            }
        }))
    }

    /// The body's directions that were x, y, z in the reference configuration.
    fn frame(&mut self, body: usize) -> [Vec<(usize, crate::algebra::Coef<T>)>; 3] {
        axes::<T>().map(|d| self.direction(BodyRef::Body(body), d))
    }
}

/// The three global axes.
pub(crate) fn axes<T: Real>() -> [Vector<T, 3>; 3] {
    core::array::from_fn(|i| {
        let mut e = Vector::<T, 3>::zeros();
        e[i] = T::ONE;
        e
    })
}
