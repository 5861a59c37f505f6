//! Bodies of small files beside what Pinocchio, MuJoCo and Drake read of them (lab/models/README.md).

use mbs_core::scene::{Inertia, Scene};
use mbs_import::{ImportOptions, import};
use mbs_scene::SceneFile;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../lab/models/conventions")
}

fn scene(file: &str) -> Scene<f64> {
    let bytes = std::fs::read(folder().join(file)).expect("a file of this repository");
    let model = import(&bytes, file, &ImportOptions::default()).unwrap_or_else(|e| panic!("{}", e.render()));
    let scene = SceneFile::parse(&model.text, file).and_then(|scene| scene.scene());
    scene.unwrap_or_else(|e| panic!("{}\n{}", e.render(), model.text))
}

/// Mass, centre and tensor of a body.
type Ten = [f64; 10];

/// The body that a reference calls so: by its own name, or by that of the joint whose second body it is.
fn body(scene: &Scene<f64>, name: &str) -> Ten {
    let name = name.strip_prefix("m::").unwrap_or(name);
    let of_joint = scene.joints.iter().find(|joint| joint.name == name).and_then(|joint| joint.bodies[1].index());
    let number = scene.bodies.iter().position(|body| body.name == name).or(of_joint);
    let body = &scene.bodies[number.unwrap_or_else(|| panic!("no body `{name}`"))];
    let Inertia::Spatial(six) = body.inertia else { panic!("a body of space") };
    let mut ten = [body.mass; 10];
    ten[1..4].copy_from_slice(&body.center);
    ten[4..].copy_from_slice(&six);
    ten
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().filter_map(Value::as_f64).collect(),
        other => other.as_f64().into_iter().collect(),
    }
}

/// Compares all files of an ending; the number of bodies that were compared.
fn compare(references: &str, ending: &str) -> usize {
    let text = std::fs::read_to_string(folder().join(references)).expect("a file of this repository");
    let references: Value = serde_json::from_str(&text).expect("JSON");
    let mut compared = 0;
    let files = references["files"].as_object().expect("an object");
    for (file, reference) in files.iter().filter(|(file, _)| file.ends_with(ending)) {
        let scene = scene(file);
        for (name, expected) in reference["bodies"].as_object().expect("an object") {
            let expected = ["mass", "center", "inertia"].map(|key| numbers(&expected[key])).concat();
            let found = body(&scene, name);
            for (found, expected) in found.iter().zip(&expected) {
                // a dozen products of rotations, each with its last bit
                assert!((found - expected).abs() < 1.0e-14, "{file}: {name}: {found} {expected}");
            }
            compared += 1;
        }
    }
    compared
}

#[test]
fn bodies_of_urdfs_are_those_of_pinocchio() {
    assert!(compare("conventions.json", ".urdf") > 15);
}

#[test]
fn bodies_of_sdfs_are_those_of_drake() {
    assert!(compare("sdf.json", ".sdf") > 20);
}
