//! Writes the table `[solver]`.

use super::Keys;
use crate::read::tree::Node;
use mbs_core::scene::{Number, SolverTable};

impl Keys {
    /// The keys of the table that are written.
    pub(super) fn of_solver(solver: &SolverTable<Number>) -> Self {
        let mut keys = Self::default();
        keys.push_some("formulation", solver.formulation.as_deref());
        keys.push_some("integrator", solver.integrator.as_deref());
        keys.push_some("step", solver.step.as_ref());
        keys.push_some("step_max", solver.step_max.as_ref());
        keys.push_some("tolerance", solver.tolerance.as_ref());
        keys.push_some("penalty", solver.penalty.as_ref());
        keys.push_some("step_control", solver.step_control.as_deref());
        keys.push_some("energy_tolerance", solver.energy_tolerance.as_ref());
        keys.push_some("error_tolerance", solver.error_tolerance.as_ref());
        keys.push_some("locate_events", solver.locate_events.map(Node::Bool));
        keys.push_some("energy_alarm", solver.energy_alarm.as_ref());
        keys
    }
}
