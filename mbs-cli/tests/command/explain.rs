//! Tests of the report of `mbs explain` on scenes. No time is asserted.

use crate::{files, run, scene, text, written};
use serde_json::Value;

/// The JSON object that the command prints for a scene of the repository.
fn json(name: &str, more: &[&str]) -> Value {
    crate::done(&run("explain", &[&[scene(name).as_str(), "--json"], more].concat()))
}

fn absences(value: &Value) -> Vec<&str> {
    let list = value["absent"].as_array().expect("a list");
    list.iter().map(|entry| entry["what"].as_str().expect("a word")).collect()
}

#[test]
fn json_is_one_object_with_its_keys() {
    let value = json("double-pendulum", &["--step", "1e-2"]);
    let keys: Vec<&str> =
        value.as_object().expect("an object").keys().map(String::as_str).collect();
    let wanted = "absent choice chosen dimension duration effect_costs effects error formulation integrator precision prices scene \
                  simulated step";
    assert_eq!(keys.join(" "), wanted);
    assert_eq!(
        (&value["formulation"], &value["chosen"]["formulation"]),
        (&"auto".into(), &"index-3".into())
    );
    assert!(!value["chosen"]["reasons"].as_array().expect("a list").is_empty());
    let simulated = &value["simulated"];
    assert_eq!(simulated["dof"], 2);
    assert_eq!(simulated["bodies"].as_array().expect("a list").len(), 2);
    assert_eq!(simulated["joints"][0]["kind"], "revolute");
    assert_eq!(simulated["joints"][0]["names"].as_array().expect("a list").len(), 2);
    assert_eq!(simulated["gravity"], serde_json::json!([0.0, -9.81]));
    let natural = &simulated["natural"];
    let sizes = ["coordinates", "constraints", "constraint_rank", "redundant", "dof"];
    assert_eq!(sizes.map(|key| natural[key].as_u64()), [4, 2, 2, 0, 2].map(Some));
    let relative = &simulated["relative"];
    assert_eq!(sizes.map(|key| relative[key].as_u64()), [2, 0, 0, 0, 2].map(Some));
    assert_eq!((&relative["loops"], &relative["cut_joints"]), (&0.into(), &Value::Array(vec![])));
    let absent = absences(&value);
    for what in ["third-dimension", "guides", "damping", "friction", "tires", "flexible-bodies"] {
        assert!(absent.contains(&what), "{what}");
    }
    assert!(!absent.contains(&"gravity"));
    let prices = &value["prices"];
    assert_eq!((&prices["effects"], &prices["completed"]), (&Value::Array(vec![]), &true.into()));
    for key in ["timed_steps", "repeats", "compared_duration", "iterations_per_step"] {
        assert!(prices[key].is_number(), "{key}");
    }
    assert_eq!(prices["timed_steps"], 1000);
    assert_eq!(prices, &value["effect_costs"]);
    assert_eq!(simulated["rods"], simulated["thin_rods"]);
    assert_eq!(value["absent"][0]["what"], value["absent"][0]["description"]);
}

#[test]
fn loops_are_cut_at_named_joints_and_redundant_equations_are_counted() {
    let value = json("two-four-bars", &["--duration", "0.05"]);
    let relative = &value["simulated"]["relative"];
    assert_eq!((&value["simulated"]["dof"], &relative["loops"]), (&1.into(), &2.into()));
    let cut = relative["cut_joints"].as_array().expect("a list");
    let names: Vec<_> =
        value["simulated"]["joints"][0]["names"].as_array().expect("a list").clone();
    assert!(cut.len() == 2 && cut.iter().all(|joint| names.contains(joint)));
    assert_eq!((&relative["constraints"], &relative["redundant"]), (&4.into(), &0.into()));

    // one spatial revolute joint is cut: it has five equations, of which the planar motion needs two
    let value = json("spatial-four-bar", &["--duration", "0.05"]);
    let relative = &value["simulated"]["relative"];
    let sizes = ["coordinates", "constraints", "constraint_rank", "redundant", "dof", "loops"];
    assert_eq!(sizes.map(|key| relative[key].as_u64()), [3, 5, 2, 3, 1, 1].map(Some));
    assert!(value["simulated"]["natural"]["redundant"].as_u64() > Some(0));
    assert_eq!(value["simulated"]["natural"]["dof"], 1);
    assert!(!absences(&value).contains(&"third-dimension"));
}

#[test]
fn guides_are_reported_and_leave_no_freedom() {
    let value = json("guided-four-bar", &["--duration", "0.05"]);
    let simulated = &value["simulated"];
    assert_eq!(simulated["guides"], serde_json::json!([{"joint": "crank-pivot", "law": "ramp"}]));
    assert_eq!((&simulated["dof"], &simulated["relative"]["dof"]), (&0.into(), &0.into()));
    assert_eq!(simulated["rods"], Value::Array(vec![]), "the plane has no idle spin");
    assert!(!absences(&value).contains(&"guides"));
}

#[test]
fn files_are_written_and_the_page_stands_alone() {
    let out = files::scratch("explain-files");
    let directory = out.to_str().expect("a plain path");
    let output = run("explain", &[&scene("andrews"), "--duration", "1e-3", "--out", directory]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    for words in ["What is simulated", "cut at", "Cost of each effect", "costs nothing", "drive"] {
        assert!(table.contains(words), "{words}: {table}");
    }
    let json = std::fs::read(out.join("explain.json")).expect("it is written");
    let value: Value = serde_json::from_slice(&json).expect("one JSON object");
    assert_eq!(value["prices"]["effects"][0]["kind"], "spring-damper");
    let html = std::fs::read_to_string(out.join("explain.html")).expect("it is written");
    for word in ["http:", "https:", "src=", "href=", "url(", "<script"] {
        assert!(!html.contains(word), "{word}");
    }
    assert!(html.contains("mbs explain") && html.contains("Cost of each effect"));
}

#[test]
fn refusals_and_scenes_without_a_start_have_their_status() {
    let output = run("explain", &[&scene("double-pendulum"), "--formulation", "index-2"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("hint:") && output.stdout.is_empty());
    let output = run("explain", &["no-such-scene.toml"]);
    assert_eq!(output.status.code(), Some(1));

    let far = std::fs::read_to_string(scene("guided-four-bar")).expect("it is there");
    // the linkage cannot be assembled with this start of the rocker
    let start = "[[initial]]\njoint = \"rocker-pivot\"\nvalue = 2.0\n\n[solver]";
    let bad = written("explain-open-loop.toml", &far.replace("[solver]", start));
    let output = run("explain", &[&bad, "--json"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let value = crate::json(&output);
    assert_eq!(value["error"]["code"], "cannot-assemble");
    assert!(value["prices"].is_null() && value["simulated"]["natural"].is_null());
    assert_eq!(value["simulated"]["bodies"][0], "crank");
}
