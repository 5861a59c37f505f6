//! Readings of a simulation: quantities that the first call after a step computes, and that are stored until the next step.

use super::values::{Coordinates, Wrench};
use crate::channels::Channels;
use crate::checkpoint::tape::{Tape, Walked};
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::ops::Range;
use mbs_core::Real;
use mbs_core::algebra::Vector;
use mbs_core::outputs::{EffectWrenches, Reactions};
use mbs_core::scene::{JointId, Output, Quantity, Scene};

/// Joint coordinates with full turns, outputs and reactions.
#[derive(Debug, Clone)]
pub struct Readings<T: Real, const D: usize> {
    joints: Group<T, D>,
    rates: Group<T, D>,
    /// Outputs that the scene names; `None`: the outputs are the joint coordinates.
    outputs: Option<Group<T, D>>,
    /// Reactions, created by the first call that needs them. The flag is true if they belong to the current state.
    reactions: Option<(Box<Reactions<T, D>>, bool)>,
    /// Forces of effects, created by the first call that needs them.
    effects: Option<Box<EffectWrenches<T, D>>>,
}

/// Channels that are evaluated together.
#[derive(Debug, Clone)]
struct Group<T: Real, const D: usize> {
    channels: Channels<T, D>,
    row: Vec<T>,
    /// Index range of each channel's components in the row.
    places: Vec<Range<usize>>,
    is_present: bool,
}

impl<T: Real, const D: usize> Group<T, D> {
    /// Creates a group of the given outputs.
    fn new(
        scene: &Scene<T>,
        outputs: &[Output<T>],
        simulation: &Simulation<T, D>,
    ) -> Result<Self, StopError> {
        let mut channels = Channels::of_outputs(outputs, scene, simulation.model())?;
        channels.track(simulation)?;
        let mut end = 0;
        let places = channels.lengths().map(|n| {
            end += n;
            end - n..end
        });
        let places: Vec<_> = places.collect();
        Ok(Self { channels, row: vec![T::ZERO; end], places, is_present: false })
    }

    /// Evaluates the row at the current state, unless it is up to date.
    fn update(&mut self, now: &Simulation<T, D>) -> Result<(), StopError> {
        if !self.is_present {
            self.channels.write(now, &mut self.row)?;
            self.is_present = true;
        }
        Ok(())
    }

    /// Returns the components of a channel. The second value is an error if some component of the row is not finite.
    fn of(
        &mut self,
        channel: usize,
        now: &Simulation<T, D>,
    ) -> (Coordinates, Result<(), StopError>) {
        let written = self.update(now);
        let place = self.places.get(channel).cloned().unwrap_or_default();
        (Coordinates::new(self.row[place].iter().map(|x| x.to_f64())), written)
    }
}

impl<T: Real, const D: usize> Readings<T, D> {
    /// Creates the readings of a simulation at its start.
    pub fn new(scene: &Scene<T>, simulation: &Simulation<T, D>) -> Result<Self, StopError> {
        let of_joints = |quantity: fn(JointId) -> Quantity<T>| {
            let joints = (0..scene.joints.len()).map(JointId::new);
            let outputs: Vec<_> = joints.map(quantity).map(Output::new).collect();
            Group::new(scene, &outputs, simulation)
        };
        let outputs = scene.outputs.iter().map(|o| Output { magnitude: false, ..o.clone() });
        let outputs: Vec<_> = outputs.collect();
        let outputs = (!outputs.is_empty()).then(|| Group::new(scene, &outputs, simulation));
        Ok(Self {
            joints: of_joints(|joint| Quantity::JointValue { joint })?,
            rates: of_joints(|joint| Quantity::JointRate { joint })?,
            outputs: outputs.transpose()?,
            reactions: None,
            effects: None,
        })
    }

    /// Updates tracked angles after a step, so that full turns are counted.
    pub fn follow(&mut self, simulation: &Simulation<T, D>) -> Result<(), StopError> {
        self.stale();
        self.joints.channels.track(simulation)?;
        self.outputs.as_mut().map_or(Ok(()), |outputs| outputs.channels.track(simulation))
    }

    fn outputs(&mut self) -> &mut Group<T, D> {
        self.outputs.as_mut().unwrap_or(&mut self.joints)
    }

    /// Marks all stored values as out of date, so that the next call evaluates the current state.
    pub fn stale(&mut self) {
        for group in [&mut self.joints, &mut self.rates].into_iter().chain(&mut self.outputs) {
            group.is_present = false;
        }
        if let Some((_, is_present)) = &mut self.reactions {
            *is_present = false;
        }
    }

    /// Coordinates of a joint; values that are not finite are returned as they are.
    pub fn values(&mut self, joint: usize, now: &Simulation<T, D>) -> Coordinates {
        self.joints.of(joint, now).0
    }

    pub fn rates(&mut self, joint: usize, now: &Simulation<T, D>) -> Coordinates {
        self.rates.of(joint, now).0
    }

    pub fn output(
        &mut self,
        output: usize,
        now: &Simulation<T, D>,
    ) -> Result<Coordinates, StopError> {
        let (output, written) = self.outputs().of(output, now);
        written.map(|()| output)
    }

    /// Number of components of all outputs.
    pub fn n_components(&self) -> usize {
        self.outputs.as_ref().unwrap_or(&self.joints).row.len()
    }

    /// Writes the components of all outputs, in their order.
    pub fn write(&mut self, now: &Simulation<T, D>, out: &mut [f64]) -> Result<(), StopError> {
        let outputs = self.outputs();
        let written = outputs.update(now);
        out.iter_mut().zip(&outputs.row).for_each(|(to, x)| *to = x.to_f64());
        written
    }

    /// Force and moment that the first body of a joint exerts on the second, at the joint's point on the second body [N, N m].
    pub fn reaction(
        &mut self,
        joint: usize,
        (scene, simulation): (&Scene<T>, &Simulation<T, D>),
    ) -> Result<Wrench, StopError> {
        if self.reactions.is_none() {
            let reactions =
                Reactions::new(scene, simulation.model()).map_err(StopError::Reaction)?;
            self.reactions = Some((Box::new(reactions), false));
        }
        let Some((reactions, is_present)) = &mut self.reactions else {
            return Ok(Wrench::default());
        };
        if !*is_present {
            reactions.update(simulation.state());
            *is_present = true;
        }
        let [a, b, c, d, e, f] = reactions.reaction(joint).map(Real::to_f64);
        Ok(match D {
            2 => Wrench { force: [a, b, 0.0], moment: [0.0, 0.0, c] },
            _ => Wrench { force: [a, b, c], moment: [d, e, f] },
        })
    }

    /// Force and moment that an effect exerts on its body, or on the second body if it acts between two bodies [N, N m].
    pub fn effect(
        &mut self,
        effect: usize,
        (scene, simulation): (&Scene<T>, &Simulation<T, D>),
    ) -> Result<Wrench, StopError> {
        let wrenches = match &mut self.effects {
            Some(wrenches) => wrenches,
            None => {
                let made = EffectWrenches::new(scene, simulation.model());
                self.effects.insert(Box::new(made.map_err(|e| StopError::Start(e.into()))?))
            }
        };
        let wrench = wrenches.of(effect, simulation.state());
        let numbers = |x: Vector<T, 3>| [x[0], x[1], x[2]].map(Real::to_f64);
        Ok(Wrench { force: numbers(wrench.force), moment: numbers(wrench.moment) })
    }

    /// Writes the counted turns to a checkpoint, or reads them from one.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        self.joints.channels.walk(tape)?;
        self.outputs.as_mut().map_or(Ok(()), |outputs| outputs.channels.walk(tape))
    }
}
