//! One step of 1 ms of the Runge-Kutta method of order 4.

use crate::clock::time_of_steps;
use crate::line::{Failure, exactly, print_line};
use crate::open::Open;
use crate::scenes::{GRAVITY, Shape};
use mbs_core::Real;
use mbs_core::real::DoubleDouble;
use mbs_core::scene::{Dimension, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Options, Planar, Spatial, TreeMethod};
use std::hint::black_box;

/// Length of the step [s].
const STEP: f64 = 1e-3;
/// Error tolerance of the reference.
const FINE: f64 = 1e-25;

/// Times a step of a chain in the plane and in space. The value is the angle of the first joint after one step [rad].
pub(crate) fn step(n: usize, seconds: f64) -> Result<(), Failure> {
    let mut exact =
        Open::<DoubleDouble, Spatial>::new(&Shape::Chain.scene(n, Dimension::Spatial, GRAVITY))?;
    let options = Options { error: exactly(FINE), ..Options::default() };
    let state = &mut exact.states[0];
    let method = TreeMethod::Extrapolation;
    exact.model.step(method, exactly(STEP), &options, state, &mut exact.workspace)?;
    print_line("reference", 0.0, state.z[exact.first].to_f64(), "exact");
    let scene = |dimension| Shape::Chain.scene(n, dimension, GRAVITY);
    timed::<Planar>("planar RK4", &scene(Dimension::Planar), seconds)?;
    timed::<Spatial>("spatial RK4", &scene(Dimension::Spatial), seconds)
}

fn timed<S: Space<f64>>(name: &str, scene: &Scene<f64>, seconds: f64) -> Result<(), Failure> {
    let Open { model, states, mut workspace, first } = Open::<f64, S>::new(scene)?;
    let options = Options::default();
    let mut state = states[0].clone();
    model.step(TreeMethod::Rk4, STEP, &options, &mut state, &mut workspace)?;
    let value = state.z[first];
    let time = time_of_steps(seconds, |n| {
        state.copy_from(&states[0]);
        for _ in 0..n {
            let made = model.step(TreeMethod::Rk4, STEP, &options, &mut state, &mut workspace);
            black_box(made.is_ok());
        }
    });
    print_line(name, time, value, "exact");
    Ok(())
}
