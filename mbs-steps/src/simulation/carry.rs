//! Transfer of the state of a simulation to another simulation of the same mechanism, in which other effects are enabled.
//!
//! ```text
//! q, v   as they are
//! a, λ   anew, under the effects that are there
//! W      + (T + V)_after − (T + V)_before: what the change put into the mechanism or took out counts as work
//! ```
//!
//! The positions q and velocities v are copied. The accelerations a and multipliers λ are computed with the effects that are enabled now.
//! The change of energy counts as work W, so the invariant Π = T + V − W does not jump, and its error can be monitored further.

use super::Simulation;
use mbs_core::formulation::SwitchError;
use mbs_core::natural::NaturalModel;
use mbs_core::step::StepError;
use mbs_core::{Cliques, Real};

impl<T: Real, const D: usize> Simulation<T, D> {
    /// Checks whether this simulation can [`take_over`](Self::take_over) the state of another one. Both must have the same formulation:
    /// index-3, index-1, multi-index or recursive. The scenes may differ in the effects that are enabled, except effects that count full
    /// turns (such as torsion springs). They must not differ in anything else that defines coordinates.
    ///
    /// # Errors
    /// [`SwitchError`] with the reason why it cannot.
    pub fn takes_over(&self, other: &Self) -> Result<(), SwitchError> {
        self.formulation.can_take_over(&*other.formulation)?;
        let is_same =
            self.model.has_same_coordinates(&other.model) && same_memory(&self.model, &other.model);
        if is_same { Ok(()) } else { Err(SwitchError::Coordinates) }
    }

    /// Copies time, positions and velocities from another simulation of the same mechanism, in which other effects may be enabled. The next
    /// step continues from this state. The energy that differs between the two sets of effects counts as work.
    ///
    /// Cost: one copy, and two or three evaluations and factorisations; no allocation.
    ///
    /// # Errors
    /// [`StepError`] if the accelerations at this state cannot be computed.
    ///
    /// # Panics
    /// May panic if [`takes_over`](Self::takes_over) returns an error for the other simulation.
    pub fn take_over(&mut self, other: &Self) -> Result<(), StepError> {
        self.show(other);
        self.resume()
    }

    /// Copies the state of another simulation, so that outputs can be measured. Before the next step, `resume` must be called.
    pub fn show(&mut self, other: &Self) {
        self.state.copy_unknowns(&other.state, self.model.n_unknowns());
        self.invariant = other.invariant;
        self.formulation.take_over(&*other.formulation);
    }

    /// Prepares the simulation to continue from a state that `show` copied.
    pub fn resume(&mut self) -> Result<(), StepError> {
        let Self { model, state, formulation, control, invariant, .. } = self;
        formulation.refresh(model, state)?;
        state.dt = T::ZERO;
        if let Some(control) = control {
            control.restart(state);
        }
        let [kinetic, potential, _] = formulation.energies(model, state);
        let [kinetic_before, potential_before, _] = invariant.energies();
        let change = (kinetic - kinetic_before) + (potential - potential_before);
        state.work += T::from_f64(change);
        formulation.set_work(state.work);
        Ok(())
    }
}

/// True if both models count the turns of the same angles, in the same order.
fn same_memory<T: Real, const D: usize>(a: &NaturalModel<T, D>, b: &NaturalModel<T, D>) -> bool {
    a.remembered().eq(b.remembered())
}
