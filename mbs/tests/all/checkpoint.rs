//! Resuming a run from a checkpoint gives every bit of the run without interruption.

use crate::common::files::{scratch, without_clocks};
use crate::common::{path, scene};
use mbs::core::scene::{BodyId, BodyTorque, Dimension, Effect, EffectKind, Motion, Scene, Signal};
use mbs::record::Provenance;
use mbs::scene_file::SceneFile;
use mbs::typed::Simulation;
use mbs::{
    CHECKPOINT, Checkpoint, FormulationKind, Mechanism, Method, Outcome, ResolvedMethod, Run,
    Watchers, run, run_with,
};
use std::time::Duration;

mod bytes;
mod items;
mod layout;
mod record;
mod refused;
mod tape;

/// Rows of the summary that clocks determine.
const CLOCK_ROWS: [&str; 3] = ["CPU time of the steps", "times real time", "slowest step"];

/// All results of a run except times: rows, steps, JSON, and the contents of its page.
fn results(outcome: &Outcome) -> [String; 4] {
    let (mut rows, mut steps) = (Vec::new(), Vec::new());
    outcome.write_csv(&mut rows).expect("memory");
    outcome.write_steps(&mut steps).expect("memory");
    let [rows, steps] = [rows, steps].map(|text| String::from_utf8(text).expect("text"));
    let mut record = outcome.record(Provenance::default());
    let n = record.summary.len();
    record.summary.retain(|(label, _)| !CLOCK_ROWS.contains(&label.as_str()));
    assert_eq!(n, record.summary.len() + CLOCK_ROWS.len());
    [rows, steps, without_clocks(&outcome.summary.to_json()), format!("{record:?}")]
}

fn same(a: &[String; 4], b: &[String; 4], what: &str) {
    for ((a, b), part) in a.iter().zip(b).zip(["rows", "steps", "JSON", "record"]) {
        let at = || a.bytes().zip(b.bytes()).position(|(a, b)| a != b);
        assert!(
            a == b,
            "{what}: {part} differ from byte {:?} of {} and {}",
            at(),
            a.len(),
            b.len()
        );
    }
}

/// Time of more than two ticks of a file system's clock.
const COARSE: Duration = Duration::from_millis(20);

/// Runs a scene without interruption, with checkpoints, and from each of these checkpoints. Returns the outcome of the first run.
fn split(name: &str, overrides: &Method, every: f64) -> Outcome {
    let document = std::fs::read(path(name)).expect("the scene is in the repository");
    let document = SceneFile::from_bytes(&document, name).expect("TOML");
    let mechanism = Mechanism::of_file(document).expect("a scene");
    let options = Run::new().method(overrides.clone());
    let what = format!("{name} {overrides:?}");
    let whole = run(&mechanism, &options).expect("a scene").into_outcome();

    let out = scratch(&format!("checkpoint-split-{:?}-{name}", std::thread::current().id()));
    let mut kept = Vec::<Vec<u8>>::new();
    let mut of_last = None;
    let mut look = |_| {
        let file = out.join(CHECKPOINT);
        let written = file.metadata().and_then(|m| m.modified()).expect("there is always one");
        // clocks of files are coarse: a file that was just written may have been written again within the same tick
        if of_last == Some(written) && written.elapsed().is_ok_and(|age| age > COARSE) {
            return;
        }
        of_last = Some(written);
        let now = std::fs::read(file).expect("there is always one");
        if kept.last() != Some(&now) {
            kept.push(now);
        }
    };
    let options = options.checkpoints(&out, every);
    let result = run_with(&mechanism, &options, &mut Watchers::progress(&mut look));
    let result = result.expect("a folder of ours");
    same(&results(&whole), &results(result.outcome()), &what);
    let writer = result.checkpoints().expect("it is kept");
    assert!(writer.failure().is_none() && kept.len() >= 3, "{what}: {} kept", kept.len());

    for bytes in &kept {
        let checkpoint = Checkpoint::read(&bytes[..]).expect("it is whole");
        let from = format!("{what} from {} s", checkpoint.time());
        let result = run(&mechanism, &Run::new().resume(checkpoint));
        let result = result.unwrap_or_else(|e| panic!("{from}: {e}"));
        same(&results(&whole), &results(result.outcome()), &from);
    }
    let _ = std::fs::remove_dir_all(out);
    whole
}

fn with(formulation: &str, duration: f64) -> Method {
    let formulation = Some(formulation.to_owned());
    Method { formulation, duration: Some(duration), ..Method::default() }
}

#[test]
fn every_formulation_resumes_to_the_same_bits() {
    let scenes = [
        ("double-pendulum", 1e-3),
        ("guided-four-bar", 1e-3),
        ("two-four-bars", 1e-3),
        ("spatial-four-bar", 1e-3),
        ("iltis-suspension", 1e-3),
        ("quarter-car", 1e-3),
        ("servo-arm", 1e-3),
        ("geared-arm", 1e-3),
        ("hexapod", 5e-3),
    ];
    for formulation in FormulationKind::ALL {
        for (name, step) in scenes {
            let overrides = with(formulation.name(), 0.9);
            // the classical Lagrangian accepts redundant constraints only with regularisation
            let is_redundant =
                formulation == FormulationKind::Classical && name == "spatial-four-bar";
            let penalty = is_redundant.then_some(1e10);
            split(name, &Method { step: Some(step), penalty, ..overrides }, 0.21);
        }
    }
}

#[test]
fn every_integrator_resumes_to_the_same_bits() {
    let implicit = ["newmark", "generalised-alpha", "hht"];
    let first_order = ["rk4", "rk54", "rk853", "gbs", "radau5"];
    let pairs = implicit.map(|i| ("index-3", i)).into_iter();
    let relative = implicit.into_iter().chain(first_order).map(|i| ("recursive", i));
    for (formulation, integrator) in pairs.chain(relative) {
        for name in ["double-pendulum", "spatial-four-bar", "iltis-suspension", "servo-arm"] {
            let overrides = with(formulation, 0.5);
            let integrator = Some(integrator.to_owned());
            split(name, &Method { integrator, step: Some(1e-3), ..overrides }, 0.12);
        }
    }
}

#[test]
fn every_precision_resumes_to_the_same_bits() {
    for precision in ["f32", "dd"] {
        for formulation in FormulationKind::ALL {
            let overrides = with(formulation.name(), 0.2);
            let precision = Some(precision.to_owned());
            split("double-pendulum", &Method { precision, ..overrides }, 0.05);
        }
        let (precision, integrator) = (Some(precision.to_owned()), Some("gbs".to_owned()));
        let overrides = Method { precision, integrator, ..with("recursive", 0.2) };
        split("double-pendulum", &overrides, 0.05);
    }
}

#[test]
fn steps_of_controlled_length_resume_to_the_same_bits() {
    for formulation in FormulationKind::ALL {
        for rule in ["energy", "energy-printed", "error", "both"] {
            let overrides = Method {
                step_control: Some(rule.to_owned()),
                step: Some(1e-3),
                step_max: Some(2e-2),
                ..with(formulation.name(), 1.5)
            };
            let outcome = split("double-pendulum", &overrides, 0.37);
            let control = outcome.summary.control.expect("it is controlled");
            assert!(control.largest_step > 2.0 * control.smallest_step, "{control:?}");
        }
    }
}

#[test]
fn contacts_resume_to_the_same_bits() {
    for formulation in ["multi-index", "index-1", "recursive"] {
        for rule in ["fixed", "both"] {
            let overrides = Method {
                step_control: Some(rule.to_owned()).filter(|_| formulation != "multi-index"),
                step: Some(1e-3),
                step_max: Some(5e-3),
                ..with(formulation, 1.0)
            };
            let outcome = split("iltis-suspension", &overrides, 0.06);
            assert!(!outcome.summary.contacts.is_empty());
        }
    }
}

#[test]
fn changes_of_index_resume_to_the_same_bits() {
    let overrides = Method {
        energy_tolerance: Some([1e-8, 1e-10]),
        step: Some(1e-4),
        step_max: Some(1e-2),
        ..with("multi-index", 10.0)
    };
    let outcome = split("double-pendulum", &overrides, 0.7);
    let control = outcome.summary.control.expect("it is controlled");
    assert!(control.index_changes > 1 && control.index_1_steps > 1, "{control:?}");
}

#[test]
fn what_is_thinned_resumes_to_the_same_bits() {
    // the first run has 30,000 steps, of which every third is a row; the second run has about 30,000 steps of controlled lengths
    let fixed = Method { step: Some(1e-4), ..with("recursive", 3.0) };
    assert_eq!(split("double-pendulum", &fixed, 0.7501).summary.steps, 30_000);
    let controlled = Method {
        step_control: Some("error".to_owned()),
        error_tolerance: Some(1e-12),
        step_max: Some(1e-2),
        ..with("recursive", 10.0)
    };
    let outcome = split("double-pendulum", &controlled, 3.0);
    assert!(outcome.summary.steps > 20_001, "{}", outcome.summary.steps);
    assert!(outcome.rows().len() < 20_001, "{}", outcome.rows().len());
}

#[test]
fn a_run_that_stops_resumes_to_the_same_stop() {
    // with long steps of the double pendulum, the energy error is too large in ten steps in a row, relative to the exchanged energy
    let alarm = Method { energy_alarm: Some(1e-3), step: Some(1e-2), ..with("index-3", 10.0) };
    let outcome = split("double-pendulum", &alarm, 0.13);
    let stop = outcome.summary.error.expect("it stops");
    assert!(stop.time > 0.5 && stop.time < 9.0, "{stop:?}");
}

/// The guided four-bar linkage with a torque and a guide that are inputs.
fn driven() -> Scene<f64> {
    let mut scene = scene("guided-four-bar");
    scene.guides[0].law = Motion::Input([0.0, 0.0, 0.0]);
    let course = Signal::Input([0.0; 3]);
    let kind = EffectKind::BodyTorque(BodyTorque { body: BodyId::Body(1), course });
    scene.effects.push(Effect { name: "motor".into(), enabled: true, kind });
    scene
}

/// Bits of state and energies after each of `steps` steps.
fn bits<const D: usize>(simulation: &mut Simulation<f64, D>, steps: usize) -> Vec<u64> {
    let mut told = Vec::new();
    for k in 0..=steps {
        let s = simulation.state();
        for numbers in [&s.q[..], &s.v, &s.a, &s.reaction, &s.memory, &simulation.energies()] {
            told.extend(numbers.iter().map(|x| x.to_bits()));
        }
        if k < steps {
            let report = simulation.step(1e-3).expect("a regular step");
            told.push(u64::from(report.iterations));
        }
    }
    told
}

#[test]
fn a_simulation_that_is_restored_continues_with_inputs_as_they_are_set() {
    let scene = driven();
    assert_eq!(scene.dimension, Dimension::Planar);
    // multi-index controls its steps: the first part of a divided step would use up the guide's input
    for formulation in
        FormulationKind::ALL.into_iter().filter(|f| *f != FormulationKind::MultiIndex)
    {
        let settings =
            ResolvedMethod::new(&scene, &with(formulation.name(), 1.0)).expect("settings");
        let new = || Simulation::<f64, 2>::new(&scene, &settings).expect("the scene starts");
        let (mut first, mut second) = (new(), new());
        let effect = scene.effects.len() - 1;
        for k in 0..50 {
            let t = 1e-3 * f64::from(k + 1);
            first.set_guide(0, [t * t, 2.0 * t, 2.0]).expect("an input");
            first.set_input(effect, [0.3, 0.0, 0.3]).expect("an input");
            first.step(1e-3).expect("a regular step");
        }
        // the inputs are set, but not yet used by a step
        first.set_input(effect, [0.5, 0.0, 0.2]).expect("an input");
        let mut bytes = Vec::new();
        first.save((&scene, &settings), &mut bytes).expect("memory");
        second.restore((&scene, &settings), &bytes[..]).expect("of the same scene");
        assert_eq!(first.state(), second.state(), "{}", formulation.name());
        // from here on the guide keeps the value that was set last
        assert_eq!(bits(&mut first, 5), bits(&mut second, 5), "{}", formulation.name());
    }
}
