//! Tests of the messages of `mbs doctor`. No time is asserted.

use crate::{done, files, run, run_line, scene, text, written};
use serde_json::Value;

#[test]
fn the_command_gives_one_object_a_page_and_a_status() {
    let out = files::scratch("doctor-out");
    let scene = scene("spatial-four-bar");
    // doubts do not count as faults
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
    // the place of a finding is the line of the first joint of the set
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

#[test]
fn run_check_and_doctor_note_a_spline_that_leaves_its_rows() {
    let cam = std::fs::read_to_string(scene("cam-follower")).expect("a scene");
    let (head, rest) = cam.split_once("table = [\n").expect("a table");
    let (_, tail) = rest.split_once("\n]\n").expect("its end");
    let turn = core::f64::consts::TAU;
    let rows: Vec<String> = (0_u32..)
        .zip([0.0, 0.0, 0.01, 0.01, 0.0, 0.0, 0.0])
        .map(|(i, lift)| format!("[{:?}, {lift:?}]", turn * f64::from(i) / 6.0))
        .collect();
    let of = |way: &str| format!("{head}table = [{}]\n{way}{tail}", rows.join(", "));
    let line = of("").lines().position(|line| line.starts_with("table =")).expect("a line") + 1;
    for (way, is_noted) in [("", true), ("interpolation = \"monotone\"\n", false)] {
        let file = written("leaves-rows.toml", &of(way));
        let checked = text(&run("check", &[&file]).stdout);
        let note = "note: the spline of `table` of coupling `lift` goes to f = 0.0120";
        assert_eq!(checked.contains(note), is_noted, "{checked}");
        let ran = text(&run("run", &[&file, "--duration", "0.01"]).stdout);
        assert_eq!(ran.contains("the spline of `table` of coupling `lift`"), is_noted, "{ran}");
        let found = done(&run_line(&format!("doctor {file} --json --duration 0.01")));
        let findings = found["findings"].as_array().expect("a list");
        let of_table = findings.iter().find(|finding| finding["code"] == "table-leaves-rows");
        assert_eq!(of_table.map(|finding| finding["line"].clone()), is_noted.then(|| line.into()));
    }
}
