//! The scene's wishes for the solver.

use alloc::string::String;
use alloc::vec::Vec;

/// The `[solver]` table: all optional; the command line overrides.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SolverTable<T> {
    /// Formulation as written, checked by the face of the workspace.
    pub formulation: Option<String>,
    /// Integrator as written, likewise.
    pub integrator: Option<String>,
    /// Length of the steps [s].
    pub step: Option<T>,
    /// Largest step of variable-step methods [s].
    pub step_max: Option<T>,
    /// Newton tolerance, relative to the scene's length.
    pub tolerance: Option<T>,
    /// Penalty factor, the printed alpha: N/m in index-3, kg in index-1.
    pub penalty: Option<T>,
    /// Rule that chooses the length of the steps, as written, checked likewise.
    pub step_control: Option<String>,
    /// [U, L] of the energy rule: shares of the energy that moves.
    pub energy_tolerance: Option<[T; 2]>,
    /// Error of a step by its estimate, relative to the scene's length.
    pub error_tolerance: Option<T>,
    /// Do steps of a controlled length end at contacts and kinks of the road?
    pub locate_events: Option<bool>,
    /// Share of the energy turned over that the invariant may be off by before the run stops.
    pub energy_alarm: Option<T>,
    /// Further keys accepted by the reader and not used yet.
    pub unused: Vec<String>,
}
