//! Poses with rotations as quaternions.

use mbs::Pose;

#[test]
fn a_quaternion_turns_axes_as_its_rotation_does() {
    // near half a revolution about each axis, another component is used to find the quaternion
    for (x, y, z) in [(0.3, -0.2, 0.9), (3.1, 0.0, 0.0), (0.0, 3.1, 0.1), (0.1, 0.0, -3.1)] {
        let angle = f64::hypot(f64::hypot(x, y), z);
        let n = [x / angle, y / angle, z / angle];
        let (s, c) = angle.sin_cos();
        let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
        let rotation = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let same = if i == j { c } else { 0.0 };
                same + s * cross[i][j] + (1.0 - c) * n[i] * n[j]
            })
        });
        let mut pose = Pose::default();
        pose.rotation = rotation;
        let q = pose.quaternion();
        let half = 0.5 * angle;
        let sign = half.cos().signum();
        let right = [half.cos(), n[0] * half.sin(), n[1] * half.sin(), n[2] * half.sin()];
        for (a, b) in q.iter().zip(right) {
            // the limit is about eight rounding errors of numbers of order one
            assert!((a - sign * b).abs() < 1e-15, "{q:?} for {right:?}");
        }
    }
}
