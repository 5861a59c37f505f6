//! Tests of `mbs equilibrium` and `mbs modes` as commands.

use crate::{done, files, json, run, run_line, scene, written};
use serde_json::Value;

#[test]
fn every_scene_has_an_equilibrium_that_is_reported_in_one_object() {
    // the first two have a constant driving torque or force; a disc has no equilibrium but lying flat on the ground
    const RESTLESS: [&str; 3] = ["planetary-gear", "crane", "rolling-disc"];
    for name in RESTLESS {
        assert_eq!(run("equilibrium", &[&scene(name), "--json"]).status.code(), Some(2), "{name}");
    }
    for name in files::SCENES.into_iter().filter(|name| !RESTLESS.contains(name)) {
        let value = done(&run("equilibrium", &[&scene(name), "--json"]));
        assert!(value["stable"].is_boolean(), "{name}: {value}");
        // the bound is the rounding of some ten parts of each force
        assert!(value["relative_residual"].as_f64().is_some_and(|r| r < 1e-13), "{name}: {value}");
        assert!(value["joints"].is_object() && value["reactions"].is_object(), "{name}");
    }
}

#[test]
fn a_double_pendulum_hangs_and_its_first_joint_carries_all() {
    let value = json(&run("equilibrium", &[&scene("double-pendulum"), "--json"]));
    assert_eq!(value["stable"], true);
    let weight: f64 =
        mbs_testkit::file("double-pendulum").bodies.iter().map(|b| b.mass * 9.81).sum();
    let reaction = value["reactions"].as_object().expect("there are joints").values();
    let most = reaction.filter_map(|r| r[1].as_f64()).fold(0.0, f64::max);
    assert!((most - weight).abs() < 1e-9 * weight, "{value}");
}

#[test]
fn modes_are_written_as_a_table_and_as_json_and_to_a_file() {
    let out = files::scratch("modes");
    let file = scene("simple-pendulum");
    let value = done(&run_line(&format!("modes {file} --json --out {}", out.display())));
    let written = std::fs::read(out.join("modes.json")).expect("it was written");
    assert_eq!(serde_json::from_slice::<Value>(&written).expect("it is JSON"), value);
    assert_eq!((&value["at"], &value["stable"]), (&"equilibrium".into(), &true.into()));
    let mode = &value["modes"][0];
    let wanted = f64::sqrt(9.81) / std::f64::consts::TAU;
    let found = mode["frequency"].as_f64().expect("a number");
    assert!((found - wanted).abs() < 1e-9 * wanted, "{found} {wanted}");
    assert!(mode["damping_ratio"].as_f64().is_some_and(|x| x.abs() < 1e-9), "{mode}");
    let table = String::from_utf8(run("modes", &[&file]).stdout).expect("it is text");
    assert!(table.contains("0.498487") && table.contains("stable"), "{table}");
}

#[test]
fn what_cannot_be_done_has_status_two_and_malformed_requests_one() {
    let free = "[scene]\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\n\
        [[body]]\nname = \"stone\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.1\n";
    let file = &written("stone.toml", free)[..];
    let output = run("equilibrium", &[file, "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let value = json(&output);
    assert_eq!(
        (&value["completed"], &value["error"]["code"]),
        (&false.into(), &"no-equilibrium".into())
    );
    assert_eq!(value["error"]["body"], "stone");
    let output = run("modes", &[file]);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(text.contains("stone") && text.contains("hint"), "{text}");
    for arguments in
        [&["modes", "no-such.toml"][..], &["modes", file, "--at", "noon"], &["equilibrium"]]
    {
        assert_eq!(run(arguments[0], &arguments[1..]).status.code(), Some(1), "{arguments:?}");
    }
}

#[test]
fn near_its_start_a_pendulum_stands_and_the_text_says_how_far_it_went() {
    let pendulum = "[scene]\nname = \"pendulum\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\n\
        [[body]]\nname = \"rod\"\nmass = 1.0\nrod = { from = [0.0, 0.0], to = [0.0, -1.0] }\n\n\
        [[joint]]\nname = \"pivot\"\nkind = \"revolute\"\nbodies = [\"ground\", \"rod\"]\nat = [0.0, 0.0]\n\n\
        [[effect]]\nname = \"rub\"\nkind = \"friction\"\njoint = \"pivot\"\ncoulomb = 0.5\n\n\
        [[initial]]\njoint = \"pivot\"\nvalue = 3.0\n";
    let file = &written("standing.toml", pendulum)[..];
    let value = json(&run("equilibrium", &[file, "--near", "--json"]));
    assert_eq!((&value["stable"], &value["unstable_modes"]), (&false.into(), &1.into()), "{value}");
    let turn = value["moved"]["turn"]["size"].as_f64().expect("a number");
    assert!((turn - (std::f64::consts::PI - 3.0)).abs() < 1e-9, "{turn}");
    assert_eq!(value["left_out"][0]["effect"], "rub");
    let told = |arguments: &[&str]| {
        let output = run(arguments[0], &arguments[1..]);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        String::from_utf8(output.stdout).expect("it is text")
    };
    let text = told(&["equilibrium", file]);
    assert!(text.contains("from the start") && text.contains("3 rad (`rod`)"), "{text}");
    assert!(text.contains("left out of this analysis: dry friction of `rub`"), "{text}");
    let text = told(&["modes", file, "--near"]);
    assert!(text.contains("unstable") && text.contains("dry friction of `rub`"), "{text}");
    let frozen = told(&["modes", file, "--at", "initial", "--frozen"]);
    assert!(!frozen.contains("left out") && frozen.contains("at an instant"), "{frozen}");
    let refused = run("modes", &[file, "--at", "initial"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("`pivot` accelerates by") && said.contains("--frozen"), "{said}");
    assert_eq!(run("modes", &[file, "--near", "--at", "initial"]).status.code(), Some(1));
}
