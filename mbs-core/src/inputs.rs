//! Prescribed functions of time, prepared once: guide laws and signals.

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

/// The guides of a scene, its signals, and the signals of its effects.
///
/// The named signals come first in the list of all signals, by their numbers. Guides and effects that name a signal read its value there.
#[derive(Debug, Clone, PartialEq)]
pub struct Prescribed<T> {
    guides: Vec<GuideInput<T>>,
    signals: SignalGraph<T>,
    /// Index of the effect that each signal belongs to, and the signal.
    courses: Vec<(usize, SignalInput<T>)>,
}

impl<T: Real> Prescribed<T> {
    /// Prepares the guides of a scene, then the nonzero sums of its couplings, and the named signals. Signals of effects are added later.
    pub(crate) fn new(
        guides: &[Guide<T>],
        signals: &[NamedSignal<T>],
        sums: impl Iterator<Item = GuideInput<T>>,
    ) -> Self {
        let of_guides = guides.iter().map(|guide| GuideInput::new(&guide.law));
        let signals = SignalGraph::new(signals);
        Self { guides: of_guides.chain(sums).collect(), signals, courses: Vec::new() }
    }

    /// Adds a signal for `scene.effects[effect]` and returns its number.
    pub(crate) fn add(&mut self, effect: usize, course: SignalInput<T>) -> usize {
        self.courses.push((effect, course));
        self.n_courses() - 1
    }

    /// The guides in the order of the scene, then the sums of couplings that are not always zero.
    #[must_use]
    pub fn guides(&self) -> &[GuideInput<T>] {
        &self.guides
    }

    /// Signals of the scene, prepared.
    #[must_use]
    pub fn signals(&self) -> &SignalGraph<T> {
        &self.signals
    }

    /// Signals of effects, numbered after the named signals, each with the number of its effect.
    #[must_use]
    pub fn courses(&self) -> &[(usize, SignalInput<T>)] {
        &self.courses
    }

    /// Number of guides, sums of couplings included.
    #[must_use]
    pub fn n_guides(&self) -> usize {
        self.guides.len()
    }

    /// Number of signals: named signals and signals of effects.
    #[must_use]
    pub fn n_courses(&self) -> usize {
        self.signals.len() + self.courses.len()
    }

    /// Value, rate and acceleration of a guide at time `t`; for an input, its start value. Cost: the evaluation of all signals.
    ///
    /// # Panics
    /// If there is no such guide.
    #[must_use]
    pub fn guide_at(&self, guide: usize, t: T) -> [T; 3] {
        self.guides[guide].at(t, &self.signals.values(t))
    }

    /// Writes value, rate and acceleration of each guide and the vector of each signal at time `t`. `inputs` are those of a state, in their
    /// [places](Self::input).
    pub fn write(&self, t: T, inputs: &[T], guides: &mut [[T; 3]], courses: &mut [[T; 3]]) {
        self.write_parts(t, inputs.split_at(self.first_course()), (guides, courses));
    }

    /// Writes guides and signals at time `t`, the end of a step. Guides use the inputs `applied` in that step; signals use `inputs`.
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

    /// Index of each guide that is an input in the scene, and its start value.
    pub fn guide_inputs(&self) -> impl Iterator<Item = (usize, [T; 3])> + '_ {
        self.guides.iter().enumerate().filter_map(|(i, guide)| Some((i, guide.input()?)))
    }

    /// Index of each effect that has an input in the scene, and its start value.
    pub fn effect_inputs(&self) -> impl Iterator<Item = (usize, [T; 3])> + '_ {
        self.courses.iter().filter_map(|(effect, course)| Some((*effect, course.input()?)))
    }

    /// Start values of the inputs of a state: guides, then effects, three numbers each; then signals, one number each.
    #[must_use]
    pub fn inputs(&self) -> Vec<T> {
        let threes = self.guide_inputs().chain(self.effect_inputs()).flat_map(|(_, value)| value);
        threes.chain(self.signals.inputs().iter().map(|(_, value)| *value)).collect()
    }

    /// Index of the first input of an effect among the inputs of a state.
    fn first_course(&self) -> usize {
        3 * self.guide_inputs().count()
    }

    /// Indices of the input of `scene.effects[effect]` among a state's inputs: a force, a torque, or the argument of a user-defined law.
    ///
    /// # Errors
    /// [`InputError::NotAnInput`] if the effect has no input. An effect has an input if it is enabled and its signal is [`Signal::Input`].
    pub fn input(&self, effect: usize) -> Result<Range<usize>, InputError> {
        let place = self.effect_inputs().position(|(e, _)| e == effect);
        let place = place.ok_or(InputError::NotAnInput { number: effect })?;
        Ok(part(self.first_course() + 3 * place))
    }

    /// Indices of value, rate and acceleration of `scene.guides[guide]` among a state's inputs.
    ///
    /// # Errors
    /// [`InputError::NotAnInput`] if the guide is no input ([`Motion::Input`]).
    pub fn guide_input(&self, guide: usize) -> Result<Range<usize>, InputError> {
        let place = self.guide_inputs().position(|(g, _)| g == guide);
        place.map(|place| part(3 * place)).ok_or(InputError::NotAnInput { number: guide })
    }

    /// Index of `scene.signals[signal]` among a state's inputs.
    ///
    /// # Errors
    /// [`InputError::NotAnInput`] if the signal is no input ([`SignalKind::Input`](crate::scene::SignalKind::Input)).
    pub fn signal_input(&self, signal: usize) -> Result<usize, InputError> {
        let place = self.signals.inputs().iter().position(|(s, _)| *s == signal);
        let place = place.ok_or(InputError::NotAnInput { number: signal })?;
        Ok(self.first_course() + 3 * self.effect_inputs().count() + place)
    }

    /// Sets `scene.signals[signal]` between two steps, among the `inputs` of a state. The value holds as with
    /// [`set_input`](Self::set_input).
    ///
    /// # Errors
    /// [`InputError`] if the signal is [no input](Self::signal_input), or if the value is not finite.
    pub fn set_signal(&self, inputs: &mut [T], signal: usize, value: T) -> Result<(), InputError> {
        InputError::check(signal, &[value, T::ZERO, T::ZERO])?;
        inputs[self.signal_input(signal)?] = value;
        Ok(())
    }

    /// Sets the input of `scene.effects[effect]` between two steps, among the `inputs` of a state. The value acts from the beginning of the
    /// next step and holds until it is set again.
    ///
    /// # Errors
    /// [`InputError`] if the effect has [no input](Self::input), or if a component is not finite.
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

    /// Sets value, rate and acceleration that `scene.guides[guide]` has at the end of the next step, among the `inputs` of a state. A jump
    /// of the value gives an acceleration proportional to 1 / dt^2: pass a smooth reference.
    ///
    /// # Errors
    /// [`InputError`] if the guide is [no input](Self::guide_input), or if a component is not finite.
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

    /// True if the input of an effect or signal differs from the applied one.
    #[must_use]
    pub fn differs(&self, inputs: &[T], applied: &[T]) -> bool {
        if inputs.is_empty() {
            return false;
        }
        let first = self.first_course();
        inputs[first..] != applied[first..]
    }

    /// Copies the inputs of effects and signals into `applied`: they act at once. Inputs of guides stay, since they hold only at the end of
    /// the next step.
    pub fn apply(&self, inputs: &[T], applied: &mut [T]) {
        let first = self.first_course();
        applied[first..].copy_from_slice(&inputs[first..]);
    }
}

impl<T: Real> Prescribed<T> {
    /// Writes the signals that depend on the motion among all signals, with the values of a [state](crate::model::State::signals).
    /// [`write`](Self::write) leaves these values unchanged and copies them to the signals of effects that name them.
    pub fn write_followed(&self, signals: &[[T; 2]], courses: &mut [[T; 3]]) {
        let following = self.signals.following();
        let values = signals.iter().rev().take(following.clone().count()).rev();
        for (signal, &[value, rate]) in following.zip(values) {
            if let Some(to) = courses.get_mut(signal) {
                *to = [value, rate, T::ZERO];
            }
        }
    }

    /// Times at which signals and tables of forces jump or have corners. Cost: one pass over the tables; allocates.
    #[must_use]
    pub fn signal_times(&self) -> SignalTimes<T> {
        SignalTimes::new(&self.signals, self.courses.iter().map(|(_, course)| course.course()))
    }

    /// True if a signal names another signal that depends on the motion.
    #[must_use]
    pub fn follows_motion(&self, course: &Signal<T>) -> bool {
        let Signal::Named(of) = course else { return false };
        of.iter().flatten().any(|signal| self.signals.follows_motion(*signal))
    }

    /// Operations that compute the signals that depend on the motion, and the signals of effects that name them.
    ///
    /// Cost: one pass over named signals and signals of effects; allocates.
    #[must_use]
    pub fn feedback(&self) -> Feedback<T> {
        let follows = |signal| self.signals.follows_motion(signal);
        self.operations(follows, follows)
    }

    /// Operations that compute all signals that depend on other signals or on the motion and are not constant. The operations for signals
    /// of effects that name a variable signal come last. These operations are for steps on the tables of an exported model. Such steps read
    /// functions of time and inputs directly.
    ///
    /// States and measured coordinates have the same indices as in [`feedback`](Self::feedback).
    ///
    /// Cost: one pass over named signals and signals of effects; allocates.
    #[must_use]
    pub fn program(&self) -> Feedback<T> {
        let moves = |signal| !self.signals.is_constant(signal);
        let is_made = |signal: SignalId| {
            let kind = self.signals.kinds().nth(signal.index());
            kind.is_some_and(|(kind, _)| !kind.operands().is_empty() || kind.is_feedback())
        };
        self.operations(|signal| moves(signal) && is_made(signal), moves)
    }

    /// Operations that compute the signals for which `is_taken` holds, then the components of effects' signals for which `is_named` holds.
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

/// The three indices of one input.
fn part(first: usize) -> Range<usize> {
    first..first + 3
}

/// A guide law with its spline prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct GuideInput<T> {
    law: Motion<T>,
    curvature: Vec<T>,
    /// Offset that is added to the value of the law. `None`: the law has no offset.
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

    /// Value, rate and acceleration of the law, with the offset added to the value.
    fn shifted(&self, [value, rate, acceleration]: [T; 3]) -> [T; 3] {
        [self.offset.map_or(value, |offset| value + offset), rate, acceleration]
    }

    /// Offset that is added to the value of the law.
    #[must_use]
    pub const fn offset(&self) -> Option<T> {
        self.offset
    }

    /// Law of the guide. A table contains its prepared knots, which belong to [`curvature`](Self::curvature).
    #[must_use]
    pub fn law(&self) -> &Motion<T> {
        &self.law
    }

    /// Second derivatives at the knots of a table. Empty for other laws.
    #[must_use]
    pub fn curvature(&self) -> &[T] {
        &self.curvature
    }

    /// Value, rate and acceleration at time `t`. `signals` are the [values](SignalGraph::values) of the scene's signals at `t`. An input
    /// has its start value. Cost: one law; no allocation.
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

    /// Start value, start rate and start acceleration of an input; `None` for a law.
    fn input(&self) -> Option<[T; 3]> {
        match self.law {
            Motion::Input(motion) => Some(motion),
            _ => None,
        }
    }
}

/// A prepared signal: a constant, names of signals, a table with linear interpolation between its rows, or distance and speed of a moving
/// road.
#[derive(Debug, Clone, PartialEq)]
pub struct SignalInput<T> {
    course: Signal<T>,
    /// Speed v of a moving road [m/s]: the signal is (v t, v, 0).
    travel: Option<T>,
    /// Joint and number of the coordinate on which the signal is a force.
    on: Option<(usize, usize)>,
}

impl<T: Real> SignalInput<T> {
    /// Prepares the signal of an effect.
    #[must_use]
    pub fn new(course: &Signal<T>) -> Self {
        Self { course: course.clone(), travel: None, on: None }
    }

    /// Signal (speed t, speed, 0) of a moving road.
    #[must_use]
    pub fn travel(speed: T) -> Self {
        Self { course: Signal::Constant([T::ZERO; 3]), travel: Some(speed), on: None }
    }

    /// Makes the signal a force on a joint's coordinate.
    #[must_use]
    pub(crate) fn force_on(mut self, on: (usize, usize)) -> Self {
        self.on = Some(on);
        self
    }

    /// Signal of the effect. A moving road has a constant here that is not used.
    #[must_use]
    pub fn course(&self) -> &Signal<T> {
        &self.course
    }

    /// Speed of a moving road [m/s]; `None` for other signals.
    #[must_use]
    pub fn speed(&self) -> Option<T> {
        self.travel
    }

    /// Start value of an input; `None` for other signals.
    fn input(&self) -> Option<[T; 3]> {
        match self.course {
            Signal::Input(value) => Some(value),
            _ => None,
        }
    }

    /// Value at time `t`. `signals` are the values of the scene's signals at `t`. An input has its start value.
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
