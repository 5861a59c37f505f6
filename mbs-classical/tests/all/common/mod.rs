//! Runs of scenes for the tests of this crate.

use mbs_classical::{Options, Saddle, StepError, StepReport, Workspace};
use mbs_core::Real;
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::step::Step;
use mbs_sparse::Indefinite;
use mbs_testkit::{apart, centres, invariant, start_in};

/// Formulation of this crate that a run uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Index {
    One,
    Three,
}

/// A scene with its model, state and options.
pub(crate) struct Run<T: Real, const D: usize> {
    pub(crate) scene: Scene<T>,
    pub(crate) model: NaturalModel<T, D>,
    pub(crate) state: State<T>,
    pub(crate) w: Workspace<T, Indefinite<T>>,
    pub(crate) options: Options<T>,
    pub(crate) index: Index,
}

impl<T: Real, const D: usize> Run<T, D> {
    pub(crate) fn new(scene: &Scene<T>, index: Index) -> Self {
        let (model, state) = start_in::<T, D>(scene);
        let analyse = mbs_sparse::Options::default();
        let w = Workspace::new(&model, Indefinite::analyse(&Saddle::new(&model), analyse));
        let options = if index == Index::One { Options::index1() } else { Options::index3() };
        Self { scene: scene.clone(), model, state, w, options, index }
    }

    pub(crate) fn step(&mut self, dt: f64) -> Result<StepReport<T>, StepError> {
        let size = Step { dt: T::from_f64(dt), length: self.model.length() };
        match self.index {
            Index::One => mbs_classical::index1::step(
                &self.model,
                size,
                &self.options,
                &mut self.state,
                &mut self.w,
            ),
            Index::Three => mbs_classical::index3::step(
                &self.model,
                size,
                &self.options,
                &mut self.state,
                &mut self.w,
            ),
        }
    }

    /// Makes `n` steps of the run. Panics if one of them fails.
    #[track_caller]
    pub(crate) fn steps(mut self, dt: f64, n: usize) -> Self {
        for i in 0..n {
            self.step(dt).unwrap_or_else(|e| panic!("{}: step {i}: {e}", self.scene.name));
        }
        self
    }

    /// Returns the energy invariant: kinetic and potential energy less the work done on the mechanism [J].
    pub(crate) fn invariant(&self) -> f64 {
        invariant(&self.model, &self.state).to_f64()
    }

    /// Returns the centres of mass of all bodies.
    pub(crate) fn points(&self) -> Vec<[f64; 3]> {
        centres(&self.scene, &self.model, &self.state)
    }
}

/// Returns the largest distance of two lists of points along a coordinate axis.
pub(crate) fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    apart(a.as_flattened(), b.as_flattened())
}
