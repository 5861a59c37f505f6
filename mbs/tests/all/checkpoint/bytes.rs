//! Changed checkpoints: any bytes give an error at worst, never a panic.

use super::items::{CASE, Case, saved};
use super::layout::{Parts, sealed};
use super::scratch;
use mbs::core::scene::Scene;
use mbs::typed::{Recording, Simulation, run_recorded};
use mbs::{Checkpoint, CheckpointError, CheckpointWriter, Method, ResolvedMethod};
use proptest::prelude::*;
use proptest::test_runner::{TestRng, TestRunner};

#[test]
fn a_checkpoint_of_another_version_is_refused_with_its_name() {
    let (scene, case) = (CASE.scene(), CASE);
    let settings = case.settings(&scene);
    let mut bytes = saved(&case.before::<2>(), (&scene, &settings));
    // the version comes first, after its length
    let version = env!("CARGO_PKG_VERSION").as_bytes();
    assert_eq!(&bytes[36..36 + version.len()], version);
    bytes[36] = b'9';
    match Checkpoint::read(&sealed(&bytes)[..]) {
        Err(CheckpointError::Version(found)) => assert!(found.starts_with('9')),
        other => panic!("{other:?}"),
    }
}

/// Cases that cover all parts of the format, with few bytes, so that many changes can be tried.
const TRIED: [Case; 5] = [
    CASE,
    Case { formulation: "multi-index", control: "both", ..CASE },
    Case { formulation: "state-space", ..CASE },
    Case { formulation: "recursive", integrator: "rk54", ..CASE },
    Case { formulation: "recursive", control: "energy", ..CASE },
];

/// Runs 30 steps with checkpoints, and returns the bytes of the middle one.
fn run_bytes(case: Case) -> (Scene<f64>, ResolvedMethod, Vec<u8>) {
    let scene = case.scene();
    let overrides = Method { duration: Some(0.03), ..case.overrides() };
    let settings = ResolvedMethod::new(&scene, &overrides).expect("good settings");
    let out = scratch("bytes");
    let mut writer = CheckpointWriter::new(&out, 0.01).expect("a directory of ours");
    let done = run_recorded::<f64, 2>(
        &scene,
        &settings,
        &mut (),
        Recording { writer: Some(&mut writer), ..Recording::default() },
    );
    assert!(done.is_ok_and(|outcome| outcome.summary.completed));
    let bytes = std::fs::read(writer.path()).expect("it is there");
    std::fs::remove_dir_all(&out).expect("it is ours");
    (scene, settings, bytes)
}

#[test]
fn no_bytes_do_harm() {
    for case in TRIED {
        let (scene, settings, bytes) = run_bytes(case);
        assert!(Checkpoint::read(&bytes[..]).is_ok());
        // the bytes before the state identify the scene and the settings
        let begin = Parts::of_run(bytes.clone(), &settings).place("simulation").start;
        let strategy = (prop::collection::vec((0..bytes.len(), any::<u8>()), 1..4), 0..bytes.len());
        let config = ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() };
        let rng = TestRng::deterministic_rng(Default::default());
        let mut runner = TestRunner::new_with_rng(config, rng);
        let tried = runner.run(&strategy, |(changes, length)| {
            let mut changed = bytes.clone();
            for (place, byte) in changes {
                changed[place] = byte;
            }
            if length % 4 == 0 {
                changed.truncate(length);
            }
            prop_assert!(changed == bytes || Checkpoint::read(&changed[..]).is_err());
            // with correct length and checksum all bytes are read: a state that no run can have gives an error at worst
            let Ok(checkpoint) = Checkpoint::read(&sealed(&changed)[..]) else { return Ok(()) };
            let mut simulation = Simulation::<f64, 2>::new(&scene, &settings).expect("it starts");
            // the state is restored whatever scene and settings the bytes had
            changed[..begin].copy_from_slice(&bytes[..begin]);
            let restored = simulation.restore((&scene, &settings), &sealed(&changed)[..]);
            if case.control != "fixed" && restored.is_ok() {
                // the run to the end may need very many steps, because the changed state determines their length
                let _ = (0..20).try_for_each(|_| simulation.advance(case.rest()).map(|_| ()));
            } else if case.integrator == "trapezoidal" {
                let from = Recording { from: Some(&checkpoint), ..Recording::default() };
                let _ = run_recorded::<f64, 2>(&scene, &settings, &mut (), from);
            }
            Ok(())
        });
        tried.unwrap_or_else(|error| panic!("{case:?}: {error}"));
    }
}
