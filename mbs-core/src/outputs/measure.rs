//! The numbers of all channels of a scene at a state.

use super::coordinate::Coordinate;
use crate::Real;
use crate::inputs::GuideInput;
use crate::model::State;
use crate::natural::{Affine, ModelError, NaturalModel};
use crate::scene::{InitialTarget, Joint, JointId, Quantity, Scene};
use crate::step::StepError;
use alloc::vec;
use alloc::vec::Vec;

/// The part of all turns that positions and rates may differ by before an angle is no longer known: that of the trapezoidal rule at half a
/// radian a step.
const MISFIT: f64 = 2e-2;

/// Measures the output channels of a scene in the order of its file; without outputs, every joint coordinate.
///
/// Angles are not wrapped: [`track`](Self::track) counts turns and must see every step, recorded or not; more than half a turn a step is
/// followed by the rates. Counting starts from the scene's initial value (an `[[initial]]` entry or a guide at time zero), else from zero.
#[derive(Debug, Clone)]
pub struct Measures<T: Real, const D: usize> {
    channels: Vec<Channel<T, D>>,
    /// Last values of all tracked joint coordinates, then their rates, then what the rates tell of their turns since the start, then what the
    /// positions do less, then the time.
    memory: Vec<T>,
    n_values: usize,
    n_components: usize,
}

/// What one channel reads.
#[derive(Debug, Clone)]
enum Channel<T: Real, const D: usize> {
    Position(Affine<T, D>),
    Velocity(Affine<T, D>),
    Acceleration(Affine<T, D>),
    /// Coordinates, where their last values start in the memory, and the joint.
    Value(Vec<Coordinate<T, D>>, usize, usize),
    Rate(Vec<Coordinate<T, D>>),
    Reaction(usize),
}

impl<T: Real, const D: usize> Measures<T, D> {
    /// Prepares the channels of a scene that passed its check.
    ///
    /// # Errors
    /// [`ModelError::Dimension`] when the scene's dimension is not D.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ModelError> {
        if scene.dimension.count() != D {
            return Err(ModelError::Dimension);
        }
        let mut measures =
            Self { channels: Vec::new(), memory: Vec::new(), n_values: 0, n_components: 0 };
        let starts = start_values(scene);
        if scene.outputs.is_empty() {
            for joint in 0..scene.joints.len() {
                if scene.joints[joint].kind.n_coordinates(scene.dimension) > 0 {
                    measures.add(
                        (scene, &starts),
                        model,
                        &Quantity::JointValue { joint: JointId::new(joint) },
                    );
                }
            }
        }
        for output in &scene.outputs {
            measures.add((scene, &starts), model, &output.quantity);
        }
        measures.n_values = measures.memory.len();
        measures.memory.resize(4 * measures.n_values, T::ZERO);
        // No state was seen yet: the first one is followed from the start values.
        measures.memory.push(-T::ONE);
        Ok(measures)
    }

    fn add(
        &mut self,
        (scene, starts): (&Scene<T>, &[Vec<T>]),
        model: &NaturalModel<T, D>,
        quantity: &Quantity<T>,
    ) {
        let point = |body, at| model.point(body, at);
        let coordinates = |joint: JointId| Coordinate::of_joint(scene, model, &scene.joints[joint]);
        let channel = match *quantity {
            Quantity::Position { body, at } => Channel::Position(point(body, at)),
            Quantity::Velocity { body, at } => Channel::Velocity(point(body, at)),
            Quantity::Acceleration { body, at } => Channel::Acceleration(point(body, at)),
            Quantity::JointValue { joint } => {
                let start = self.memory.len();
                self.memory.extend_from_slice(&starts[joint.index()]);
                Channel::Value(coordinates(joint), start, joint.index())
            }
            Quantity::JointRate { joint } => Channel::Rate(coordinates(joint)),
            Quantity::Reaction { joint } => Channel::Reaction(joint.index()),
        };
        self.n_components += channel.len();
        self.channels.push(channel);
    }

    /// Number of components of all channels: the places that [`write`](Self::write) fills.
    #[must_use]
    pub fn n_components(&self) -> usize {
        self.n_components
    }

    /// Number of components of each channel, in order.
    pub fn lengths(&self) -> impl Iterator<Item = usize> + '_ {
        self.channels.iter().map(Channel::len)
    }

    /// The last values of the joint coordinates that are followed, with their turns; then the state from which following them continues.
    #[must_use]
    pub fn memory(&self) -> &[T] {
        &self.memory
    }

    /// The same, to restore others.
    pub fn memory_mut(&mut self) -> &mut [T] {
        &mut self.memory
    }

    /// Follows all joint coordinates to `state`, so that no turn is lost. Call it at every step.
    ///
    /// Cost: a few products for each measured joint coordinate, one arc tangent for each angle; no allocation.
    ///
    /// # Errors
    /// [`StepError::TurnTooLarge`] names a joint whose turns are not known: its positions give a quarter of a turn less than its rates, and
    /// a fiftieth of all turns.
    pub fn track(&mut self, state: &State<T>) -> Result<(), StepError> {
        self.follow(state, |_, _| None, true)
    }

    /// The same where angles, by joint and number, are known with their turns, as most of a tree are. Its steps may be any number of steps of
    /// its rule: rates do not determine the turns between them, and nothing is refused.
    pub fn track_with(&mut self, state: &State<T>, known: impl Fn(usize, usize) -> Option<T>) {
        // Without a check there is no error.
        let _ = self.follow(state, known, false);
    }

    fn follow(
        &mut self,
        state: &State<T>,
        known: impl Fn(usize, usize) -> Option<T>,
        is_checked: bool,
    ) -> Result<(), StepError> {
        let Self { channels, memory, n_values: n, .. } = self;
        let (values, rest) = memory.split_at_mut(*n);
        let (rates, rest) = rest.split_at_mut(*n);
        let (turns, rest) = rest.split_at_mut(*n);
        let (misfits, time) = rest.split_at_mut(*n);
        let dt = state.t - time[0];
        let has_passed = dt > T::ZERO && time[0] >= T::ZERO;
        time[0] = state.t;
        let mut lost = Ok(());
        for channel in channels {
            let Channel::Value(coordinates, start, joint) = channel else { continue };
            let mut at = *start;
            for (number, coordinate) in coordinates.iter().enumerate() {
                let end = at + coordinate.len();
                let mut expected = [T::ZERO; 3];
                let expected = &mut expected[..end - at];
                expected.copy_from_slice(&values[at..end]);
                if !coordinate.is_angle() {
                    coordinate.track(&state.q, expected, &mut values[at..end]);
                    at = end;
                    continue;
                }
                let (last, before) = (values[at], rates[at]);
                coordinate.rates(&state.q, &state.v, &mut rates[at..end]);
                if let Some(known) = known(*joint, number) {
                    expected[0] = known;
                } else if has_passed {
                    expected[0] = Coordinate::<T, D>::expected(last, [before, rates[at]], dt);
                }
                coordinate.track(&state.q, expected, &mut values[at..end]);
                if is_checked && has_passed {
                    turns[at] += expected[0] - last;
                    misfits[at] += expected[0] - values[at];
                    let (turn, misfit) = (expected[0] - last, misfits[at].abs());
                    let most = (T::PI * T::HALF).max(turns[at].abs() * T::from_f64(MISFIT));
                    if misfit > most && lost.is_ok() {
                        let joint = u32::try_from(*joint).unwrap_or(u32::MAX);
                        lost = Err(StepError::TurnTooLarge { joint, turn: turn.to_f64() });
                    }
                }
                at = end;
            }
        }
        lost
    }

    /// Tracks `state` and writes all components in the order of the channels.
    ///
    /// `reaction` gives the reaction of a joint (planar [Fx, Fy, Mz] in the first three places); it is asked only for the
    /// channels that are reactions.
    ///
    /// Cost: as [`track`](Self::track), and a few products for each point; no allocation.
    ///
    /// # Errors
    /// As for [`track`](Self::track); all is written.
    ///
    /// # Panics
    /// If `out` has not [`n_components`](Self::n_components) places.
    pub fn write(
        &mut self,
        state: &State<T>,
        mut reaction: impl FnMut(usize) -> [T; 6],
        out: &mut [T],
    ) -> Result<(), StepError> {
        assert_eq!(out.len(), self.n_components, "one place per component");
        let tracked = self.track(state);
        let mut rest = out;
        for channel in &self.channels {
            let (here, tail) = rest.split_at_mut(channel.len());
            rest = tail;
            match channel {
                Channel::Position(x) => copy(x.value(&state.q).as_slice(), here),
                Channel::Velocity(x) => copy(x.rate(&state.v).as_slice(), here),
                Channel::Acceleration(x) => copy(x.rate(&state.a).as_slice(), here),
                Channel::Value(_, start, _) => copy(&self.memory[*start..self.n_values], here),
                Channel::Rate(coordinates) => {
                    let mut at = 0;
                    for coordinate in coordinates {
                        let mut rates = [T::ZERO; 3];
                        let n = coordinate.len();
                        coordinate.rates(&state.q, &state.v, &mut rates[..n]);
                        copy(&rates, &mut here[at..at + n]);
                        at += n;
                    }
                }
                Channel::Reaction(joint) => copy(&reaction(*joint), here),
            }
        }
        tracked
    }
}

impl<T: Real, const D: usize> Channel<T, D> {
    fn len(&self) -> usize {
        match self {
            Self::Position(_) | Self::Velocity(_) | Self::Acceleration(_) => D,
            Self::Value(coordinates, ..) | Self::Rate(coordinates) => {
                coordinates.iter().map(Coordinate::len).sum()
            }
            Self::Reaction(_) => 3 * (D - 1),
        }
    }
}

fn copy<T: Real>(from: &[T], to: &mut [T]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// The coordinates of each joint at time zero where the scene gives them (initial values, guides); zero elsewhere.
///
/// Cost: one pass over joints, guides and initial values.
#[must_use]
pub fn start_values<T: Real>(scene: &Scene<T>) -> Vec<Vec<T>> {
    let zeros = |joint: &Joint<T>| vec![T::ZERO; joint.kind.n_coordinates(scene.dimension)];
    let mut values: Vec<Vec<T>> = scene.joints.iter().map(zeros).collect();
    for guide in &scene.guides {
        if let Some(values) = values.get_mut(guide.joint.index()) {
            values.fill(GuideInput::new(&guide.law).at(T::ZERO)[0]);
        }
    }
    for initial in &scene.initials {
        if let InitialTarget::Joint { joint, value: Some(value), .. } = &initial.target
            && let Some(values) = values.get_mut(joint.index())
        {
            values.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        }
    }
    values
}
