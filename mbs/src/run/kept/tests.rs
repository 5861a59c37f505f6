//! That every item of a run's record matters.

use crate::alarm::Alarm;
use crate::checkpoint::{Checkpoint, Identity, Keeping};
use crate::figure::Figure;
use crate::recorder::{Keep, Recorder};
use crate::run::{Counts, Outcome, Progress, Run, run_kept};
use crate::{InSpace, Overrides, Plane, Settings};
use core::time::Duration;
use mbs_core::scene::Scene;
use mbs_scene::{Channel, Document, Provenance, RunSummary};
use std::path::PathBuf;

fn scene(name: &str) -> Scene<f64> {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).expect("the scene is in the repository");
    Document::from_bytes(&bytes, name).and_then(|d| d.scene()).expect("a good scene")
}

/// Takes the checkpoint that stands there at a time.
struct Copy {
    at: f64,
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Progress for Copy {
    fn reached(&mut self, t: f64) {
        if t >= self.at && self.bytes.is_empty() {
            self.bytes = std::fs::read(&self.path).expect("there is always one");
        }
    }
}

/// Everything that a run gives but for what clocks say.
fn seen(outcome: &Outcome) -> String {
    let (mut rows, mut steps) = (Vec::new(), Vec::new());
    outcome.write_csv(&mut rows).expect("memory");
    outcome.write_steps(&mut steps).expect("memory");
    let timeless = RunSummary {
        cpu_seconds: 0.0,
        real_time_factor: 0.0,
        worst_step_seconds: 0.0,
        ..outcome.summary.clone()
    };
    let page = outcome.page(Provenance::default());
    let (before, after) = page.split_once("CPU time of the steps").expect("it has a row of it");
    let (_, after) = after.split_once("\"notes\"").expect("notes follow");
    format!("{rows:?}{steps:?}{}{before}{after}", timeless.to_json())
}

/// Leaves an item out: it is then as in a run that has made no step.
type Leave<const D: usize> = for<'a> fn(&mut Run<'a, f64, D>);

/// That a run gives the same from its checkpoint before time `at`, and something else where one of the items is left out.
fn every_item_matters<const D: usize>(
    name: &str,
    overrides: &Overrides,
    at: f64,
    items: &[(&str, Leave<D>)],
) where
    Plane<D>: InSpace<f64>,
{
    let scene = scene(name);
    let settings = Settings::new(&scene, overrides).expect("good settings");
    let folder = format!("mbs-record-{}-{:?}", std::process::id(), std::thread::current().id());
    let out = std::env::temp_dir().join(folder);
    let mut keeping = Keeping::new(&out, settings.step).expect("a directory of ours");
    let mut copy = Copy { at, path: keeping.path(), bytes: Vec::new() };
    let whole = run_kept::<f64, D>(&scene, &settings, &mut copy, (None, Some(&mut keeping)));
    let whole = seen(&whole.expect("no checkpoint to refuse"));
    std::fs::remove_dir_all(&out).expect("it is ours");
    let checkpoint = Checkpoint::read(&copy.bytes[..]).expect("it is whole");
    let before = at - checkpoint.time();
    assert!(before >= 0.0 && before <= 2.0 * settings.step_max, "{}", checkpoint.time());

    let again = |leave: Option<&Leave<D>>| {
        let run = Run::<f64, D>::begin(&scene, &settings, Keep::Rows);
        let mut run = run.unwrap_or_else(|outcome| panic!("{:?}", outcome.error));
        run.resume(&checkpoint, &Identity::new(&scene, &settings)).expect("it is ours");
        if let Some(leave) = leave {
            leave(&mut run);
        }
        seen(&run.complete(&mut ()))
    };
    assert!(whole == again(None), "{name}: what is kept is not all");
    for (item, leave) in items {
        assert!(whole != again(Some(leave)), "{name}: nothing is lost without {item}");
    }
}

fn of(step: f64, duration: f64) -> Overrides {
    Overrides { step: Some(step), duration: Some(duration), ..Overrides::default() }
}

#[test]
fn every_item_of_the_record_matters() {
    let items: [(&str, Leave<2>); 6] = [
        ("count of steps", |run| run.done += 1),
        ("rows", |run| {
            let channels = Channel::of_scene(run.scene);
            let initial = run.simulation.invariant().initial();
            run.recorder = Recorder::new(channels, run.settings.n_steps(), initial, Keep::Rows);
        }),
        ("pictures", |run| {
            let duration = run.settings.duration;
            run.figure = Figure::new(run.scene, run.simulation.model(), duration);
        }),
        ("counts", |run| run.counts = Counts::default()),
        ("turns of angles", |run| {
            run.measures = crate::channels::Channels::new(run.scene, run.simulation.model())
                .unwrap_or_else(|error| panic!("{error:?}"));
        }),
        ("simulation", |run| {
            let fresh = crate::Simulation::new(run.scene, run.settings);
            run.simulation = fresh.unwrap_or_else(|error| panic!("{error:?}"));
        }),
    ];
    // the crank turns at half a turn each second
    every_item_matters("guided-four-bar", &of(1e-2, 4.0), 3.0, &items);
}

#[test]
fn contacts_and_what_control_has_counted_matter() {
    let items: [(&str, Leave<3>); 2] = [
        ("contacts", |run| run.contacts.resume(run.simulation.state(), &[], 0)),
        ("counts of the control", |run| run.counts.control = mbs_scene::ControlSummary::default()),
    ];
    let control = Some("both".to_owned());
    let overrides = Overrides { step_control: control, step_max: Some(5e-3), ..of(1e-3, 1.0) };
    every_item_matters("iltis-suspension", &overrides, 0.8, &items);
}

#[test]
fn what_the_alarm_has_heard_matters() {
    // it rings after ten steps in a row, here at 1.99 s
    let items: [(&str, Leave<2>); 1] =
        [("alarm", |run| run.alarm = Alarm::new(run.settings.energy_alarm))];
    let overrides = Overrides { energy_alarm: Some(1e-3), ..of(1e-2, 10.0) };
    every_item_matters("double-pendulum", &overrides, 1.95, &items);
}

#[test]
fn processor_time_is_that_of_all_starts() {
    let scene = scene("double-pendulum");
    let settings = Settings::new(&scene, &of(1e-3, 1.0)).expect("good settings");
    let run = Run::<f64, 2>::begin(&scene, &settings, Keep::Rows);
    let mut run = run.unwrap_or_else(|outcome| panic!("{:?}", outcome.error));
    run.clock.before = Duration::from_secs(100);
    let outcome = run.complete(&mut ());
    assert!(outcome.summary.cpu_seconds > 100.0);
}
