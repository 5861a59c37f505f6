//! Coordinates of a file in its own order, and where they are in the scene.

/// Kind of motion that a coordinate of a file has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileMotion {
    /// A hinge or a slide: one number.
    Single,
    /// A ball: a quaternion, and an angular velocity in axes of the body.
    Ball,
    /// A free body: a global place and a quaternion; a global velocity, and an angular velocity in axes of the body.
    Free,
}

/// A joint of a file, in the order in which its states have numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct FileCoordinate {
    /// Kind of motion of the joint.
    pub motion: FileMotion,
    /// The joint of the scene.
    pub joint: String,
    /// Number of the first coordinate among those of the joint.
    pub number: usize,
    /// Sign of a single coordinate: the scene's value is `sign` (value − `zero`) [-].
    pub sign: f64,
    /// The file's value in the reference configuration [rad or m].
    pub zero: f64,
    /// Place of the body as it is drawn, global [m].
    pub at: [f64; 3],
    /// Axes of the body as it is drawn, as columns, global.
    pub turn: [[f64; 3]; 3],
}
