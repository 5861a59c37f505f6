//! `mbs equilibrium` and `mbs modes` as their users meet them, and the start from an equilibrium.

use crate::common;

use crate::common::{path, scene};
use mbs::core::model::Model;
use mbs::core::natural::NaturalModel;
use mbs::core::start::assemble;
use mbs::sparse::{Multifrontal, Options};
use serde_json::Value;
use std::process::{Command, Output};

fn mbs(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mbs")).args(arguments).output().expect("the command is built")
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&output.stderr)))
}

fn of_scene(name: &str) -> String {
    path(name).to_str().expect("a plain path").to_owned()
}

#[test]
fn every_scene_has_an_equilibrium_that_is_told_in_one_object() {
    for name in common::SCENES {
        let output = mbs(&["equilibrium", &of_scene(name), "--json"]);
        assert_eq!(output.status.code(), Some(0), "{name}");
        let value = json(&output);
        assert!(value["stable"].is_boolean(), "{name}: {value}");
        // Rounding of some ten parts of each force.
        assert!(value["relative_residual"].as_f64().is_some_and(|r| r < 1e-13), "{name}: {value}");
        assert!(value["joints"].is_object() && value["reactions"].is_object(), "{name}");
    }
}

#[test]
fn a_double_pendulum_hangs_and_its_first_joint_carries_all() {
    let value = json(&mbs(&["equilibrium", &of_scene("double-pendulum"), "--json"]));
    assert_eq!(value["stable"], true);
    let weight: f64 = scene("double-pendulum").bodies.iter().map(|b| b.mass * 9.81).sum();
    let reaction = value["reactions"].as_object().expect("there are joints").values();
    let most = reaction.filter_map(|r| r[1].as_f64()).fold(0.0, f64::max);
    assert!((most - weight).abs() < 1e-9 * weight, "{value}");
}

#[test]
fn modes_are_written_as_a_table_and_as_json_and_to_a_file() {
    let out = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("modes");
    let file = of_scene("simple-pendulum");
    let output = mbs(&["modes", &file, "--json", "--out", out.to_str().expect("a plain path")]);
    assert_eq!(output.status.code(), Some(0));
    let value = json(&output);
    let written = std::fs::read(out.join("modes.json")).expect("it was written");
    assert_eq!(serde_json::from_slice::<Value>(&written).expect("it is JSON"), value);
    assert_eq!((&value["at"], &value["stable"]), (&"equilibrium".into(), &true.into()));
    let mode = &value["modes"][0];
    let wanted = f64::sqrt(9.81) / std::f64::consts::TAU;
    let found = mode["frequency"].as_f64().expect("a number");
    assert!((found - wanted).abs() < 1e-9 * wanted, "{found} {wanted}");
    assert!(mode["damping_ratio"].as_f64().is_some_and(|x| x.abs() < 1e-9), "{mode}");
    let table = String::from_utf8(mbs(&["modes", &file]).stdout).expect("it is text");
    assert!(table.contains("0.498487") && table.contains("stable"), "{table}");
}

#[test]
fn what_cannot_be_done_has_status_two_and_what_cannot_be_meant_one() {
    let free = "[scene]\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\n\
        [[body]]\nname = \"stone\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.1\n";
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("stone.toml");
    std::fs::write(&file, free).expect("the directory is ours");
    let file = file.to_str().expect("a plain path");
    let output = mbs(&["equilibrium", file, "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let value = json(&output);
    assert_eq!(
        (&value["completed"], &value["error"]["code"]),
        (&false.into(), &"no-equilibrium".into())
    );
    assert_eq!(value["error"]["body"], "stone");
    let output = mbs(&["modes", file]);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(text.contains("stone") && text.contains("hint"), "{text}");
    for arguments in
        [&["modes", "no-such.toml"][..], &["modes", file, "--at", "noon"], &["equilibrium"]]
    {
        assert_eq!(mbs(arguments).status.code(), Some(1), "{arguments:?}");
    }
}

#[test]
fn a_start_from_equilibrium_rests_or_moves_as_the_scene_says() {
    for name in ["double-pendulum", "spatial-four-bar", "tree-30"] {
        let mut scene = scene(name);
        scene.initials.clear();
        match scene.dimension {
            mbs::core::scene::Dimension::Planar => rests::<2>(&scene),
            mbs::core::scene::Dimension::Spatial => rests::<3>(&scene),
        }
    }
}

/// Without initial velocities nothing moves, and accelerations are rounding.
fn rests<const D: usize>(scene: &mbs::core::scene::Scene<f64>) {
    let model = NaturalModel::<f64, D>::new(scene).expect("it has a model");
    let analyse = Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver);
    let mut start = start.expect("it assembles");
    let found = mbs::equilibrium_start(scene, &model, &mut solver, &mut start)
        .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    assert!(found.relative < 1e-12, "{}: {found:?}", scene.name);
    assert!(start.state.v.iter().all(|v| *v == 0.0), "{}", scene.name);
    // Rounding of forces over the lightest inertia, some 1e-3 kg m^2 of the tree.
    let fastest = start.state.a.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    assert!(fastest < 1e-8, "{}: {fastest}", scene.name);
    assert!(start.residual.iter().all(|r| *r < 1e-9), "{:?}", start.residual);
    assert!(model.kinetic_energy(&start.state.v) == 0.0);
}

#[test]
fn a_start_from_equilibrium_takes_the_initial_velocities() {
    let mut scene = scene("simple-pendulum");
    scene.initials = vec![mbs::core::scene::Initial {
        target: mbs::core::scene::InitialTarget::Joint {
            joint: 0,
            value: Some(vec![0.4]),
            rate: Some(vec![2.0]),
        },
    }];
    let model = NaturalModel::<f64, 2>::new(&scene).expect("it has a model");
    let analyse = Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(&scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver);
    let mut start = start.expect("it assembles");
    mbs::equilibrium_start(&scene, &model, &mut solver, &mut start).expect("it hangs");
    // Hanging straight down, turning at 2 rad/s: the centripetal acceleration is 4 m/s^2 for 1 m.
    let tip = model.point(mbs::core::scene::BodyRef::Body(0), [-1.0, 0.0, 0.0]);
    let (x, v, a) = (tip.value(&start.state.q), tip.rate(&start.state.v), tip.rate(&start.state.a));
    assert!(x[0].abs() < 1e-10 && (x[1] + 1.0).abs() < 1e-10, "{x:?}");
    assert!((v[0] - 2.0).abs() < 1e-10 && v[1].abs() < 1e-9, "{v:?}");
    assert!((a[1] - 4.0).abs() < 1e-8 && a[0].abs() < 1e-8, "{a:?}");
}
