//! Properties that all formulations have: failed steps, clones, and the registry.

use crate::common::{scene, settings};
use mbs::core::scene::{Dimension, Scene};
use mbs::core::step::{Step, StepError};
use mbs::scene_file::{Family, generate};
use mbs::typed::Simulation;
use mbs::{FORMULATIONS, FormulationKind, Method, ResolvedMethod, StopError};

fn simulation<const D: usize>(scene: &Scene<f64>, overrides: Method) -> Simulation<f64, D> {
    let settings = ResolvedMethod::new(scene, &overrides).expect("the settings are built");
    Simulation::new(scene, &settings).expect("the scene assembles")
}

/// Bits of all results of a step.
fn bits<const D: usize>(simulation: &Simulation<f64, D>) -> Vec<u64> {
    let s = simulation.state();
    let all = [&s.q[..], &s.q_low, &s.v, &s.a, &s.lambda, &s.reaction, &s.phi, &s.memory];
    let numbers = all.into_iter().flatten().chain([&s.t, &s.work, &s.power]);
    numbers.copied().chain(simulation.energies()).map(f64::to_bits).collect()
}

/// Makes steps of 1 ms and returns the bits after each.
fn go<const D: usize>(simulation: &mut Simulation<f64, D>, steps: usize) -> Vec<u64> {
    for _ in 0..steps {
        simulation.step(1e-3).expect("it steps");
    }
    bits(simulation)
}

#[test]
fn names_and_rows_stand_for_each_other() {
    assert_eq!(FormulationKind::ALL.map(FormulationKind::name), FORMULATIONS[1..]);
    for formulation in FormulationKind::ALL {
        assert_eq!(FormulationKind::of_name(formulation.name()), Some(formulation));
        assert!(formulation.row().sentence.ends_with('.'));
    }
    assert!(FormulationKind::RELATIVE.row().relative);
    let relative = FormulationKind::ALL.into_iter().filter(|f| f.row().relative);
    assert!(relative.eq([FormulationKind::RELATIVE]), "integrators of first order have one home");
}

#[test]
fn a_step_that_is_none_is_refused_by_every_formulation_and_changes_nothing() {
    let scene = scene("double-pendulum");
    let first_order = ["rk4", "rk54", "rk853", "gbs", "radau5"];
    let all = FormulationKind::ALL.map(|f| (f.name(), "trapezoidal"));
    for (formulation, integrator) in
        all.into_iter().chain(first_order.map(|i| (FormulationKind::RELATIVE.name(), i)))
    {
        for step_control in ["fixed", "error"] {
            if first_order.contains(&integrator) && step_control == "error" {
                continue;
            }
            let [formulation, integrator, step_control] =
                [formulation, integrator, step_control].map(|name| Some(name.to_owned()));
            let overrides = Method { formulation, integrator, step_control, ..Method::default() };
            let mut simulation = simulation::<2>(&scene, overrides.clone());
            let before = go(&mut simulation, 3);
            for dt in [0.0, -1e-3, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                for stopped in [
                    simulation.step(dt).err(),
                    simulation.advance(dt).err().map(|e| simulation.explain(e)),
                ] {
                    let is_refused =
                        matches!(stopped, Some(StopError::Step(StepError::BadStep { .. }, _)));
                    assert!(is_refused, "{overrides:?}, {dt}: {stopped:?}");
                }
                assert_eq!(bits(&simulation), before, "{overrides:?}, {dt}");
            }
            assert_ne!(go(&mut simulation, 1), before);
        }
    }
}

#[test]
fn a_scene_without_length_is_no_scene_to_step() {
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let step = Step { dt: 1e-3, length };
        assert!(matches!(step.checked(), Err(StepError::BadStep { .. })), "{length}");
    }
}

#[test]
fn a_clone_steps_to_the_same_bits_and_leaves_the_original_as_it_is() {
    for name in ["double-pendulum", "two-four-bars", "quarter-car", "iltis-suspension", "servo-arm"]
    {
        let scene = scene(name);
        for formulation in FormulationKind::ALL {
            match scene.dimension {
                Dimension::Planar => clones::<2>(&scene, formulation),
                Dimension::Spatial => clones::<3>(&scene, formulation),
            }
        }
    }
}

fn clones<const D: usize>(scene: &Scene<f64>, formulation: FormulationKind) {
    let settings = settings(scene, formulation.name(), Some(1e-3));
    let mut original = Simulation::<f64, D>::new(scene, &settings).expect("it assembles");
    let before = go(&mut original, 20);
    let mut clone = original.clone();
    let of_clone = go(&mut clone, 20);
    assert_eq!(bits(&original), before, "{} {formulation:?}", scene.name);
    assert_eq!(go(&mut original, 20), of_clone, "{} {formulation:?}", scene.name);
    assert_ne!(of_clone, before);
}

#[test]
fn clones_that_share_threads_step_at_the_same_time() {
    fn travels<S: Clone + Send + Sync>(_: &S) {}
    let text = generate(&Family::Chain { bodies: 300 }, "chain").expect("generated");
    let scene = mbs_testkit::scene(&text);
    for formulation in FormulationKind::ALL.into_iter().filter(|f| f.row().threads) {
        let of = |threads| Method {
            formulation: Some(formulation.name().to_owned()),
            threads: Some(threads),
            ..Method::default()
        };
        let alone = go(&mut simulation::<3>(&scene, of(1)), 4);
        let mut original = simulation::<3>(&scene, of(2));
        travels(&original);
        let mut clone = original.clone();
        let both = std::thread::scope(|scope| {
            let other = scope.spawn(|| go(&mut clone, 4));
            [go(&mut original, 4), other.join().expect("no panic")]
        });
        assert!(both.iter().all(|bits| *bits == alone), "{formulation:?}");
    }
}
