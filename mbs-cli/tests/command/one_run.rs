//! Tests that `mbs run` and `mbs_study::run` give the same results for every scene, and the same refusals.

use crate::files::scratch;
use crate::{json, plain, run, scene, status, text, written};
use mbs::typed::Simulation;
use mbs::{
    Checkpoint, Error as _, Goal, InputTable, Mechanism, Method, ResolvedMethod, Run, RunResult,
    SimulationError,
};
use serde_json::Value;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of steps of each scene: every channel has rows, and all scenes together run in a short time.
const STEPS: f64 = 20.0;

/// Rows and summary of a run through the command.
fn by_command(scene: &str, arguments: &[&str]) -> (String, Value) {
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    let out = scratch(&format!("one-run-{}", CALLS.fetch_add(1, Ordering::Relaxed)));
    let folder = ["--json", "--out", out.to_str().expect("plain letters")];
    let output = run("run", &[&[scene], &folder[..], arguments].concat());
    assert!([0, 2].contains(&status(&output)), "{scene}: {}", text(&output.stderr));
    assert_eq!(status(&output) == 2, !json(&output)["error"].is_null(), "{scene}");
    let rows = std::fs::read_to_string(out.join("run.csv")).expect("its rows");
    std::fs::remove_dir_all(out).expect("it is ours");
    (rows, untimed(json(&output)))
}

/// Rows and summary of a run through the library.
fn by_rust(result: &RunResult) -> (String, Value) {
    let mut rows = Vec::new();
    result.outcome().write_csv(&mut rows).expect("memory");
    let summary = serde_json::from_str(&result.summary().to_json()).expect("JSON");
    (String::from_utf8(rows).expect("text"), untimed(summary))
}

/// The object without times and without keys that only files have.
fn untimed(mut value: Value) -> Value {
    for key in ["cpu_seconds", "real_time_factor", "worst_step_seconds", "id", "checksums", "files"]
    {
        if let Some(object) = value.as_object_mut() {
            object.remove(key);
        }
    }
    if let Some(estimate) = value.get_mut("estimate").and_then(Value::as_object_mut) {
        estimate.remove("cpu_seconds");
    }
    value
}

#[test]
fn the_command_and_rust_make_the_same_run_of_every_scene() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");
    let files = std::fs::read_dir(folder).expect("scenes").flatten().map(|file| file.path());
    let mut n = 0;
    for file in files.filter(|file| file.extension().is_some_and(|end| end == "toml")) {
        let mechanism = Mechanism::read(&file).unwrap_or_else(|e| panic!("{}", e.render()));
        let scene = mechanism.resolve().expect("a scene");
        let duration = STEPS * scene.solver.step.unwrap_or(1e-3);
        let result = mbs_study::run(&mechanism, &Run::new().duration(duration));
        let rust = by_rust(&result.unwrap_or_else(|e| panic!("{}: {e}", file.display())));
        let arguments = ["--no-estimate", "--duration", &format!("{duration:?}")];
        let command = by_command(&plain(file.clone()), &arguments);
        assert!(rust == command, "{}: {rust:?}\n{command:?}", file.display());
        n += 1;
    }
    assert!(n > 30, "{n} scenes");
}

#[test]
fn the_command_and_rust_make_the_same_estimate_and_resume_alike() {
    let file = scene("double-pendulum");
    let mechanism = Mechanism::read(&file).expect("a scene");
    let options = Run::new().duration(0.5);
    let result = mbs_study::run(&mechanism, &options.clone().estimate()).expect("a run");
    assert!(result.summary().estimate.as_ref().is_some_and(|e| e.largest.is_some()));
    let whole = by_rust(&result);
    assert_eq!(whole, by_command(&file, &["--duration", "0.5"]));

    let out = scratch("one-run-kept");
    let half = Method { duration: Some(0.5), ..Method::default() };
    let kept = mbs_study::run(&mechanism, &Run::new().method(half).checkpoints(&out, 0.2));
    let kept = kept.expect("a run");
    let checkpoint = Checkpoint::open(&out.join(mbs::CHECKPOINT)).expect("it is kept");
    assert!((checkpoint.time() - 0.4).abs() < 2e-3, "{}", checkpoint.time());
    let resume = format!("--resume={}", plain(out.join(mbs::CHECKPOINT)));
    let resumed = mbs_study::run(&mechanism, &Run::new().resume(checkpoint)).expect("a run");
    let rust = by_rust(&resumed);
    assert_eq!(rust.0, whole.0);
    assert_eq!(rust, by_rust(&kept));
    assert_eq!(rust, by_command(&file, &[&resume, "--no-estimate"]));
}

/// A wheel with a motor that has an input.
const WHEEL: &str = "[scene]\nname = \"wheel\"\ndimension = 2\nduration = 0.3\n\
    [[body]]\nname = \"wheel\"\nmass = 1\ncenter = [0, 0]\ninertia = 2\n\
    [[joint]]\nname = \"axle\"\nkind = \"revolute\"\nbodies = [\"ground\", \"wheel\"]\nat = [0, 0]\n\
    [[effect]]\nname = \"motor\"\nkind = \"torque\"\njoint = \"axle\"\nvalue = 2\ninput = true\n";

#[test]
fn inputs_as_numbers_are_those_of_a_file() {
    let file = written("one-run-wheel.toml", WHEEL);
    let csv = written("one-run-motor.csv", "t,motor\n0.05,0\n0.1,3.7\n0.25,-1e-3\n");
    let mechanism = Mechanism::read(&file).expect("a scene");
    let table = InputTable::new([0.05, 0.1, 0.25], [("motor", vec![0.0, 3.7, -1e-3])]);
    let result = mbs_study::run(&mechanism, &Run::new().inputs(table)).expect("a run");
    let rust = by_rust(&result);
    assert_eq!(rust, by_command(&file, &["--inputs", &csv, "--no-estimate"]));
    let still = by_rust(&mbs_study::run(&mechanism, &Run::new()).expect("a run"));
    assert_ne!(rust.0, still.0);
}

#[test]
fn the_settings_that_a_goal_chose_give_its_rows() {
    let file = scene("double-pendulum");
    let mechanism = Mechanism::read(&file).expect("a scene");
    let goal = Goal::error(1e-3);
    let result = mbs_study::run(&mechanism, &Run::new().duration(0.5).goal(goal)).expect("a run");
    assert!(result.summary().completed && result.summary().chosen.is_some());
    let again = Run::new().method(result.settings().decided());
    let again = mbs_study::run(&mechanism, &again).expect("a run");
    assert_eq!(result.outcome().rows(), again.outcome().rows());
}

/// Code, message and hint of a refusal through the command.
fn refused_by_command(arguments: &[&str]) -> [String; 3] {
    let output = run("run", &[arguments, &["--json"]].concat());
    assert_eq!(status(&output), 1, "{arguments:?}: {}", text(&output.stderr));
    let error = &json(&output)["error"];
    ["code", "message", "hint"].map(|key| error[key].as_str().unwrap_or_default().to_owned())
}

fn refused_by_rust(error: &SimulationError) -> [String; 3] {
    [error.code().to_owned(), error.message().to_owned(), error.hint().unwrap_or_default()]
}

#[test]
fn contradictions_are_refused_alike_by_command_and_rust() {
    let wheel = written("one-run-refused.toml", WHEEL);
    let bad_name = written("one-run-name.csv", "t,moter\n0,1\n");
    let out = scratch("one-run-refused");
    let kept = plain(out.clone());
    let mechanism = Mechanism::read(&wheel).expect("a scene");
    let goal = Goal::error(1e-3);
    let step = Method { step: Some(1e-3), ..Method::default() };
    let paced = || Run::new().pacing(mbs::realtime::Pacing::default());
    let numbers = |name: &str, values: Vec<f64>| {
        Run::new().inputs(InputTable::new([0.0, 1.0], [(name, values)]))
    };
    let cases: [(Run, &[&str]); 7] = [
        (Run::new().method(step).goal(goal), &["--error", "1e-3", "--step", "1e-3"]),
        (
            Run::new().goal(goal).checkpoints(&out, 0.1),
            &["--error", "1e-3", "--checkpoint", "0.1", "--out", &kept],
        ),
        (paced().goal(goal), &["--error", "1e-3", "--realtime"]),
        (paced().checkpoints(&out, 0.1), &["--realtime", "--checkpoint", "0.1", "--out", &kept]),
        (Run::new().checkpoints(&out, -1.0), &["--checkpoint", "-1", "--out", &kept]),
        (Run::new().goal(Goal::error(2.0)), &["--error", "2"]),
        (numbers("moter", vec![0.0, 1.0]), &["--inputs", &bad_name]),
    ];
    for (options, arguments) in cases {
        let error = mbs_study::run(&mechanism, &options).expect_err("it contradicts itself");
        let arguments = [&[wheel.as_str()], arguments].concat();
        assert_eq!(refused_by_rust(&error), refused_by_command(&arguments), "{arguments:?}");
    }
    for (options, words) in [
        (numbers("motor", vec![0.0]), "1 values, and `t` 2"),
        (numbers("motor", vec![0.0, f64::NAN]), "not a finite number"),
        (paced().estimate(), "an estimate of the errors"),
        (Run::new().estimate().last_row_alone(), "compares rows"),
    ] {
        let error = mbs_study::run(&mechanism, &options).expect_err("it contradicts itself");
        assert!(error.to_string().contains(words) && error.hint().is_some(), "{error}");
    }
}

#[test]
fn a_scene_that_is_none_in_single_precision_is_refused_at_its_place() {
    // in f32 both times are rounded to 1
    let tabled = "table = [[0, 0], [1, 1], [1.00000001, 2]]";
    let text = WHEEL.replace("value = 2\ninput = true", tabled);
    let file = written("one-run-f32.toml", &text);
    let output = run("run", &[&file, "--precision", "f32", "--json"]);
    let error = &json(&output)["error"];
    assert_eq!((status(&output), &error["code"]), (1, &Value::from("scene-refused")));
    assert!(error["line"].is_u64() && error["file"].is_string(), "{error}");
    let options = Run::new().method(Method { precision: Some("f32".into()), ..Method::default() });
    let mechanism = Mechanism::read(&file).expect("a scene in f64");
    let error = mbs::run(&mechanism, &options).expect_err("no scene in f32");
    assert!(error.to_string().contains("one-run-f32.toml:"), "{error}");
}

#[test]
fn a_state_of_a_simulation_is_no_run_to_resume() {
    let file = scene("double-pendulum");
    let mechanism = Mechanism::read(&file).expect("a scene");
    let scene = mechanism.resolve().expect("a scene");
    let settings = ResolvedMethod::new(&scene, &Method::default()).expect("settings");
    let simulation = Simulation::<f64, 2>::new(&scene, &settings).expect("a start");
    let out = scratch("one-run-state");
    let state = out.join("state.mbs");
    let sink = std::fs::File::create(&state).expect("the folder is ours");
    simulation.save((&scene, &settings), sink).expect("written");
    let resume = format!("--resume={}", plain(state.clone()));
    let [code, message, _] =
        refused_by_command(&[&file, &resume, "--out", &plain(out.join("results"))]);
    let checkpoint = Checkpoint::open(&state).expect("a checkpoint");
    let error = mbs::run(&mechanism, &Run::new().resume(checkpoint)).expect_err("it has no rows");
    assert_eq!([code, message], [error.code().to_owned(), error.message().to_owned()]);
    assert_eq!(error.code(), "checkpoint-refused");
}

#[test]
fn the_front_door_refuses_what_is_for_the_studies_by_their_name() {
    let mechanism = Mechanism::read(scene("four-bar")).expect("a scene");
    let goal = Goal::error(1e-3);
    for options in [Run::new().goal(goal), Run::new().estimate()] {
        let error = mbs::run(&mechanism, &options).expect_err("it is for the studies");
        assert_eq!(error.code(), "settings-refused");
        assert!(error.hint().is_some_and(|hint| hint.contains("mbs_study::run")), "{error}");
    }
}
