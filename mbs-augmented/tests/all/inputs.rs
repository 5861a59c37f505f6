//! Inputs are part of the state: one model serves states with different inputs, each in its own thread.

use mbs_augmented::{Options, Step, Workspace, index3};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Effect, JointId, JointTorque, Motion, Scene, Signal};
use mbs_core::step::InputError;
use mbs_testkit::{file, solver, start};

/// A four-bar linkage with inputs for the guide of the crank and for a torque on the coupler.
fn scene() -> Scene<f64> {
    let mut scene = file("guided-four-bar");
    scene.guides[0].law = Motion::Input([0.0, 0.0, 2.0]);
    scene.initials.clear();
    let kind =
        JointTorque { joint: JointId::new(1), coordinate: None, course: Signal::Input([0.0; 3]) }
            .into();
    scene.effects.push(Effect { name: "motor".into(), enabled: true, kind });
    scene
}

/// Returns the state after 100 steps with the given acceleration of the guide [rad/s^2] and torque [N m].
fn stepped(
    model: &NaturalModel<f64, 2>,
    mut state: State<f64>,
    effect: usize,
    [acceleration, torque]: [f64; 2],
) -> State<f64> {
    let mut work = Workspace::new(model, solver(model));
    for k in 1..=100 {
        let t = f64::from(k) * 1e-3;
        let motion = [acceleration * t * t / 2.0, acceleration * t, acceleration];
        let torque = [torque * f64::from(k / 10 % 3), 0.0, 0.0];
        model.prescribed().set_guide(&mut state.inputs, 0, motion).expect("an input");
        model.prescribed().set_input(&mut state.inputs, effect, torque).expect("an input");
        index3::step(
            model,
            Step { dt: 1e-3, length: model.length() },
            &Options::index3(),
            &mut state,
            &mut work,
        )
        .expect("a regular step");
    }
    state
}

#[test]
fn one_model_steps_states_with_different_inputs_in_two_threads_as_two_models_do() {
    let scene = scene();
    let effect = scene.effects.len() - 1;
    let inputs = [[2.0, 30.0], [-1.0, -20.0]];
    let (model, first) = start::<2>(&scene);
    let run = |inputs| stepped(&model, first.clone(), effect, inputs);
    let shared = std::thread::scope(|scope| {
        inputs
            .map(|inputs| scope.spawn(move || run(inputs)))
            .map(|thread| thread.join().expect("no panic"))
    });
    for (inputs, shared) in inputs.into_iter().zip(&shared) {
        let (own, state) = start::<2>(&scene);
        assert_eq!(*shared, stepped(&own, state, effect, inputs));
        assert_eq!(shared.inputs, shared.applied);
    }
    assert_ne!(shared[0].q, shared[1].q);
}

#[test]
fn a_copy_of_a_state_has_its_inputs() {
    let (model, mut state) = start::<2>(&scene());
    let (prescribed, before) = (model.prescribed(), state.clone());
    prescribed.set_guide(&mut state.inputs, 0, [0.1, 0.2, 0.3]).expect("an input");
    let mut copy = before.clone();
    copy.copy_from(&state);
    assert_eq!(copy, state);
    assert_eq!(copy.inputs[prescribed.guide_input(0).expect("an input")], [0.1, 0.2, 0.3]);
    assert_eq!(copy.applied, before.inputs, "no step was made with it");
    let refused = prescribed.set_guide(&mut state.inputs, 1, [0.0; 3]);
    assert_eq!(refused, Err(InputError::NotAnInput { number: 1 }));
    assert_eq!(state, copy, "nothing is set then");
}
