//! A scene in the making.

use crate::scene::{Carrier, Kind};
use crate::vector::Vector;

/// Standard gravity, which makes times of lengths [m/s²].
pub(crate) const GRAVITY: f64 = 9.81;

/// A scene in the making.
#[derive(Debug, Clone, Default)]
pub(crate) struct Draft {
    pub(crate) planar: bool,
    pub(crate) length: f64,
    pub(crate) time: f64,
    pub(crate) mass: f64,
    pub(crate) duration: f64,
    pub(crate) gravity: Option<Vector>,
    pub(crate) bodies: Vec<Part>,
    pub(crate) links: Vec<Link>,
    /// Kinds of couplings, with their text.
    pub(crate) couplings: Vec<(String, String)>,
    /// Signals as text, each with whether its rate is shown.
    pub(crate) signals: Vec<(String, bool)>,
    /// Contacts that roll, and blades, as text.
    pub(crate) rollings: Vec<String>,
    /// Effects, roads and velocities of bodies, as text.
    pub(crate) blocks: Vec<String>,
    /// The largest of the drawn frequencies, in radians in T.
    pub(crate) stiffest: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub(crate) mass: f64,
    pub(crate) center: Vector,
    pub(crate) inertia: [f64; 6],
    pub(crate) rod: Option<[Vector; 2]>,
    /// A point whose motion is looked at.
    pub(crate) mark: Vector,
    /// The body before it in the tree, with its joint.
    pub(crate) parent: Carrier,
}

#[derive(Debug, Clone)]
pub(crate) struct Link {
    pub(crate) kind: Kind,
    pub(crate) bodies: [Carrier; 2],
    pub(crate) points: [Vector; 2],
    pub(crate) axes: [Vector; 2],
    pub(crate) hinged: bool,
    pub(crate) guide: Option<String>,
    pub(crate) value: Option<Vec<f64>>,
    pub(crate) rate: Option<Vec<f64>>,
    /// Does it take part in a loop?
    pub(crate) looped: bool,
    /// Does a coupling or what rolls hold it?
    pub(crate) coupled: bool,
}
