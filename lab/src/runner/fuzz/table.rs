//! Trials of files that are read with a scene: tables of references, sweeps, price lists. Their bytes and numbers are changed. A reader
//! must accept such a file or refuse it with a message.

use crate::fuzz::mutate::mutated;
use crate::fuzz::torn::damage;
use mbs::Method;
use mbs::core::scene::Scene;
use mbs::export::ladder;
use mbs::record::Channel;
use mbs::scene_file::{Dice, SceneFile};
use mbs_study::compare::check_table;
use mbs_study::sweep::{Study, StudyError};

/// Largest number of columns of a table of references, and number of its time intervals.
const ROWS: usize = 12;

/// Damages one file of each kind and reads it.
///
/// # Errors
/// The fault of a reader: a refusal without a message or without its place.
pub(crate) fn tables(
    document: &SceneFile,
    scene: &Scene<f64>,
    dice: &mut Dice,
) -> Result<(), String> {
    if let Err(error) = check_table(scene, &damaged(&reference(scene), dice)) {
        words("a table of references", &error.to_string(), &error.hint())?;
    }
    let sweep = damaged(&sweep(scene), dice);
    let sweep = match SceneFile::parse(&sweep, "fuzzed-sweep.toml") {
        Ok(sweep) => Study::new(document.clone(), &sweep.into(), &Method::default()).map(drop),
        Err(error) => Err(StudyError::Read(error)),
    };
    match sweep {
        Err(StudyError::Read(error)) if !error.render().contains("fuzzed") => {
            return Err("a sweep: a refusal without a place".to_owned());
        }
        Err(error) => words("a sweep", &error.to_string(), "-")?,
        Ok(()) => {}
    }
    if let Err(error) = ladder(&damaged(&prices(scene), dice), scene) {
        words("a list of effect costs", &error.to_string(), "-")?;
    }
    Ok(())
}

fn words(of: &str, message: &str, hint: &str) -> Result<(), String> {
    let has_words = !message.is_empty() && !hint.is_empty();
    has_words.then_some(()).ok_or_else(|| format!("{of}: a refusal without words"))
}

/// A text with mutated numbers, words and lines. In half of the cases bytes are changed too.
fn damaged(text: &str, dice: &mut Dice) -> String {
    let mut bytes = mutated(text, &[], dice).into_bytes();
    if !bytes.is_empty() && dice.below(2) == 0 {
        damage(&mut bytes, dice);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The outputs of a scene at a few times, in the form that a run writes.
fn reference(scene: &Scene<f64>) -> String {
    let columns: Vec<String> =
        Channel::of_scene(scene).iter().flat_map(Channel::columns).take(ROWS).collect();
    let mut text = format!("t,{}\n", columns.join(","));
    for k in 0..=ROWS {
        #[allow(clippy::cast_precision_loss, reason = "a small count")]
        let t = scene.duration * k as f64 / ROWS as f64;
        text += &format!("{t}{}\n", ",1.25".repeat(columns.len()));
    }
    text
}

/// A sweep of the first body's mass.
fn sweep(scene: &Scene<f64>) -> String {
    let body = scene.bodies.first().map_or("none", |body| &body.name);
    format!(
        "[sweep]\ncombine = \"latin-hypercube\"\nsamples = 12\nseed = 3\n\n[[vary]]\npath = {:?}\nfrom = 0.5\nto = 2.0\nscale = \"log\"\n",
        format!("body.{body}.mass")
    )
}

/// A price list of effects, in the form that `mbs explain` writes.
fn prices(scene: &Scene<f64>) -> String {
    let effect = scene.effects.first().map_or("none", |effect| &effect.name);
    format!(
        "{{\"prices\": {{\"effects\": [{{\"names\": [{effect:?}], \"share\": 0.2, \"completed\": true,\n\
         \"changes\": [{{\"relative\": 1e-3}}]}}]}}}}\n"
    )
}
