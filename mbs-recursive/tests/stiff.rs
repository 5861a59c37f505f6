//! Stiff forces and rest: what the iteration of a trapezoidal step must carry.

mod support;

use mbs_recursive::Spatial;
use support::{Run, file};

#[test]
fn a_mechanism_that_comes_to_rest_stays_there() {
    // At 1.2 s what still moves is below the rounding of its coordinates.
    let mut run = Run::<Spatial>::new::<3>(&file("iltis-suspension"));
    for i in 0..3000 {
        run.step(1e-3).unwrap_or_else(|e| panic!("step {i}: {e}"));
    }
    let fastest = run.state.v.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    // Coordinates of order one, rounded to 2e-16, in steps of 1e-3 s.
    assert!(fastest < 1e-12, "{fastest}");
}
