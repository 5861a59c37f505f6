//! Tests of comparisons through the command: true errors with their orders, failures among results, the same runs every time, and a journal
//! that survives a kill. Times are never asserted.

use crate::{done as json, files, mbs, scene, text};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Output;

/// An empty directory for one test.
fn scratch(name: &str) -> PathBuf {
    files::scratch(&format!("compare-{name}"))
}

/// Runs `mbs compare` on a scene with the least number of timings.
fn compare(name: &str, arguments: &[&str]) -> Output {
    let mut command = mbs("compare");
    command.arg(scene(name)).args(["--repeats", "2"]).args(arguments);
    command.output().expect("the command is built")
}

fn method<'a>(comparison: &'a Value, name: &str) -> &'a Value {
    let methods = comparison["methods"].as_array().expect("a list");
    methods.iter().find(|m| m["name"] == name).unwrap_or_else(|| panic!("no method {name}"))
}

fn errors(method: &Value) -> Vec<f64> {
    let runs = method["runs"].as_array().expect("a list").iter();
    runs.filter_map(|run| run["error"].as_f64()).collect()
}

fn keys(value: &Value) -> BTreeSet<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

#[test]
fn orders_against_the_closed_form_are_those_of_the_integrators() {
    let steps = "5e-3,2.5e-3,1.25e-3,6.25e-4";
    let arguments =
        ["--precision", "f64", "--steps", steps, "--tolerances", "1e-4,1e-6", "--no-maps"];
    let found = json(&compare("simple-pendulum", &[&arguments[..], &["--json"]].concat()));
    assert_eq!(found["reference"]["kind"], "table");
    assert!(found["reference"]["uncertainty"].as_f64().unwrap() < 1e-17);
    // the trapezoidal rule has order two; the tolerance is for the longer steps, which deviate from it
    for name in
        ["index-3, f64", "index-1, f64", "classical, f64", "state-space, f64", "recursive, f64"]
    {
        let order = method(&found, name)["fit"]["order"].as_f64().expect("four runs on a line");
        assert!((order - 2.0).abs() < 0.02, "{name}: {order}");
    }
    let order = method(&found, "recursive rk4, f64")["fit"]["order"].as_f64().expect("a line");
    assert!((order - 4.0).abs() < 0.1, "rk4: {order}");
    // with steps of 0.625 ms the phase lags by (w h)^2 / 12 of 10 s, at up to 4.4 m/s, over a range of 2 m: 5e-6
    let least = *errors(method(&found, "recursive, f64")).last().expect("completed");
    assert!((2.5e-6..1e-5).contains(&least), "{least}");
}

#[test]
fn the_reference_is_not_under_test_and_another_formulation_agrees_with_it() {
    let arguments =
        ["--duration", "2", "--steps", "1e-2,5e-3", "--tolerances", "1e-4", "--no-maps"];
    let found = json(&compare("double-pendulum", &[&arguments[..], &["--json"]].concat()));
    let reference = &found["reference"];
    assert_eq!(reference["is_verified"], true, "{reference:#}");
    let check = &reference["cross_check"];
    assert!(check["method"].as_str().unwrap().starts_with("index-3"));
    assert!(
        check["difference"].as_f64().unwrap() <= 3.0 * check["own_uncertainty"].as_f64().unwrap()
    );
    assert!(reference["uncertainty"].as_f64().unwrap() < 1e-10);
    // the tolerance of the reference is not one of those under test
    let own = method(&found, "recursive rk54, f64");
    assert!(
        own["runs"].as_array().unwrap().iter().all(|run| run["setting"].as_f64() > Some(1e-12))
    );
    // the trapezoidal rule in one coordinate set gives the same errors for every elimination
    let [a, b] = ["index-3, f64", "classical, f64"].map(|name| errors(method(&found, name)));
    assert!((a[0] - b[0]).abs() < 1e-3 * a[0], "{a:?} {b:?}");
}

#[test]
fn a_method_that_fails_stays_with_its_reason() {
    let arguments =
        ["--formulation", "classical,index-3", "--precision", "f64", "--duration", "0.5"];
    let more = ["--steps", "1e-2,5e-3", "--tolerances", "1e-4", "--no-maps"];
    let out = scratch("failure");
    let figure = out.join("figure.svg");
    let [out_text, figure] = [&out, &figure].map(|path| path.to_str().expect("UTF-8"));
    let place = ["--out", out_text, "--json", "--figure", figure];
    let found = json(&compare("spatial-four-bar", &[&arguments[..], &more, &place].concat()));
    let classical = method(&found, "classical, f64");
    let run = &classical["runs"][0];
    assert_eq!((&run["status"], &run["failure"]["code"]), (&"failed".into(), &"rank-lost".into()));
    assert!(run["failure"]["joint"].is_string(), "{run:#}");
    assert!(found["ranking"][0]["not_reached"].as_array().unwrap().contains(&"classical".into()));
    assert!(errors(method(&found, "index-3, f64")).len() == 2);
    let read = |file| std::fs::read_to_string(out.join(file)).expect("it is written");
    assert!(read("compare.csv").contains(",failed,rank-lost,"));
    assert!(read("compare.html").contains("rank-lost"));
    let svg = read("figure.svg");
    assert!(svg.starts_with("<svg") && svg.contains("index-3, f64") && svg.contains("CPU time"));
}

#[test]
fn two_comparisons_make_the_same_runs_with_the_same_errors() {
    let run = || {
        let arguments = ["--duration", "1", "--budget", "2", "--no-maps", "--json"];
        let found = json(&compare("double-pendulum", &arguments));
        let methods = found["methods"].as_array().expect("a list").iter();
        let of = |m: &Value| -> Vec<(Value, Value, Value)> {
            let runs = m["runs"].as_array().expect("a list").iter();
            runs.map(|r| (r["setting"].clone(), r["status"].clone(), r["error"].clone())).collect()
        };
        methods.map(of).collect::<Vec<_>>()
    };
    let (first, second) = (run(), run());
    assert_eq!(first, second);
    let n = |status: &str| first.iter().flatten().filter(|run| run.1 == *status).count();
    assert!(n("completed") > 50, "{}", n("completed"));
    assert!(n("not-run") > 0, "a budget of 2 s leaves something out");
}

#[test]
fn a_quick_comparison_is_of_f64_alone_and_has_no_maps() {
    let scene = scene("double-pendulum");
    let arguments =
        [&scene, "--duration", "0.1", "--formulation", "index-3,recursive", "--quick", "--json"];
    let found = json(&crate::run("compare", &arguments));
    let names = found["methods"].as_array().expect("a list").iter().map(|m| &m["name"]);
    let names: Vec<&str> = names.map(|name| name.as_str().expect("a name")).collect();
    assert!(names.len() > 3 && names.iter().all(|name| name.ends_with(", f64")), "{names:?}");
    assert!(found["maps"].as_array().is_none_or(Vec::is_empty), "{}", found["maps"]);
    let refused = crate::run("compare", &[&arguments[..], &["--budget", "3"]].concat());
    assert_eq!(crate::status(&refused), 1, "{refused:?}");
}

/// Runs a short comparison in a directory, with a map. Returns its JSON.
fn short(out: &Path, more: &[&str]) -> Output {
    let arguments = ["--formulation", "index-3", "--duration", "0.4", "--steps", "1e-2,5e-3"];
    let rest = ["--tolerances", "1e-4", "--json", "--out", out.to_str().expect("UTF-8")];
    compare("double-pendulum", &[&arguments[..], &rest, more].concat())
}

/// The lines of a journal that are not times. The number of timings depends on the measured times.
fn results(journal: &str) -> std::collections::BTreeSet<&str> {
    let keys = journal.lines().map(|line| line.split(',').next().unwrap_or(line));
    keys.filter(|key| !key.trim_start_matches('"').starts_with("time ")).collect()
}

#[test]
fn a_comparison_that_was_killed_resumes_to_the_same_result() {
    let out = scratch("resume");
    let whole = json(&short(&out, &[]));
    let journal = std::fs::read(out.join("compare.journal")).expect("the journal is there");
    // all finished runs are restored, with the same times
    assert_eq!(json(&short(&out, &["--resume"])), whole);
    let ends: Vec<usize> = (0..journal.len()).filter(|&i| journal[i] == b'\n').collect();
    assert!(ends.len() > 20, "reference, runs, times and cells: {}", ends.len());
    for cut in [ends[0] + 1, ends[3] + 17, ends[ends.len() / 2] + 1, journal.len() - 5] {
        std::fs::write(out.join("compare.journal"), &journal[..cut]).expect("ours");
        let found = json(&short(&out, &["--resume"]));
        assert_eq!(found["maps"], whole["maps"]);
        assert_eq!(found["reference"], whole["reference"]);
        let errors_of = |v: &Value| -> Vec<Vec<f64>> {
            v["methods"].as_array().unwrap().iter().map(errors).collect()
        };
        assert_eq!(errors_of(&found), errors_of(&whole), "cut at {cut}");
        let again = std::fs::read_to_string(out.join("compare.journal")).expect("text");
        assert_eq!(results(&again), results(&String::from_utf8_lossy(&journal)), "cut at {cut}");
    }
}

#[test]
fn finished_runs_are_not_lost_by_mistake_and_others_are_not_taken() {
    let out = scratch("refusals");
    json(&short(&out, &[]));
    let refused = |output: &Output, words: &str| {
        let text = text(&output.stderr);
        assert!(output.status.code() == Some(1) && text.contains(words), "{text}");
    };
    refused(&short(&out, &[]), "runs of an earlier start");
    refused(&short(&out, &["--resume", "--error", "1e-3"]), "an option has changed");
    json(&short(&out, &["--restart"]));
    refused(&compare("double-pendulum", &["--formulation", "index3"]), "did you mean `index-3`?");
    refused(&compare("double-pendulum", &["--steps", "-1"]), "steps must be positive");
    let once = crate::run("compare", &[&scene("double-pendulum"), "--repeats", "1"]);
    refused(&once, "must be timed twice at least");
    refused(&compare("double-pendulum", &["--resume"]), "--out");
}

#[test]
fn keys_of_the_json_are_stable() {
    let out = scratch("keys");
    let found = json(&short(&out, &[]));
    let top = "compared duration instants interval maps methods notes outputs provenance ranking reference repeats scene";
    assert_eq!(keys(&found), top.split(' ').collect());
    let one = "at_error control fit formulation integrator name precision runs";
    assert_eq!(keys(&found["methods"][0]), one.split(' ').collect());
    let run = "clocked_seconds cpu_least cpu_seconds energy error error_rms failure is_below_reference iterations mean_step not_run setting \
               status step_times steps violation";
    assert_eq!(keys(&found["methods"][0]["runs"][0]), run.split_whitespace().collect());
    let origin = "build command commit cpu scene_hash version";
    assert_eq!(keys(&found["provenance"]), origin.split(' ').collect());
    // seven penalties, steps from the longest, and cells with the outcome of each run
    let map = &found["maps"][0];
    assert_eq!(map["cells"].as_array().unwrap().len(), 7);
    let cells = map["cells"][0].as_array().unwrap();
    assert_eq!(cells.len(), map["steps"].as_array().unwrap().len());
    assert_eq!(keys(&cells[0]), ["error", "failure", "iterations"].into());
    let repeat = found["provenance"]["command"].as_str().unwrap();
    assert!(repeat.ends_with("--formulation index-3 --steps 0.01,0.005 --tolerances 0.0001 --duration 0.4 --repeats 2"), "{repeat}");
}
