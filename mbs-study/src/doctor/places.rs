//! Points that probably belong together without coinciding, and points that were probably given in another frame.

use super::finding::{Finding, Severity, Topic};
use mbs_core::algebra::Vector;
use mbs_core::cluster::{mass_properties, scene_length};
use mbs_core::effects::Value;
use mbs_core::scene::{BodyId, Dimension, Entry, Inertia, JointKind, Scene};
use mbs_scene::format::few;

/// Distance below which a separate end of an effect and another point of its body are reported, relative to the scene's length [-]. Chosen,
/// not tuned.
const NEAR_ON_SCENE: f64 = 0.02;
/// Distance below which a point near a rod's unattached end is reported, relative to the rod's length [-]. The rod's other end is not
/// compared with it.
const NEAR_ON_ROD: f64 = 0.15;
/// Distance from the centre of mass beyond which a point is not on the body, in sizes of the body [-]. If the coordinates of the point are
/// within one size, they were probably measured from the centre of mass.
const FAR_FROM_CENTER: f64 = 3.0;

/// Owner of a point on a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Owner {
    /// End of the body's rod, if the body is one.
    Rod,
    Joint(usize),
    Effect(usize, &'static str),
}

/// Point of a body with its owner.
#[derive(Debug, Clone, Copy)]
struct Place {
    owner: Owner,
    body: usize,
    point: Vector<f64, 3>,
}

/// Reports points that are near another point of their body, and effects that are far from their body.
pub(super) fn findings(scene: &Scene<f64>, findings: &mut Vec<Finding>) {
    let near = NEAR_ON_SCENE * scene_length(scene);
    for here in places(scene) {
        for (place, other) in apart(scene, &here, near) {
            findings.push(near_miss(scene, place, other));
        }
        findings.extend(here.iter().filter_map(|place| stray(scene, place, &here)));
    }
}

/// All points that the file gives for each body, in the order: rods, joints, effects.
fn places(scene: &Scene<f64>) -> Vec<Vec<Place>> {
    let mut places = vec![Vec::new(); scene.bodies.len()];
    let mut add = |owner, body, point: [f64; 3]| {
        if let BodyId::Body(body) = body {
            places[body].push(Place { owner, body, point: Vector::from(point) });
        }
    };
    for (b, body) in scene.bodies.iter().enumerate() {
        if let Inertia::Rod { from, to } = body.inertia {
            add(Owner::Rod, BodyId::Body(b), from);
            add(Owner::Rod, BodyId::Body(b), to);
        }
    }
    // welds and free joints have the same effect at any point
    let is_placed = |kind: JointKind| !kind.is_rigid() && !kind.is_free();
    for (j, joint) in scene.joints.iter().enumerate().filter(|(_, j)| is_placed(j.kind)) {
        joint.bodies.into_iter().zip(joint.points).for_each(|(b, p)| add(Owner::Joint(j), b, p));
    }
    for (e, effect) in scene.effects.iter().enumerate().filter(|(_, effect)| effect.enabled) {
        for (key, body, point) in effect.kind.places() {
            add(Owner::Effect(e, key), body, point);
        }
    }
    places
}

/// Returns pairs of points of one body that are near each other. Each pair is a point that coincides with no joint, and the point that is
/// nearest to it.
///
/// An end of a rod or of an effect that coincides with a joint belongs to it, even if another joint is near.
fn apart<'a>(scene: &Scene<f64>, here: &'a [Place], near: f64) -> Vec<(&'a Place, &'a Place)> {
    let distance = |a: &Place, b: &Place| (a.point - b.point).norm();
    let is_joint = |place: &Place| matches!(place.owner, Owner::Joint(_));
    let is_rod = |place: &Place| place.owner == Owner::Rod;
    let mut pairs: Vec<(&Place, &Place)> = Vec::new();
    for place in here.iter().filter(|place| !is_joint(place)) {
        let is_there = |other: &Place| distance(place, other) <= 0.0;
        let others = || here.iter().filter(|other| other.owner != place.owner);
        if others().any(|other| is_there(other) && is_joint(other)) {
            continue;
        }
        // an effect at the end of a rod shows that both points are correct
        let is_shared = others().any(|other| is_there(other) && is_rod(other) != is_rod(place));
        let limit = limit(scene, place, (near, is_shared));
        // points of two effects are compared only if both effects act between the same bodies
        let may_belong = |other: &&Place| {
            !is_there(other)
                && (is_joint(other)
                    || is_rod(other) != is_rod(place)
                    || is_same_pair(scene, place, other))
        };
        let candidates = others().filter(may_belong);
        let nearest = candidates.min_by(|a, b| distance(place, a).total_cmp(&distance(place, b)));
        let Some(other) = nearest.filter(|other| distance(place, other) < limit) else { continue };
        if !pairs.iter().any(|(a, b)| a.owner == other.owner && b.owner == place.owner) {
            pairs.push((place, other));
        }
    }
    pairs
}

/// Returns the largest distance [m] at which another point was probably meant to coincide with this point. On a rod it is at most half of the
/// rod's length, because the ends of a rod may be near each other.
fn limit(scene: &Scene<f64>, place: &Place, (near, is_shared): (f64, bool)) -> f64 {
    let Inertia::Rod { from, to } = scene.bodies[place.body].inertia else { return near };
    let length = (Vector::from(to) - Vector::from(from)).norm();
    match place.owner {
        Owner::Rod if !is_shared => near.max(NEAR_ON_ROD * length).min(0.5 * length),
        _ => near.min(0.5 * length),
    }
}

/// True if two effects act between the same bodies.
fn is_same_pair(scene: &Scene<f64>, a: &Place, b: &Place) -> bool {
    let (Owner::Effect(i, _), Owner::Effect(j, _)) = (a.owner, b.owner) else { return false };
    let pair = |e: usize| match scene.effects[e].kind.values()[..] {
        [Value::Bodies(bodies), Value::Points(_), ..] => Some(bodies),
        _ => None,
    };
    let (Some([a, b]), Some(other)) = (pair(i), pair(j)) else { return false };
    i != j && (other == [a, b] || other == [b, a])
}

fn near_miss(scene: &Scene<f64>, place: &Place, other: &Place) -> Finding {
    let distance = (place.point - other.point).norm();
    let (entry, key) = entry(place);
    let message = format!(
        "{} is {} from {}: intended as one point?",
        whose(scene, place),
        length(distance),
        whose(scene, other)
    );
    let remedy = format!(
        "write it once, as [[point]], and its name for both, or leave it: it runs as it is written ({})",
        written(scene, other.point)
    );
    let code = (Topic::Places, "places-apart");
    Finding::new(Severity::Doubt, code, message, remedy).bodies(vec![place.body]).at(entry, key)
}

/// Reports an effect whose point is far from its body, and would be on it if its coordinates were relative to the centre of mass.
fn stray(scene: &Scene<f64>, place: &Place, here: &[Place]) -> Option<Finding> {
    let Owner::Effect(..) = place.owner else { return None };
    let (mass, center, inertia) = mass_properties(scene, place.body);
    if !(mass > 0.0) {
        return None;
    }
    let others = here.iter().filter(|other| !matches!(other.owner, Owner::Effect(..)));
    let reach = others.map(|other| (other.point - center).norm()).fold(0.0, f64::max);
    let size = reach.max((inertia.trace() / mass).sqrt());
    let distance = (place.point - center).norm();
    if !(size > 0.0 && distance > FAR_FROM_CENTER * size && place.point.norm() <= size) {
        return None;
    }
    let (entry, key) = entry(place);
    let message = format!(
        "{} is {} from the centre of `{}`, whose joints and mass are within {}: it looks like a place counted from there",
        whose(scene, place),
        length(distance),
        scene.bodies[place.body].name,
        length(size)
    );
    let remedy = format!(
        "all places are global ones, in the reference configuration: counted from the centre it is {}",
        written(scene, center + place.point)
    );
    let code = (Topic::Places, "place-off-body");
    let finding = Finding::new(Severity::Doubt, code, message, remedy);
    Some(finding.bodies(vec![place.body]).at(entry, key))
}

fn entry(place: &Place) -> (Entry, &'static str) {
    match place.owner {
        Owner::Rod => (Entry::Body(place.body), "rod"),
        Owner::Joint(j) => (Entry::Joint(j), "at"),
        Owner::Effect(e, key) => (Entry::Effect(e), key),
    }
}

fn whose(scene: &Scene<f64>, place: &Place) -> String {
    match place.owner {
        Owner::Rod => format!("the end of rod `{}`", scene.bodies[place.body].name),
        Owner::Joint(j) => format!("joint `{}`", scene.joints[j].name),
        Owner::Effect(e, "points") => format!("the end of `{}`", scene.effects[e].name),
        Owner::Effect(e, _) => format!("the place of `{}`", scene.effects[e].name),
    }
}

/// Coordinates of a point as the file has them.
fn written(scene: &Scene<f64>, point: Vector<f64, 3>) -> String {
    let n = if scene.dimension == Dimension::Planar { 2 } else { 3 };
    let numbers: Vec<String> =
        (0..n).map(|i| mbs_scene::format::significant(point[i] + 0.0)).collect();
    format!("[{}]", numbers.join(", "))
}

/// Formats a length in millimetres or metres.
fn length(x: f64) -> String {
    if x < 1.0 { format!("{} mm", few(1e3 * x)) } else { format!("{} m", few(x)) }
}
