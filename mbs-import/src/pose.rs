//! Positions and rotations of frames.

use mbs_core::algebra::{Matrix, Vector, along, cross, norm, vector};

/// A vector in space.
pub(crate) type V3 = Vector<f64, 3>;
/// A rotation matrix or an inertia tensor.
pub(crate) type M3 = Matrix<f64, 3>;

/// Pose of a frame relative to another frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    /// Rotation matrix: it converts components in the frame to components in the other frame.
    pub(crate) turn: M3,
    /// Origin of the frame, in the other frame [m].
    pub(crate) at: V3,
}

impl Pose {
    pub(crate) fn identity() -> Self {
        Self { turn: M3::identity(), at: V3::zeros() }
    }

    pub(crate) const fn new(turn: M3, at: V3) -> Self {
        Self { turn, at }
    }

    /// The pose of `inner` relative to the outer frame. The argument is its pose relative to this frame, which has the pose `self` in the
    /// outer frame.
    pub(crate) fn then(&self, inner: &Self) -> Self {
        Self { turn: self.turn * inner.turn, at: self.point(&inner.at) }
    }

    /// The inverse pose: that of the outer frame relative to this frame.
    pub(crate) fn inverse(&self) -> Self {
        let turn = self.turn.transpose();
        Self { turn, at: -(turn * self.at) }
    }

    /// The position of a point of this frame, in the other frame.
    pub(crate) fn point(&self, x: &V3) -> V3 {
        self.at + self.turn * x
    }
}

/// The vector with three components.
pub(crate) const fn v3(numbers: [f64; 3]) -> V3 {
    vector(numbers)
}

/// The rotation by an angle [rad] about a unit vector.
pub(crate) fn about(axis: &V3, angle: f64) -> M3 {
    // The matrix of a quarter turn is exact.
    let (sine, cosine) = sine_cosine(angle);
    let outer = axis * axis.transpose();
    let skew = M3::new(0.0, -axis[2], axis[1], axis[2], 0.0, -axis[0], -axis[1], axis[0], 0.0);
    outer + (M3::identity() - outer) * cosine + skew * sine
}

/// Sine and cosine of an angle. Values near zero become exactly zero, so that right angles are exact.
fn sine_cosine(angle: f64) -> (f64, f64) {
    /// Bound of a sine or cosine that counts as zero [-]. Right angles in files have at least 15 digits.
    const SLACK: f64 = 1.0e-15;
    let (sine, cosine) = angle.sin_cos();
    let clean = |x: f64| if x.abs() < SLACK { 0.0 } else { x };
    (clean(sine), clean(cosine))
}

/// The rotation by roll, pitch and yaw: about the fixed axes x, y, z in this order.
pub(crate) fn roll_pitch_yaw([roll, pitch, yaw]: [f64; 3]) -> M3 {
    let [x, y, z] = [0, 1, 2].map(unit);
    about(&z, yaw) * about(&y, pitch) * about(&x, roll)
}

/// The rotation of a quaternion w, x, y, z; `None` when the quaternion is zero.
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

/// The unit vector along a vector; `None` when its length is zero or not finite.
pub(crate) fn direction(x: &V3) -> Option<V3> {
    let length = norm(x);
    if length == 0.0 || !length.is_finite() {
        return None;
    }
    // A vector along an axis of the frame gives that axis exactly.
    let is_axis = x.iter().filter(|x| **x != 0.0).count() == 1;
    Some(if is_axis { x.map(|x| if x == 0.0 { 0.0 } else { x.signum() }) } else { along(x) })
}

/// The rotation by the smallest angle that turns the z axis to a unit vector.
pub(crate) fn from_z_to(z: &V3) -> M3 {
    let axis = cross(&unit(2), z);
    let sine = norm(&axis);
    match direction(&axis) {
        Some(axis) => about(&axis, sine.atan2(z[2])),
        None if z[2] < 0.0 => about(&unit(0), core::f64::consts::PI),
        None => M3::identity(),
    }
}
