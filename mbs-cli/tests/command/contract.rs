//! The keys of JSON objects and tables, compared with the lists in docs/CONTRACT.md.

use super::{json, run, scene};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

const CONTRACT: &str = include_str!("../../../docs/CONTRACT.md");

/// The lists between the marks: a line `name:`, followed by its keys.
fn lists() -> BTreeMap<&'static str, BTreeSet<&'static str>> {
    let inner = CONTRACT.split("<!-- keys:begin -->").nth(1).expect("the mark is there");
    let inner = inner.split("<!-- keys:end -->").next().unwrap_or_default();
    let (mut lists, mut name) = (BTreeMap::new(), "");
    for line in inner.lines().filter(|line| !line.starts_with("```")) {
        if let Some(next) = line.strip_suffix(':') {
            name = next;
        } else {
            lists.entry(name).or_insert_with(BTreeSet::new).extend(line.split_whitespace());
        }
    }
    lists
}

/// The keys of an object at any depth. Keys under `outputs` and `frames`, and those of lists by joint or body, are left out: they are names
/// of the scene.
fn keys<'a>(value: &'a Value, found: &mut BTreeSet<&'a str>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                found.insert(key);
                let is_named = ["outputs", "joints", "reactions", "frames", "centers", "jacobians"]
                    .contains(&key.as_str());
                if !(is_named && value.is_object()) {
                    keys(value, found);
                }
            }
        }
        Value::Array(list) => list.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

const ALL_QUANTITIES: &str = "accelerations,efforts,gravity,bias,mass-matrix,loops,momentum,frames,centers,jacobians,derivatives";

#[test]
fn json_keys_are_those_of_the_contract() {
    let lists = lists();
    let other = scene("double-pendulum");
    for (command, name, options) in [
        ("diff", "double-pendulum", &[other.as_str(), "--within", "1"][..]),
        ("run", "double-pendulum", &["--duration", "0.05"]),
        ("explain", "tree-30", &["--duration", "0.02"]),
        ("doctor", "spatial-four-bar", &["--duration", "0.05"]),
        ("equilibrium", "rssr", &[]),
        ("modes", "double-pendulum", &[]),
        ("import", "", &["--base", "free"]),
        ("inspect", "double-pendulum", &["--what", ALL_QUANTITIES]),
    ] {
        let path = if command == "import" { super::models::arm() } else { scene(name) };
        let output = run(command, &[&[path.as_str(), "--json"], options].concat());
        let (object, mut found) = (json(&output), BTreeSet::new());
        keys(&object, &mut found);
        let always = &lists[command];
        let besides = lists.get(format!("{command}, besides").as_str());
        let missing: Vec<_> = always.difference(&found).collect();
        let new: Vec<_> = found
            .difference(always)
            .filter(|key| !besides.is_some_and(|list| list.contains(*key)))
            .collect();
        assert!(missing.is_empty(), "mbs {command} has no more: {missing:?}");
        assert!(new.is_empty(), "not in docs/CONTRACT.md, mbs {command}: {new:?}");
    }
}
