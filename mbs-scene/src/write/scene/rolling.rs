//! Writes the table `[[rolling]]`.

use super::{Keys, Node, WriteError, Writer};
use mbs_core::scene::{Dimension, Number, Rolling, RollingKind};

impl Writer<'_> {
    pub(super) fn rolling(self, rolling: &Rolling<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("name", rolling.name.as_str());
        let (kind, place) = match &rolling.kind {
            RollingKind::Wheel { .. } => ("wheel", "center"),
            RollingKind::Ball { .. } => ("ball", "center"),
            RollingKind::Blade { .. } => ("blade", "at"),
        };
        keys.push("kind", kind);
        keys.push("body", self.body_name(rolling.body)?);
        keys.push(place, self.vector(&rolling.at));
        match &rolling.kind {
            RollingKind::Wheel { axis, .. } if self.scene.dimension == Dimension::Spatial => {
                keys.push("axis", self.vector(axis));
            }
            RollingKind::Blade { direction } => keys.push("direction", self.vector(direction)),
            RollingKind::Wheel { .. } | RollingKind::Ball { .. } => {}
        }
        keys.push_some("radius", rolling.kind.radius());
        keys.push("on", self.body_name(rolling.on)?);
        if let Some(plane) = &rolling.plane {
            let mut inner = Keys::default();
            inner.push("point", self.vector(&plane.point));
            inner.push("normal", self.vector(&plane.normal));
            keys.push("plane", Node::from(inner));
        }
        Ok(keys)
    }
}
