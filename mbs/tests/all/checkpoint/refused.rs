//! Checkpoints from which a run cannot be resumed, and their errors.

use crate::common::scene;
use mbs::core::scene::{Inertia, Scene};
use mbs::typed::Simulation;
use mbs::{Checkpoint, CheckpointError, Method, ResolvedMethod};

fn settings(scene: &Scene<f64>, overrides: &Method) -> ResolvedMethod {
    ResolvedMethod::new(scene, overrides).expect("good settings")
}

/// A checkpoint of the double pendulum after some steps.
fn saved() -> Vec<u8> {
    let scene = scene("double-pendulum");
    let settings = settings(&scene, &Method::default());
    let mut simulation = Simulation::<f64, 2>::new(&scene, &settings).expect("it starts");
    for _ in 0..10 {
        simulation.step(1e-3).expect("a regular step");
    }
    let mut bytes = Vec::new();
    simulation.save((&scene, &settings), &mut bytes).expect("memory");
    bytes
}

/// Restores a checkpoint in a scene with settings, and asserts that an error leaves the state as it was.
fn restored(scene: &Scene<f64>, overrides: &Method, bytes: &[u8]) -> Result<(), CheckpointError> {
    let settings = settings(scene, overrides);
    let mut simulation = Simulation::<f64, 2>::new(scene, &settings).expect("it starts");
    let before = simulation.state().clone();
    let restored = simulation.restore((scene, &settings), bytes);
    assert!(restored.is_ok() || *simulation.state() == before, "nothing has changed");
    restored
}

#[test]
fn another_scene_is_named_by_its_parts() {
    let bytes = saved();
    let plain = Method::default();
    let mut other = scene("double-pendulum");
    assert!(restored(&other, &plain, &bytes).is_ok());
    other.bodies[1].mass *= 1.0 + f64::EPSILON;
    match restored(&other, &plain, &bytes) {
        Err(CheckpointError::Scene(parts)) => assert_eq!(parts, ["[[body]]"]),
        other => panic!("{other:?}"),
    }
    other.gravity = None;
    if let Inertia::Rod { from, .. } = &mut other.bodies[0].inertia {
        from[0] = 0.1;
    }
    match restored(&other, &plain, &bytes) {
        Err(CheckpointError::Scene(parts)) => assert_eq!(parts, ["[scene]", "[[body]]"]),
        other => panic!("{other:?}"),
    }
}

#[test]
fn another_setting_is_named_with_both_values() {
    let (bytes, scene) = (saved(), scene("double-pendulum"));
    let plain = Method::default();
    let text = |text: &str| Some(text.to_owned());
    let others = [
        ("step", Method { step: Some(2e-3), ..plain.clone() }),
        ("formulation", Method { formulation: text("recursive"), ..plain.clone() }),
        ("integrator", Method { integrator: text("hht"), ..plain.clone() }),
        ("tolerance", Method { tolerance: Some(1e-9), ..plain.clone() }),
        ("penalty", Method { penalty: Some(1e7), ..plain.clone() }),
        ("duration", Method { duration: Some(20.0), ..plain.clone() }),
        ("step-control", Method { step_control: text("error"), ..plain.clone() }),
        ("energy-alarm", Method { energy_alarm: Some(0.2), ..plain.clone() }),
        ("precision", Method { precision: text("f32"), ..plain.clone() }),
    ];
    for (name, overrides) in others {
        match restored(&scene, &overrides, &bytes) {
            Err(CheckpointError::Setting { key, was, is }) => {
                assert_eq!(key, name);
                assert_ne!(was, is);
            }
            other => panic!("{name}: {other:?}"),
        }
    }
    let threads = Method { threads: Some(2), ..plain };
    assert!(restored(&scene, &threads, &bytes).is_ok(), "threads change no bit");
}

#[test]
fn a_file_that_is_not_whole_is_refused_at_every_length() {
    let bytes = saved();
    for n in 0..bytes.len() {
        match Checkpoint::read(&bytes[..n]) {
            Err(CheckpointError::NotACheckpoint) if n == 0 => {}
            Err(CheckpointError::Torn { stated, found }) => assert!(found < stated, "{n}"),
            other => panic!("{n} bytes: {other:?}"),
        }
    }
    let longer = [&bytes[..], &[0; 3]].concat();
    assert!(matches!(Checkpoint::read(&longer[..]), Err(CheckpointError::Torn { .. })));
}

#[test]
fn a_changed_byte_is_found_wherever_it_is() {
    let bytes = saved();
    for place in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[place] ^= 1 << (place % 8);
        assert!(Checkpoint::read(&changed[..]).is_err(), "byte {place}");
    }
}

#[test]
fn a_length_that_is_claimed_takes_no_memory() {
    let mut bytes = saved();
    bytes[12..20].copy_from_slice(&u64::MAX.to_le_bytes());
    let there = bytes.len() as u64 - 28;
    match Checkpoint::read(&bytes[..]) {
        Err(CheckpointError::Torn { stated: u64::MAX, found }) => assert_eq!(found, there),
        other => panic!("{other:?}"),
    }
}
