//! The wrenches that effects apply to bodies.
//!
//! ```text
//! spring-damper    k (L - L0) + c L'      tension along the line of its points
//! torsion spring   -(k (theta - theta0) + c theta')   about the joint's axis on the second body, opposite on the first
//! ```

use super::coordinate::Coordinate;
use super::frame::{lifted, unit};
use super::wrench::Wrench;
use crate::Real;
use crate::algebra::{Matrix, Vector, norm};
use crate::inputs::CourseInput;
use crate::model::State;
use crate::natural::{Affine, NaturalModel, joint_axes};
use crate::scene::{AxisFrame, BodyRef, EffectKind, Scene};
use alloc::vec::Vec;

/// An enabled effect as seen by the bodies.
#[derive(Debug, Clone)]
pub(super) enum Load<T: Real, const D: usize> {
    Spring {
        bodies: [BodyRef; 2],
        points: [Affine<T, D>; 2],
        /// Stiffness, damping, length without tension.
        law: [T; 3],
    },
    Torsion {
        about: About<T>,
        angle: Coordinate<T, D>,
        /// Where the state remembers the angle; `None`: neither body moves.
        memory: Option<usize>,
        /// Stiffness, damping, angle without torque.
        law: [T; 3],
    },
    JointTorque {
        about: About<T>,
        course: CourseInput<T>,
    },
    Force {
        body: usize,
        point: Affine<T, D>,
        course: CourseInput<T>,
        turns: bool,
    },
    BodyTorque {
        body: usize,
        course: CourseInput<T>,
    },
}

/// The axis of a torque between two bodies: fixed in the first, as in the reference configuration.
#[derive(Debug, Clone)]
pub(super) struct About<T: Real> {
    bodies: [BodyRef; 2],
    axis: Vector<T, 3>,
}

/// Where a wrench acts: a body and, for a force, a point.
pub(super) type Applied<T> = (BodyRef, Option<Vector<T, 3>>, Wrench<T>);

impl<T: Real, const D: usize> Load<T, D> {
    /// All enabled effects of a scene.
    pub(super) fn all(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Vec<Self> {
        let effects = scene.effects.iter().enumerate().filter(|(_, effect)| effect.enabled);
        effects.map(|(index, effect)| Self::new(scene, model, index, &effect.kind)).collect()
    }

    fn new(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        index: usize,
        kind: &EffectKind<T>,
    ) -> Self {
        let about = |joint: usize| {
            let joint = &scene.joints[joint];
            About { bodies: joint.bodies, axis: joint_axes(joint, scene.dimension)[0].into() }
        };
        match kind {
            EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length } => {
                Self::Spring {
                    bodies: *bodies,
                    points: [0, 1].map(|i| model.point(bodies[i], points[i])),
                    law: [*stiffness, *damping, *free_length],
                }
            }
            EffectKind::TorsionSpring { joint, stiffness, damping, free_value } => Self::Torsion {
                about: about(*joint),
                angle: Coordinate::angle(scene, model, &scene.joints[*joint], 0),
                memory: model.memory_of_effect(index),
                law: [*stiffness, *damping, *free_value],
            },
            EffectKind::JointTorque { joint, course } => {
                Self::JointTorque { about: about(*joint), course: CourseInput::new(course) }
            }
            EffectKind::Force { body, at, course, frame } => Self::Force {
                body: *body,
                point: model.point(BodyRef::Body(*body), *at),
                course: CourseInput::new(course),
                turns: *frame == AxisFrame::Body,
            },
            EffectKind::BodyTorque { body, course } => {
                Self::BodyTorque { body: *body, course: CourseInput::new(course) }
            }
            _ => todo!(),
        }
    }

    /// Hands out the wrenches it applies at a state; `turned` gives the rotation of a body.
    pub(super) fn apply(
        &self,
        state: &State<T>,
        turned: impl Fn(BodyRef) -> Matrix<T, 3>,
        mut take: impl FnMut(Applied<T>),
    ) {
        match self {
            Self::Spring { bodies, points, law } => {
                let [p, r] = [0, 1].map(|i| lifted(&points[i].value(&state.q)));
                let rate = lifted(&points[1].rate(&state.v)) - lifted(&points[0].rate(&state.v));
                let (line, length) = (r - p, norm(&(r - p)));
                if length > T::ZERO {
                    let n = line * (T::ONE / length);
                    let tension = law[0] * (length - law[2]) + law[1] * n.dot(&rate);
                    let pull = Wrench { force: n * tension, moment: Vector::zeros() };
                    take((bodies[0], Some(p), pull));
                    take((bodies[1], Some(r), pull.scaled(-T::ONE)));
                }
            }
            Self::Torsion { about, angle, memory, law } => {
                let (mut value, mut rate) = ([T::ZERO], [T::ZERO]);
                value[0] = memory.map_or(T::ZERO, |place| state.memory[place]);
                angle.track(&state.q, &mut value);
                angle.rates(&state.q, &state.v, &mut rate);
                about.apply(-(law[0] * (value[0] - law[2]) + law[1] * rate[0]), turned, take);
            }
            Self::JointTorque { about, course } => about.apply(course.at(state.t)[0], turned, take),
            Self::Force { body, point, course, turns } => {
                let body = BodyRef::Body(*body);
                let given = Vector::<T, 3>::from(course.at(state.t));
                let force = if *turns { turned(body) * given } else { given };
                let at = lifted(&point.value(&state.q));
                take((body, Some(at), Wrench { force, moment: Vector::zeros() }));
            }
            Self::BodyTorque { body, course } => {
                let given = course.at(state.t);
                let moment = if D == 2 { unit(2) * given[0] } else { given.into() };
                take((BodyRef::Body(*body), None, Wrench { force: Vector::zeros(), moment }));
            }
        }
    }
}

impl<T: Real> About<T> {
    fn apply(
        &self,
        torque: T,
        turned: impl Fn(BodyRef) -> Matrix<T, 3>,
        mut take: impl FnMut(Applied<T>),
    ) {
        let moment = turned(self.bodies[0]) * self.axis * torque;
        let wrench = Wrench { force: Vector::zeros(), moment };
        take((self.bodies[1], None, wrench));
        take((self.bodies[0], None, wrench.scaled(-T::ONE)));
    }
}
