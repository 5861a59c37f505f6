//! Scenes of the repository, assembled and stepped in state space and in index-3.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its part")]

use mbs_augmented::index3;
use mbs_core::Real;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyRef, Scene};
use mbs_core::start::assemble;
use mbs_scene::Document;
use mbs_sparse::Multifrontal;
use mbs_statespace::{Options, StepError, StepReport, Workspace, step};

/// The scene of a text.
pub fn scene<T: Real>(text: &str) -> Scene<T> {
    let document = Document::parse(text, "test.toml").unwrap_or_else(|e| panic!("{e}"));
    document.scene().unwrap_or_else(|e| panic!("{e}"))
}

/// A mechanism that runs.
pub struct Bench<T: Real, const D: usize> {
    pub scene: Scene<T>,
    pub model: NaturalModel<T, D>,
    pub state: State<T>,
    pub start: State<T>,
    pub w: Workspace<T>,
    pub options: Options<T>,
}

impl<T: Real, const D: usize> Bench<T, D> {
    pub fn of(scene: Scene<T>) -> Self {
        let model = NaturalModel::<T, D>::new(&scene).unwrap_or_else(|e| panic!("{e}"));
        let analyse = mbs_sparse::Options::default();
        let mut solver = Multifrontal::analyse(&model, analyse);
        let start = assemble(&scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver)
            .unwrap_or_else(|e| panic!("{}: {e}", scene.name))
            .state;
        let w = Workspace::new(&model, &start);
        Self { scene, model, state: start.clone(), start, w, options: Options::default() }
    }

    pub fn new(text: &str) -> Self {
        Self::of(scene(text))
    }

    pub fn try_step(&mut self, dt: f64) -> Result<StepReport<T>, StepError> {
        let scale = (T::from_f64(dt), self.model.length());
        step(&self.model, scale, &self.options, &mut self.state, &mut self.w)
    }

    #[track_caller]
    pub fn run(&mut self, dt: f64, steps: u32) {
        for i in 0..steps {
            self.try_step(dt).unwrap_or_else(|e| panic!("{}: step {i}: {e:?}", self.scene.name));
        }
    }

    /// The state after `steps` steps of index-3.
    #[track_caller]
    pub fn index3(&self, dt: f64, steps: u32) -> State<T> {
        let solver = Multifrontal::analyse(&self.model, mbs_sparse::Options::default());
        let mut w = mbs_augmented::Workspace::new(&self.model, solver);
        let options = mbs_augmented::Options::index3();
        let (mut state, scale) = (self.start.clone(), (T::from_f64(dt), self.model.length()));
        for i in 0..steps {
            index3::step(&self.model, scale, &options, &mut state, &mut w)
                .unwrap_or_else(|e| panic!("{}: step {i}: {e}", self.scene.name));
        }
        state
    }

    /// T + V - work [J].
    pub fn invariant(&mut self) -> T {
        let (s, mut terms) = (&self.state, self.model.terms());
        self.model.set_inputs(s.t, &mut terms);
        self.model.evaluate_forces(&s.q, &s.v, &s.memory, &mut terms);
        self.model.kinetic_energy(&s.v) + self.model.potential_energy(&s.q, &terms) - s.work
    }

    /// The centres of the bodies, by name.
    pub fn centers(&self, state: &State<T>) -> Vec<(String, [f64; 3])> {
        let place = |i: usize| {
            let x = self.model.point(BodyRef::Body(i), self.scene.bodies[i].center).value(&state.q);
            std::array::from_fn(|k| if k < D { x[k].to_f64() } else { 0.0 })
        };
        let mut all: Vec<_> =
            self.scene.bodies.iter().enumerate().map(|(i, b)| (b.name.clone(), place(i))).collect();
        all.sort_by(|a, b| a.0.cmp(&b.0));
        all
    }
}

/// Largest difference of a coordinate.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |d: f64, (a, b)| d.max((a - b).abs()))
}
