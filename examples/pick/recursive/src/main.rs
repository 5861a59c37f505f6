//! A double pendulum with mbs-core and mbs-recursive alone: joint angles, articulated inertia, fixed-point iteration.

#[path = "../../double_pendulum.rs"]
mod double_pendulum;

use double_pendulum::{TRAPEZOIDAL, check, double_pendulum};
use mbs_recursive::{Options, Planar, TreeMethod, TreeModel, TreeState, Workspace};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = double_pendulum();
    let model = TreeModel::<f64, Planar>::new(&scene)?;
    let mut workspace = Workspace::new(&model);
    let mut state = TreeState::at_rest(&model);
    model.settle(&mut state, &mut workspace)?;

    let options = Options::default();
    for _ in 0..1000 {
        model.step(TreeMethod::Trapezoidal, 1e-3, &options, &mut state, &mut workspace)?;
    }

    // The elbow's angle is that of the lower rod on the upper one.
    let (upper, lower) = (state.z[0], state.z[0] + state.z[1]);
    check("recursive", [upper.cos() + lower.cos(), upper.sin() + lower.sin()], TRAPEZOIDAL);
    Ok(())
}
