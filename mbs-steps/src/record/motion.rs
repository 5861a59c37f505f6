//! The motion of the bodies of a run, and what is drawn of them: plain data.

use mbs_core::Real;
use mbs_core::scene::{Body, Scene};
use serde::Serialize;

/// Numbers of a pose: the place of the centre of mass [m], then a unit quaternion w, x, y, z of the turn since the reference configuration.
pub const N_POSE: usize = 7;

/// The motion of all bodies over time, and what is drawn of them.
///
/// Places on a body count from its centre of mass, in the global axes of the reference configuration; those of the ground are global.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordedMotion {
    /// 2 or 3; planar places have a third number zero.
    pub dimension: usize,
    /// The direction that points up in the picture of a spatial scene; zero: +z.
    pub up: [f64; 3],
    /// The scene's length [m]: sizes of marks follow from it.
    pub length: f64,
    /// Times of the pictures [s].
    pub times: Vec<f64>,
    /// The poses of all bodies, picture by picture: [`N_POSE`] numbers for each body.
    pub poses: Vec<f64>,
    /// The bodies, in file order.
    pub bodies: Vec<DrawnBody>,
    /// What is drawn on bodies and on the ground.
    pub shapes: Vec<DrawnShape>,
    /// What is drawn between places on bodies.
    pub lines: Vec<DrawnLine>,
    /// Points whose path is drawn.
    pub traces: Vec<DrawnPoint>,
    /// Joints, for labels.
    pub joints: Vec<DrawnPoint>,
    /// Where forces and moments act that outputs measure, by the names of the outputs.
    pub forces: Vec<DrawnForce>,
    /// The road under tires.
    pub road: Option<DrawnRoad>,
}

impl RecordedMotion {
    /// The name of the body that is farthest from its reference configuration in the first picture, by its way [m] or turn [rad].
    pub fn most_moved<T: Real>(&self, scene: &Scene<T>) -> Option<&str> {
        let moved = |(pose, body): (&[f64], &Body<T>)| {
            let ways = pose[..3].iter().zip(body.center).map(|(x, c)| x - c.to_f64());
            let way = ways.map(|way| way * way).sum::<f64>();
            let turn = 2.0 * pose[3].abs().min(1.0).acos();
            way.sqrt().max(turn)
        };
        let poses = self.poses.chunks_exact(N_POSE).zip(&scene.bodies).map(moved);
        let (_, body) = poses.zip(&self.bodies).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(&body.name)
    }
}

/// A body of a picture.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DrawnBody {
    /// Its name.
    pub name: String,
    /// Its mass [kg].
    pub mass: f64,
}

/// A place on a body; on the ground without one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct BodyPlace {
    /// Number of the body.
    pub body: Option<usize>,
    /// Where [m].
    pub at: [f64; 3],
}

/// A place with a name.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DrawnPoint {
    /// Its name.
    pub name: String,
    /// Where it is.
    #[serde(flatten)]
    pub place: BodyPlace,
}

/// A place where a force acts that an output measures, by its name.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DrawnForce {
    /// The output, and where the force acts.
    #[serde(flatten)]
    pub point: DrawnPoint,
    /// Number of the body in whose axes its components are; none: global axes.
    pub axes: Option<usize>,
}

/// A shape that moves with a body, or stands on the ground.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnShape {
    /// Number of the body; none: the ground.
    pub body: Option<usize>,
    /// The shape.
    #[serde(flatten)]
    pub form: ShapeForm,
    /// Its colour, `#rrggbb`; none: that of its body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<String>,
    /// From 0, not seen, to 1 [-].
    pub opacity: f64,
    /// Is it drawn only where no file of its body's meshes can be read?
    #[serde(skip)]
    pub stands_in: bool,
}

impl DrawnShape {
    /// In the colour of its body.
    pub fn new(body: Option<usize>, form: ShapeForm) -> Self {
        Self { body, form, colour: None, opacity: 1.0, stands_in: false }
    }
}

/// The forms that are drawn; lengths in m.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "form", rename_all = "kebab-case")]
pub enum ShapeForm {
    /// A cylinder between two places.
    Rod {
        /// One end.
        from: [f64; 3],
        /// The other end.
        to: [f64; 3],
        /// Its radius.
        radius: f64,
    },
    /// A box.
    Box {
        /// Its centre.
        at: [f64; 3],
        /// Half lengths along its axes.
        half: [f64; 3],
        /// Its axes, as unit vectors.
        axes: [[f64; 3]; 3],
        /// Is something of interest inside it?
        is_clear: bool,
    },
    /// A cylinder with round ends between two places.
    Capsule {
        /// One end of the cylinder.
        from: [f64; 3],
        /// The other end.
        to: [f64; 3],
        /// Its radius.
        radius: f64,
        /// Is something of interest inside it?
        is_clear: bool,
    },
    /// A ball; with marks where it shows that it turns.
    Ball {
        /// Its centre.
        at: [f64; 3],
        /// Its radius.
        radius: f64,
        /// Has it marks?
        turns: bool,
    },
    /// A thin bar between two places.
    Stroke {
        /// One end.
        from: [f64; 3],
        /// The other end.
        to: [f64; 3],
    },
    /// A surface of triangles, from a file that the page reads.
    Mesh {
        /// The file.
        #[serde(skip)]
        file: String,
        /// Where its origin is.
        at: [f64; 3],
        /// Its axes, times the factors of its numbers.
        axes: [[f64; 3]; 3],
    },
    /// A flat polygon across z.
    Polygon {
        /// Its corners.
        points: Vec<[f64; 3]>,
    },
    /// A wheel, a disc or a gear.
    Wheel {
        /// Its centre.
        at: [f64; 3],
        /// Its axis, a unit vector.
        axis: [f64; 3],
        /// Its radius.
        radius: f64,
        /// Its width.
        width: f64,
        /// Has its rim marks?
        turns: bool,
    },
    /// The axis of a revolute joint.
    Pin {
        /// Where.
        at: [f64; 3],
        /// Its axis, a unit vector.
        axis: [f64; 3],
    },
    /// A ball joint.
    Socket {
        /// Where.
        at: [f64; 3],
    },
    /// A straight guide through a place; it is as long as the other place goes along it.
    Rail {
        /// Where.
        at: [f64; 3],
        /// Its direction, a unit vector.
        axis: [f64; 3],
        /// What slides on it.
        slider: BodyPlace,
    },
    /// A block that slides on a rail.
    Block {
        /// Where.
        at: [f64; 3],
        /// The rail's direction, a unit vector.
        axis: [f64; 3],
    },
    /// A rubber ring of a bushing.
    Ring {
        /// Where.
        at: [f64; 3],
    },
    /// A mark of the ground at a joint.
    Support {
        /// Where.
        at: [f64; 3],
    },
    /// A plane on which bodies roll.
    Plane {
        /// A place in it.
        at: [f64; 3],
        /// Its normal, a unit vector.
        axis: [f64; 3],
        /// What rolls on it.
        slider: BodyPlace,
    },
}

/// Something between places on bodies, straight from each to the next.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnLine {
    /// Name of the effect, joint or coupling.
    pub name: String,
    /// How it is drawn.
    pub style: LineStyle,
    /// The places, two or more.
    pub places: Vec<BodyPlace>,
}

/// How lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineStyle {
    /// A spring.
    Coil,
    /// A damper.
    Damper,
    /// A spring with a damper in it.
    CoilDamper,
    /// A bumper.
    Bumper,
    /// A force between two places.
    Actuator,
    /// A bar of constant length.
    Link,
    /// A rope.
    Rope,
}

/// The surface of a road along x.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DrawnRoad {
    /// The first place [m].
    pub start: f64,
    /// Distance of the places [m].
    pub spacing: f64,
    /// Strips across y: from, to, and the heights at the places [m].
    pub strips: Vec<RoadStrip>,
    /// Speed along -x [m/s].
    pub speed: f64,
}

/// A strip of a road.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoadStrip {
    /// Its two sides [m].
    pub sides: [f64; 2],
    /// Heights at the places [m].
    pub heights: Vec<f64>,
}

impl RecordedMotion {
    /// Where a place is in a picture [m]; `None`: there is no such picture or body.
    #[must_use]
    pub fn place(&self, picture: usize, place: &BodyPlace) -> Option<[f64; 3]> {
        let Some(body) = place.body else { return Some(place.at) };
        let n = self.bodies.len() * N_POSE;
        let pose = self.poses.get(picture * n..)?.get(body * N_POSE..)?.get(..N_POSE)?;
        let (center, q) = (&pose[..3], &pose[3..]);
        // u = at + 2 r x (r x at + w at)
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let (w, r, at) = (q[0], [q[1], q[2], q[3]], place.at);
        let first = cross(r, at);
        let second = cross(r, [0, 1, 2].map(|i| first[i] + w * at[i]));
        Some([0, 1, 2].map(|i| center[i] + at[i] + 2.0 * second[i]))
    }
}
