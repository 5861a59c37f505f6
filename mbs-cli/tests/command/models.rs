//! `mbs import`, and models where a scene is wanted.

use super::{done, run, status, text};
use std::path::{Path, PathBuf};

pub(crate) fn arm() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command/models/arm.urdf");
    path.display().to_string()
}

fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("models");
    std::fs::create_dir_all(&folder).expect("a folder");
    folder.join(name)
}

/// What a run says of the motion: all but its own time and the name of the file.
fn motion(scene: &str) -> Vec<serde_json::Value> {
    let object = done(&run("run", &[scene, "--json", "--step", "1e-2"]));
    ["outputs", "energy", "violation", "iterations", "channels"]
        .map(|key| object[key].clone())
        .to_vec()
}

#[test]
fn a_model_runs_to_the_bits_of_the_scene_that_is_imported_from_it() {
    let scene = file("arm.toml");
    let scene = scene.to_str().expect("UTF-8");
    let report = run("import", &[&arm(), "-o", scene]);
    assert_eq!(status(&report), 0, "{}", text(&report.stderr));
    let report = text(&report.stdout);
    assert!(
        report.contains("URDF, 2 bodies of 4 links, 2 joints, 0 couplings, 1 input"),
        "{report}"
    );
    assert!(
        report.contains("arm.urdf:12:5  robot/joint[shoulder]/limit: ends without stiffness"),
        "{report}"
    );
    assert!(
        report.contains("arm.urdf:8:5  robot[arm]/link[upper]/collision: there is no contact"),
        "{report}"
    );
    assert_eq!(motion(&arm()), motion(scene));
    // the fixed tool is a frame of the lower arm
    let output = "\n[[output]]\nname = \"tool\"\nbody = \"tool\"\nquantity = \"position\"\n";
    let with_tool = file("with-tool.toml");
    let whole = std::fs::read_to_string(scene).expect("it was written") + output;
    std::fs::write(&with_tool, whole).expect("a folder");
    let object =
        done(&run("run", &[with_tool.to_str().expect("UTF-8"), "--json", "--duration", "0.01"]));
    assert_eq!(object["channels"][0]["name"], "tool");
}

#[test]
fn strict_refuses_what_can_act_and_is_not_in_the_scene() {
    let strict = run("import", &[&arm(), "--strict", "--json", "-o", "/nowhere/arm.toml"]);
    assert_eq!(status(&strict), 1);
    let object: serde_json::Value = serde_json::from_slice(&strict.stdout).expect("JSON");
    assert_eq!(object["mapped"]["bodies"], 2);
    assert_eq!(object["approximated"][0]["element"], "robot/joint[shoulder]/limit");
    assert!(text(&strict.stderr).contains("--strict: "), "{}", text(&strict.stderr));
}

#[test]
fn a_model_that_cannot_be_meant_is_refused_at_its_place_by_every_command() {
    let broken = file("broken.urdf");
    let arm = std::fs::read_to_string(arm()).expect("a file of this repository");
    std::fs::write(&broken, arm.replace("link=\"lower\"/><axis", "link=\"lover\"/><axis"))
        .expect("a folder");
    for command in ["import", "run", "check", "doctor", "explain"] {
        let refused = run(command, &[broken.to_str().expect("UTF-8")]);
        assert_eq!(status(&refused), 1, "{command}");
        let said = text(&refused.stderr);
        assert!(said.contains("broken.urdf:17:"), "{command}: {said}");
        assert!(
            said.contains("unknown link `lover`") && said.contains("did you mean `lower`?"),
            "{command}: {said}"
        );
    }
}
