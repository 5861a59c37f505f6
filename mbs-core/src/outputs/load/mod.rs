//! Effects as loads on bodies: their attachment points and laws.

mod apply;
mod gap;
mod work;

pub use gap::Gap;
pub(super) use gap::{MOST_GAPS, N_READING, Reading};

use super::coordinate::Coordinate;
use super::coupled_sum::CoupledSum;
use super::frame::Frame;
use super::wrench::Wrench;
use crate::Real;
use crate::actions::ActionError;
use crate::algebra::{Vector, unit};
use crate::effects::action::{Action, Actions, Attachment, Tables};
use crate::effects::{BodyLaw, Law};
use crate::inputs::Prescribed;
use crate::joint::{Axis, Freedom};
use crate::laws::LawInputs;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{Affine, NaturalModel};
use crate::scene::BodyId;
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

/// Enabled effects of a scene, with the signals of one instant.
#[derive(Debug, Clone)]
pub(super) struct Loads<T: Real, const D: usize> {
    list: Vec<Load<T, D>>,
    prescribed: Prescribed<T>,
    /// Vectors of the signals at this instant.
    values: Vec<[T; 3]>,
    tables: Tables<T>,
}

/// Load of one effect, or of a part of an effect, on bodies.
#[derive(Debug, Clone)]
pub(super) enum Load<T: Real, const D: usize> {
    /// Law of a measure between two bodies.
    Between { bodies: [BodyId; 2], gauge: Measure<T, D>, law: Law<T> },
    /// Law of a sum of joint coordinates and lengths.
    Sum { sum: CoupledSum<T, D>, law: Law<T> },
    /// Constant force in global axes.
    Constant { body: usize, point: Affine<T, D>, force: Vector<T, 3> },
    /// Force with the values of a signal. Its axes turn with the body if `turns` is true.
    Force { body: usize, point: Affine<T, D>, course: usize, turns: bool },
    /// Torque with the values of a signal.
    Torque { body: usize, frame: Frame<T, D>, course: usize },
    /// Law on one body.
    OnBody {
        body: usize,
        point: Affine<T, D>,
        frame: Frame<T, D>,
        axis: Vector<T, 3>,
        law: BodyLaw<T>,
    },
}

/// Measure of a scalar law.
#[derive(Debug, Clone)]
pub(super) enum Measure<T: Real, const D: usize> {
    Length {
        points: [Affine<T, D>; 2],
    },
    Along {
        points: [Affine<T, D>; 2],
        direction: Affine<T, D>,
        offset: T,
    },
    Angle {
        /// Axis of the joint in the reference configuration, fixed in the first body. `None`: the joint has two axes, one in each body.
        axis: Option<Vector<T, 3>>,
        angle: Coordinate<T, D>,
        /// Index of the angle in the memory of the state; `None`: neither body moves.
        memory: Option<usize>,
    },
    /// Component of the rotation vector of the second body relative to the first.
    Rotation {
        frames: Box<[Frame<T, D>; 2]>,
        number: usize,
        /// Index of the rotation in the memory of the state; `None`: neither body moves.
        memory: Option<usize>,
    },
}

impl<T: Real, const D: usize> Loads<T, D> {
    /// All enabled effects of a scene, and their indices.
    ///
    /// # Errors
    /// [`ActionError`] as when the model is built.
    pub(super) fn new(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Result<(Self, Vec<usize>), ActionError> {
        Self::of(scene, model, |_| true)
    }

    /// Enabled one-sided effects, and their indices.
    ///
    /// # Errors
    /// [`ActionError`] as when the model is built.
    pub(super) fn one_sided(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Result<(Self, Vec<usize>), ActionError> {
        Self::of(scene, model, |load| load.n_gaps() > 0)
    }

    /// Enabled effects whose laws have gaps or may have kinks, and their indices.
    ///
    /// # Errors
    /// [`ActionError`] as when the model is built.
    pub(super) fn with_kinks(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Result<(Self, Vec<usize>), ActionError> {
        Self::of(scene, model, |load| load.n_gaps() > 0 || load.may_have_kinks())
    }

    fn of(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        keeps: impl Fn(&Load<T, D>) -> bool,
    ) -> Result<(Self, Vec<usize>), ActionError> {
        let Actions { list, prescribed, tables } = Actions::new(scene)?;
        let load = |(effect, action): &(usize, Action<T>)| {
            (*effect, Load::new((scene, model), *effect, action))
        };
        let (effects, list) = list.iter().map(load).filter(|(_, load)| keeps(load)).unzip();
        let values = vec![[T::ZERO; 3]; prescribed.n_courses()];
        Ok((Self { list, prescribed, values, tables }, effects))
    }

    /// Loads, and the signals at the instant of a state. Inputs are those with which the accelerations of the state were computed.
    pub(super) fn at(&mut self, state: &State<T>) -> (&[Load<T, D>], LawInputs<'_, T>) {
        self.update(state);
        (&self.list, self.law_inputs())
    }

    /// Sets the signals to the instant of a state.
    pub(super) fn update(&mut self, state: &State<T>) {
        self.prescribed.write_followed(&state.signals, &mut self.values);
        self.prescribed.write(state.t, &state.applied, &mut [], &mut self.values);
    }

    /// List of the loads.
    pub(super) fn list(&self) -> &[Load<T, D>] {
        &self.list
    }

    /// Signals as last set.
    pub(super) fn law_inputs(&self) -> LawInputs<'_, T> {
        self.tables.law_inputs(&self.values)
    }
}

impl<T: Real, const D: usize> Load<T, D> {
    fn new(
        (scene, model): (&Scene<T>, &NaturalModel<T, D>),
        effect: usize,
        action: &Action<T>,
    ) -> Self {
        let points = |ends: &[Attachment<T>; 2]| [0, 1].map(|i| model.point(ends[i].0, ends[i].1));
        let point = |at: &(usize, [T; 3])| model.point(BodyId::Body(at.0), at.1);
        let (bodies, gauge, law) = match action {
            Action::Length { ends, law } => {
                (ends.map(|e| e.0), Measure::Length { points: points(ends) }, law)
            }
            Action::Along { ends, direction, offset, law, .. } => {
                let direction = model.direction(ends[0].0, *direction);
                let gauge = Measure::Along { points: points(ends), direction, offset: *offset };
                (ends.map(|e| e.0), gauge, law)
            }
            Action::Angle { joint, number, law } => {
                let (joint, dimension) = (&scene.joints[*joint], scene.dimension);
                let turn = joint.kind.freedom(dimension, *number).unwrap_or(Freedom::Turn(Axis::Z));
                let angle = Coordinate::of_freedom(scene, model, (joint, turn));
                let is_single = joint.kind.n_rotations(dimension) == 1;
                let axis = turn.axis().filter(|_| is_single).map(|axis| joint.direction(axis));
                let gauge = Measure::Angle { axis, angle, memory: model.memory_of_effect(effect) };
                (joint.bodies, gauge, law)
            }
            Action::Sum { terms, law } => {
                let memory = model.memory_of_effect(effect);
                let sum = CoupledSum::of_terms((scene, model), terms, memory);
                return Self::Sum { sum, law: *law };
            }
            Action::Turn { bodies, law } => {
                let angle = Coordinate::between(model, *bodies);
                let gauge = Measure::Angle {
                    axis: Some(unit(2)),
                    angle,
                    memory: model.memory_of_effect(effect),
                };
                (*bodies, gauge, law)
            }
            Action::Rotation { bodies, number, law } => {
                let frames = Box::new(bodies.map(|body| Frame::new(model, body)));
                let (number, memory) = (*number as usize, model.memory_of_effect(effect));
                (*bodies, Measure::Rotation { frames, number, memory }, law)
            }
            Action::Constant { at, force } => {
                return Self::Constant { body: at.0, point: point(at), force: (*force).into() };
            }
            Action::Force { at, course, turns } => {
                let (course, turns) = (*course as usize, *turns);
                return Self::Force { body: at.0, point: point(at), course, turns };
            }
            Action::Torque { body, course } => {
                let frame = Frame::new(model, BodyId::Body(*body));
                return Self::Torque { body: *body, frame, course: *course as usize };
            }
            Action::BodyLoad { at, axis, law } => {
                let frame = Frame::new(model, BodyId::Body(at.0));
                let (axis, law) = ((*axis).into(), *law);
                return Self::OnBody { body: at.0, point: point(at), frame, axis, law };
            }
        };
        Self::Between { bodies, gauge, law: *law }
    }
}
