//! `mbs kinds`, `mbs schema` and `mbs check`.

use crate::{run, scene, status, text, written};
use serde_json::Value;

#[test]
fn a_kind_has_a_page_and_a_mistyped_one_the_nearest_name() {
    let output = run("kinds", &["revolute"]);
    assert_eq!(status(&output), 0);
    let page = text(&output.stdout);
    for part in ["[[joint]]", "at  ", "`turn` [rad]", "velocity_limit"] {
        assert!(page.contains(part), "{part}: {page}");
    }
    let output = run("kinds", &["revolut"]);
    assert_eq!(status(&output), 1);
    assert!(text(&output.stderr).contains("did you mean `revolute`?"));
}

#[test]
fn every_line_of_the_list_names_a_page() {
    let list = text(&run("kinds", &[]).stdout);
    let names = list.lines().filter_map(|line| line.get(..22)).map(str::trim);
    for name in names.filter(|name| !name.is_empty() && !name.contains("features")) {
        assert_eq!(status(&run("kinds", &[name])), 0, "{name}");
    }
}

#[test]
fn the_schema_is_a_json_object_that_closes_its_tables() {
    let schema: Value = serde_json::from_slice(&run("schema", &[]).stdout).expect("JSON");
    assert_eq!(schema["additionalProperties"], false);
    assert!(schema["definitions"]["joint"]["anyOf"].is_array());
}

#[test]
fn scenes_are_checked_without_a_run_and_each_has_its_line() {
    let [good, bad] =
        [scene("double-pendulum"), written("check-bad.toml", "[scene]\ndimension = 2\n")];
    let output = run("check", &[&good, &bad, "--json"]);
    assert_eq!(status(&output), 1);
    let objects: Vec<Value> = text(&output.stdout)
        .lines()
        .map(|line| serde_json::from_str(line).expect("an object a line"))
        .collect();
    assert_eq!((&objects[0]["completed"], &objects[0]["dof"]), (&true.into(), &2.into()));
    assert_eq!(objects[1]["error"]["code"], "scene-refused");
    assert!(text(&output.stderr).contains("`duration` is missing"));
    assert_eq!(status(&run("check", &[&good])), 0);
}

#[test]
fn what_does_not_assemble_does_not_pass() {
    let open = "[scene]\ndimension = 2\nduration = 1.0\n\n[[body]]\nname = \"bar\"\nmass = 1.0\nrod = { from = [0.0, 0.0], to = [1.0, 0.0] }\n\n\
        [[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"bar\"]\nat = [0.0, 0.0]\n\n\
        [[joint]]\nname = \"b\"\nkind = \"distance\"\nbodies = [\"ground\", \"bar\"]\npoints = [[3.0, 0.0], [1.0, 0.0]]\n\n\
        [[initial]]\njoint = \"a\"\nvalue = 1.0\n";
    let output = run("check", &[&written("check-open.toml", open)]);
    assert_eq!(status(&output), 1, "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("hint:"), "{}", text(&output.stderr));
}

#[test]
fn the_manual_names_the_methods_that_run() {
    use mbs::scene_file::keys::{KeyValue, tables};
    let solver = tables().iter().find(|table| table.header == "solver").expect("the table");
    let sorted = |words: &[&'static str]| {
        let mut words = words.to_vec();
        words.sort_unstable();
        words
    };
    let words = |key: &str| match &solver.key(key).expect("the key").value {
        KeyValue::Word(words) => sorted(words),
        other => panic!("{key}: {other:?}"),
    };
    assert_eq!(words("formulation"), sorted(&mbs::FORMULATIONS));
    assert_eq!(words("integrator"), sorted(&mbs::INTEGRATORS));
    // the list of rules includes the second name of one rule
    let rules = [&mbs::STEP_RULES[..], &["energy-published"]].concat();
    assert_eq!(words("step_control"), sorted(&rules));
}
