//! `mbs doctor`: what the command says. No time is asserted.

use crate::{done, files, run, run_line, scene, text, written};
use serde_json::Value;

#[test]
fn the_command_gives_one_object_a_page_and_a_status() {
    let out = files::scratch("doctor-out");
    let scene = scene("spatial-four-bar");
    // Doubts are no faults.
    let line = format!("doctor {scene} --json --duration 0.2 --out {}", out.display());
    let value = done(&run_line(&line));
    let keys = "scene dimension dof worst findings position natural joint_level dependent_sets reactions loops shares_of_the_motion massless \
                methods motion start";
    for key in keys.split_whitespace() {
        assert!(value.get(key).is_some(), "{key}");
    }
    let joints = ["crank-pivot", "crank-pin", "rocker-pin", "rocker-pivot"];
    assert_eq!(value["dependent_sets"][0]["joints"], serde_json::json!(joints));
    assert_eq!(
        (&value["joint_level"]["redundant"], &value["natural"]["redundant"]),
        (&3.into(), &1.into())
    );
    assert_eq!(value["worst"], "doubt");
    // The line of the first joint of the set.
    let file = std::fs::read_to_string(&scene).expect("a scene");
    let line = file.lines().position(|l| l.contains("\"crank-pivot\"")).expect("it is there") + 1;
    assert_eq!(value["findings"][0]["line"], line);
    let written = std::fs::read_to_string(out.join("doctor.json")).expect("written");
    assert_eq!(serde_json::from_str::<Value>(&written).expect("JSON"), value);
    let page = std::fs::read_to_string(out.join("doctor.html")).expect("written");
    assert!(page.contains("dependent-set") && page.contains("rocker-pin"));
}

#[test]
fn a_scene_without_a_start_is_a_fault_and_one_that_cannot_be_read_is_refused() {
    let four_bar = std::fs::read_to_string(scene("four-bar")).expect("a scene");
    let more = "\n[[initial]]\njoint = \"pivot-1\"\nrate = 1.0e3\n";
    let file = written("contradicts.toml", &(four_bar + more));
    let output = run("doctor", &[&file]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    let told = text(&output.stdout);
    assert!(
        told.contains("fault: contradicting-velocities, line") && told.contains("mend:"),
        "{told}"
    );
    let missing = run("doctor", &["no-such-scene.toml"]);
    assert_eq!(missing.status.code(), Some(1));
    assert!(text(&missing.stderr).contains("hint:") && missing.stdout.is_empty());
    let wrong = run("doctor", &[&scene("four-bar"), "--step", "-1"]);
    assert_eq!(wrong.status.code(), Some(1), "{}", text(&wrong.stderr));
    let help = text(&run("doctor", &["--help"]).stdout);
    assert!(help.contains("docs/DOCTOR.md") && help.contains("--still"), "{help}");
}
