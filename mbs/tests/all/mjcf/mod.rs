//! Models in MJCF have the accelerations of MuJoCo 4.0.0 at the keyframe `on`, without its soft constraints.

mod actuators;
mod balls;
mod loops;
mod parts;
mod sizes;
mod small;
mod springs;

use crate::common::oracle::{self, Way};
use mbs_import::{ImportOptions, import};

/// Difference by the rounding of both programs, relative to one or to the value [-].
const ROUNDED: f64 = 1e-9;

/// Text of a model's scene at the keyframe.
fn scene_text(model: &str, options: ImportOptions) -> String {
    let key = model.contains("<key").then(|| "on".to_owned());
    let imported = import(model.as_bytes(), "model.xml", &ImportOptions { key, ..options });
    imported.unwrap_or_else(|error| panic!("{}", error.render())).text
}

/// Compares outputs at the start. Each output has the text of its table and the values of its components.
fn compare(mut text: String, outputs: &[(String, Vec<f64>)]) {
    for (number, (output, _)) in outputs.iter().enumerate() {
        text += &format!("\n[[output]]\nname = \"output {number}\"\n{output}\n");
    }
    let rows = oracle::run(&text, Way("index-3", "trapezoidal"), (1e-6, 1e-6));
    let expected =
        outputs.iter().flat_map(|(output, numbers)| numbers.iter().map(move |x| (output, x)));
    for (found, (output, expected)) in rows[0].1.iter().zip(expected) {
        let allowed = ROUNDED * expected.abs().max(1.0);
        assert!((found - expected).abs() < allowed, "{output}: {found} for {expected}\n{text}");
    }
}

/// Compares accelerations of joints with expected ones.
fn agrees(model: &str, expected: &[(&str, f64)]) {
    let outputs = expected.iter().map(|(joint, x)| (of_joint(joint), vec![*x]));
    compare(scene_text(model, ImportOptions::default()), &outputs.collect::<Vec<_>>());
}

fn of_joint(joint: &str) -> String {
    format!("joint = \"{joint}\"\nquantity = \"acceleration\"")
}

/// Compares the angular acceleration of a body with the expected one.
fn turns(model: &str, body: &str, expected: [f64; 3]) {
    let output = format!("body = \"{body}\"\nquantity = \"angular-acceleration\"");
    let text = scene_text(model, ImportOptions::default());
    compare(text, &[(output, expected.to_vec())]);
}
