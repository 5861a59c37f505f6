//! Scenes of the repository, assembled and stepped in state space and in index-3.

use mbs_augmented::index3;
use mbs_core::Real;
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::step::Step;
use mbs_statespace::{Options, StepError, StepReport, Workspace, step};
use mbs_testkit::{invariant, named_centres, scene_in, solver, start_in};

/// A mechanism with its state and workspace.
pub(crate) struct Bench<T: Real, const D: usize> {
    pub(crate) scene: Scene<T>,
    pub(crate) model: NaturalModel<T, D>,
    pub(crate) state: State<T>,
    pub(crate) start: State<T>,
    pub(crate) w: Workspace<T>,
    pub(crate) options: Options<T>,
}

impl<T: Real, const D: usize> Bench<T, D> {
    pub(crate) fn of(scene: Scene<T>) -> Self {
        let (model, start) = start_in::<T, D>(&scene);
        let w = Workspace::new(&model, &start);
        Self { scene, model, state: start.clone(), start, w, options: Options::default() }
    }

    pub(crate) fn new(text: &str) -> Self {
        Self::of(scene_in(text))
    }

    pub(crate) fn try_step(&mut self, dt: f64) -> Result<StepReport<T>, StepError> {
        let scale = Step { dt: T::from_f64(dt), length: self.model.length() };
        step(&self.model, scale, &self.options, &mut self.state, &mut self.w)
    }

    #[track_caller]
    pub(crate) fn run(&mut self, dt: f64, steps: u32) {
        for i in 0..steps {
            self.try_step(dt).unwrap_or_else(|e| panic!("{}: step {i}: {e:?}", self.scene.name));
        }
    }

    /// Returns the state after `steps` steps of index-3.
    #[track_caller]
    pub(crate) fn index3(&self, dt: f64, steps: u32) -> State<T> {
        let mut w = mbs_augmented::Workspace::new(&self.model, solver(&self.model));
        let options = mbs_augmented::Options::index3();
        let (mut state, scale) =
            (self.start.clone(), Step { dt: T::from_f64(dt), length: self.model.length() });
        for i in 0..steps {
            index3::step(&self.model, scale, &options, &mut state, &mut w)
                .unwrap_or_else(|e| panic!("{}: step {i}: {e}", self.scene.name));
        }
        state
    }

    /// Returns the energy invariant T + V - work [J].
    pub(crate) fn invariant(&self) -> T {
        invariant(&self.model, &self.state)
    }

    /// Returns the centres of mass of the bodies, by name.
    pub(crate) fn centers(&self, state: &State<T>) -> Vec<(String, [f64; 3])> {
        named_centres(&self.scene, &self.model, state)
    }
}
