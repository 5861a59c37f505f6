//! Joints that a coupling names, and the coordinates of them that its kind uses.

use crate::read::ReadFault;
use crate::read::error::NAMED;
use crate::read::fields::{Fields, Read};
use crate::read::tree::Item;
use mbs_core::scene::{CouplingMeasure, CouplingTerm, Freedom, Joint, JointId, Number};

/// Coordinate of a joint that a kind of coupling uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Needed {
    /// The only rotation of the joint about an axis.
    Turn,
    /// The only translation of the joint.
    Slide,
    /// The only coordinate of the joint.
    Only,
    /// The only coordinate of the joint, or one of several that a key names.
    Named,
}

/// A joint, with the value in the file that names it.
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

    /// Number of the coordinate, from 0. The number is 0 for a joint that has no coordinate about or along an axis. The check of the scene
    /// refuses such a joint later.
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

    /// A term: the coordinate, multiplied by a factor.
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

    /// A term: the rotation of the joint, multiplied by a factor.
    pub(super) fn turn(&self, fields: &Fields<'a>, factor: Number) -> Read<CouplingTerm<Number>> {
        self.term(fields, Needed::Turn, factor)
    }
}
