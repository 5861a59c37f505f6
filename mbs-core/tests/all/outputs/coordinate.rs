//! Rotation vectors over several turns.

use mbs_core::algebra::{Vector, norm, rotation, rotation_vector};
use mbs_core::inside::outputs::normalised;
use mbs_core::natural::unwrap_rotation;

#[test]
fn a_rotation_vector_grows_continuously_over_three_turns() {
    let axis = normalised(&Vector::<f64, 3>::new(0.3, -1.0, 0.7));
    let mut last = Vector::<f64, 3>::zeros();
    for i in 0..=600 {
        let angle = f64::from(i) * core::f64::consts::PI / 100.0;
        last = unwrap_rotation(&rotation_vector(&rotation(&(axis * angle))), &last);
        assert!(norm(&(last - axis * angle)) < 1e-7, "at {angle}: {last}");
    }
}
