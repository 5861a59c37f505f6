//! The recorded motion of the bodies of a run, and the shapes to draw: plain data.

use mbs_core::Real;
use mbs_core::scene::{Body, Scene};
use serde::Serialize;

/// Number of values of a pose: three for the position of the centre of mass [m], and four for a unit quaternion. The quaternion (w, x, y,
/// z) is the rotation from the reference configuration.
pub const N_POSE: usize = 7;

/// Motion of all bodies over time, and the shapes to draw.
///
/// Points on a body are relative to its centre of mass, in the global axes of the reference configuration. Points on the ground are global.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordedMotion {
    /// Dimension of the scene, 2 or 3; the third component of a planar point is zero.
    pub dimension: usize,
    /// Upward direction in the picture of a spatial scene; a zero vector means +z.
    pub up: [f64; 3],
    /// Length of the scene [m], which determines the size of symbols.
    pub length: f64,
    /// Times of the frames [s].
    pub times: Vec<f64>,
    /// Poses of all bodies, frame by frame, with [`N_POSE`] values for each body.
    pub poses: Vec<f64>,
    /// The bodies, in file order.
    pub bodies: Vec<DrawnBody>,
    /// Shapes on bodies and on the ground.
    pub shapes: Vec<DrawnShape>,
    /// Lines between points on bodies.
    pub lines: Vec<DrawnLine>,
    /// Points whose paths are drawn.
    pub traces: Vec<DrawnPoint>,
    /// Positions of the joints, for labels.
    pub joints: Vec<DrawnPoint>,
    /// Points at which measured forces and moments act, with the names of the outputs.
    pub forces: Vec<DrawnForce>,
    /// Surface of the road under tires.
    pub road: Option<DrawnRoad>,
}

impl RecordedMotion {
    /// Name of the body whose pose in the first frame differs most from the reference configuration. Displacements [m] and rotations [rad]
    /// are compared as numbers.
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

/// Body of a picture, with its name and mass.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DrawnBody {
    /// Name of the body, as in the scene.
    pub name: String,
    /// Mass of the body [kg].
    pub mass: f64,
}

/// Point of a body, or of the ground.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct BodyPlace {
    /// Index of the body; `None`: the ground.
    pub body: Option<usize>,
    /// Position of the point [m]. On a body it is relative to the centre of mass in the reference configuration, on the ground it is
    /// global.
    pub at: [f64; 3],
}

/// Point with a name.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DrawnPoint {
    /// Name of the point.
    pub name: String,
    /// Position on a body, or on the ground.
    #[serde(flatten)]
    pub place: BodyPlace,
}

/// Point at which a measured force acts, with the name of the output.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DrawnForce {
    /// Name of the output, and the point of the force.
    #[serde(flatten)]
    pub point: DrawnPoint,
    /// Index of the body in whose axes the components of the force are; `None`: they are in global axes.
    pub axes: Option<usize>,
}

/// Shape that is fixed to a body or to the ground.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnShape {
    /// Index of the body; `None`: the ground.
    pub body: Option<usize>,
    /// Form of the shape.
    #[serde(flatten)]
    pub form: ShapeForm,
    /// Colour of the shape, `#rrggbb`; `None`: the colour of its body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<String>,
    /// Opacity from 0 (invisible) to 1 [-].
    pub opacity: f64,
    /// True for a shape that replaces a mesh. It is drawn only if no mesh file of the body can be read.
    #[serde(skip)]
    pub stands_in: bool,
}

impl DrawnShape {
    /// Creates a shape in the colour of its body.
    pub fn new(body: Option<usize>, form: ShapeForm) -> Self {
        Self { body, form, colour: None, opacity: 1.0, stands_in: false }
    }
}

/// Geometric forms of shapes; all lengths in m.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "form", rename_all = "kebab-case")]
pub enum ShapeForm {
    /// Cylinder between two points.
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
        /// True if the box must be drawn transparent, to show something inside it.
        is_clear: bool,
    },
    /// Cylinder with round ends between two points.
    Capsule {
        /// One end of the cylinder.
        from: [f64; 3],
        /// Other end of the cylinder.
        to: [f64; 3],
        /// Radius of the capsule.
        radius: f64,
        /// True if the capsule must be drawn transparent, to show something inside it.
        is_clear: bool,
    },
    /// Ball, which may have marks on its surface that show its rotation.
    Ball {
        /// Centre of the ball.
        at: [f64; 3],
        /// Radius of the ball.
        radius: f64,
        /// True if the ball has marks.
        turns: bool,
    },
    /// Thin bar between two points.
    Stroke {
        /// One end of the bar.
        from: [f64; 3],
        /// Other end of the bar.
        to: [f64; 3],
    },
    /// Surface of triangles, from a file that the HTML page reads.
    Mesh {
        /// File of the surface.
        #[serde(skip)]
        file: String,
        /// Position of the mesh's origin.
        at: [f64; 3],
        /// Axes of the mesh, each multiplied by its scale factor.
        axes: [[f64; 3]; 3],
    },
    /// Flat polygon, perpendicular to z.
    Polygon {
        /// Corners of the polygon.
        points: Vec<[f64; 3]>,
    },
    /// Wheel, disc or gear.
    Wheel {
        /// Centre of the wheel.
        at: [f64; 3],
        /// Axis of the wheel, a unit vector.
        axis: [f64; 3],
        /// Radius of the wheel.
        radius: f64,
        /// Width of the wheel.
        width: f64,
        /// True if the rim has marks.
        turns: bool,
    },
    /// Axis of a revolute joint.
    Pin {
        /// Position of the pin.
        at: [f64; 3],
        /// Axis of the pin, a unit vector.
        axis: [f64; 3],
    },
    /// Socket of a ball joint.
    Socket {
        /// Position of the socket.
        at: [f64; 3],
    },
    /// Straight rail through a point. It is drawn so long that the sliding point always remains on it.
    Rail {
        /// Point on the rail.
        at: [f64; 3],
        /// Direction of the rail, a unit vector.
        axis: [f64; 3],
        /// Point on the body that slides along the rail.
        slider: BodyPlace,
    },
    /// Block that slides on a rail.
    Block {
        /// Position of the block.
        at: [f64; 3],
        /// The rail's direction, a unit vector.
        axis: [f64; 3],
    },
    /// Rubber ring of a bushing.
    Ring {
        /// Position of the ring.
        at: [f64; 3],
    },
    /// Symbol of the ground at a joint.
    Support {
        /// Position of the symbol.
        at: [f64; 3],
    },
    /// Plane on which bodies roll.
    Plane {
        /// A point in the plane.
        at: [f64; 3],
        /// Normal of the plane, a unit vector.
        axis: [f64; 3],
        /// Point on the body that rolls on the plane.
        slider: BodyPlace,
    },
}

/// Line between points on bodies, straight from each point to the next.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnLine {
    /// Name of the effect, joint or coupling.
    pub name: String,
    /// Style in which the line is drawn.
    pub style: LineStyle,
    /// The points of the line, two or more.
    pub places: Vec<BodyPlace>,
}

/// Style in which a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineStyle {
    /// A spring, drawn as a coil.
    Coil,
    /// A damper, drawn as a cylinder.
    Damper,
    /// A coil spring with a damper inside.
    CoilDamper,
    /// A bumper, drawn as a stop.
    Bumper,
    /// A force element between two points.
    Actuator,
    /// A bar of constant length.
    Link,
    /// A rope through all points.
    Rope,
}

/// Surface of a road along x.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DrawnRoad {
    /// Position of the first point along x [m].
    pub start: f64,
    /// Distance between successive points along x [m].
    pub spacing: f64,
    /// Strips next to each other along y.
    pub strips: Vec<RoadStrip>,
    /// Speed at which the road moves in direction -x [m/s].
    pub speed: f64,
}

/// A strip of a road.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoadStrip {
    /// Positions of both sides of the strip along y [m].
    pub sides: [f64; 2],
    /// Heights of the road at the points along x [m].
    pub heights: Vec<f64>,
}

impl RecordedMotion {
    /// Returns the position of a point in a recorded frame [m]; `None` if the frame or the body does not exist.
    #[must_use]
    pub fn place(&self, picture: usize, place: &BodyPlace) -> Option<[f64; 3]> {
        let Some(body) = place.body else { return Some(place.at) };
        let n = self.bodies.len() * N_POSE;
        let pose = self.poses.get(picture * n..)?.get(body * N_POSE..)?.get(..N_POSE)?;
        let (center, q) = (&pose[..3], &pose[3..]);
        // Rotation of `at` by the quaternion (w, r): at + 2 r x (r x at + w at).
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let (w, r, at) = (q[0], [q[1], q[2], q[3]], place.at);
        let first = cross(r, at);
        let second = cross(r, [0, 1, 2].map(|i| first[i] + w * at[i]));
        Some([0, 1, 2].map(|i| center[i] + at[i] + 2.0 * second[i]))
    }
}
