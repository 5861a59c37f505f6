//! Values of all output channels of a scene at a state.

use super::axes::OutputAxes;
use super::coordinate::Coordinate;
use super::forces::Forces;
use super::quantity::{Channel, Instant, Maker, magnitudes};
use crate::Real;
use crate::mechanism::{Output, Scene, given_values};
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use crate::step::StepError;
use alloc::vec::Vec;
use core::ops::Range;

/// Largest relative difference between the rotations by positions and by rates, since the start, for which turns count as known [-]. It is
/// that of the trapezoidal rule at half a radian per step.
const MISFIT: f64 = 2e-2;

/// Output channels of a scene in the order of its file; without outputs, every joint coordinate.
///
/// Angles include whole turns. [`track`](Self::track) counts the turns and must be called at every step, recorded or not. Rates determine
/// the turns if an angle changes by more than half a turn in a step. Counting starts from the initial value of the scene (`[[initial]]` or
/// a guide at time zero), or else from zero.
#[derive(Debug, Clone)]
pub struct Measures<T: Real, const D: usize> {
    channels: Vec<Recorded<T, D>>,
    /// Memory of the tracked joint coordinates: first their last values, then their rates. Then their rotations since the start according
    /// to the rates follow, then the deficits of their rotations according to positions. The last number is the time.
    memory: Vec<T>,
    n_values: usize,
    n_components: usize,
    invariant_error: T,
}

/// Recorded output: its channel, and the form of its values.
#[derive(Debug, Clone)]
struct Recorded<T: Real, const D: usize> {
    channel: Channel<T, D>,
    n_components: usize,
    /// Axes of the output, if they differ from those of its quantity.
    axes: Option<OutputAxes<T, D>>,
    /// Ranges of the vectors among the components. Their magnitudes follow the components.
    vectors: Vec<Range<usize>>,
    /// Indices of the values that are written in degrees.
    degrees: Vec<usize>,
}

impl<T: Real, const D: usize> Recorded<T, D> {
    fn new(output: &Output<T>, from: &mut Maker<'_, T, D>) -> Self {
        let components = output.quantity.components(from.scene);
        let vectors = if output.magnitude { magnitudes(&components) } else { Vec::new() };
        Self {
            channel: Channel::new(&output.quantity, from),
            n_components: components.len(),
            axes: OutputAxes::new(output, from.scene, from.model),
            vectors: vectors.into_iter().map(|vector| vector.places).collect(),
            degrees: output.places_in_degrees(from.scene),
        }
    }

    fn len(&self) -> usize {
        self.n_components + self.vectors.len()
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let (components, sizes) = out.split_at_mut(self.n_components);
        self.channel.write(now, components);
        if let Some(axes) = &self.axes {
            axes.turn(now.state, components);
        }
        for (size, places) in sizes.iter_mut().zip(&self.vectors) {
            let square = components[places.clone()].iter().fold(T::ZERO, |sum, x| sum + *x * *x);
            *size = square.sqrt();
        }
        for &place in &self.degrees {
            out[place] *= T::from_f64(180.0) / T::PI;
        }
    }
}

impl<T: Real, const D: usize> Measures<T, D> {
    /// Prepares the channels of a checked scene.
    ///
    /// # Errors
    /// [`ModelError::Dimension`] if the scene's dimension is not D.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ModelError> {
        Self::of_outputs(&scene.channels(), scene, model)
    }

    /// Prepares channels of these outputs, independent of the outputs of the scene.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn of_outputs(
        outputs: &[Output<T>],
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Result<Self, ModelError> {
        if scene.dimension.count() != D {
            return Err(ModelError::Dimension);
        }
        let starts = start_values(scene);
        let mut maker = Maker { scene, model, starts: &starts, values: Vec::new() };
        let channels = outputs.iter().map(|output| Recorded::new(output, &mut maker));
        let channels: Vec<_> = channels.collect();
        let n_components = channels.iter().map(Recorded::len).sum();
        let mut memory = maker.values;
        let n_values = memory.len();
        memory.resize(4 * n_values, T::ZERO);
        // The time -1 marks that no state was tracked yet. The first state is tracked from the start values.
        memory.push(-T::ONE);
        Ok(Self { channels, memory, n_values, n_components, invariant_error: T::ZERO })
    }

    /// True if any state has been tracked or written.
    #[must_use]
    pub fn has_begun(&self) -> bool {
        self.memory.last().is_some_and(|time| *time >= T::ZERO)
    }

    /// Sets the error of the run's energy invariant that the next [`write`](Self::write) writes [J]. It is zero at first.
    pub fn set_invariant_error(&mut self, error: T) {
        self.invariant_error = error;
    }

    /// Number of components of all channels: the number of values that [`write`](Self::write) writes.
    #[must_use]
    pub fn n_components(&self) -> usize {
        self.n_components
    }

    /// Number of components of each channel, in order.
    pub fn lengths(&self) -> impl Iterator<Item = usize> + '_ {
        self.channels.iter().map(Recorded::len)
    }

    /// Memory from which tracking resumes: the last values of tracked joint coordinates with their turns, then further numbers.
    #[must_use]
    pub fn memory(&self) -> &[T] {
        &self.memory
    }

    /// Mutable values of [`memory`](Self::memory), to restore a saved memory.
    pub fn memory_mut(&mut self) -> &mut [T] {
        &mut self.memory
    }

    /// Tracks all joint coordinates to `state`, so that no turn is lost. Call it at every step.
    ///
    /// Cost: a few products for each measured joint coordinate, one arc tangent for each angle; no allocation.
    ///
    /// # Errors
    /// [`StepError::TurnTooLarge`] with a joint whose turns are unknown. Its positions give less rotation than its rates, by more than a
    /// quarter of a turn and more than a fiftieth of all its rotation.
    pub fn track(&mut self, state: &State<T>) -> Result<(), StepError> {
        self.follow(state, |_, _| None, true)
    }

    /// Tracks all joint coordinates to `state`. `known` returns an angle with its turns, from the indices of a joint and its coordinate, if
    /// the caller knows it. Relative coordinates of a tree contain most angles. Several steps may lie between two calls. Rates then do not
    /// determine the turns, and no error is returned.
    pub fn track_with(&mut self, state: &State<T>, known: impl Fn(usize, usize) -> Option<T>) {
        // The argument `false` disables the check, so that no error can occur.
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
        for recorded in channels {
            let Some(value) = recorded.channel.followed() else { continue };
            let mut at = value.start;
            for (number, coordinate) in value.coordinates.iter().enumerate() {
                let end = at + coordinate.len();
                let mut expected = [T::ZERO; 4];
                let expected = &mut expected[..end - at];
                expected.copy_from_slice(&values[at..end]);
                if !coordinate.is_angle() {
                    // A rotation vector turns about its axis with the component of the angular velocity along it.
                    let before = [0, 1, 2].map(|i| rates.get(at + i).copied().unwrap_or(T::ZERO));
                    coordinate.turning(&state.q, &state.v, &mut rates[at..end]);
                    if has_passed && coordinate.is_turn() {
                        for ((expected, before), now) in
                            expected.iter_mut().zip(before).zip(&rates[at..end])
                        {
                            *expected = Coordinate::<T, D>::expected(*expected, [before, *now], dt);
                        }
                    }
                    coordinate.track(&state.q, expected, &mut values[at..end]);
                    at = end;
                    continue;
                }
                let (last, before) = (values[at], rates[at]);
                coordinate.rates(&state.q, &state.v, &mut rates[at..end]);
                if let Some(known) = value.joint.and_then(|joint| known(joint, number)) {
                    expected[0] = known;
                } else if has_passed {
                    expected[0] = Coordinate::<T, D>::expected(last, [before, rates[at]], dt);
                }
                coordinate.track(&state.q, expected, &mut values[at..end]);
                if let (true, true, Some(joint)) = (is_checked, has_passed, value.joint) {
                    turns[at] += expected[0] - last;
                    misfits[at] += expected[0] - values[at];
                    let (turn, misfit) = (expected[0] - last, misfits[at].abs());
                    let most = (T::PI * T::HALF).max(turns[at].abs() * T::from_f64(MISFIT));
                    if misfit > most && lost.is_ok() {
                        let joint = u32::try_from(joint).unwrap_or(u32::MAX);
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
    /// `forces` belong to the state. Without them, channels of reactions and effects are zero.
    ///
    /// Cost: as [`track`](Self::track), and a few products for each point; no allocation.
    ///
    /// # Errors
    /// The errors of [`track`](Self::track); all components are then written.
    ///
    /// # Panics
    /// If the length of `out` is not [`n_components`](Self::n_components).
    pub fn write(
        &mut self,
        state: &State<T>,
        forces: Option<&Forces<T, D>>,
        out: &mut [T],
    ) -> Result<(), StepError> {
        assert_eq!(out.len(), self.n_components, "one place per component");
        let tracked = self.track(state);
        let values = &self.memory[..self.n_values];
        let (reactions, effects) =
            (forces.and_then(Forces::reactions), forces.and_then(Forces::effects));
        let invariant_error = self.invariant_error;
        let now = Instant { state, values, reactions, effects, invariant_error };
        let mut rest = out;
        for recorded in &self.channels {
            let (here, tail) = rest.split_at_mut(recorded.len());
            recorded.write(&now, here);
            rest = tail;
        }
        tracked
    }
}

/// Coordinates of each joint at time zero that the scene determines; other coordinates are zero. Given values follow from initial
/// conditions, guides, and couplings.
///
/// Cost: one pass over joints, guides and initial values.
#[must_use]
pub fn start_values<T: Real>(scene: &Scene<T>) -> Vec<Vec<T>> {
    let or_zero =
        |values: Vec<Option<T>>| values.into_iter().map(Option::unwrap_or_default).collect();
    given_values(scene).into_iter().map(or_zero).collect()
}
