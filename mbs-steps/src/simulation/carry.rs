//! The state of one simulation taken over by another of the same mechanism, in which some effects are on or off.
//!
//! ```text
//! q, v   as they are
//! a, λ   anew, under the effects that are there
//! W      + (T + V)_after − (T + V)_before: what the change put into the mechanism or took out counts as work
//! ```
//!
//! So Π = T + V − W continues without a jump, and the invariant stays watched.

use super::Simulation;
use mbs_core::formulation::SwitchError;
use mbs_core::natural::NaturalModel;
use mbs_core::step::StepError;
use mbs_core::{Cliques, Real};

impl<T: Real, const D: usize> Simulation<T, D> {
    /// May this simulation [`take_over`](Self::take_over) the state of another? It may where both are of one formulation (index-3,
    /// index-1, multi-index or recursive). The scenes may differ in effects that are switched off, other than those that
    /// count turns (torsion springs and the like). They differ in nothing else that makes coordinates.
    ///
    /// # Errors
    /// [`SwitchError`].
    pub fn takes_over(&self, other: &Self) -> Result<(), SwitchError> {
        self.formulation.can_take_over(&*other.formulation)?;
        let is_same =
            self.model.has_same_coordinates(&other.model) && same_memory(&self.model, &other.model);
        if is_same { Ok(()) } else { Err(SwitchError::Coordinates) }
    }

    /// Takes time, positions and velocities over from another simulation of the same mechanism, whose effects may be others, so that
    /// the next step continues from there. The change of the energy by effects that come or go is booked as work.
    ///
    /// Cost: a copy, and two or three evaluations and factorisations; no allocation.
    ///
    /// # Errors
    /// [`StepError`] where no accelerations are found there.
    ///
    /// # Panics
    /// May panic if the other is none that this one [`takes_over`](Self::takes_over).
    pub fn take_over(&mut self, other: &Self) -> Result<(), StepError> {
        self.show(other);
        self.resume()
    }

    /// Shows the state of another simulation, without being ready to continue from it.
    pub fn show(&mut self, other: &Self) {
        self.state.copy_unknowns(&other.state, self.model.n_unknowns());
        self.invariant = other.invariant;
        self.formulation.take_over(&*other.formulation);
    }

    /// Makes ready to continue from a state that was shown.
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

/// Do both remember the same angles in the same places?
fn same_memory<T: Real, const D: usize>(a: &NaturalModel<T, D>, b: &NaturalModel<T, D>) -> bool {
    a.remembered().eq(b.remembered())
}
