//! Loops that a file closes by a common point of two links.

use crate::element::Element;
use crate::pose::V3;
use crate::robot::{Joint, Kind};
use crate::source::Read;

/// Largest distance between the two points of a closed loop [m]. Published poses have six digits.
pub(crate) const CLOSED: f64 = 1.0e-5;

/// A ball joint at two points that coincide when all joints are at zero.
pub(crate) fn ball(name: &str, element: &Element, [a, b]: [(usize, V3); 2]) -> Read<Joint> {
    let gap = (a.1 - b.1).norm();
    if gap > CLOSED {
        return Err(element.fault(
            format!("the two points are {gap:e} m apart where all joints are at zero"),
            "give poses in which the loop is closed",
        ));
    }
    let joint = Joint::new(name, element.at, Kind::Spherical, [a.0, b.0], a.1);
    Ok(Joint { closes: true, ..joint })
}
