//! Scenes, their starts, and runs, for all tests of this crate.

use mbs_core::model::{Load, Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_core::step::{StepError, StepReport};
use mbs_recursive::space::Space;
use mbs_recursive::{Options, TreeMethod, TreeModel, TreeState, Workspace};
use nalgebra::Vector3;

pub(crate) mod random;

/// Returns two residuals of a state's accelerations in the equations of natural coordinates, relative to their terms. The first is the
/// residual of M a - Q along all directions that the constraints allow. The second is the residual of J a + bias.
pub(crate) fn imbalance<const D: usize>(
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> [f64; 2] {
    let mut terms = model.terms();
    model.set_inputs(state.t, state, &mut terms);
    model.evaluate(&state.q, &mut terms);
    model.evaluate_forces(&state.q, &state.v, &mut terms);
    model.evaluate_phi_t(&state.q, &mut terms);
    model.evaluate_bias(&state.q, &state.v, &mut terms);
    let largest = |x: &[f64]| x.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    let load = Load { mass: Some(&state.a), multipliers: None, force: 1.0 };
    let forces = mbs_testkit::residual(model, &terms, &load);
    let free = mbs_testkit::in_null_space(&mbs_testkit::jacobian(model, &terms), &forces);
    let rates = mbs_testkit::rates(model, &terms, &state.a);
    let left: Vec<f64> = rates.iter().zip(&terms.phi_bias).map(|(x, y)| x + y).collect();
    [largest(&free) / (1.0 + largest(&forces)), largest(&left) / (1.0 + largest(&terms.phi_bias))]
}

/// A tree with a state and scratch.
pub(crate) struct Run<S: Space<f64>> {
    pub(crate) model: TreeModel<f64, S>,
    pub(crate) state: TreeState<f64>,
    pub(crate) workspace: Workspace<f64, S>,
    pub(crate) options: Options<f64>,
}

impl<S: Space<f64>> Run<S> {
    /// Makes a run at the assembled start of a scene.
    pub(crate) fn new<const D: usize>(scene: &Scene<f64>) -> Self {
        let (natural, state) = mbs_testkit::start::<D>(scene);
        let model =
            TreeModel::<f64, S>::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        let state =
            model.start(scene, &natural, &state).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        Self { workspace: Workspace::new(&model), options: Options::default(), model, state }
    }

    /// Makes a run from the reference configuration with random velocities, which are projected onto the loops, and advances it for some
    /// time.
    pub(crate) fn wandering(scene: &Scene<f64>, seed: u64) -> Self {
        let model =
            TreeModel::<f64, S>::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        let mut state = TreeState::at_rest(&model);
        let n = state.v.len();
        state.v = mbs_testkit::Random(seed).vector(n, n, 1.0);
        let mut workspace = Workspace::new(&model);
        model.settle(&mut state, &mut workspace).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        let mut run = Self { workspace, options: Options::default(), model, state };
        for _ in 0..20 {
            run.rk4(0.02).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        }
        run
    }

    /// Evaluates the accelerations of the state.
    pub(crate) fn accelerate(&mut self) {
        self.model
            .accelerate(&self.options, &mut self.state, &mut self.workspace)
            .expect("a regular position");
    }

    /// Makes one step of length `dt` [s] with a method.
    pub(crate) fn by(&mut self, method: TreeMethod, dt: f64) -> Result<StepReport<f64>, StepError> {
        self.model.step(method, dt, &self.options, &mut self.state, &mut self.workspace)
    }

    /// Makes one step of the trapezoidal rule.
    pub(crate) fn step(&mut self, dt: f64) -> Result<StepReport<f64>, StepError> {
        self.by(TreeMethod::Trapezoidal, dt)
    }

    /// Returns the invariant T + V - work [J].
    pub(crate) fn invariant(&mut self) -> f64 {
        let [kinetic, potential] = self.model.energies(&self.state, &mut self.workspace);
        kinetic + potential - self.state.work
    }

    /// Returns the largest change of the invariant over `n` steps.
    pub(crate) fn drift(&mut self, dt: f64, n: u32) -> f64 {
        self.drift_of(n, |run| run.step(dt))
    }

    /// Returns the largest change of the invariant over `n` steps of any kind.
    pub(crate) fn drift_of(
        &mut self,
        n: u32,
        step: impl Fn(&mut Self) -> Result<StepReport<f64>, StepError>,
    ) -> f64 {
        let (start, mut worst) = (self.invariant(), 0.0_f64);
        for i in 0..n {
            step(self).unwrap_or_else(|e| panic!("step {i}: {e} {e:?}"));
            worst = worst.max((self.invariant() - start).abs());
        }
        worst
    }

    /// Makes one step of the Runge-Kutta method of order 4.
    pub(crate) fn rk4(&mut self, dt: f64) -> Result<StepReport<f64>, StepError> {
        self.by(TreeMethod::Rk4, dt)
    }

    /// Advances over `dt` with error control, by the pair 5(4).
    pub(crate) fn rk54(&mut self, dt: f64) -> Result<StepReport<f64>, StepError> {
        self.by(TreeMethod::Rk54, dt)
    }

    /// Advances over `dt` with error control, by the Runge-Kutta method of order 8.
    pub(crate) fn rk853(&mut self, dt: f64) -> Result<StepReport<f64>, StepError> {
        self.by(TreeMethod::Rk853, dt)
    }

    /// Advances over `dt` with error control, by Radau collocation.
    pub(crate) fn radau5(&mut self, dt: f64) -> Result<StepReport<f64>, StepError> {
        self.by(TreeMethod::Radau5, dt)
    }

    /// Returns the motions of the bodies.
    pub(crate) fn motions(&mut self, n: usize) -> Vec<RigidMotion<f64>> {
        let mut motions = vec![RigidMotion::at_rest(Vector3::zeros()); n];
        self.model.write_motions(&self.state, &mut self.workspace, &mut motions);
        motions
    }
}
