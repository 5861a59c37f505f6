//! Principal moments of inertia of bodies.

use mbs_core::inside::check::principal_moments;

#[test]
fn principal_moments_of_a_turned_tensor_by_hand() {
    // diag(1, 3) rotated by 45 degrees in the plane is [[2, 1], [1, 2]]
    let found = principal_moments([2.0_f64, 2.0, 2.5, 1.0, 0.0, 0.0]);
    for (found, expected) in found.iter().zip([1.0, 2.5, 3.0]) {
        assert!((found - expected).abs() < 1.0e-15, "{found} {expected}");
    }
}

#[test]
fn principal_moments_keep_trace_and_determinant() {
    let [xx, yy, zz, xy, yz, zx] = [3.0, 2.0, 4.0, 0.3, -0.7, 1.1];
    let [a, b, c] = principal_moments([xx, yy, zz, xy, yz, zx]);
    let det: f64 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    assert!((a + b + c - 9.0_f64).abs() < 1.0e-14);
    assert!((a * b * c - det).abs() < 1.0e-13);
}
