//! Every kind of effect in joint coordinates: accelerations compared with natural coordinates, and a balance of power.

use crate::support::{Run, imbalance};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::Reactions;
use mbs_core::scene::{Dimension, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial};
use mbs_testkit::effects::{every, with};

/// Largest residual of the equations, relative to their terms [-]: a few hundred rounding errors.
const ROUNDING: f64 = 1e-12;
/// Largest residual of the balances of single bodies [N], under forces of about a hundred newtons.
const BODIES: f64 = 1e-10;
/// Length of a step so short that the powers at its start and end determine the work in the step [s].
const SHORT: f64 = 1e-4;
/// Error of the power over this step, relative to energies divided by the step [-]. It comes from third derivatives of order 1e3 and from
/// rounding.
const BALANCE: f64 = 1e-4;

const SEEDS: std::ops::Range<u64> = 1..5;

fn check<S: Space<f64>, const D: usize>(what: &str, scene: &Scene<f64>) {
    for seed in SEEDS {
        let mut run = Run::<S>::wandering(scene, seed);
        let motions = run.motions(scene.bodies.len());
        let model = NaturalModel::<f64, D>::new(scene).expect("the scene has a model");
        let mut state = State::at_rest(&model);
        state.t = run.state.t;
        model.write_motions(&motions, &mut state);
        let left = imbalance(&model, &state);
        assert!(left.iter().all(|&x| x < ROUNDING), "{what}, {D}, seed {seed}: {left:?}");
        // Effects, gravity and joint reactions balance the inertia force of every body.
        let mut reactions = Reactions::new(scene, &model).expect("no loops");
        reactions.update(&state);
        let left = reactions.residual();
        assert!(left < BODIES, "{what}, {D}, seed {seed}: {left} N");
        // balance of power: d(T + V)/dt = power
        let energy = |run: &mut Run<S>| {
            let [kinetic, potential] = run.model.energies(&run.state, &mut run.workspace);
            kinetic + potential
        };
        let (before, first) = (energy(&mut run), run.state.power);
        run.rk4(SHORT).expect("a regular position");
        let change = (energy(&mut run) - before) / SHORT;
        let power = 0.5 * (first + run.state.power);
        let apart = (change - power).abs();
        assert!(apart < BALANCE * (1.0 + power.abs()), "{what}, {D}: {change} W, told {power} W");
    }
}

#[test]
fn every_effect_gives_the_accelerations_of_natural_coordinates_and_books_its_power() {
    for (what, kind) in every(Dimension::Planar) {
        check::<Planar, 2>(what, &with(Dimension::Planar, kind));
    }
    for (what, kind) in every(Dimension::Spatial) {
        check::<Spatial, 3>(what, &with(Dimension::Spatial, kind));
    }
}
