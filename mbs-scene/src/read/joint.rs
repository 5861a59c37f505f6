//! `[[joint]]`.

use crate::read::fields::{Fields, Read};
use mbs_core::scene::{BodyId, Joint, JointKind, Number};

const KEYS: [&str; 8] = ["name", "kind", "bodies", "at", "axis", "axes", "points", "direction"];

/// Reads a joint; `centers` are the bodies' centres of mass, where a free joint is placed by default.
pub(crate) fn read(fields: &Fields<'_>, centers: &[[Number; 3]]) -> Read<Joint<Number>> {
    let kind = read_kind(fields)?;
    let geometry = geometry_keys(kind, fields.context.is_planar());
    let known = [&["name", "kind", "bodies"], geometry].concat();
    fields.allow(&known, &KEYS)?;
    let bodies = fields.pair()?;
    let points = if kind == JointKind::Distance {
        fields.two_vectors("points")?
    } else {
        let at = match default_place(kind, bodies, centers) {
            Some(center) if fields.get("at").is_none() => center,
            _ => fields.vector("at")?,
        };
        [at.clone(), at]
    };
    let vector = |key: &str| fields.get(key).map(|item| fields.context.vector(item)).transpose();
    let axes = if kind == JointKind::Universal {
        fields.two_vectors("axes")?.map(Some)
    } else {
        for key in geometry.iter().filter(|key| ["axis", "direction"].contains(*key)) {
            if kind != JointKind::Distance {
                fields.need(key)?;
            }
        }
        [vector("axis")?, vector("direction")?]
    };
    Ok(Joint { name: fields.name()?, kind, bodies, points, axes })
}

fn read_kind(fields: &Fields<'_>) -> Read<JointKind> {
    let word = fields.word("kind")?;
    match JointKind::ALL.into_iter().find(|kind| kind.name() == word.0) {
        Some(kind) => Ok(kind),
        None => fields.unknown_word("kind", word, &JointKind::ALL.map(JointKind::name)),
    }
}

/// The keys that say where a joint is. Spatial kinds keep theirs in planar scenes: the check speaks about the
/// kind, which is the fault there.
fn geometry_keys(kind: JointKind, is_planar: bool) -> &'static [&'static str] {
    match kind {
        JointKind::Revolute if is_planar => &["at"],
        JointKind::Revolute | JointKind::Prismatic | JointKind::Cylindrical => &["at", "axis"],
        JointKind::Universal => &["at", "axes"],
        JointKind::Planar => &["at", "axis", "direction"],
        JointKind::Distance if is_planar => &["points"],
        JointKind::Distance => &["points", "axis"],
        JointKind::Spherical | JointKind::Weld | JointKind::Free => &["at"],
    }
}

/// A free joint speaks about the centre of mass of the second body, or of the first when that is the ground.
fn default_place(
    kind: JointKind,
    bodies: [BodyId; 2],
    centers: &[[Number; 3]],
) -> Option<[Number; 3]> {
    match (kind, bodies) {
        (JointKind::Free, [_, BodyId::Body(i)] | [BodyId::Body(i), BodyId::Ground]) => {
            centers.get(i).cloned()
        }
        _ => None,
    }
}
