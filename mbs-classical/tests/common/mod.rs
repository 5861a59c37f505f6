//! Scenes and runs for the tests.

#![allow(dead_code, reason = "each test binary uses a part")]

use mbs_classical::{Options, Saddle, StepError, StepReport, Workspace};
use mbs_core::Real;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyRef, Scene};
use mbs_core::start::assemble;
use mbs_scene::Document;
use mbs_sparse::{Indefinite, Multifrontal};

pub(crate) const SIMPLE: &str = include_str!("../../../scenes/simple-pendulum.toml");
pub(crate) const DOUBLE: &str = include_str!("../../../scenes/double-pendulum.toml");
pub(crate) const TWO_FOUR_BARS: &str = include_str!("../../../scenes/two-four-bars.toml");
pub(crate) const CHAIN: &str = include_str!("../../../scenes/spatial-chain-20.toml");
pub(crate) const REDUNDANT: &str = include_str!("../../../scenes/spatial-four-bar.toml");
pub(crate) const TOP: &str = include_str!("../../../scenes/spinning-top.toml");
pub(crate) const FREE: &str = include_str!("../../../scenes/free-body.toml");
pub(crate) const GUIDED: &str = include_str!("../../../scenes/guided-four-bar.toml");
pub(crate) const SLIDER: &str = include_str!("../../../scenes/slider-crank.toml");
pub(crate) const N_FOUR_BAR: &str = include_str!("../../../scenes/n-four-bar-10.toml");

/// Which formulation of this crate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Index {
    One,
    Three,
}

pub(crate) fn scene<T: Real>(text: &str) -> Scene<T> {
    let document = Document::parse(text, "test.toml").unwrap_or_else(|e| panic!("{e}"));
    document.scene().unwrap_or_else(|e| panic!("{e}"))
}

/// A model in motion.
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
        let model = NaturalModel::<T, D>::new(scene).unwrap_or_else(|e| panic!("{e}"));
        let analyse = mbs_sparse::Options::default();
        let mut solver = Multifrontal::analyse(&model, analyse);
        let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver)
            .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        let w = Workspace::new(&model, Indefinite::analyse(&Saddle::new(&model), analyse));
        let options = if index == Index::One { Options::index1() } else { Options::index3() };
        Self { scene: scene.clone(), model, state: start.state, w, options, index }
    }

    pub(crate) fn step(&mut self, dt: f64) -> Result<StepReport<T>, StepError> {
        let size = (T::from_f64(dt), self.model.length());
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

    /// So many steps, none of which may fail.
    #[track_caller]
    pub(crate) fn steps(mut self, dt: f64, n: usize) -> Self {
        for i in 0..n {
            self.step(dt).unwrap_or_else(|e| panic!("{}: step {i}: {e}", self.scene.name));
        }
        self
    }

    /// Kinetic and potential energy less the work done on the mechanism [J].
    pub(crate) fn invariant(&mut self) -> f64 {
        let mut terms = self.model.terms();
        self.model.set_inputs(self.state.t, &mut terms);
        let s = &self.state;
        self.model.evaluate_forces(&s.q, &s.v, &s.memory, &mut terms);
        let energy = self.model.kinetic_energy(&s.v) + self.model.potential_energy(&s.q, &terms);
        (energy - s.work).to_f64()
    }

    /// Centres of mass of all bodies.
    pub(crate) fn points(&self) -> Vec<[f64; 3]> {
        centres(&self.scene, &self.model, &self.state)
    }
}

/// Centres of mass of all bodies.
pub(crate) fn centres<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    state: &State<T>,
) -> Vec<[f64; 3]> {
    let place = |i: usize| {
        let x = model.point(BodyRef::Body(i), scene.bodies[i].center).value(&state.q);
        std::array::from_fn(|k| if k < D { x[k].to_f64() } else { 0.0 })
    };
    (0..scene.bodies.len()).map(place).collect()
}

/// The largest distance between two lists of points along an axis.
pub(crate) fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let pairs = a.iter().zip(b).flat_map(|(a, b)| a.iter().zip(b));
    pairs.fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()))
}
