//! From the effects of a scene to actions: springs, dampers and given forces, which every build has.

use super::{Action, ActionError, Actions, Seat, Tables};
use crate::Real;
use crate::inputs::{Prescribed, SignalInput};
use crate::laws::scalar::Law;
use crate::scene::{AxisFrame, BodyId, EffectKind, JointId, Scene, Signal};
use alloc::vec::Vec;

impl<T: Real> Actions<T> {
    /// The actions of the enabled effects of a checked scene.
    ///
    /// # Errors
    /// [`ActionError::LeftOut`] for an enabled effect whose Cargo feature is off.
    pub fn new(scene: &Scene<T>) -> Result<Self, ActionError> {
        let mut compiler = Compiler {
            scene,
            effect: 0,
            #[cfg(feature = "tire")]
            roads: None,
            actions: Self {
                list: Vec::new(),
                prescribed: Prescribed::new(scene),
                tables: Tables::empty(),
            },
        };
        for (effect, e) in scene.effects.iter().enumerate().filter(|(_, e)| e.enabled) {
            if let Some((feature, false)) = feature(&e.kind) {
                return Err(ActionError::LeftOut { effect, feature });
            }
            compiler.effect = effect;
            compiler.add(&e.kind);
        }
        Ok(compiler.actions)
    }
}

/// The Cargo feature that brings an effect, and whether it is on; `None`: every build has the effect.
fn feature<T>(kind: &EffectKind<T>) -> Option<(&'static str, bool)> {
    macro_rules! named {
        ($name:literal) => {
            Some(($name, cfg!(feature = $name)))
        };
    }
    match kind {
        EffectKind::Polynomial { .. } => named!("polynomial"),
        EffectKind::Bumper { .. } => named!("bumper"),
        EffectKind::Limit { .. } => named!("limit"),
        EffectKind::Friction { .. } => named!("friction"),
        EffectKind::Bushing { .. } => named!("bushing"),
        EffectKind::AeroDrag { .. } => named!("drag"),
        EffectKind::SpeedHold { .. } => named!("speed-hold"),
        EffectKind::Tire { .. } => named!("tire"),
        EffectKind::Own { .. } => named!("own-laws"),
        EffectKind::SpringDamper { .. }
        | EffectKind::TorsionSpring { .. }
        | EffectKind::Force { .. }
        | EffectKind::BodyTorque { .. }
        | EffectKind::JointTorque { .. }
        | EffectKind::Actuator { .. } => None,
    }
}

pub(super) struct Compiler<'a, T> {
    pub(super) scene: &'a Scene<T>,
    effect: usize,
    /// Features of the left and the right track, and the course of a moving road, once a tire asks.
    #[cfg(feature = "tire")]
    pub(super) roads: Option<([crate::laws::Part; 2], Option<u32>)>,
    pub(super) actions: Actions<T>,
}

impl<T: Real> Compiler<'_, T> {
    pub(super) fn push(&mut self, action: Action<T>) {
        self.actions.list.push((self.effect, action));
    }

    pub(super) fn course(&mut self, course: SignalInput<T>) -> u32 {
        number(self.actions.prescribed.add(self.effect, course))
    }

    fn add(&mut self, kind: &EffectKind<T>) {
        match kind {
            EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length } => {
                let (stiffness, damping, free) = (*stiffness, *damping, *free_length);
                let law = Law::SpringDamper { stiffness, damping, free };
                self.push(Action::Length { ends: ends(bodies, points), law });
            }
            EffectKind::Actuator { bodies, points, course } => {
                let law = Law::Torque { course: self.course(SignalInput::new(course)) };
                self.push(Action::Length { ends: ends(bodies, points), law });
            }
            EffectKind::TorsionSpring { joint, stiffness, damping, free_value } => {
                let (stiffness, damping, free) = (*stiffness, *damping, *free_value);
                let law = Law::SpringDamper { stiffness, damping, free };
                self.about_axis(*joint, law);
            }
            EffectKind::JointTorque { joint, course } => {
                let law = Law::Torque { course: self.course(SignalInput::new(course)) };
                self.about_axis(*joint, law);
            }
            EffectKind::Force { body, at, course, frame } => {
                let Some(body) = body.index() else { return };
                let at = (body, *at);
                let action = match (course, frame) {
                    (Signal::Constant(force), AxisFrame::Global) => {
                        Action::Constant { at, force: *force }
                    }
                    _ => {
                        let course = self.course(SignalInput::new(course));
                        Action::Force { at, course, turns: *frame == AxisFrame::Body }
                    }
                };
                self.push(action);
            }
            EffectKind::BodyTorque { body, course } => {
                let Some(body) = body.index() else { return };
                let course = self.course(SignalInput::new(course));
                self.push(Action::Torque { body, course });
            }
            _ => {
                self.add_law(kind);
                self.add_law_on_body(kind);
            }
        }
    }

    /// A law about the one axis that a joint turns about: the scene's check refuses others.
    fn about_axis(&mut self, id: JointId, law: Law<T>) {
        if let Some((_, axis)) = self.scene.joints[id].kind.turn(self.scene.dimension) {
            self.push(Action::Angle { joint: id.index(), axis, law });
        }
    }
}

/// The places of two points.
pub(super) fn ends<T: Copy>(bodies: &[BodyId; 2], points: &[[T; 3]; 2]) -> [Seat<T>; 2] {
    [(bodies[0], points[0]), (bodies[1], points[1])]
}

pub(super) fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

/// The entries from `first` up to `end`.
#[cfg(any(feature = "polynomial", feature = "tire"))]
pub(super) fn part(first: usize, end: usize) -> crate::laws::Part {
    crate::laws::Part { first: number(first), n: number(end - first) }
}
