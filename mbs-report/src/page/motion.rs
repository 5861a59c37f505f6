//! Motion of a run in a pack: pictures over time, and the drawn shapes.

use super::decimate::spread;
use super::meshes::PageMeshes;
use super::pack::{Column, Pack};
use super::section::PageSection;
use mbs::record::{DrawnShape, N_POSE, RecordedMotion, ShapeForm};
use serde_json::{Value, json};

/// Step of packed positions, relative to the scene's length [-]. It is a hundredth of a millimetre for a scene of one metre. If the step
/// were relative to the length of the path, the rounding would be visible where the view follows a vehicle.
const PLACE_STEP: f64 = 1e-5;
/// Step of the components of a quaternion [-]: about a tenth of a milliradian.
const TURN_STEP: f64 = 1.0 / 16_384.0;
/// Step of packed times, relative to the duration of the run [-].
pub(super) const TIME_STEP: f64 = 1e-6;

/// Returns the sections of a page that show the start of a mechanism with names, and the packed data for the view. Notes are the first
/// section. Returns `None` if there is nothing to draw.
pub(crate) fn still_view(motion: &RecordedMotion) -> Option<(Vec<PageSection>, String)> {
    let mut first = motion.clone();
    first.times.truncate(1);
    let mut pack = Pack::default();
    let meshes = PageMeshes::of(&first);
    let motion = packed((&first, &meshes), (1, true), &mut pack)?;
    let caption = "The start, with the names of bodies, and in italics of the joints that findings name. Left button turns, right \
                   button moves, wheel or pinch zooms.";
    let notes = (!meshes.notes.is_empty()).then_some(PageSection::Notes(meshes.notes));
    let sections = notes.into_iter().chain([PageSection::View(caption.to_owned())]);
    Some((sections.collect(), pack.text(json!({ "motion": motion }))))
}

/// Packs a motion with at most `most` pictures, with or without names of bodies and joints. Returns `None` if there is nothing to draw.
pub(super) fn packed(
    (motion, meshes): (&RecordedMotion, &PageMeshes),
    (most, is_named): (usize, bool),
    pack: &mut Pack,
) -> Option<Value> {
    let n = motion.bodies.len() * N_POSE;
    let is_whole = |k: &usize| {
        let picture = motion.poses.get(k * n..(k + 1) * n);
        picture.is_some_and(|poses| poses.iter().all(|x| x.is_finite()))
    };
    let kept: Vec<usize> = (0..motion.times.len()).filter(is_whole).collect();
    let kept: Vec<usize> = spread(kept.len(), most).into_iter().map(|i| kept[i]).collect();
    if n == 0 || kept.is_empty() {
        return None;
    }
    let column = |i: usize| -> Vec<f64> { kept.iter().map(|k| motion.poses[k * n + i]).collect() };
    let columns = |numbers: core::ops::Range<usize>| -> Vec<Vec<f64>> {
        let of_body = |body: usize| numbers.clone().map(move |i| body * N_POSE + i);
        (0..motion.bodies.len()).flat_map(of_body).map(column).collect()
    };
    let step = PLACE_STEP * if motion.length > 0.0 { motion.length } else { 1.0 };
    let times: Vec<f64> = kept.iter().map(|k| motion.times[*k]).collect();
    Some(json!({
        "dimension": motion.dimension,
        "up": motion.up,
        "length": motion.length,
        "times": times_of(&times, pack),
        "places": pack.fixed(&columns(0..3), step),
        "turns": pack.fixed(&columns(3..N_POSE), TURN_STEP),
        "bodies": motion.bodies,
        "meshes": meshes.packed(pack),
        "shapes": shapes(motion, meshes),
        "lines": motion.lines,
        "traces": motion.traces,
        "joints": motion.joints,
        "is_named": is_named,
        "road": motion.road.as_ref().map(|road| json!({
            "start": road.start,
            "spacing": road.spacing,
            "speed": road.speed,
            "sides": road.strips.iter().map(|strip| strip.sides).collect::<Vec<_>>(),
            "heights": pack.fixed(
                &road.strips.iter().map(|strip| strip.heights.clone()).collect::<Vec<_>>(),
                step,
            ),
        })),
    }))
}

/// Returns the drawn shapes. Meshes are given by their indices. Other shapes replace meshes that cannot be read.
fn shapes(motion: &RecordedMotion, meshes: &PageMeshes) -> Vec<Value> {
    let number = |shape: &DrawnShape| match &shape.form {
        ShapeForm::Mesh { file, .. } => meshes.number(file),
        _ => None,
    };
    let with_mesh: Vec<_> =
        motion.shapes.iter().filter(|s| number(s).is_some()).map(|s| s.body).collect();
    let is_drawn = |shape: &&DrawnShape| match shape.form {
        ShapeForm::Mesh { .. } => number(shape).is_some(),
        _ => !(shape.stands_in && with_mesh.contains(&shape.body)),
    };
    let shapes = motion.shapes.iter().filter(is_drawn).map(|shape| {
        let mut value = json!(shape);
        if let Some(number) = number(shape) {
            value["mesh"] = number.into();
        }
        value
    });
    shapes.collect()
}

/// Packs times [s] with a step relative to the duration of the run.
pub(super) fn times_of(times: &[f64], pack: &mut Pack) -> Column {
    let length = times.last().copied().unwrap_or(0.0).abs();
    let step = TIME_STEP * if length > 0.0 { length } else { 1.0 };
    pack.fixed(&[times.to_vec()], step)[0]
}
