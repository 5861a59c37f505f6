//! Models of scenes, their assembled initial states, and measures of a state.

use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyId, Scene};
use mbs_core::start::assemble;
use mbs_core::{Cliques, Real};
use mbs_sparse::{Multifrontal, Options};

/// A model with its consistent initial state.
type Start<const D: usize> = (NaturalModel<f64, D>, State<f64>);

/// The function [`start`] for planar scenes. It is compiled here for this static, so that no test program compiles it again.
pub static START_IN_PLANE: fn(&Scene<f64>) -> Start<2> = start::<2>;
/// The function [`start`] for spatial scenes.
pub static START_IN_SPACE: fn(&Scene<f64>) -> Start<3> = start::<3>;

/// Creates the model of a scene.
///
/// # Panics
///
/// If the scene has no model.
#[must_use]
pub fn model<const D: usize>(scene: &Scene<f64>) -> NaturalModel<f64, D> {
    NaturalModel::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}

/// Creates the multifrontal solver of a problem, with default options.
#[must_use]
pub fn solver<T: Real>(problem: &impl Cliques) -> Multifrontal<T> {
    Multifrontal::analyse(problem, Options::default())
}

/// Creates the model of a scene and its assembled state.
///
/// # Panics
///
/// If the scene has no model or no consistent state.
#[must_use]
pub fn start<const D: usize>(scene: &Scene<f64>) -> Start<D> {
    start_in(scene)
}

/// Creates the model of a scene and its assembled state, in numbers of type `T`.
///
/// # Panics
///
/// If the scene has no model or no consistent state.
#[must_use]
pub fn start_in<T: Real, const D: usize>(scene: &Scene<T>) -> (NaturalModel<T, D>, State<T>) {
    let model = NaturalModel::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let assembled = assemble(scene, &model, |problem| solver(problem), &mut solver(&model))
        .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    (model, assembled.state)
}

/// Returns the energy invariant: kinetic and potential energy less the work done on the mechanism [J].
#[must_use]
pub fn invariant<T: Real, const D: usize>(model: &NaturalModel<T, D>, state: &State<T>) -> T {
    let mut terms = model.terms();
    model.set_inputs(state.t, state, &mut terms);
    model.evaluate_forces(&state.q, &state.v, &mut terms);
    model.kinetic_energy(&state.v) + model.potential_energy(&state.q, &terms) - state.work
}

/// Returns the centres of mass of all bodies [m].
#[must_use]
pub fn centres<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    state: &State<T>,
) -> Vec<[f64; 3]> {
    let place = |i: usize| {
        let x = model.point(BodyId::Body(i), scene.bodies[i].center).value(&state.q);
        std::array::from_fn(|k| if k < D { x[k].to_f64() } else { 0.0 })
    };
    (0..scene.bodies.len()).map(place).collect()
}

/// Returns the centres of mass of all bodies [m] with the names of the bodies, sorted by name.
#[must_use]
pub fn named_centres<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    state: &State<T>,
) -> Vec<(String, [f64; 3])> {
    let names = scene.bodies.iter().map(|body| body.name.clone());
    let mut all: Vec<_> = names.zip(centres(scene, model, state)).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}
