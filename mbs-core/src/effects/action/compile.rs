//! Conversion of the effects of a scene to actions. Each kind of effect adds its actions by the methods of `Compiler`.

use super::{Action, Actions, Attachment};
use crate::Real;
use crate::algebra::{Vector, norm};
use crate::effects::laws::{CodeBodyLaw, CodeLaw, TorqueLaw};
use crate::effects::{BodyLaw, Law};
use crate::inputs::SignalInput;
use crate::joint::{Dimension, Freedom};
use crate::laws::Part;
use crate::laws::code::{BodyLaw as BodyCode, Code, ForceLaw};
use crate::laws::relation::Relation;
use crate::measure::TermInput;
use crate::scene::{BodyId, CouplingTerm, JointId, Signal, Surroundings};
use alloc::vec;

/// Converter of effects to actions: each kind of effect adds its actions to it.
pub(crate) struct Compiler<'a, T> {
    pub(crate) among: Surroundings<'a, T>,
    pub(crate) effect: usize,
    /// Features of the left and the right track, and the signal of a moving road; `None` until a tire needs them.
    pub(crate) roads: Option<([Part; 2], Option<u32>)>,
    /// Number of the signal whose value is the time; `None` until a law needs it.
    pub(crate) clock: Option<u32>,
    pub(crate) actions: Actions<T>,
}

impl<T: Real> Compiler<'_, T> {
    pub(crate) fn is_planar(&self) -> bool {
        self.among.dimension == Dimension::Planar
    }

    pub(crate) fn push(&mut self, action: Action<T>) {
        self.actions.list.push((self.effect, action));
    }

    /// Adds a signal to the signals of the effects, and returns its number.
    pub(crate) fn course(&mut self, signal: &Signal<T>) -> u32 {
        self.input(SignalInput::new(signal))
    }

    pub(super) fn input(&mut self, input: SignalInput<T>) -> u32 {
        number(self.actions.prescribed.add(self.effect, input))
    }

    /// Number of a signal whose first component is the time [s]. The first call adds the signal.
    fn clock(&mut self) -> u32 {
        if let Some(clock) = self.clock {
            return clock;
        }
        let clock = self.input(SignalInput::travel(T::ONE));
        *self.clock.insert(clock)
    }

    /// Adds a user-defined law along a line or on a joint, with its input.
    pub(crate) fn force_code(&mut self, law: &Code<dyn ForceLaw>, input: &Signal<T>) -> CodeLaw<T> {
        let effect = number(self.effect);
        let number = self.actions.tables.codes.add_force(effect, law);
        CodeLaw::new(number, [self.course(input), self.clock()])
    }

    /// Adds a user-defined law on a body, with its input.
    pub(crate) fn body_code(
        &mut self,
        law: &Code<dyn BodyCode>,
        input: &Signal<T>,
    ) -> CodeBodyLaw<T> {
        let effect = number(self.effect);
        let number = self.actions.tables.codes.add_body(effect, law);
        CodeBodyLaw::new(number, [self.course(input), self.clock()])
    }

    /// Adds the user-defined relation of a coupling.
    pub(crate) fn relation(&mut self, coupling: usize, relation: &Code<dyn Relation>) {
        self.actions.tables.codes.add_relation(number(coupling), relation);
    }

    /// Adds an action with this law. Nothing is added if the Cargo feature of the law is off; such an effect is refused elsewhere.
    pub(crate) fn act(
        &mut self,
        law: impl Into<Option<Law<T>>>,
        action: impl FnOnce(Law<T>) -> Action<T>,
    ) {
        if let Some(law) = law.into() {
            self.push(action(law));
        }
    }

    /// Adds a law along the line between two points.
    pub(crate) fn length(
        &mut self,
        bodies: [BodyId; 2],
        points: [[T; 3]; 2],
        law: impl Into<Option<Law<T>>>,
    ) {
        self.act(law, |law| Action::Length { ends: ends(bodies, points), law });
    }

    /// Adds a law of the distance of two points along a direction. The direction is a unit vector that is fixed in the first body.
    pub(crate) fn along(
        &mut self,
        bodies: [BodyId; 2],
        points: [[T; 3]; 2],
        direction: [T; 3],
        law: impl Into<Option<Law<T>>>,
    ) {
        let ends = ends(bodies, points);
        self.act(law, |law| Action::Along { ends, direction, offset: T::ZERO, of: None, law });
    }

    /// Index of the joint, and number of its coordinate, on which an effect acts.
    pub(crate) fn coordinate(
        &self,
        (id, coordinate): (JointId, Option<usize>),
    ) -> Option<(usize, usize)> {
        let joint = &self.among.joints[id.index()];
        let number = joint.kind.coordinate_or_default(coordinate, self.among.dimension)?;
        Some((id.index(), number))
    }

    /// Law of a force that follows a signal, on a coordinate. A signal that depends on the motion also gives the slopes of the
    /// force.
    pub(crate) fn torque_law(
        &mut self,
        signal: &Signal<T>,
        on: Option<(usize, usize)>,
    ) -> TorqueLaw {
        let Some(on) = on.filter(|_| self.actions.prescribed.follows_motion(signal)) else {
            return TorqueLaw::new(self.course(signal));
        };
        TorqueLaw::following(self.input(SignalInput::new(signal).force_on(on)))
    }

    /// Adds a law of a joint's coordinate. The check of a scene has refused coordinates that the joint does not have.
    pub(crate) fn on_joint(
        &mut self,
        (id, coordinate): (JointId, Option<usize>),
        law: impl Into<Option<Law<T>>>,
    ) {
        let Some((index, number)) = self.coordinate((id, coordinate)) else { return };
        let (joint, dimension) = (&self.among.joints[index], self.among.dimension);
        match joint.kind.freedom(dimension, number) {
            Some(Freedom::Slide(axis)) => {
                let direction = direction_of(joint.direction(axis).into());
                let ends = ends(joint.bodies, joint.points);
                let is_single = joint.kind.single(dimension).is_some();
                let of = (!is_single).then_some((index, number));
                self.act(law, |law| Action::Along { ends, direction, offset: T::ZERO, of, law });
            }
            Some(Freedom::Turn(_)) => {
                self.act(law, |law| Action::Angle { joint: index, number, law });
            }
            Some(Freedom::Ball) | None => {}
        }
    }

    /// Adds a law of a sum of joint coordinates and lengths.
    pub(crate) fn on_sum(&mut self, terms: &[CouplingTerm<T>], law: impl Into<Option<Law<T>>>) {
        self.act(law, |law| Action::Sum { terms: TermInput::all(terms), law });
    }

    /// Adds a law of the length of a line through points. For two points it is the distance between them.
    pub(crate) fn on_line(&mut self, points: &[Attachment<T>], law: impl Into<Option<Law<T>>>) {
        match points {
            [first, second] => {
                let ends = [*first, *second];
                self.act(law, |law| Action::Length { ends, law });
            }
            _ => self.act(law, |law| Action::Sum { terms: vec![TermInput::line(points)], law }),
        }
    }

    /// Adds a law on a body at a point, with a direction. The direction is a unit vector.
    pub(crate) fn on_body(
        &mut self,
        (body, at): Attachment<T>,
        axis: [T; 3],
        law: impl Into<Option<BodyLaw<T>>>,
    ) {
        if let (Some(body), Some(law)) = (body.index(), law.into()) {
            self.push(Action::BodyLoad { at: (body, at), axis, law });
        }
    }
}

/// Pairs each of two points with its body.
fn ends<T: Copy>(bodies: [BodyId; 2], points: [[T; 3]; 2]) -> [Attachment<T>; 2] {
    [(bodies[0], points[0]), (bodies[1], points[1])]
}

fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

/// Range of the entries from `first` to `end`, without `end`.
pub(crate) fn part(first: usize, end: usize) -> Part {
    Part { first: number(first), n: number(end - first) }
}

/// Unit vector along the direction `d`.
pub(crate) fn direction_of<T: Real>(d: [T; 3]) -> [T; 3] {
    let size = norm(&Vector::from(d));
    d.map(|x| x / size)
}
