//! Pose of a body from natural coordinates. Two or three directions of the body are made orthogonal and converted to a quaternion.

use mbs_core::Real;
use mbs_core::natural::{Affine, NaturalModel};
use mbs_core::scene::{BodyId, Inertia, Scene};

/// Functions of the coordinates that give the pose of a body.
#[derive(Debug)]
pub(super) struct BodyPose<T: Real, const D: usize> {
    center: Affine<T, D>,
    turn: Turn<T, D>,
}

/// Vectors that determine the rotation of a body.
#[derive(Debug)]
enum Turn<T: Real, const D: usize> {
    /// The body is a point and has no rotation.
    None,
    /// Current directions of the body axes that were the global x and y axes in the reference configuration. In the plane only x is used.
    Axes([Affine<T, D>; 2]),
    /// Rod without spin about its axis: its ends, and its direction in the reference configuration. The smallest rotation between the two
    /// directions is used.
    Line([Affine<T, D>; 2], [f64; 3]),
}

impl<T: Real, const D: usize> BodyPose<T, D> {
    pub(super) fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, body: usize) -> Self {
        let data = &scene.bodies[body];
        let id = BodyId::Body(body);
        let unit = |i: usize| core::array::from_fn(|k| if k == i { T::ONE } else { T::ZERO });
        let turn = match data.inertia {
            Inertia::Point => Turn::None,
            Inertia::Rod { from, to } if !model.has_full_rotation(id) => {
                let along = [0, 1, 2].map(|i| (to[i] - from[i]).to_f64());
                Turn::Line([from, to].map(|end| model.point(id, end)), unit_of(along))
            }
            _ if !model.has_full_rotation(id) => Turn::None,
            _ => Turn::Axes([0, 1].map(|i| model.direction(id, unit(i)))),
        };
        Self { center: model.point(id, data.center), turn }
    }

    /// Position of the centre of mass [m].
    pub(super) fn place(&self, q: &[T]) -> [f64; 3] {
        numbers(&self.center, q)
    }

    /// Rotation from the reference configuration, as a quaternion. Of the two quaternions q and -q, the one closer to `before` is returned.
    pub(super) fn quaternion(&self, q: &[T], before: Option<[f64; 4]>) -> [f64; 4] {
        let turn = match &self.turn {
            Turn::None => [1.0, 0.0, 0.0, 0.0],
            Turn::Axes([x, y]) => {
                // In the plane the y axis is perpendicular to the x axis.
                let x = unit_of(numbers(x, q));
                let y = if D == 2 { [-x[1], x[0], 0.0] } else { numbers(y, q) };
                let z = unit_of(cross(x, y));
                of_axes([x, cross(z, x), z])
            }
            Turn::Line([from, to], reference) => {
                let (from, to) = (numbers(from, q), numbers(to, q));
                smallest(*reference, unit_of([0, 1, 2].map(|i| to[i] - from[i])))
            }
        };
        let is_turned = before.is_some_and(|b| (0..4).map(|i| b[i] * turn[i]).sum::<f64>() < 0.0);
        if is_turned { turn.map(|x| -x) } else { turn }
    }
}

/// Components of a point or a direction; the third one is zero in the plane.
fn numbers<T: Real, const D: usize>(x: &Affine<T, D>, q: &[T]) -> [f64; 3] {
    let x = x.value(q);
    core::array::from_fn(|i| if i < D { x[i].to_f64() } else { 0.0 })
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// Unit vector in the direction of a vector; +z for a zero vector.
pub(super) fn unit_of(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}

/// Orthonormal axes from two vectors: the first axis is along the first vector, and the second axis is in the plane of both vectors.
pub fn frame([first, second]: [[f64; 3]; 2]) -> [[f64; 3]; 3] {
    let x = unit_of(first);
    let along = dot(x, second);
    let y = unit_of([0, 1, 2].map(|i| second[i] - along * x[i]));
    [x, y, cross(x, y)]
}

/// Quaternion of a rotation matrix with these columns. The computation starts from the largest component of the quaternion.
pub fn of_axes([x, y, z]: [[f64; 3]; 3]) -> [f64; 4] {
    let squares = [
        1.0 + x[0] + y[1] + z[2],
        1.0 + x[0] - y[1] - z[2],
        1.0 - x[0] + y[1] - z[2],
        1.0 - x[0] - y[1] + z[2],
    ];
    let largest = (0..4).fold(0, |a, b| if squares[b] > squares[a] { b } else { a });
    let s = 2.0 * squares[largest].sqrt();
    let (a, b, c) = ((y[2] - z[1]) / s, (z[0] - x[2]) / s, (x[1] - y[0]) / s);
    let (d, e, f) = ((x[1] + y[0]) / s, (z[0] + x[2]) / s, (y[2] + z[1]) / s);
    match largest {
        0 => [s / 4.0, a, b, c],
        1 => [a, s / 4.0, d, e],
        2 => [b, d, s / 4.0, f],
        _ => [c, e, f, s / 4.0],
    }
}

/// Quaternion of the smallest rotation from one direction to another.
pub fn smallest(from: [f64; 3], to: [f64; 3]) -> [f64; 4] {
    let w = 1.0 + dot(from, to);
    if w < 1e-12 {
        // Opposite directions need half a turn about any axis perpendicular to them.
        let other = if from[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let axis = unit_of(cross(from, other));
        return [0.0, axis[0], axis[1], axis[2]];
    }
    let [x, y, z] = cross(from, to);
    let size = (w * w + x * x + y * y + z * z).sqrt();
    [w, x, y, z].map(|x| x / size)
}
