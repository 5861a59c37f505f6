//! Bodies of small files, compared with those that Pinocchio, MuJoCo and Drake read (lab/models/README.md).

use mbs_core::scene::{Inertia, Scene};
use mbs_import::{ImportOptions, import};
use mbs_scene::SceneFile;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../lab/models/conventions")
}

fn scene(file: &str) -> Scene<f64> {
    let options = ImportOptions { folder: Some(folder()), ..ImportOptions::default() };
    let bytes = std::fs::read(folder().join(file)).expect("a file of this repository");
    let model = import(&bytes, file, &options).unwrap_or_else(|e| panic!("{}", e.render()));
    let scene = SceneFile::parse(&model.text, file).and_then(|scene| scene.scene());
    scene.unwrap_or_else(|e| panic!("{}\n{}", e.render(), model.text))
}

/// Mass, centre of mass and tensor of a body: ten numbers.
type Ten = [f64; 10];

/// The body that a reference names: by its own name, or by the name of the joint whose second body it is.
fn body(scene: &Scene<f64>, name: &str) -> Ten {
    let of_joint = scene
        .joints
        .iter()
        .find(|joint| joint.name == name)
        .and_then(|joint| joint.bodies[1].index());
    let number = scene.bodies.iter().position(|body| body.name == name).or(of_joint);
    let body = &scene.bodies[number.unwrap_or_else(|| panic!("no body `{name}`"))];
    let Inertia::Spatial(six) = body.inertia else { panic!("a body of space") };
    let mut ten = [body.mass; 10];
    ten[1..4].copy_from_slice(&body.center);
    ten[4..].copy_from_slice(&six);
    ten
}

/// Bodies of another program, combined into the bodies of the scene. Bodies whose names are frames of one scene body are added together.
fn expected(scene: &Scene<f64>, bodies: &serde_json::Map<String, Value>) -> Vec<(String, Ten)> {
    // Drake adds the name of the model before all other names.
    let plain = |name: &str| name.split_once("::").map_or(name, |(_, name)| name).to_owned();
    let ten = |value: &Value| -> Ten {
        let list = ["mass", "center", "inertia"].map(|key| numbers(&value[key])).concat();
        list.try_into().expect("ten numbers")
    };
    // The scene has no mass for bodies that are welded to the ground.
    let frame = |name: &str| {
        let of = scene.frames.iter().find(|frame| frame.name == plain(name));
        // The frame of a body has the body's name.
        let is_own = |b: usize| scene.bodies[b].name == plain(name);
        of.filter(|frame| !frame.body.index().is_some_and(is_own))
    };
    let mut whole: Vec<(String, Ten)> = Vec::new();
    for (name, value) in bodies {
        if frame(name).is_none() {
            whole.push((plain(name), ten(value)));
        }
    }
    for (name, part) in bodies {
        let Some(carrier) = frame(name).and_then(|frame| frame.body.index()) else { continue };
        let carrier = &scene.bodies[carrier].name;
        let sum = whole.iter_mut().find(|(name, _)| name == carrier);
        let sum = sum.expect("its carrier has an entry");
        sum.1 = added(sum.1, ten(part));
    }
    whole
}

/// Two bodies as one, with each tensor moved to the common centre.
fn added(a: Ten, b: Ten) -> Ten {
    let mass = a[0] + b[0];
    let center: [f64; 3] = core::array::from_fn(|i| (a[0] * a[1 + i] + b[0] * b[1 + i]) / mass);
    let mut sum = [mass; 10];
    sum[1..4].copy_from_slice(&center);
    sum[4..].fill(0.0);
    for part in [a, b] {
        let [x, y, z]: [f64; 3] = core::array::from_fn(|i| part[1 + i] - center[i]);
        let moved = [y * y + z * z, x * x + z * z, x * x + y * y, -x * y, -y * z, -z * x];
        for (i, square) in moved.into_iter().enumerate() {
            sum[4 + i] += part[4 + i] + part[0] * square;
        }
    }
    sum
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().filter_map(Value::as_f64).collect(),
        other => other.as_f64().into_iter().collect(),
    }
}

/// Files that the comparison leaves out. MuJoCo stores vertices of meshes in single precision, and does not add the armature of a free body
/// to the body.
const LEFT_OUT: [&str; 2] = ["mesh.xml", "armature_free.xml"];

/// Compares all files with an ending; returns the number of bodies that were compared.
fn compare(references: &str, ending: &str) -> usize {
    let text =
        std::fs::read_to_string(folder().join(references)).expect("a file of this repository");
    let references: Value = serde_json::from_str(&text).expect("JSON");
    let mut compared = 0;
    let files = references["files"].as_object().expect("an object");
    for (file, reference) in files
        .iter()
        .filter(|(file, _)| file.ends_with(ending) && !LEFT_OUT.contains(&file.as_str()))
    {
        let scene = scene(file);
        let bodies = reference["bodies"].as_object().expect("an object");
        for (name, expected) in expected(&scene, bodies) {
            let found = body(&scene, &name);
            for (found, expected) in found.iter().zip(&expected) {
                // A dozen products of rotations have rounding errors in the last bit.
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
    assert!(compare("sdf.json", ".urdf") > 3);
}

#[test]
fn bodies_of_mjcfs_are_those_of_mujoco() {
    assert!(compare("conventions.json", ".xml") > 60);
}
