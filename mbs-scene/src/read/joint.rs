//! `[[joint]]`.

use crate::read::fields::{Fields, Read};
use mbs_core::scene::{BodyId, Dimension, Joint, JointKind, JointLimits, Number};

const KEYS: [&str; 8] = ["name", "kind", "bodies", "at", "axis", "axes", "points", "direction"];
/// Keys that every joint may have; the check says which have no meaning.
const LIMITS: [&str; 3] = ["range", "effort_limit", "velocity_limit"];

/// Reads a joint; `centers` are the bodies' centres of mass, where a free joint is placed by default.
pub(crate) fn read(fields: &Fields<'_>, centers: &[[Number; 3]]) -> Read<Joint<Number>> {
    let kind = read_kind(fields)?;
    let dimension = fields.context.dimension;
    // Spatial kinds keep their axes in planar scenes: the check speaks about the kind, which is the fault there.
    let needed = kind.needs_axes(dimension);
    let axis_keys = kind.axis_keys(dimension);
    let has_hinge = kind.is_link() && dimension == Dimension::Spatial;
    let place = if kind.is_link() { "points" } else { "at" };
    let mut known = vec!["name", "kind", "bodies", place];
    known.extend((0..2).filter(|&i| needed[i] || has_hinge && i == 0).map(|i| axis_keys[i]));
    known.dedup();
    known.extend(LIMITS);
    fields.allow(&known, &KEYS)?;
    let bodies = fields.pair()?;
    let points = if kind.is_link() {
        fields.two_vectors("points")?
    } else {
        let at = match default_place(kind, bodies, centers) {
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
    centers: &[[Number; 3]],
) -> Read<Option<Joint<Number>>> {
    let Some(item) = fields.get("body") else { return Ok(None) };
    let body = fields.context.moving_body(item)?;
    let (kind, bodies) = (JointKind::Free, [BodyId::Ground, body]);
    let at = match default_place(kind, bodies, centers) {
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

/// A free joint speaks about the centre of mass of the second body, or of the first when that is the ground.
fn default_place(
    kind: JointKind,
    bodies: [BodyId; 2],
    centers: &[[Number; 3]],
) -> Option<[Number; 3]> {
    match bodies {
        [_, BodyId::Body(i)] | [BodyId::Body(i), BodyId::Ground] if kind.is_free() => {
            centers.get(i).cloned()
        }
        _ => None,
    }
}
