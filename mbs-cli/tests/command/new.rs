//! Tests of `mbs new`: all templates run, and one has known correct values.

use super::{done, plain, run, status, text};
use serde_json::Value;
use std::path::Path;

/// Writes a template to a new file with the given name.
fn template(name: &str, file: &str) -> String {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(file);
    let _ = std::fs::remove_file(&path);
    let path = plain(path);
    let output = run("new", &[name, &path]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    path
}

#[test]
fn every_template_of_the_list_is_written_once_and_runs() {
    let list = text(&run("new", &[]).stdout);
    assert!(list.lines().count() >= 6, "{list}");
    for name in list.lines().filter_map(|line| line.split_whitespace().next()) {
        let file = template(name, &format!("new-{name}.toml"));
        let object = done(&run("run", &[&file, "--json", "--no-estimate"]));
        assert_eq!(object["completed"], true, "{name}");
        let again = run("new", &[name, &file]);
        assert_eq!(status(&again), 1);
        assert!(text(&again.stderr).contains("not overwritten"), "{name}");
    }
}

#[test]
fn a_template_that_is_none_is_met_with_the_nearest() {
    let output = run("new", &["crank-roker"]);
    assert_eq!(status(&output), 1);
    assert!(text(&output.stderr).contains("did you mean `crank-rocker`?"));
}

/// Expected values: the swing in closed form; forces from positions in closed form, by the Newton-Euler equations of each bar.
#[test]
fn the_crank_rocker_has_its_angles_forces_and_moment() {
    let file = template("crank-rocker", "new-right-values.toml");
    let object = done(&run("run", &[&file, "--step", "1e-4", "--json", "--no-estimate"]));
    let channel = |name: &str| {
        let list = object["channels"].as_array().expect("a list");
        list.iter().find(|channel| channel["name"] == name).cloned().expect("the channel")
    };
    let is_near = |found: &Value, right: f64, digit: f64| {
        let found = found.as_f64().expect("a number");
        assert!((found - right).abs() <= digit, "{found} is not {right}");
    };
    // half a unit of the last digit; near the turning point an angle changes by less than this in half a step
    let angle = channel("rocker angle");
    is_near(&angle["min"][0], -0.102_680, 1e-6);
    is_near(&angle["max"][0], 0.710_075, 1e-6);
    is_near(&angle["at_max"][0], 0.6062, 1.1e-4);
    // the columns are first the components, then the magnitude of the force
    let force = channel("force at O");
    is_near(&force["max"][3], 20.2206, 1e-4);
    is_near(&force["rms"][3], 14.8723, 1e-4);
    is_near(&channel("force at B")["max"][3], 6.941_40, 1e-5);
    let moment = channel("moment of the motor");
    is_near(&moment["min"][0], -1.302_43, 1e-5);
    is_near(&moment["max"][0], 1.106_12, 1e-5);
}
