//! The numbers of all channels of a scene at a state.

use super::coordinate::Coordinate;
use crate::Real;
use crate::inputs::GuideInput;
use crate::model::State;
use crate::natural::{Affine, ModelError, NaturalModel};
use crate::scene::{BodyRef, InitialTarget, Joint, Quantity, Scene};
use alloc::vec;
use alloc::vec::Vec;

/// Measures the output channels of a scene in the order of its file; without outputs, every joint coordinate.
///
/// Angles are not wrapped: [`track`](Self::track) counts turns and must see every step, recorded or not. Counting starts
/// from the scene's initial value (an `[[initial]]` entry or a guide at time zero), else from zero.
#[derive(Debug, Clone)]
pub struct Measures<T: Real, const D: usize> {
    channels: Vec<Channel<T, D>>,
    /// Last values of all tracked joint coordinates.
    memory: Vec<T>,
    n_components: usize,
}

/// What one channel reads.
#[derive(Debug, Clone)]
enum Channel<T: Real, const D: usize> {
    Position(Affine<T, D>),
    Velocity(Affine<T, D>),
    Acceleration(Affine<T, D>),
    /// Coordinates, and where their last values start in the memory.
    Value(Vec<Coordinate<T, D>>, usize),
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
        let mut measures = Self { channels: Vec::new(), memory: Vec::new(), n_components: 0 };
        let starts = start_values(scene);
        if scene.outputs.is_empty() {
            for joint in 0..scene.joints.len() {
                if scene.joints[joint].kind.n_coordinates(scene.dimension) > 0 {
                    measures.add((scene, &starts), model, &Quantity::JointValue { joint });
                }
            }
        }
        for output in &scene.outputs {
            measures.add((scene, &starts), model, &output.quantity);
        }
        Ok(measures)
    }

    fn add(
        &mut self,
        (scene, starts): (&Scene<T>, &[Vec<T>]),
        model: &NaturalModel<T, D>,
        quantity: &Quantity<T>,
    ) {
        let point = |body, at| model.point(BodyRef::Body(body), at);
        let coordinates = |joint: usize| Coordinate::of_joint(scene, model, &scene.joints[joint]);
        let channel = match *quantity {
            Quantity::Position { body, at } => Channel::Position(point(body, at)),
            Quantity::Velocity { body, at } => Channel::Velocity(point(body, at)),
            Quantity::Acceleration { body, at } => Channel::Acceleration(point(body, at)),
            Quantity::JointValue { joint } => {
                let start = self.memory.len();
                self.memory.extend_from_slice(&starts[joint]);
                Channel::Value(coordinates(joint), start)
            }
            Quantity::JointRate { joint } => Channel::Rate(coordinates(joint)),
            Quantity::Reaction { joint } => Channel::Reaction(joint),
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

    /// The last values of the joint coordinates that are followed, with their turns.
    #[must_use]
    pub fn memory(&self) -> &[T] {
        &self.memory
    }

    /// The same, to go on from others.
    pub fn memory_mut(&mut self) -> &mut [T] {
        &mut self.memory
    }

    /// Follows all joint coordinates to `state`, so that no turn is lost. Call it at every step.
    ///
    /// Cost: a few products for each measured joint coordinate, one arc tangent for each angle; no allocation.
    pub fn track(&mut self, state: &State<T>) {
        for channel in &self.channels {
            if let Channel::Value(coordinates, start) = channel {
                let mut at = *start;
                for coordinate in coordinates {
                    let end = at + coordinate.len();
                    coordinate.track(&state.q, &mut self.memory[at..end]);
                    at = end;
                }
            }
        }
    }

    /// Tracks `state` and writes all components in the order of the channels.
    ///
    /// `reaction` gives the reaction of a joint (planar [Fx, Fy, Mz] in the first three places); it is asked only for the
    /// channels that are reactions.
    ///
    /// Cost: as [`track`](Self::track), and a few products for each point; no allocation.
    ///
    /// # Panics
    /// If `out` has not [`n_components`](Self::n_components) places.
    pub fn write(
        &mut self,
        state: &State<T>,
        mut reaction: impl FnMut(usize) -> [T; 6],
        out: &mut [T],
    ) {
        assert_eq!(out.len(), self.n_components, "one place per component");
        self.track(state);
        let mut rest = out;
        for channel in &self.channels {
            let (here, tail) = rest.split_at_mut(channel.len());
            rest = tail;
            match channel {
                Channel::Position(x) => copy(x.value(&state.q).as_slice(), here),
                Channel::Velocity(x) => copy(x.rate(&state.v).as_slice(), here),
                Channel::Acceleration(x) => copy(x.rate(&state.a).as_slice(), here),
                Channel::Value(_, start) => copy(&self.memory[*start..], here),
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
    }
}

impl<T: Real, const D: usize> Channel<T, D> {
    fn len(&self) -> usize {
        match self {
            Self::Position(_) | Self::Velocity(_) | Self::Acceleration(_) => D,
            Self::Value(coordinates, _) | Self::Rate(coordinates) => {
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

/// What the coordinates of each joint are at time zero as far as the scene says it (initial values, guides); zero elsewhere.
///
/// Cost: one pass over joints, guides and initial values.
#[must_use]
pub fn start_values<T: Real>(scene: &Scene<T>) -> Vec<Vec<T>> {
    let zeros = |joint: &Joint<T>| vec![T::ZERO; joint.kind.n_coordinates(scene.dimension)];
    let mut values: Vec<Vec<T>> = scene.joints.iter().map(zeros).collect();
    for guide in &scene.guides {
        if let Some(values) = values.get_mut(guide.joint) {
            values.fill(GuideInput::new(&guide.law).at(T::ZERO)[0]);
        }
    }
    for initial in &scene.initials {
        if let InitialTarget::Joint { joint, value: Some(value), .. } = &initial.target
            && let Some(values) = values.get_mut(*joint)
        {
            values.iter_mut().zip(value).for_each(|(to, from)| *to = *from);
        }
    }
    values
}
