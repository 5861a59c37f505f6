//! Conversion of actions to effect elements, one group for each effect. Effects that are switched off get no group.

use super::basis::Combination;
use super::build::Builder;
use super::coordinate::{Coordinate, Places};
use super::error::ModelError;
use super::row_builder::{EffectDraft, GroupDraft, difference, lifted};
use crate::Real;
use crate::algebra::{Vector, unit};
use crate::effects::Law;
use crate::effects::action::{Action, Attachment};
use crate::effects::joint_torque::TorqueLaw;
use crate::joint::Dimension;
use crate::model::Owner;
use crate::scene::BodyId;
use alloc::vec::Vec;

impl<T: Real> Builder<'_, T> {
    /// Adds one group for each enabled effect.
    pub(super) fn add_effects(&mut self, list: &[(usize, Action<T>)]) -> Result<(), ModelError> {
        for of_effect in list.chunk_by(|a, b| a.0 == b.0) {
            let mut group = GroupDraft::new(Owner::Effect(of_effect[0].0));
            for (_, action) in of_effect {
                self.add_action(action, &mut group)?;
            }
            self.groups.push(group);
        }
        Ok(())
    }

    fn add_action(
        &mut self,
        action: &Action<T>,
        group: &mut GroupDraft<T>,
    ) -> Result<(), ModelError> {
        let draft = match action {
            Action::Length { ends, law } => {
                EffectDraft::Length { x: self.between(ends), law: *law }
            }
            Action::Along { ends, direction, offset, law, .. } => EffectDraft::Along {
                x: self.between(ends),
                d: self.direction(ends[0].0, Vector::from(*direction)),
                offset: *offset,
                law: *law,
            },
            Action::Angle { joint, number, law } => {
                let (joint, dimension) = (&self.scene.joints[*joint], self.scene.dimension);
                let turn = joint.kind.freedom(dimension, *number);
                match turn.map(|turn| self.coordinate(joint, dimension, turn)) {
                    Some(Coordinate::Angle { x1, x2, y, sign }) => {
                        // the angle of -x2 is minus the angle of x2
                        let x2 = if sign < T::ZERO { difference(&Vec::new(), &x2) } else { x2 };
                        EffectDraft::Angle { x1, x2, y, law: *law }
                    }
                    _ => return Ok(()),
                }
            }
            Action::Sum { terms, law } => {
                let terms = terms.iter().map(|term| self.coupled_draft(term, T::ONE)).collect();
                EffectDraft::Sum { terms, law: *law }
            }
            Action::Turn { bodies: [first, second], law } => {
                let [x, y] = [0, 1].map(unit);
                let (x1, x2) = (self.direction(*first, x), self.direction(*first, y));
                EffectDraft::Angle { x1, x2, y: self.direction(*second, x), law: *law }
            }
            Action::Rotation { bodies, number, law } => {
                bodies.iter().try_for_each(|body| self.needs_rotation(*body))?;
                let frames = bodies.map(|body| self.frame(body));
                EffectDraft::Rotation { frames, number: *number, law: *law }
            }
            Action::Constant { at: (body, at), force } => {
                // A constant force has a potential, -F.r, and is treated like gravity.
                if self.clusters.of_body[*body].is_some() {
                    let f = Vector::<T, 3>::from(*force);
                    let point = self.point(BodyId::Body(*body), *at);
                    group.forces.extend(point.into_iter().map(|(e, c)| (e, lifted(c, &f))));
                }
                return Ok(());
            }
            _ => return self.add_action_on_body(action, group),
        };
        group.effects.push(draft);
        Ok(())
    }

    /// Adds an action on one body, relative to the ground. A body that is welded to the ground gets no action.
    fn add_action_on_body(
        &mut self,
        action: &Action<T>,
        group: &mut GroupDraft<T>,
    ) -> Result<(), ModelError> {
        let (Action::Force { at: (body, _), .. }
        | Action::Torque { body, .. }
        | Action::BodyLoad { at: (body, _), .. }) = action
        else {
            return Ok(());
        };
        if self.clusters.of_body[*body].is_none() {
            return Ok(());
        }
        let me = BodyId::Body(*body);
        let draft = match action {
            Action::Force { at: (_, at), course, turns } => EffectDraft::Force {
                point: self.point(me, *at),
                frame: turns.then(|| self.frame(me)),
                course: *course,
            },
            Action::Torque { course, .. } => {
                self.needs_rotation(me)?;
                match self.scene.dimension {
                    Dimension::Planar => {
                        let [x, y] = [0, 1].map(unit);
                        EffectDraft::Angle {
                            x1: self.direction(BodyId::Ground, x),
                            x2: self.direction(BodyId::Ground, y),
                            y: self.direction(me, x),
                            law: Law::Torque(TorqueLaw::new(*course)),
                        }
                    }
                    Dimension::Spatial => {
                        EffectDraft::Torque { frame: self.frame(me), course: *course }
                    }
                }
            }
            Action::BodyLoad { at: (_, at), axis, law } => {
                if law.needs_rotation() {
                    self.needs_rotation(me)?;
                }
                let frame = law.needs_rotation().then(|| self.frame(me));
                EffectDraft::BodyLoad { point: self.point(me, *at), frame, axis: *axis, law: *law }
            }
            _ => return Ok(()),
        };
        group.effects.push(draft);
        Ok(())
    }

    /// Vector from the first attachment point to the second.
    fn between(&mut self, ends: &[Attachment<T>; 2]) -> Combination<T> {
        let second = self.point(ends[1].0, ends[1].1);
        difference(&second, &self.point(ends[0].0, ends[0].1))
    }

    /// Checks that a body has a full rotation. A rod held by ball joints has no rotation about its line.
    fn needs_rotation(&self, body: BodyId) -> Result<(), ModelError> {
        match (body, self.clusters.of(body)) {
            (BodyId::Body(body), Some(c)) if !self.bases[c].is_full() => {
                Err(ModelError::NoRotation { body })
            }
            _ => Ok(()),
        }
    }

    /// Directions of the body that were the axes x, y, z in the reference configuration; in the plane x and y.
    fn frame(&mut self, body: BodyId) -> Vec<Combination<T>> {
        let n = self.scene.dimension.count();
        (0..n).map(|i| self.direction(body, unit(i))).collect()
    }
}
