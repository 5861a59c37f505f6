//! Names of bodies and joints.

use crate::node::{Node, Read, Table, fault};
use crate::scene::Carrier;

/// Names of bodies and joints.
pub(crate) struct Names {
    pub(crate) bodies: Vec<String>,
    pub(crate) joints: Vec<String>,
}

impl Names {
    pub(crate) fn body(&self, name: &str) -> Read<usize> {
        self.bodies
            .iter()
            .position(|n| n == name)
            .map_or_else(|| fault(format!("no body `{name}`")), Ok)
    }

    pub(crate) fn carrier(&self, name: &str) -> Read<Carrier> {
        if name == "ground" { Ok(None) } else { self.body(name).map(Some) }
    }

    pub(crate) fn joint(&self, name: &str) -> Read<usize> {
        self.joints
            .iter()
            .position(|n| n == name)
            .map_or_else(|| fault(format!("no joint `{name}`")), Ok)
    }

    pub(crate) fn pair(&self, table: &mut Table) -> Read<[Carrier; 2]> {
        match table.need("bodies")?.list()? {
            [Node::Text(a), Node::Text(b)] => Ok([self.carrier(a)?, self.carrier(b)?]),
            other => fault(format!("not two bodies: {other:?}")),
        }
    }
}
