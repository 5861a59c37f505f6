//! A double pendulum with mbs-nostd alone: constant tables, no allocation, a fixed number of operations.
//!
//! `model.rs` was written by `mbs export scenes/double-pendulum.toml --rust model.rs`.

mod model;

use mbs_nostd::{Checked, LoadError, Unwatched, operation_bound};
use model::{MODEL, ModelSolver};

/// Position of the tip after 1 s, by an extrapolation with 34 digits [m].
const TIP: [f64; 2] = [-1.662_115_135_816_127_6, -1.041_466_667_193_224_7];

/// Error of the tip after 1 s by the trapezoidal rule with steps of 1 ms: 10.5 m/s^2 times the square of the step [m].
const OFF: f64 = 1.1e-5;

fn main() -> Result<(), LoadError> {
    let model = Checked::new(&MODEL)?;
    let mut solver = ModelSolver::new(&model)?;
    for step in 0..1000 {
        if let Err(error) = solver.step(&model, 1e-3, &mut Unwatched) {
            panic!("step {step}: {error}");
        }
    }

    let bound = operation_bound::step(&MODEL, solver.bounds);
    // The elbow's angle is that of the lower rod on the upper one.
    let z = solver.coordinates();
    let (upper, lower) = (z[0], z[0] + z[1]);
    let tip = [upper.cos() + lower.cos(), upper.sin() + lower.sin()];
    let off = (tip[0] - TIP[0]).hypot(tip[1] - TIP[1]);
    println!(
        "nostd: tip at ({:.6}, {:.6}) m after 1 s, {off:.1e} m from the reference; {} operations a step",
        tip[0],
        tip[1],
        bound.total()
    );
    assert!(off <= OFF, "at most {OFF:.1e} m");
    Ok(())
}
