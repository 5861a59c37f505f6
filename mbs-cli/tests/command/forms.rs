//! Scenes in other forms: JSON, standard input, included files, and values set by the command line.

use crate::{mbs, run, scene, status, text, written};
use mbs::Precision;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};

/// A pendulum in two files: this one includes the other.
const MAIN: &str = "\
include = [{ file = \"forms-rod.toml\", set = { length = \"2*half\" } }]

[scene]
name = \"pendulum\"
dimension = 2
gravity = [0.0, -9.81]
duration = 0.05

[parameters]
half = 0.5

[[joint]]
name = \"pivot\"
kind = \"revolute\"
bodies = [\"ground\", \"rod\"]
at = \"foot\"
";
const ROD: &str = "\
[parameters]
length = 3.0

[[point]]
name = \"foot\"
at = [0.0, 0.0]

[[body]]
name = \"rod\"
mass = \"1/3\"
rod = { from = \"foot\", to = { of = \"foot\", plus = [\"length\", 0.0] } }
";
/// The pendulum of [`MAIN`] and [`ROD`] in one file.
const TOML: &str = "\
[scene]
name = \"pendulum\"
dimension = 2
gravity = [0.0, -9.81]
duration = 0.05

[[body]]
name = \"rod\"
mass = \"1/3\"
rod = { from = [0.0, 0.0], to = [1.0, 0.0] }

[[joint]]
name = \"pivot\"
kind = \"revolute\"
bodies = [\"ground\", \"rod\"]
at = [0.0, 0.0]
";
const JSON: &str = r#"{
  "scene": { "name": "pendulum", "dimension": 2, "gravity": [0.0, -9.81], "duration": 0.05 },
  "body": [{ "name": "rod", "mass": "1/3", "rod": { "from": [0.0, 0.0], "to": [1.0, 0.0] } }],
  "joint": [{ "name": "pivot", "kind": "revolute", "bodies": ["ground", "rod"], "at": [0.0, 0.0] }]
}"#;

/// Runs a command with a text on standard input.
fn piped(arguments: &[&str], input: &str) -> Output {
    let mut command = mbs(arguments[0]);
    command.args(&arguments[1..]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.stderr(Stdio::piped()).spawn().expect("the command is built");
    // an error is ignored: a command that refuses may not read all of the text
    let _ = child.stdin.take().expect("a pipe").write_all(input.as_bytes());
    child.wait_with_output().expect("it ends")
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// The file run.csv of a scene, which is read from a file or from standard input.
fn table(scene: &str, input: Option<&str>, (name, precision): (&str, &str)) -> Vec<u8> {
    let out = folder(&format!("forms-{name}"));
    let arguments = ["run", scene, "--precision", precision, "--out", out.to_str().expect("plain")];
    let output = match input {
        Some(input) => piped(&arguments, input),
        None => run(arguments[0], &arguments[1..]),
    };
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    std::fs::read(out.join("run.csv")).expect("the results")
}

#[test]
fn toml_json_standard_input_and_includes_give_the_same_table() {
    let (toml, json) = (written("forms.toml", TOML), written("forms.json", JSON));
    written("forms-rod.toml", ROD);
    let parts = written("forms-parts.toml", MAIN);
    let precisions = [Precision::F64, Precision::DoubleDouble].into_iter();
    for precision in precisions.filter(|precision| precision.is_built()) {
        let of = |scene: &str, input, name: &str| table(scene, input, (name, precision.name()));
        let plain = of(&toml, None, "toml");
        assert!(plain.len() > 500);
        assert_eq!(of(&json, None, "json"), plain);
        assert_eq!(of("-", Some(TOML), "standard"), plain);
        assert_eq!(of("-", Some(JSON), "standard-json"), plain);
        assert_eq!(of(&parts, None, "parts"), plain);
    }
}

#[test]
fn the_iltis_of_parts_gives_the_table_of_its_scene() {
    let of = |name: &str, out: &str| {
        let out = folder(out);
        let scene = scene(name);
        let arguments = [&scene, "--duration", "0.5", "--out", out.to_str().expect("plain")];
        assert_eq!(status(&run("run", &arguments)), 0);
        std::fs::read(out.join("run.csv")).expect("the results")
    };
    assert_eq!(of("parts/iltis-stairs", "forms-corners"), of("iltis-stairs", "forms-iltis"));
}

#[test]
fn values_are_set_in_every_command_that_reads_a_scene() {
    let pendulum = written("forms-set.toml", TOML);
    let frequency = |set: &[&str]| {
        let mut arguments = vec![&pendulum[..], "--at", "equilibrium", "--json"];
        arguments.extend(set);
        let modes = crate::done(&run("modes", &arguments));
        modes["modes"][0]["frequency"].as_f64().expect("a frequency")
    };
    // a uniform rod on its end has the frequency sqrt(3 g / (2 l)) / (2 pi)
    let closed = |l: f64| (1.5 * 9.81 / l).sqrt() / std::f64::consts::TAU;
    assert!((frequency(&[]) / closed(1.0) - 1.0).abs() < 1e-9);
    let longer = ["--set", "body.rod.rod.to=[4, 0]"];
    assert!((frequency(&longer) / closed(4.0) - 1.0).abs() < 1e-9);
    for command in ["run", "explain", "doctor", "equilibrium"] {
        let output = run(command, &[&pendulum, "--set", "body.rod.mas=2"]);
        assert_eq!(status(&output), 1, "{command}");
        let why = text(&output.stderr);
        assert!(why.contains("--set:1:1: unknown key `mas`"), "{command}: {why}");
        assert!(why.contains("did you mean `mass`?"), "{command}: {why}");
    }
}

#[test]
fn a_run_names_what_was_set() {
    let pendulum = written("forms-named.toml", TOML);
    let out = folder("forms-named");
    let set = ["--set", "body.rod.mass=36 kg", "--set", "scene.duration=10 ms"];
    let arguments = [&[&pendulum[..], "--out", out.to_str().expect("plain")], &set[..]].concat();
    assert_eq!(status(&run("run", &arguments)), 0);
    let page = std::fs::read_to_string(out.join("run.html")).expect("the results");
    for part in ["body.rod.mass=36 kg", "scene.duration=10 ms"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn refusals_of_standard_input_and_of_included_files_say_where() {
    let output = piped(&["run", "-"], "[scene]\ndimension = 4\nduration = 1.0\n");
    assert_eq!(status(&output), 1);
    assert!(text(&output.stderr).starts_with("standard input:2:13: "), "{}", text(&output.stderr));
    let output = piped(&["check", "-", "--json"], "{\"scene\": {\"dimension\": 2,}}");
    assert_eq!(status(&output), 1);
    assert!(text(&output.stdout).contains("not JSON"), "{}", text(&output.stdout));
    written("forms-bad.toml", &ROD.replace("\"1/3\"", "\"1/0\""));
    let main = written("forms-of-bad.toml", &MAIN.replace("forms-rod", "forms-bad"));
    let output = run("run", &[&main]);
    let why = text(&output.stderr);
    assert_eq!(status(&output), 1);
    assert!(why.contains("forms-bad.toml:10:11: ") && why.contains("included from "), "{why}");
}
