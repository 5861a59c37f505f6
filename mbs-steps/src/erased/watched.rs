//! A run before observers that see no scalar and no dimension.

use super::function::{Function, FunctionColumns};
use super::inputs::Inputs;
use super::view::{Observed, Observer, Sight};
use crate::names::Names;
use crate::precision::{ReadScene, SceneWork};
use crate::run::{Outcome, run_columns};
use crate::settings::ResolvedMethod;
use crate::typed;
use mbs_core::Real;
use mbs_core::scene::Scene;

/// A run before observers.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct Watched<'a, 'b> {
    pub settings: &'a ResolvedMethod,
    pub names: &'a Names,
    pub inputs: Inputs,
    pub observers: &'a mut [&'b mut dyn Observer],
    pub functions: &'a [Function],
}

impl Watched<'_, '_> {
    /// Runs the scene in the precision that it was read in.
    pub fn run(self, read: &ReadScene<'_>) -> Outcome {
        read.work(self)
    }
}

impl SceneWork for Watched<'_, '_> {
    type Done = Outcome;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Outcome {
        let Self { settings, names, inputs, observers, functions } = self;
        let sight = || Sight::<T, D>::new(scene, names);
        let mut observed;
        let observer: &mut dyn typed::StepObserver<T, D> = if observers.is_empty() {
            &mut ()
        } else {
            observed = Observed::new(sight(), inputs, observers);
            &mut observed
        };
        if functions.is_empty() {
            return typed::run(scene, settings, observer);
        }
        let mut columns = FunctionColumns { sight: sight(), functions };
        run_columns(scene, settings, observer, &mut columns)
    }
}
