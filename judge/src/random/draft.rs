//! A random scene while its parts are drawn.

use crate::scene::{Carrier, Kind};
use crate::vector::Vector;

/// Standard gravity g [m/s²]. A length L has the time scale sqrt(L/g).
pub(crate) const GRAVITY: f64 = 9.81;

/// A random scene while its parts are drawn.
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
    /// Signals of the scene as text. The Boolean says whether the signal's rate is an output.
    pub(crate) signals: Vec<(String, bool)>,
    /// Contacts of rolling bodies and of blades, as text.
    pub(crate) rollings: Vec<String>,
    /// Effects, roads and velocities of bodies, as text.
    pub(crate) blocks: Vec<String>,
    /// The largest of the drawn frequencies, in radians per time scale.
    pub(crate) stiffest: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub(crate) mass: f64,
    pub(crate) center: Vector,
    pub(crate) inertia: [f64; 6],
    pub(crate) rod: Option<[Vector; 2]>,
    /// A point of the body whose motion is an output.
    pub(crate) mark: Vector,
    /// The parent of the body in the tree.
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
    /// True if the joint belongs to a closed loop.
    pub(crate) looped: bool,
    /// True if a coupling or a rolling contact constrains the joint.
    pub(crate) coupled: bool,
}
