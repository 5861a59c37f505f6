//! Loops that a file closes by two points.

use crate::element::Element;
use crate::pose::V3;
use crate::robot::{Joint, Kind};
use crate::source::Read;

/// Largest gap between the ends of a loop that counts as closed [m]: published poses have six digits.
pub(crate) const CLOSED: f64 = 1.0e-5;

/// A ball at two points that are one where all joints are at zero.
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
