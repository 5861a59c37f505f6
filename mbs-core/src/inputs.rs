//! Prescribed functions of time: guide laws and courses, prepared once.

mod breaks;
mod coupling;
mod feedback;
mod signals;

pub use breaks::{SignalTime, SignalTimes};
pub use coupling::CouplingInput;
pub use feedback::Feedback;
pub use signals::SignalGraph;

use crate::Real;
use crate::feedback::FeedbackOperation;
use crate::laws::guide;
use crate::measure::{TermInput, knots};
use crate::scene::{
    CouplingMeasure, Guide, Interpolation, JointId, Motion, NamedSignal, Signal, SignalId,
};
use crate::step::InputError;
use alloc::vec::Vec;
use core::ops::Range;
use feedback::number;
use signals::value_of;

/// The guides of a scene, its signals, and the courses of its effects.
///
/// Signals are the first courses, by their numbers: those of effects that follow them, and guides, read them there.
#[derive(Debug, Clone, PartialEq)]
pub struct Prescribed<T> {
    guides: Vec<GuideInput<T>>,
    signals: SignalGraph<T>,
    /// The effect that asked for each course, and the course.
    courses: Vec<(usize, SignalInput<T>)>,
}

impl<T: Real> Prescribed<T> {
    /// The guides of a scene, then the sums of its couplings that are not always zero; its signals, and no other course.
    pub(crate) fn new(
        guides: &[Guide<T>],
        signals: &[NamedSignal<T>],
        sums: impl Iterator<Item = GuideInput<T>>,
    ) -> Self {
        let of_guides = guides.iter().map(|guide| GuideInput::new(&guide.law));
        let signals = SignalGraph::new(signals);
        Self { guides: of_guides.chain(sums).collect(), signals, courses: Vec::new() }
    }

    /// Adds a course for `scene.effects[effect]` and returns its number.
    pub(crate) fn add(&mut self, effect: usize, course: SignalInput<T>) -> usize {
        self.courses.push((effect, course));
        self.n_courses() - 1
    }

    /// The guides, in the order of the scene; then the sums of couplings that are not always zero.
    #[must_use]
    pub fn guides(&self) -> &[GuideInput<T>] {
        &self.guides
    }

    /// Signals of the scene, prepared.
    #[must_use]
    pub fn signals(&self) -> &SignalGraph<T> {
        &self.signals
    }

    /// The courses by number behind the signals, each with the effect that asked for it.
    #[must_use]
    pub fn courses(&self) -> &[(usize, SignalInput<T>)] {
        &self.courses
    }

    /// Number of guides, sums of couplings included.
    #[must_use]
    pub fn n_guides(&self) -> usize {
        self.guides.len()
    }

    /// Number of courses, signals included.
    #[must_use]
    pub fn n_courses(&self) -> usize {
        self.signals.len() + self.courses.len()
    }

    /// Value, rate and acceleration at time `t` of a guide; of an input, what it begins with. Cost: that of all signals.
    ///
    /// # Panics
    /// If there is no such guide.
    #[must_use]
    pub fn guide_at(&self, guide: usize, t: T) -> [T; 3] {
        self.guides[guide].at(t, &self.signals.values(t))
    }

    /// Writes value, rate and acceleration of each guide and the vector of each course at time `t`, with `inputs` in their
    /// [places](Self::input).
    pub fn write(&self, t: T, inputs: &[T], guides: &mut [[T; 3]], courses: &mut [[T; 3]]) {
        self.write_parts(t, inputs.split_at(self.first_course()), (guides, courses));
    }

    /// Writes guides and courses at time `t` where a step has ended that was made with the inputs `applied`; courses are those of
    /// `inputs`.
    pub fn write_end(
        &self,
        t: T,
        (applied, inputs): (&[T], &[T]),
        (guides, courses): (&mut [[T; 3]], &mut [[T; 3]]),
    ) {
        let first = self.first_course();
        self.write_parts(t, (&applied[..first], &inputs[first..]), (guides, courses));
    }

    fn write_parts(
        &self,
        t: T,
        (of_guides, of_courses): (&[T], &[T]),
        (guides, courses): (&mut [[T; 3]], &mut [[T; 3]]),
    ) {
        if guides.is_empty() && courses.is_empty() {
            return;
        }
        let n_of_effects = of_courses.len().saturating_sub(self.signals.inputs().len());
        let (of_courses, of_signals) = of_courses.split_at(n_of_effects);
        let (signals, courses) = courses.split_at_mut(self.signals.len().min(courses.len()));
        if !signals.is_empty() {
            self.signals.write(t, of_signals, signals);
        }
        let mut inputs = of_guides.as_chunks().0.iter();
        for (value, guide) in guides.iter_mut().zip(&self.guides) {
            let input = guide.input().and_then(|_| inputs.next());
            *value = input.map_or_else(|| guide.at(t, signals), |u| guide.shifted(*u));
        }
        let mut inputs = of_courses.as_chunks().0.iter();
        for (value, (_, course)) in courses.iter_mut().zip(&self.courses) {
            let input = course.input().and_then(|_| inputs.next());
            *value = input.map_or_else(|| course.at(t, signals), |u| *u);
        }
    }

    /// The scene's number of each guide that is an input, and what it begins with.
    pub fn guide_inputs(&self) -> impl Iterator<Item = (usize, [T; 3])> + '_ {
        self.guides.iter().enumerate().filter_map(|(i, guide)| Some((i, guide.input()?)))
    }

    /// The scene's number of each effect that has an input, and what it begins with.
    pub fn effect_inputs(&self) -> impl Iterator<Item = (usize, [T; 3])> + '_ {
        self.courses.iter().filter_map(|(effect, course)| Some((*effect, course.input()?)))
    }

    /// Start values of the inputs of a state: guides, then effects, three numbers each; then signals, one number each.
    #[must_use]
    pub fn inputs(&self) -> Vec<T> {
        let threes = self.guide_inputs().chain(self.effect_inputs()).flat_map(|(_, value)| value);
        threes.chain(self.signals.inputs().iter().map(|(_, value)| *value)).collect()
    }

    /// Place of the first number of an effect's input.
    fn first_course(&self) -> usize {
        3 * self.guide_inputs().count()
    }

    /// The place among a state's inputs of that of `scene.effects[effect]`: force, torque, or what its own law asks for.
    ///
    /// # Errors
    /// [`InputError::NotAnInput`] where the effect has none: it has one where it is enabled and its course is [`Signal::Input`].
    pub fn input(&self, effect: usize) -> Result<Range<usize>, InputError> {
        let place = self.effect_inputs().position(|(e, _)| e == effect);
        let place = place.ok_or(InputError::NotAnInput { number: effect })?;
        Ok(part(self.first_course() + 3 * place))
    }

    /// The place among a state's inputs of value, rate and acceleration of `scene.guides[guide]`.
    ///
    /// # Errors
    /// [`InputError::NotAnInput`] where the guide is none ([`Motion::Input`]).
    pub fn guide_input(&self, guide: usize) -> Result<Range<usize>, InputError> {
        let place = self.guide_inputs().position(|(g, _)| g == guide);
        place.map(|place| part(3 * place)).ok_or(InputError::NotAnInput { number: guide })
    }

    /// The place among a state's inputs of `scene.signals[signal]`.
    ///
    /// # Errors
    /// [`InputError::NotAnInput`] where the signal is none ([`SignalKind::Input`](crate::scene::SignalKind::Input)).
    pub fn signal_input(&self, signal: usize) -> Result<usize, InputError> {
        let place = self.signals.inputs().iter().position(|(s, _)| *s == signal);
        let place = place.ok_or(InputError::NotAnInput { number: signal })?;
        Ok(self.first_course() + 3 * self.effect_inputs().count() + place)
    }

    /// Sets `scene.signals[signal]` between two steps, among the `inputs` of a state, as [`set_input`](Self::set_input) does.
    ///
    /// # Errors
    /// [`InputError`] where the signal is [no input](Self::signal_input), or the value not finite.
    pub fn set_signal(&self, inputs: &mut [T], signal: usize, value: T) -> Result<(), InputError> {
        InputError::check(signal, &[value, T::ZERO, T::ZERO])?;
        inputs[self.signal_input(signal)?] = value;
        Ok(())
    }

    /// Sets the input of `scene.effects[effect]` between two steps, among the `inputs` of a state. It holds until it is set again,
    /// and the next step is made with it from its beginning.
    ///
    /// # Errors
    /// [`InputError`] where the effect has [none](Self::input), or where a component is not finite.
    pub fn set_input(
        &self,
        inputs: &mut [T],
        effect: usize,
        value: [T; 3],
    ) -> Result<(), InputError> {
        InputError::check(effect, &value)?;
        inputs[self.input(effect)?].copy_from_slice(&value);
        Ok(())
    }

    /// Sets value, rate and acceleration that `scene.guides[guide]` has at the end of the next step, among the `inputs` of a state.
    /// Values that jump make accelerations jump with the square of the step: pass what a smooth reference gives.
    ///
    /// # Errors
    /// [`InputError`] where the guide is [no input](Self::guide_input), or where a component is not finite.
    pub fn set_guide(
        &self,
        inputs: &mut [T],
        guide: usize,
        motion: [T; 3],
    ) -> Result<(), InputError> {
        InputError::check(guide, &motion)?;
        inputs[self.guide_input(guide)?].copy_from_slice(&motion);
        Ok(())
    }

    /// Has an effect another input than the one that was applied?
    #[must_use]
    pub fn differs(&self, inputs: &[T], applied: &[T]) -> bool {
        if inputs.is_empty() {
            return false;
        }
        let first = self.first_course();
        inputs[first..] != applied[first..]
    }

    /// The inputs of effects are applied now; guides are set for the end of the next step, where the state is not yet.
    pub fn apply(&self, inputs: &[T], applied: &mut [T]) {
        let first = self.first_course();
        applied[first..].copy_from_slice(&inputs[first..]);
    }
}

impl<T: Real> Prescribed<T> {
    /// Writes the signals that follow the motion, as a [state](crate::model::State::signals) has them, among the courses:
    /// [`write`](Self::write) keeps them, and gives them to the courses that name them.
    pub fn write_followed(&self, signals: &[[T; 2]], courses: &mut [[T; 3]]) {
        let following = self.signals.following();
        let values = signals.iter().rev().take(following.clone().count()).rev();
        for (signal, &[value, rate]) in following.zip(values) {
            if let Some(to) = courses.get_mut(signal) {
                *to = [value, rate, T::ZERO];
            }
        }
    }

    /// The times at which signals, and tables of forces, jump or have corners. Cost: one pass over them; allocates.
    #[must_use]
    pub fn signal_times(&self) -> SignalTimes<T> {
        SignalTimes::new(&self.signals, self.courses.iter().map(|(_, course)| course.course()))
    }

    /// Does a course name a signal that follows the motion?
    #[must_use]
    pub fn follows_motion(&self, course: &Signal<T>) -> bool {
        let Signal::Named(of) = course else { return false };
        of.iter().flatten().any(|signal| self.signals.follows_motion(*signal))
    }

    /// Operations that give the signals that follow the motion, and the courses that name them.
    ///
    /// Cost: one pass over signals and courses; allocates.
    #[must_use]
    pub fn feedback(&self) -> Feedback<T> {
        let follows = |signal| self.signals.follows_motion(signal);
        self.operations(follows, follows)
    }

    /// Operations that give all signals that are made of others or follow the motion, and are not constant. The courses that name those or other
    /// signals that are not constant follow. For steps on tables, where functions of time and inputs are courses by themselves.
    ///
    /// States and measured coordinates have the numbers that they have in [`feedback`](Self::feedback).
    ///
    /// Cost: one pass over signals and courses; allocates.
    #[must_use]
    pub fn program(&self) -> Feedback<T> {
        let moves = |signal| !self.signals.is_constant(signal);
        let is_made = |signal: SignalId| {
            let kind = self.signals.kinds().nth(signal.index());
            kind.is_some_and(|(kind, _)| !kind.operands().is_empty() || kind.is_feedback())
        };
        self.operations(|signal| moves(signal) && is_made(signal), moves)
    }

    /// The operations that give the signals that are taken, and the components of courses by those that are named.
    fn operations(
        &self,
        is_taken: impl Fn(SignalId) -> bool,
        is_named: impl Fn(SignalId) -> bool,
    ) -> Feedback<T> {
        let mut feedback = Feedback {
            steps: Vec::new(),
            measured: Vec::new(),
            starts: Vec::new(),
            signals: self.signals.following().map(number).collect(),
            curves: Vec::new(),
        };
        self.signals.add_feedback(is_taken, &mut feedback);
        for (i, (_, course)) in self.courses.iter().enumerate() {
            let Signal::Named(of) = course.course() else { continue };
            for (component, signal) in of.iter().enumerate() {
                let Some(signal) = signal.filter(|of| is_named(*of)) else { continue };
                let (from, component) = (number(signal.index()), number(component));
                let to = number(self.signals.len() + i);
                let operation = match course.on {
                    Some(on) if self.signals.follows_motion(signal) => {
                        let of =
                            CouplingMeasure::Coordinate { joint: JointId::new(on.0), number: on.1 };
                        let on = feedback.measure(TermInput::measured(&of));
                        FeedbackOperation::Force { from, on }
                    }
                    _ => FeedbackOperation::Component { from, component },
                };
                feedback.push(to, operation);
            }
        }
        feedback
    }
}

/// The numbers of one input.
fn part(first: usize) -> Range<usize> {
    first..first + 3
}

/// A guide law with its spline prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct GuideInput<T> {
    law: Motion<T>,
    curvature: Vec<T>,
    /// Offset that is added to the value of the law.
    offset: Option<T>,
}

impl<T: Real> GuideInput<T> {
    /// Prepares the law of a guide.
    #[must_use]
    pub fn new(law: &Motion<T>) -> Self {
        let (way, rows, ends) = match law {
            Motion::Table { rows, ends } => (Interpolation::Spline(*ends), rows, *ends),
            Motion::Monotone { rows, ends } => (Interpolation::Monotone(*ends), rows, *ends),
            _ => return Self { law: law.clone(), curvature: Vec::new(), offset: None },
        };
        let (rows, curvature) = knots(rows, way, false);
        Self { law: Motion::Table { rows, ends }, curvature, offset: None }
    }

    /// Adds `offset` to the value of the law.
    #[must_use]
    pub fn shifted_by(mut self, offset: T) -> Self {
        self.offset = Some(offset);
        self
    }

    /// A value, rate and acceleration of the law, with the offset.
    fn shifted(&self, [value, rate, acceleration]: [T; 3]) -> [T; 3] {
        [self.offset.map_or(value, |offset| value + offset), rate, acceleration]
    }

    /// Offset that is added to the value of the law.
    #[must_use]
    pub const fn offset(&self) -> Option<T> {
        self.offset
    }

    /// Law of the guide; a table goes through its knots, with their [`curvature`](Self::curvature).
    #[must_use]
    pub fn law(&self) -> &Motion<T> {
        &self.law
    }

    /// Second derivatives at the knots of a table; none for other laws.
    #[must_use]
    pub fn curvature(&self) -> &[T] {
        &self.curvature
    }

    /// Value, rate, acceleration at time `t`, with the [values](SignalGraph::values) of the scene's signals there; of an input, what
    /// it begins with. Cost: one law; no allocation.
    pub fn at(&self, t: T, signals: &[[T; 3]]) -> [T; 3] {
        let m = match &self.law {
            Motion::Table { rows, .. } | Motion::Monotone { rows, .. } => {
                guide::spline(rows, &self.curvature, t)
            }
            Motion::Sine { amplitude, frequency, phase } => {
                guide::sine(*amplitude, *frequency, *phase, t)
            }
            Motion::Ramp { rate } => guide::ramp(*rate, t),
            Motion::Input(motion) => return self.shifted(*motion),
            Motion::Signal(signal) => return self.shifted(value_of(*signal, signals)),
        };
        self.shifted([m.value, m.rate, m.acceleration])
    }

    /// Value, rate and acceleration that an input begins with; `None` of a law.
    fn input(&self) -> Option<[T; 3]> {
        match self.law {
            Motion::Input(motion) => Some(motion),
            _ => None,
        }
    }
}

/// A constant, signals, or a table, linear between its rows; or the way and speed of a road that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalInput<T> {
    course: Signal<T>,
    /// Speed of (speed t, speed, 0).
    travel: Option<T>,
    /// Joint and number of the coordinate that it is a force on.
    on: Option<(usize, usize)>,
}

impl<T: Real> SignalInput<T> {
    /// Prepares the course of an effect.
    #[must_use]
    pub fn new(course: &Signal<T>) -> Self {
        Self { course: course.clone(), travel: None, on: None }
    }

    /// The course (speed t, speed, 0) of a road.
    #[must_use]
    pub fn travel(speed: T) -> Self {
        Self { course: Signal::Constant([T::ZERO; 3]), travel: Some(speed), on: None }
    }

    /// Makes the course a force on a joint's coordinate.
    #[must_use]
    pub(crate) fn force_on(mut self, on: (usize, usize)) -> Self {
        self.on = Some(on);
        self
    }

    /// Course of the effect; a road that moves has a constant that is not read.
    #[must_use]
    pub fn course(&self) -> &Signal<T> {
        &self.course
    }

    /// The speed of a road that moves [m/s].
    #[must_use]
    pub fn speed(&self) -> Option<T> {
        self.travel
    }

    /// Start value of an input; `None` of other courses.
    fn input(&self) -> Option<[T; 3]> {
        match self.course {
            Signal::Input(value) => Some(value),
            _ => None,
        }
    }

    /// Value at time `t`, with the values of the scene's signals there; of an input, what it begins with.
    pub fn at(&self, t: T, signals: &[[T; 3]]) -> [T; 3] {
        if let Some(speed) = self.travel {
            return [speed * t, speed, T::ZERO];
        }
        let rows = match &self.course {
            Signal::Constant(value) | Signal::Input(value) => return *value,
            Signal::Named(of) => {
                return of.map(|of| of.map_or(T::ZERO, |signal| value_of(signal, signals)[0]));
            }
            Signal::Table(rows) => rows,
        };
        guide::linear(rows, |row| *row, t)
    }
}
