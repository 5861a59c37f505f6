//! Places and rotations of frames.

use mbs_core::algebra::{Matrix, Vector, along, cross, norm, vector};

/// A vector in space.
pub(crate) type V3 = Vector<f64, 3>;
/// A rotation, or a tensor.
pub(crate) type M3 = Matrix<f64, 3>;

/// Pose of a frame in another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    /// Takes components in the frame to those in the other.
    pub(crate) turn: M3,
    /// The frame's origin in the other.
    pub(crate) at: V3,
}

impl Pose {
    pub(crate) fn identity() -> Self {
        Self { turn: M3::identity(), at: V3::zeros() }
    }

    pub(crate) const fn new(turn: M3, at: V3) -> Self {
        Self { turn, at }
    }

    /// The pose, in the frame in which this one is, of a frame that is `inner` in this one.
    pub(crate) fn then(&self, inner: &Self) -> Self {
        Self { turn: self.turn * inner.turn, at: self.point(&inner.at) }
    }

    /// The other frame as seen from this one.
    pub(crate) fn inverse(&self) -> Self {
        let turn = self.turn.transpose();
        Self { turn, at: -(turn * self.at) }
    }

    /// A point of the frame, in the other.
    pub(crate) fn point(&self, x: &V3) -> V3 {
        self.at + self.turn * x
    }
}

/// The vector of three numbers.
pub(crate) const fn v3(numbers: [f64; 3]) -> V3 {
    vector(numbers)
}

/// The rotation by an angle about an axis of unit length.
pub(crate) fn about(axis: &V3, angle: f64) -> M3 {
    // a quarter of a turn has no rounding in its matrix
    let (sine, cosine) = sine_cosine(angle);
    let outer = axis * axis.transpose();
    let skew = M3::new(0.0, -axis[2], axis[1], axis[2], 0.0, -axis[0], -axis[1], axis[0], 0.0);
    outer + (M3::identity() - outer) * cosine + skew * sine
}

/// Sine and cosine; zero and one where the angle is a multiple of a right angle to its last digits.
fn sine_cosine(angle: f64) -> (f64, f64) {
    /// Right angles are written with at least so many digits.
    const SLACK: f64 = 1.0e-15;
    let (sine, cosine) = angle.sin_cos();
    let clean = |x: f64| if x.abs() < SLACK { 0.0 } else { x };
    (clean(sine), clean(cosine))
}

/// Roll, pitch and yaw: about the fixed axes x, y, z in this order.
pub(crate) fn roll_pitch_yaw([roll, pitch, yaw]: [f64; 3]) -> M3 {
    let [x, y, z] = [0, 1, 2].map(unit);
    about(&z, yaw) * about(&y, pitch) * about(&x, roll)
}

/// The rotation of a quaternion w, x, y, z; `None` where its length is zero.
pub(crate) fn quaternion(q: [f64; 4]) -> Option<M3> {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length == 0.0 {
        return None;
    }
    let [w, x, y, z] = q.map(|x| x / length);
    Some(M3::new(
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    ))
}

/// Basis vector of axis `i`.
pub(crate) fn unit(i: usize) -> V3 {
    mbs_core::algebra::unit(i)
}

/// A direction of unit length; `None` where it has none.
pub(crate) fn direction(x: &V3) -> Option<V3> {
    let length = norm(x);
    if length == 0.0 || !length.is_finite() {
        return None;
    }
    // an axis of the frame stays one exactly
    let is_axis = x.iter().filter(|x| **x != 0.0).count() == 1;
    Some(if is_axis { x.map(|x| if x == 0.0 { 0.0 } else { x.signum() }) } else { along(x) })
}

/// The rotation by the least angle that takes z to a direction of unit length.
pub(crate) fn from_z_to(z: &V3) -> M3 {
    let axis = cross(&unit(2), z);
    let sine = norm(&axis);
    match direction(&axis) {
        Some(axis) => about(&axis, sine.atan2(z[2])),
        None if z[2] < 0.0 => about(&unit(0), core::f64::consts::PI),
        None => M3::identity(),
    }
}
