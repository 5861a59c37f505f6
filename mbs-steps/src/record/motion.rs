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
    /// Dimension of the scene, 2 or 3; planar places have a third number zero.
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
    /// Shapes on bodies and on the ground.
    pub shapes: Vec<DrawnShape>,
    /// Lines between places on bodies.
    pub lines: Vec<DrawnLine>,
    /// Points whose path is drawn.
    pub traces: Vec<DrawnPoint>,
    /// Places of the joints, for labels.
    pub joints: Vec<DrawnPoint>,
    /// Places where forces and moments act that outputs measure, by the names of the outputs.
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
    /// Name of the body.
    pub name: String,
    /// Mass of the body [kg].
    pub mass: f64,
}

/// A place on a body; on the ground without one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct BodyPlace {
    /// Number of the body.
    pub body: Option<usize>,
    /// Place from the body's centre of mass in the reference configuration; on the ground from the global origin [m].
    pub at: [f64; 3],
}

/// A place with a name.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DrawnPoint {
    /// Name of the place.
    pub name: String,
    /// Place on a body, or on the ground.
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
    /// Form of the shape.
    #[serde(flatten)]
    pub form: ShapeForm,
    /// Colour of the shape, `#rrggbb`; none: that of its body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<String>,
    /// Opacity from 0, not seen, to 1 [-].
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
        /// One end of the rod.
        from: [f64; 3],
        /// Other end of the rod.
        to: [f64; 3],
        /// Radius of the rod.
        radius: f64,
    },
    /// Box, by its centre, half lengths and axes.
    Box {
        /// Centre of the box.
        at: [f64; 3],
        /// Half lengths along its axes.
        half: [f64; 3],
        /// Axes of the box, as unit vectors.
        axes: [[f64; 3]; 3],
        /// Is something of interest inside it?
        is_clear: bool,
    },
    /// A cylinder with round ends between two places.
    Capsule {
        /// One end of the cylinder.
        from: [f64; 3],
        /// Other end of the cylinder.
        to: [f64; 3],
        /// Radius of the capsule.
        radius: f64,
        /// Is something of interest inside it?
        is_clear: bool,
    },
    /// Ball, with marks where it shows that it turns.
    Ball {
        /// Centre of the ball.
        at: [f64; 3],
        /// Radius of the ball.
        radius: f64,
        /// Has the ball marks?
        turns: bool,
    },
    /// A thin bar between two places.
    Stroke {
        /// One end of the bar.
        from: [f64; 3],
        /// Other end of the bar.
        to: [f64; 3],
    },
    /// A surface of triangles, from a file that the page reads.
    Mesh {
        /// File of the surface.
        #[serde(skip)]
        file: String,
        /// Place of the mesh's origin.
        at: [f64; 3],
        /// Axes of the mesh, times the factors of its numbers.
        axes: [[f64; 3]; 3],
    },
    /// A flat polygon across z.
    Polygon {
        /// Corners of the polygon.
        points: Vec<[f64; 3]>,
    },
    /// A wheel, a disc or a gear.
    Wheel {
        /// Centre of the wheel.
        at: [f64; 3],
        /// Axis of the wheel, a unit vector.
        axis: [f64; 3],
        /// Radius of the wheel.
        radius: f64,
        /// Width of the wheel.
        width: f64,
        /// Has its rim marks?
        turns: bool,
    },
    /// The axis of a revolute joint.
    Pin {
        /// Place of the pin.
        at: [f64; 3],
        /// Axis of the pin, a unit vector.
        axis: [f64; 3],
    },
    /// Socket of a ball joint.
    Socket {
        /// Place of the socket.
        at: [f64; 3],
    },
    /// A straight guide through a place; it is as long as the other place goes along it.
    Rail {
        /// Place on the rail.
        at: [f64; 3],
        /// Direction of the rail, a unit vector.
        axis: [f64; 3],
        /// Place on the body that slides along the rail.
        slider: BodyPlace,
    },
    /// A block that slides on a rail.
    Block {
        /// Place of the block.
        at: [f64; 3],
        /// The rail's direction, a unit vector.
        axis: [f64; 3],
    },
    /// A rubber ring of a bushing.
    Ring {
        /// Place of the ring.
        at: [f64; 3],
    },
    /// A mark of the ground at a joint.
    Support {
        /// Place of the mark.
        at: [f64; 3],
    },
    /// A plane on which bodies roll.
    Plane {
        /// A place in it.
        at: [f64; 3],
        /// Normal of the plane, a unit vector.
        axis: [f64; 3],
        /// Place on the body that rolls on the plane.
        slider: BodyPlace,
    },
}

/// Something between places on bodies, straight from each to the next.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnLine {
    /// Name of the effect, joint or coupling.
    pub name: String,
    /// Style in which the line is drawn.
    pub style: LineStyle,
    /// The places, two or more.
    pub places: Vec<BodyPlace>,
}

/// Style in which a line is drawn.
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
    /// Strips side by side across y, with their sides and the heights at the places [m].
    pub strips: Vec<RoadStrip>,
    /// Speed along -x [m/s].
    pub speed: f64,
}

/// A strip of a road.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoadStrip {
    /// Two sides of the strip, along y [m].
    pub sides: [f64; 2],
    /// Heights at the places [m].
    pub heights: Vec<f64>,
}

impl RecordedMotion {
    /// Returns where a place is in a picture [m]; `None`: there is no such picture or body.
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
