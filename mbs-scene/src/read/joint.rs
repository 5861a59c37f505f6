//! `[[joint]]`.

use crate::read::fields::{Fields, Read};
use mbs_core::scene::{Body, BodyId, Dimension, Joint, JointKind, JointLimits, Number};

const KEYS: [&str; 8] = ["name", "kind", "bodies", "at", "axis", "axes", "points", "direction"];
/// Keys that every joint may have; the check says which have no meaning.
const LIMITS: [&str; 3] = ["range", "effort_limit", "velocity_limit"];

/// Reads a joint; a free one is placed at the centre of mass of one of the bodies by default.
pub(crate) fn read(fields: &Fields<'_>, known: &[Body<Number>]) -> Read<Joint<Number>> {
    let kind = read_kind(fields)?;
    let dimension = fields.context.dimension;
    // Spatial kinds keep their axes in planar scenes: the check speaks about the kind, which is the fault there.
    let needed = kind.needs_axes(dimension);
    let axis_keys = kind.axis_keys(dimension);
    let has_hinge = kind.is_link() && dimension == Dimension::Spatial;
    let place = if kind.is_link() { "points" } else { "at" };
    let mut keys = vec!["name", "kind", "bodies", place];
    keys.extend((0..2).filter(|&i| needed[i] || has_hinge && i == 0).map(|i| axis_keys[i]));
    keys.dedup();
    keys.extend(LIMITS);
    fields.allow(&keys, &KEYS)?;
    let bodies = fields.pair()?;
    let kind = kind_between(kind, bodies, known);
    let points = if kind.is_link() {
        fields.two_vectors("points")?
    } else {
        let at = match default_place(kind, bodies, known) {
            Some(center) if fields.get("at").is_none() => center,
            _ => fields.vector("at")?,
        };
        [at.clone(), at]
    };
    let axes = if axis_keys == ["axes"; 2] {
        fields.two_vectors("axes")?.map(Some)
    } else {
        for i in (0..2).filter(|&i| needed[i]) {
            fields.need(axis_keys[i])?;
        }
        let vector =
            |key: &str| fields.get(key).map(|item| fields.context.vector(item)).transpose();
        [vector("axis")?, vector("direction")?]
    };
    Ok(Joint { name: fields.name()?, kind, bodies, points, axes, limits: read_limits(fields)? })
}

/// The free joint from the ground by which a body is guided, at its centre of mass or `at`; it has the body's name.
pub(crate) fn read_of_guided_body(
    fields: &Fields<'_>,
    known: &[Body<Number>],
) -> Read<Option<Joint<Number>>> {
    let Some(item) = fields.get("body") else { return Ok(None) };
    let body = fields.context.moving_body(item)?;
    let bodies = [BodyId::Ground, body];
    let kind = kind_between(JointKind::Free, bodies, known);
    let at = match default_place(kind, bodies, known) {
        Some(center) if fields.get("at").is_none() => center,
        _ => fields.vector("at")?,
    };
    Ok(Some(Joint {
        name: fields.context.text(item)?.to_owned(),
        kind,
        bodies,
        points: [at.clone(), at],
        axes: [None, None],
        limits: JointLimits::NONE,
    }))
}

fn read_limits(fields: &Fields<'_>) -> Read<JointLimits<Number>> {
    let range = |item| fields.context.numbers_of(item, "a list of two numbers: [lower, upper]");
    Ok(JointLimits {
        range: fields.get("range").map(range).transpose()?,
        effort: fields.optional("effort_limit")?,
        velocity: fields.optional("velocity_limit")?,
    })
}

fn read_kind(fields: &Fields<'_>) -> Read<JointKind> {
    let word = fields.word("kind")?;
    match JointKind::ALL.into_iter().find(|kind| kind.name() == word.0) {
        Some(kind) => Ok(kind),
        None => fields.unknown_word("kind", word, &JointKind::ALL.map(JointKind::name)),
    }
}

/// The kind that a joint is between these bodies: a free one of a point mass does not turn.
fn kind_between(kind: JointKind, bodies: [BodyId; 2], known: &[Body<Number>]) -> JointKind {
    let is_point = |body: BodyId| body.index().is_some_and(|i| known[i].is_point());
    if bodies.into_iter().any(is_point) { kind.of_points() } else { kind }
}

/// A free joint speaks about the centre of mass of the second body, or of the first when that is the ground.
fn default_place(
    kind: JointKind,
    bodies: [BodyId; 2],
    known: &[Body<Number>],
) -> Option<[Number; 3]> {
    match bodies {
        [_, BodyId::Body(i)] | [BodyId::Body(i), BodyId::Ground] if kind.is_free() => {
            known.get(i).map(|body| body.center.clone())
        }
        _ => None,
    }
}
