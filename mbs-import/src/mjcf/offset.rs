//! Loops that are open in the drawn configuration. A massless link is added at the pose that closes the loop.

use super::model::{Model, Sort};
use crate::element::Element;
use crate::pose::{M3, V3, direction};
use crate::robot::{Coordinate, Coupling, Joint, Kind, Link, Term};

/// Largest distance [m] and rotation [rad] between two sides that count as coincident in the drawn configuration.
const SLACK: f64 = 1.0e-6;

/// Displacement and rotation (about `place`) from the drawn pose of the second side to the pose at which the first side holds it. All are
/// global.
#[derive(Debug, Clone, Copy)]
pub(super) struct Offset {
    pub(super) place: V3,
    pub(super) moved: V3,
    pub(super) turned: M3,
}

/// A link that the first link carries at the offset. When both sides coincide as drawn, no link is added, and the result is the first link.
pub(super) fn carried(
    name: &str,
    element: &Element,
    first: usize,
    offset: &Offset,
    model: &mut Model<'_, '_, '_>,
) -> usize {
    let mut link = first;
    let turn = V3::from(super::keyframe::vector_of(&offset.turned));
    if offset.moved.amax().max(turn.amax()) > SLACK {
        model.is_open = true;
        let says = "open as the model stands: it closes at the start, by the smallest motion (--key takes a keyframe that closes it)";
        model.context.findings.approximated(element.at, element.label(), says);
    }
    let step = Step { name, element, place: offset.place };
    if let Some(axis) = direction(&offset.moved).filter(|_| offset.moved.amax() > SLACK) {
        let distance = offset.moved.dot(&axis);
        link = step.add("slide", Kind::Prismatic, link, (axis, distance), model);
    }
    if let Some(axis) = direction(&turn).filter(|_| turn.amax() > SLACK) {
        let angle = turn.dot(&axis);
        link = step.add("turn", Kind::Revolute, link, (axis, angle), model);
    }
    link
}

/// Name, element and place of the joints that one offset consists of.
struct Step<'a> {
    name: &'a str,
    element: &'a Element,
    place: V3,
}

impl Step<'_> {
    /// Adds a massless link, on a joint whose coordinate is held constant.
    fn add(
        &self,
        word: &str,
        kind: Kind,
        parent: usize,
        (axis, value): (V3, f64),
        model: &mut Model<'_, '_, '_>,
    ) -> usize {
        let name = format!("{} {word}", self.name);
        let link = model.robot.links.len();
        let own = model.free_name(Sort::Link, &name);
        let pose = model.robot.links[parent].pose;
        model.robot.links.push(Link { pose, ..Link::new(&own, self.element.at) });
        let number = model.robot.joints.len();
        let own = model.free_name(Sort::Joint, &name);
        let mut joint = Joint::new(&own, self.element.at, kind, [parent, link], self.place);
        joint.axes = vec![axis];
        model.robot.joints.push(joint);
        let of = Coordinate { joint: number, number: None };
        let name = model.free_name(Sort::Law, &format!("{name} held"));
        model.robot.couplings.push(Coupling { name, terms: vec![Term::new(of, 1.0)], value });
        link
    }
}
