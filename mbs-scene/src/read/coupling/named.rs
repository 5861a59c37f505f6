//! Joints that a coupling names, and which of their coordinates its kind means.

use crate::read::ReadFault;
use crate::read::error::NAMED;
use crate::read::fields::{Fields, Read};
use crate::read::tree::Item;
use mbs_core::scene::{CouplingMeasure, CouplingTerm, Freedom, Joint, JointId, Number};

/// Coordinate that a kind takes of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Needed {
    /// The one turn of the joint about an axis.
    Turn,
    /// The one slide of the joint.
    Slide,
    /// The only coordinate of the joint.
    Only,
    /// The only coordinate of the joint, where a key can name one of several.
    Named,
}

/// A joint, and where it is named.
#[derive(Debug, Clone, Copy)]
pub(super) struct Named<'a> {
    pub(super) id: JointId,
    pub(super) joint: &'a Joint<Number>,
    item: &'a Item,
}

impl<'a> Named<'a> {
    pub(super) fn new(
        fields: &Fields<'a>,
        item: &'a Item,
        joints: &'a [Joint<Number>],
    ) -> Read<Self> {
        let id = fields.context.joint(item)?;
        Ok(Self { id, joint: &joints[id.index()], item })
    }

    /// The number of the coordinate. A joint without one about or along an axis is left to the scene's check.
    pub(super) fn number(&self, fields: &Fields<'a>, needed: Needed) -> Read<usize> {
        let (kind, dimension) = (self.joint.kind, fields.context.dimension);
        let n = kind.n_coordinates(dimension);
        let freedoms = (0..n).filter_map(|k| Some((k, kind.freedom(dimension, k)?)));
        let mut meant = freedoms.clone().filter(|(_, freedom)| match needed {
            Needed::Turn => matches!(freedom, Freedom::Turn(_)),
            Needed::Slide => matches!(freedom, Freedom::Slide(_)),
            Needed::Only | Needed::Named => true,
        });
        match (meant.next(), meant.next(), freedoms.count()) {
            (_, _, 0) => Ok(0),
            (Some((number, _)), None, _) => Ok(number),
            _ => {
                let needed = match needed {
                    Needed::Turn => "turn about an axis",
                    Needed::Slide => "slide",
                    Needed::Only => "coordinate",
                    Needed::Named => NAMED,
                };
                let known = kind.coordinate_names(dimension).map(|(_, name)| name).collect();
                fields.context.fault(&self.item.span, ReadFault::NotOneOf { needed, known })
            }
        }
    }

    /// The coordinate with a factor.
    pub(super) fn term(
        &self,
        fields: &Fields<'a>,
        needed: Needed,
        factor: Number,
    ) -> Read<CouplingTerm<Number>> {
        let of =
            CouplingMeasure::Coordinate { joint: self.id, number: self.number(fields, needed)? };
        Ok(CouplingTerm { factor, of, curve: None })
    }

    /// The turn with a factor.
    pub(super) fn turn(&self, fields: &Fields<'a>, factor: Number) -> Read<CouplingTerm<Number>> {
        self.term(fields, Needed::Turn, factor)
    }
}
