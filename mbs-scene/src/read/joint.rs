//! Reads the table `[[joint]]`.

use crate::read::ReadFault;
use crate::read::fields::{Fields, Read};
use mbs_core::scene::{Body, BodyId, Joint, JointKind, JointLimits, Number};

/// Reads a joint of a scene. By default, a free joint is at the centre of mass of one of its bodies.
pub(crate) fn read(fields: &Fields<'_>, known: &[Body<Number>]) -> Read<Joint<Number>> {
    let (word, fields) = &fields.kind()?;
    let Some(kind) = JointKind::ALL.into_iter().find(|kind| kind.name() == *word) else {
        return fields.context.fault(fields.header, ReadFault::Missing { key: "kind" });
    };
    let dimension = fields.context.dimension;
    let (needed, axis_keys) = (kind.needs_axes(dimension), kind.axis_keys(dimension));
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
        [fields.optional_vector("axis")?, fields.optional_vector("direction")?]
    };
    Ok(Joint {
        name: fields.name()?,
        kind,
        bodies,
        points,
        axes,
        limits: read_limits(fields, kind)?,
    })
}

/// The free joint between the ground and a guided body, at the body's centre of mass or at `at`. It has the body's name.
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

fn read_limits(fields: &Fields<'_>, kind: JointKind) -> Read<JointLimits<Number>> {
    // The units are those of the first coordinate. The check of the scene refuses limits for a kind that cannot have any.
    let fields = &fields.about(kind, 0);
    let range = |item| fields.at("range").numbers_of(item, "a list of two numbers: [lower, upper]");
    Ok(JointLimits {
        range: fields.get("range").map(range).transpose()?,
        effort: fields.optional("effort_limit")?,
        velocity: fields.optional("velocity_limit")?,
    })
}

/// The kind of a joint between these bodies: the free joint of a point mass has no rotation.
fn kind_between(kind: JointKind, bodies: [BodyId; 2], known: &[Body<Number>]) -> JointKind {
    let is_point = |body: BodyId| body.index().is_some_and(|i| known[i].is_point());
    if bodies.into_iter().any(is_point) { kind.of_points() } else { kind }
}

/// Default place of a free joint: the centre of mass of the second body, or of the first when the second is the ground.
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
