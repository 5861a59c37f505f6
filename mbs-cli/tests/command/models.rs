//! Tests of `mbs import`, and of models in place of scene files.

use super::{done, run, status, text};
use serde_json::Value;
use std::path::{Path, PathBuf};

pub(crate) fn arm() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command/models/arm.urdf");
    path.display().to_string()
}

pub(crate) fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("models");
    std::fs::create_dir_all(&folder).expect("a folder");
    folder.join(name)
}

/// Runs a scene by the command. Returns all results on the motion, without times and the name of the file.
fn motion(scene: &str) -> Vec<Value> {
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
    // the fixed tool of the model becomes a frame of the lower arm
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
    let object: Value = serde_json::from_slice(&strict.stdout).expect("JSON");
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

#[test]
fn options_of_import_reach_every_command_and_faults_of_the_start_are_told() {
    let imported = file("free.toml");
    let imported = imported.to_str().expect("UTF-8");
    // the base has no mass, so that a free base has no start
    let report = run("import", &[&arm(), "--base", "free", "-o", imported]);
    assert_eq!(status(&report), 0);
    let report = text(&report.stdout);
    assert!(report.contains("free.toml:13  no-inertia: "), "{report}");
    let object = done(&run("import", &[&arm(), "--base", "free", "--json"]));
    assert_eq!(object["faults"][0]["code"], "no-inertia");
    let object = done(&run("import", &[&arm(), "--json"]));
    assert_eq!(object["faults"], serde_json::json!([]));
    let words = run("inspect", &[&arm(), "--import", "base=free"]);
    let said = text(&words.stderr);
    assert!(said.contains("accelerations: `base`: no accelerations"), "{said}");
    let refused = run("run", &[&arm(), "--import", "bas=free"]);
    assert_eq!(status(&refused), 1);
    assert!(text(&refused.stderr).contains("unexpected argument '--bas'"));
    let refused = run("run", &[imported, "--import", "base=free"]);
    assert!(text(&refused.stderr).contains("leave out --import"));
}

/// Returns all numbers in a JSON value, at any depth, as one list.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(flat).collect(),
        other => other.as_f64().into_iter().collect(),
    }
}

#[test]
fn inspect_computes_what_pinocchio_does_at_a_state() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lab/models/conventions");
    let text = std::fs::read_to_string(folder.join("conventions.json"))
        .expect("a file of this repository");
    let references: Value = serde_json::from_str(&text).expect("JSON");
    for model in [
        "inertia_axes.urdf",
        "fixed_lumps.urdf",
        "long_axis.urdf",
        "massive_root.urdf",
        "default_axis.urdf",
        "armature.xml",
    ] {
        let reference = &references["files"][model];
        let state = file("state.json");
        let joints = serde_json::json!({ "joints": reference["state"] });
        std::fs::write(&state, joints.to_string()).expect("a folder");
        let [path, state] =
            [&folder.join(model), &state].map(|path| path.to_str().expect("UTF-8").to_owned());
        let object = done(&run("inspect", &[&path, "--state", &state, "--json"]));
        let name = |i: usize| object["rows"][i]["joint"].as_str().expect("a joint").to_owned();
        let close = |what: &str, found: f64, expected: f64| {
            // the reference has 16 digits, and the solution loses one
            assert!(
                (found - expected).abs() < 1.0e-12 * expected.abs().max(1.0),
                "{model}: {what}: {found} {expected}"
            );
        };
        for (i, found) in flat(&object["accelerations"]).into_iter().enumerate() {
            close("acceleration", found, flat(&reference["acceleration"][name(i)])[0]);
        }
        for (i, row) in reference["mass_matrix"].as_array().expect("rows").iter().enumerate() {
            for (j, expected) in flat(row).into_iter().enumerate() {
                close("mass matrix", flat(&object["mass_matrix"][i])[j], expected);
            }
        }
        for (key, mine) in
            [("momentum", "linear"), ("angular_momentum", "angular"), ("center", "center_of_mass")]
        {
            for (found, expected) in
                flat(&object["momentum"][mine]).iter().zip(flat(&reference[key]))
            {
                close(key, *found, expected);
            }
        }
    }
}

#[test]
fn states_that_no_joint_can_have_are_refused_with_the_nearest_name() {
    let scene = super::scene("double-pendulum");
    for (option, message) in [
        ("--joint=pivvot=0.1", "there is no joint `pivvot`"),
        ("--joint=pivot", "no name with a value and a rate"),
        ("--what=mass", "no such quantity"),
    ] {
        let refused = run("inspect", &[&scene, option]);
        assert_eq!(status(&refused), 1, "{option}");
        assert!(text(&refused.stderr).contains(message), "{option}: {}", text(&refused.stderr));
    }
    // derivatives and Jacobians are computed only on request
    let asked = ["--joint=pivot=0.3,0.2", "--what=derivatives,jacobians,mass-matrix", "--json"];
    let object = done(&run("inspect", &[&[scene.as_str()][..], &asked].concat()));
    let (mass, inverse) = (flat(&object["mass_matrix"]), flat(&object["derivatives"]["effort"]));
    let product = mass[0] * inverse[0] + mass[1] * inverse[2];
    assert!((product - 1.0).abs() < 1e-12 && object["accelerations"].is_null(), "{object}");
    assert_eq!(object["jacobians"]["lower"].as_array().expect("rows").len(), 6);
    let loops = super::scene("four-bar");
    let refused = run("inspect", &[&loops, "--what", "derivatives"]);
    assert!(
        text(&refused.stderr).contains("`end-0`: derivatives of accelerations are of open trees"),
        "{refused:?}"
    );
    // joints that are not named keep their drawn positions
    let asked = ["--joint=pivot=0.4", "--what=accelerations", "--json"];
    let object = done(&run("inspect", &[&[scene.as_str()][..], &asked].concat()));
    assert_eq!(flat(&object["q"]), [0.4, 0.0]);
    // the key `base` stands for the only free joint; this mechanism has none
    let state = file("base.json");
    std::fs::write(&state, "{\"base\": {\"rate\": [1, 0, 0, 0, 0, 2]}}").expect("a folder");
    let state = state.to_str().expect("UTF-8");
    let refused = run("inspect", &[&scene, "--state", state]);
    assert!(text(&refused.stderr).contains("the mechanism has none"), "{refused:?}");
    for (entry, message) in [
        ("{\"rates\": 1}", "unknown key `rates` of `pivot`"),
        ("0.4", "`pivot` is no object"),
        ("{\"value\": [1, 2]}", "`value` of `pivot` has 2 numbers"),
        ("{\"effort\": 1.7e308}", "no finite numbers"),
    ] {
        let file = file("entry.json");
        std::fs::write(&file, format!("{{\"joints\": {{\"pivot\": {entry}}}}}")).expect("a folder");
        let refused = run("inspect", &[&scene, "--state", file.to_str().expect("UTF-8")]);
        assert!(text(&refused.stderr).contains(message), "{entry}: {refused:?}");
    }
    // a joint that the command line sets keeps the effort that the file gives
    let state = file("effort.json");
    let entry = "{\"joints\": {\"pivot\": {\"value\": 0.1, \"effort\": 7}}}";
    std::fs::write(&state, entry).expect("a folder");
    let state = ["--state", state.to_str().expect("UTF-8"), "--what", "accelerations", "--json"];
    let by_file = done(&run("inspect", &[&[scene.as_str()][..], &state].concat()));
    let both =
        done(&run("inspect", &[&[scene.as_str(), "--joint=pivot=0.1"][..], &state].concat()));
    assert_eq!(by_file["accelerations"], both["accelerations"]);
    // in a closed loop the other coordinates follow
    let object =
        done(&run("inspect", &[&super::scene("four-bar"), "--joint", "start-0=0.3", "--json"]));
    let [rows, columns] =
        [&object["loops"], &object["loops"][0]].map(|x| x.as_array().expect("a list").len());
    assert_eq!((rows, columns), (2, 3));
}

#[test]
fn a_folded_four_bar_follows_the_joint_that_is_given_and_a_base_is_said_once() {
    // the coupler's end is at the crank's pivot
    let folded = mbs_testkit::scenes::flat_four_bar("", [0.5, 0.5, 0.3], [0.0, 1.0, 0.0, 0.6]);
    let scene = file("folded.toml");
    std::fs::write(&scene, folded).expect("a folder");
    let scene = scene.to_str().expect("UTF-8");
    let object = done(&run("inspect", &[scene, "--joint=B=0.3", "--json"]));
    // crank and coupler have length 1: the crank has the angle acos(|C| / 2) to the line to C
    let end = [0.6 - 0.6 * 0.3_f64.cos(), -0.6 * 0.3_f64.sin()];
    let crank = end[1].atan2(end[0]) + (end[0].hypot(end[1]) / 2.0).acos();
    assert!((flat(&object["q"])[0] - crank).abs() < 1e-9, "{crank}: {object}");
    let both = "{\"joints\": {\"root\": {\"value\": [1, 0, 0, 0, 0, 0]}}, \"base\": {\"value\": [2, 0, 0, 0, 0, 0]}}";
    let free = file("free.toml");
    let text_of = "[scene]\ndimension = 3\nduration = 0.1\n[[body]]\nname = \"b\"\nmass = 1.0\ncenter = [0, 0, 0]\n\
        inertia = [1, 1, 1, 0, 0, 0]\n[[joint]]\nname = \"root\"\nkind = \"free\"\nbodies = [\"ground\", \"b\"]\nat = [0, 0, 0]\n";
    let state = file("both.json");
    std::fs::write(&free, text_of).and_then(|()| std::fs::write(&state, both)).expect("a folder");
    let [free, state] = [&free, &state].map(|path| path.to_str().expect("UTF-8"));
    let refused = run("inspect", &[free, "--state", state]);
    assert!(text(&refused.stderr).contains("`base` is `root`, which stands under"), "{refused:?}");
}
