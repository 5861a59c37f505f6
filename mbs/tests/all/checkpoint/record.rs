//! Every item of a run's record in a checkpoint affects its results.

use super::layout::Parts;
use super::{results, scratch};
use crate::common::scene;
use mbs::core::scene::Scene;
use mbs::typed::{Recording, StepInputs, StepObserver, run_recorded};
use mbs::{Checkpoint, CheckpointWriter, Method, ResolvedMethod, StopError};
use std::path::PathBuf;

/// Observer that copies the checkpoints before the first step and before a time.
struct Copies {
    near: core::ops::Range<f64>,
    path: PathBuf,
    first: Vec<u8>,
    bytes: Vec<u8>,
}

impl<const D: usize> StepObserver<f64, D> for Copies {
    fn before(&mut self, inputs: &mut StepInputs<'_, f64, D>) -> Result<(), StopError> {
        let t = inputs.state().t;
        for (copy, is_due) in
            [(&mut self.first, t == 0.0), (&mut self.bytes, self.near.contains(&t))]
        {
            if is_due {
                *copy = std::fs::read(&self.path).expect("there is always one");
            }
        }
        Ok(())
    }
}

/// Runs a scene with a checkpoint after each step. Returns the checkpoints of the start and before time `at`.
fn kept<const D: usize>(
    (scene, settings): (&Scene<f64>, &ResolvedMethod),
    at: f64,
) -> ([String; 4], [Parts; 2]) {
    let out = scratch(&format!("record-{:?}", std::thread::current().id()));
    let mut writer = CheckpointWriter::new(&out, settings.step).expect("a directory of ours");
    let near = at - 2.0 * settings.step_max..at;
    let mut copies = Copies { near, path: writer.path(), first: Vec::new(), bytes: Vec::new() };
    let whole = run_recorded::<f64, D>(
        scene,
        settings,
        &mut copies,
        Recording { writer: Some(&mut writer), ..Recording::default() },
    );
    let whole = results(&whole.expect("no checkpoint to refuse"));
    std::fs::remove_dir_all(&out).expect("it is ours");
    let Copies { first, bytes, .. } = copies;
    (whole, [first, bytes].map(|bytes| Parts::of_run(bytes, settings)))
}

/// Asserts that resuming from the checkpoint before time `at` gives the results of the run. If one of the items is replaced by that of a run
/// without steps, the results must differ.
fn every_item_matters<const D: usize>(name: &str, overrides: &Method, at: f64, items: &[&str]) {
    let scene = scene(name);
    let settings = ResolvedMethod::new(&scene, overrides).expect("good settings");
    let (whole, [first, kept]) = kept::<D>((&scene, &settings), at);
    let read = |bytes: &[u8]| Checkpoint::read(bytes).expect("it is whole");
    assert!(read(first.bytes()).time() <= 0.0);
    let before = at - read(kept.bytes()).time();
    assert!(before >= 0.0 && before <= 2.0 * settings.step_max, "{before}");

    let again = |bytes: &[u8]| {
        let checkpoint = read(bytes);
        let from = Recording { from: Some(&checkpoint), ..Recording::default() };
        results(&run_recorded::<f64, D>(&scene, &settings, &mut (), from).expect("it is ours"))
    };
    assert!(whole == again(kept.bytes()), "{name}: what is kept is not all");
    for item in items {
        let lost = match *item {
            "count of steps" => {
                let done = u64::from_le_bytes(kept.part(item).try_into().expect("eight bytes"));
                kept.with(item, &(done + 1).to_le_bytes())
            }
            "turns of angles" => {
                // the rate is uniform: the revolutions could be computed again from the time, which is the last number
                let (mut turns, now) = (first.part(item).to_vec(), kept.part(item));
                let n = u64::from_le_bytes(now[..8].try_into().expect("eight bytes"));
                let time = 8 * usize::try_from(n).expect("a small count");
                turns[time..time + 8].copy_from_slice(&now[time..time + 8]);
                kept.with(item, &turns)
            }
            _ => kept.with(item, first.part(item)),
        };
        assert!(whole != again(&lost), "{name}: nothing is lost without {item}");
    }
}

fn of(step: f64, duration: f64) -> Method {
    Method { step: Some(step), duration: Some(duration), ..Method::default() }
}

#[test]
fn every_item_of_the_record_matters() {
    let items = [
        "count of steps",
        "rows",
        "statistics",
        "pictures",
        "counts",
        "turns of angles",
        "simulation",
    ];
    // the crank turns by half a revolution each second
    every_item_matters::<2>("guided-four-bar", &of(1e-2, 4.0), 3.0, &items);
}

#[test]
fn contacts_and_what_control_has_counted_matter() {
    let items = ["contacts", "counts of the control"];
    let control = Some("both".to_owned());
    let overrides = Method { step_control: control, step_max: Some(5e-3), ..of(1e-3, 1.0) };
    every_item_matters::<3>("iltis-suspension", &overrides, 0.8, &items);
}

#[test]
fn what_the_alarm_has_heard_matters() {
    // the alarm stops the run after ten steps in a row, here at 1.99 s
    let overrides = Method { energy_alarm: Some(1e-3), ..of(1e-2, 10.0) };
    every_item_matters::<2>("double-pendulum", &overrides, 1.95, &["alarm"]);
}

#[test]
fn processor_time_is_that_of_all_starts() {
    let scene = scene("double-pendulum");
    let settings = ResolvedMethod::new(&scene, &of(1e-3, 1.0)).expect("good settings");
    let (_, [first, _]) = kept::<2>((&scene, &settings), 0.5);
    let nanoseconds: u64 = 100_000_000_000;
    let bytes = first.with("CPU time", &nanoseconds.to_le_bytes());
    let checkpoint = Checkpoint::read(&bytes[..]).expect("it is whole");
    let from = Recording { from: Some(&checkpoint), ..Recording::default() };
    let outcome = run_recorded::<f64, 2>(&scene, &settings, &mut (), from).expect("it is ours");
    assert!(outcome.summary.cpu_seconds > 100.0);
}
