//! Snapshot from which a simulation continues, as plain data.

use super::history::Parts;
use super::tape::{Tape, Walked, holds};
use mbs_core::Real;
use mbs_core::control::{DriverHistory, Invariant};
use mbs_core::history::History;
use mbs_core::inputs::Prescribed;
use mbs_core::model::State;
use mbs_core::outputs::EventHistory;

/// Snapshot of a simulation: all data that its next step depends on.
#[derive(Debug, Clone)]
pub struct SimulationSnapshot<T> {
    pub state: State<T>,
    pub formulation: History<T>,
    pub control: Option<ControlSnapshot<T>>,
    pub invariant: [f64; Invariant::N_HISTORY],
    /// Inputs of effects, inputs of guides, and inputs of signals, each with its index. For signals only the first value is used.
    pub inputs: [Vec<(usize, [T; 3])>; 3],
}

/// Data of the step control that the next step depends on.
#[derive(Debug, Clone)]
pub struct ControlSnapshot<T> {
    pub driver: DriverHistory<T>,
    pub events: Option<EventHistory<T>>,
}

impl<T: Real> SimulationSnapshot<T> {
    /// Writes the snapshot to a checkpoint, or reads one with the same sizes.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        let Self { state, formulation, control, invariant, inputs } = self;
        tape.state(state)?;
        tape.history(&mut formulation.entries)?;
        let mut is_controlled = control.is_some();
        tape.flag(&mut is_controlled)?;
        holds(is_controlled == control.is_some())?;
        control.as_mut().map_or(Ok(()), |control| control.walk(tape))?;
        tape.floats(invariant)?;
        inputs.iter_mut().try_for_each(|inputs| {
            tape.places(inputs, |tape, (i, value)| {
                let is = *i;
                tape.index(i, usize::MAX)?;
                holds(*i == is)?;
                tape.reals(value)
            })
        })
    }
}

impl<T: Real> ControlSnapshot<T> {
    fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        let DriverHistory { next, energy, error, stretch } = &mut self.driver;
        tape.real(next)?;
        tape.option(energy, |tape, (memory, small)| {
            tape.float(memory)?;
            tape.small(small)
        })?;
        tape.option(error, Parts::errors)?;
        tape.option(stretch, |tape, (from, trials)| {
            tape.real(from)?;
            tape.small(trials)
        })?;
        let Some(EventHistory { t, trials, begin }) = &mut self.events else { return Ok(()) };
        tape.real(t)?;
        tape.small(trials)?;
        tape.places(begin, |tape, numbers| tape.reals(numbers))
    }
}

/// Returns the current inputs of a state: those of effects, of guides, and of signals.
pub fn inputs<T: Real>(prescribed: &Prescribed<T>, inputs: &[T]) -> [Vec<(usize, [T; 3])>; 3] {
    let of_signals = prescribed.signals().inputs();
    let (threes, ones) = inputs.split_at(inputs.len() - of_signals.len());
    let signals = of_signals.iter().zip(ones);
    let signals = signals.map(|((signal, _), value)| (*signal, [*value, T::ZERO, T::ZERO]));
    let mut values = threes.as_chunks().0.iter();
    let guides = prescribed.guide_inputs().zip(values.by_ref());
    let guides = guides.map(|((guide, _), motion)| (guide, *motion)).collect();
    let effects = prescribed.effect_inputs().zip(values);
    let effects = effects.map(|((effect, _), value)| (effect, *value)).collect();
    [effects, guides, signals.collect()]
}
