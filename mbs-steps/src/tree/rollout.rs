//! Rollouts: motions of a tree from given initial states. A rollout is a short simulation without the record of a run.

use super::inner::{Inner, Typed, with};
use super::{Tree, checked};
use crate::choice::IntegratorKind;
use crate::erased::failure::SimulationError;
use crate::interrupt::Interrupt;
use crate::methods::{Demands, tree_method, tree_options};
use crate::names::Names;
use crate::stop::StopError;
use mbs_core::step::StepError;
use mbs_recursive::space::Space;
use mbs_recursive::{TreeModel, TreeState};

/// Data of a rollout: initial coordinates and velocities, equal steps, and inputs that are constant in each step.
#[derive(Debug, Clone, Copy)]
pub struct Rollout<'a> {
    /// Initial coordinates, as in [`Tree::coordinates`].
    pub q: &'a [f64],
    /// Initial velocities [rad/s, m/s].
    pub v: &'a [f64],
    /// Inputs, one row for each step. If the slice is empty, all inputs have their initial values.
    pub inputs: &'a [f64],
    /// Length of a step [s].
    pub step: f64,
    /// Number of steps of the motion.
    pub n_steps: usize,
    /// Integrator of the steps.
    pub integrator: IntegratorKind,
    /// Interrupt that ends the motion early.
    pub interrupt: Option<&'a Interrupt>,
}

/// Reason why a motion ended early, and the number of steps before the end.
#[derive(Debug)]
pub struct RolloutEnd {
    /// Number of completed steps; `None` if the motion could not begin.
    pub steps: Option<usize>,
    /// Reason why the motion ended.
    pub error: SimulationError,
}

/// Checks that the step is positive and that the inputs have one row for each step.
fn check(task: &Rollout<'_>, n_inputs: usize) -> Result<(), SimulationError> {
    if !(task.step > 0.0 && task.step.is_finite()) {
        let message = format!("a step must be positive and finite, but is {} s", task.step);
        return Err(SimulationError::new("bad-step", message, "write a number larger than zero"));
    }
    if !task.inputs.is_empty() {
        checked("inputs", task.inputs, n_inputs * task.n_steps)?;
    }
    Ok(())
}

impl Tree {
    /// Computes a motion with all effects from time zero, and writes `n_steps + 1` rows of q and of v. The first row is the initial state
    /// after its loops were closed. After a failed step the remaining rows are NaN.
    ///
    /// A simulation by `recursive` with the same integrator and inputs gives the same result. The result is bitwise the same if the tree
    /// has no closed loop, no ball joint and no free joint. Otherwise it agrees to machine precision.
    ///
    /// Cost: the steps alone. Only q and v are recorded, and no step allocates memory.
    ///
    /// # Errors
    /// [`RolloutEnd`]: a wrong number of values, a value that is not finite, a start whose loops cannot be closed, or a step that fails.
    ///
    /// # Panics
    /// If the slices do not have `n_steps + 1` rows of q and of v.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// use mbs::{IntegratorKind, Rollout};
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// let (mut q, mut v) = ([0.0; 2 * 1001], [0.0; 2 * 1001]);
    /// let integrator = IntegratorKind::Rk4;
    /// let (q0, v0, interrupt) = ([0.0; 2], [0.0; 2], None);
    /// let task = Rollout { q: &q0, v: &v0, inputs: &[], step: 1e-3, n_steps: 1000, integrator, interrupt };
    /// tree.rollout(&task, &mut q, &mut v).map_err(|end| end.error)?;
    /// // two rods of 1 m and 1 kg, let go level
    /// assert!((q[2000] - -2.77849).abs() < 1e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rollout(
        &mut self,
        task: &Rollout<'_>,
        q_rows: &mut [f64],
        v_rows: &mut [f64],
    ) -> Result<(), RolloutEnd> {
        let [n_q, n] = self.layout.n;
        let rows = task.n_steps + 1;
        let (q_rows, v_rows) = (&mut q_rows[..n_q * rows], &mut v_rows[..n * rows]);
        q_rows.fill(f64::NAN);
        v_rows.fill(f64::NAN);
        let at = |steps| move |error| RolloutEnd { steps, error };
        self.begin(task).map_err(at(None))?;
        self.keep((q_rows, v_rows), 0);
        for k in 0..task.n_steps {
            if task.interrupt.is_some_and(Interrupt::is_set) {
                let time = self.inner.state().t;
                let error = SimulationError::stopped(StopError::Interrupted, time, &self.names);
                return Err(RolloutEnd { steps: Some(k), error });
            }
            self.step(task, k).map_err(at(Some(k)))?;
            self.keep((q_rows, v_rows), k + 1);
        }
        Ok(())
    }

    /// Sets the initial state of a motion at time zero, and closes its loops.
    fn begin(&mut self, task: &Rollout<'_>) -> Result<(), SimulationError> {
        check(task, self.input_list.len())?;
        self.reset();
        self.set(task.q, task.v)?;
        if let Some(inputs) = task.inputs.get(..self.input_list.len()) {
            self.set_inputs(inputs)?;
        }
        self.make_consistent()?;
        Ok(())
    }

    /// Resets the tree to its start: at rest in the reference configuration at time zero, with the initial inputs and signals.
    pub fn reset(&mut self) {
        with!(&mut self.inner, tree => {
            let begun = TreeState::at_rest(&tree.model);
            tree.state.copy_from(&begun);
        });
        self.layout.coordinates_outward(&self.inner.state().z, &mut self.q);
        self.v.fill(0.0);
    }

    /// Makes step `k` of the motion, counted from 0.
    fn step(&mut self, task: &Rollout<'_>, k: usize) -> Result<(), SimulationError> {
        let n = self.input_list.len();
        let dt = task.step;
        let demands = Demands {
            integrator: task.integrator,
            penalty: None,
            tolerance: None,
            threads: 1,
            step: dt,
        };
        let (places, names) = (&self.input_places, &self.names);
        with!(&mut self.inner, tree => {
            let Typed { model, state, workspace, .. } = &mut **tree;
            if !task.inputs.is_empty() {
                let row = &task.inputs[n * k..][..n];
                places.iter().zip(row).for_each(|(&place, &value)| state.inputs[place] = value);
            }
            if task.integrator.is_explicit() {
                // An explicit method evaluates the accelerations at the start of the step, so the inputs of the step must apply there.
                model.prescribed().apply(&state.inputs, &mut state.applied);
            }
            let options = tree_options(&demands);
            let method = tree_method(task.integrator);
            let made = model.step(method, dt, &options, state, workspace);
            #[allow(clippy::cast_precision_loss, reason = "steps stay far below 2^53")]
            let end = (k + 1) as f64 * dt;
            match made {
                Ok(_) => {
                    // The time at the end is a multiple of the step, because a sum of many steps would accumulate rounding errors.
                    state.t = end;
                    Ok(())
                }
                Err(error) => Err(stopped((model, state.t, names), error)),
            }
        })
    }

    /// Writes the current coordinates and velocities into row `k` of the motion.
    fn keep(&mut self, (q_rows, v_rows): (&mut [f64], &mut [f64]), k: usize) {
        let [n_q, n] = self.layout.n;
        let state = self.inner.state();
        self.layout.coordinates_outward(&state.z, &mut self.q);
        self.layout.velocities_outward(&state.v, &mut self.v);
        q_rows[n_q * k..][..n_q].copy_from_slice(&self.q);
        v_rows[n * k..][..n].copy_from_slice(&self.v);
    }
}

/// Converts the error of a failed step, with the names of the scene.
fn stopped<S: Space<f64>>(
    (model, t, names): (&TreeModel<f64, S>, f64, &Names),
    error: StepError,
) -> SimulationError {
    SimulationError::stopped(Typed::reason(model, error), t, names)
}
