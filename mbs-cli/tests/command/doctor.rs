//! `mbs doctor`: what the command says. No time is asserted.

use crate::{json, run, scene, text};
use serde_json::Value;
use std::path::Path;

#[test]
fn the_command_gives_one_object_a_page_and_a_status() {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("doctor-out");
    let _ = std::fs::remove_dir_all(&out);
    let scene = scene("spatial-four-bar");
    let arguments = [&scene, "--json", "--duration", "0.2", "--out", &out.display().to_string()];
    let output = run("doctor", &arguments);
    assert_eq!(output.status.code(), Some(0), "doubts are no faults: {}", text(&output.stderr));
    let value = json(&output);
    for key in [
        "scene",
        "dimension",
        "dof",
        "worst",
        "findings",
        "position",
        "natural",
        "joint_level",
        "dependent_sets",
        "reactions",
        "loops",
        "shares_of_the_motion",
        "massless",
        "methods",
        "motion",
        "start",
    ] {
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
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("doctor-faults");
    std::fs::create_dir_all(&folder).expect("made");
    let four_bar = std::fs::read_to_string(scene("four-bar")).expect("a scene");
    let file = folder.join("contradicts.toml").display().to_string();
    let more = "\n[[initial]]\njoint = \"pivot-1\"\nrate = 1.0e3\n";
    std::fs::write(&file, four_bar + more).expect("written");
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
