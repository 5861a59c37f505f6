//! Smallest rotation between two directions.

use mbs_core::algebra::{Matrix, Vector, norm, norm_inf};
use mbs_core::inside::outputs::{carry, normalised};

#[test]
fn the_smallest_rotation_carries_one_direction_to_the_other() {
    let a = normalised(&Vector::<f64, 3>::new(1.0, 2.0, -0.5));
    for b in [[0.3, -0.2, 0.9], [-1.0, -2.0, 0.5], [1.0, 2.0, -0.5]] {
        let b = normalised(&Vector::from(b));
        let r = carry(&a, &b);
        let orthogonal = r.transpose() * r - Matrix::<f64, 3>::identity();
        assert!(norm(&(r * a - b)) < 1e-14, "{b}");
        assert!(norm_inf(orthogonal.as_slice()) < 1e-14, "{b}");
    }
}
