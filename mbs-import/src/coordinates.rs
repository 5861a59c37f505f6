//! Coordinates in the order of the file, with their places in the scene.

/// Kind of motion of a joint of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileMotion {
    /// A hinge or a slide, with one coordinate.
    Single,
    /// A ball joint: its position is a quaternion, its velocity an angular velocity in axes of the body.
    Ball,
    /// A free body: its position is a global point and a quaternion. Its velocity is a global velocity and an angular velocity in axes of
    /// the body.
    Free,
}

/// A joint of the file, in the order of the file's position and velocity vectors.
#[derive(Debug, Clone, PartialEq)]
pub struct FileCoordinate {
    /// Kind of motion of the joint.
    pub motion: FileMotion,
    /// Name of the joint in the scene.
    pub joint: String,
    /// Index of the first coordinate of this joint among the coordinates of the scene's joint.
    pub number: usize,
    /// Sign of a single coordinate: the scene's value is `sign` (value − `zero`) [-].
    pub sign: f64,
    /// Coordinate of the file in the reference configuration [rad or m].
    pub zero: f64,
    /// Origin of the body as the model is drawn, in global axes [m].
    pub at: [f64; 3],
    /// Axes of the body as the model is drawn, as columns in global axes.
    pub turn: [[f64; 3]; 3],
}
