//! Output channels and the scene's wishes for the solver.

use crate::outputs::Quantity;
use crate::scene::{Joint, JointId, Scene};
use alloc::string::String;
use alloc::vec::Vec;

/// A channel: what is recorded, under which name.
#[derive(Debug, Clone, PartialEq)]
pub struct Output<T> {
    /// Unique name.
    pub name: String,
    /// What is measured.
    pub quantity: Quantity<T>,
}

impl<T> Output<T> {
    /// An output without a name.
    #[must_use]
    pub const fn new(quantity: Quantity<T>) -> Self {
        Self { name: String::new(), quantity }
    }
}

impl<T: Clone> Scene<T> {
    /// Its outputs; where it names none, the coordinates of every joint that has some, under the joint's name.
    #[must_use]
    pub fn channels(&self) -> Vec<Output<T>> {
        if !self.outputs.is_empty() {
            return self.outputs.clone();
        }
        let moves = |joint: &Joint<T>| joint.kind.n_coordinates(self.dimension) > 0;
        let joints = self.joints.iter().enumerate().filter(|(_, joint)| moves(joint));
        let value = |index| Quantity::JointValue { joint: JointId::new(index) };
        joints.map(|(i, joint)| Output { name: joint.name.clone(), quantity: value(i) }).collect()
    }
}

/// The `[solver]` table: all optional; the command line overrides.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SolverTable<T> {
    /// Formulation as written, checked by the face of the workspace.
    pub formulation: Option<String>,
    /// Integrator as written, likewise.
    pub integrator: Option<String>,
    /// Step [s].
    pub step: Option<T>,
    /// Largest step of variable-step methods [s].
    pub step_max: Option<T>,
    /// Newton tolerance, relative to the scene's length.
    pub tolerance: Option<T>,
    /// The printed alpha: N/m in index-3, kg in index-1.
    pub penalty: Option<T>,
    /// What chooses the length of the steps, as written, likewise.
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
