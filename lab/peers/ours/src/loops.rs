//! Accelerations of N planar four-bars in a row. The mechanism has one freedom and a closed form.
//!
//! ```text
//! a'' = −g cos a ((N + 1) / 2 + N) / ((N + 1) / 3 + N)
//! ```
//!
//! The angle a is that of the cranks.

use crate::clock::time_of;
use crate::line::{Failure, print_line};
use crate::scenes::{GRAVITY, add_joint, add_rod, empty};
use mbs_core::model::Owner;
use mbs_core::scene::{BodyId, Dimension, JointKind, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Options, Planar, Spatial, TreeModel, TreeState, Workspace};
use std::hint::black_box;

/// Angle of the cranks [rad] and its rate [rad/s].
const ANGLE: f64 = 1.2;
const RATE: f64 = -1.0;

/// A scene with the rates of its joints. In space, spherical joints close the couplers, so that there are as many equations as in the
/// peers.
fn scene(n: usize, dimension: Dimension) -> (Scene<f64>, Vec<f64>) {
    let (s, c) = ANGLE.sin_cos();
    let closing = match dimension {
        Dimension::Planar => JointKind::Revolute,
        Dimension::Spatial => JointKind::Spherical,
    };
    let (mut scene, mut rates) = (empty(dimension, GRAVITY), Vec::new());
    let mut last = None;
    for j in 0..=n {
        let x = j as f64;
        let crank = add_rod(&mut scene, [x, 0.0], [c, s]);
        add_joint(&mut scene, JointKind::Revolute, [BodyId::Ground, crank], [x, 0.0]);
        rates.push(RATE);
        let tip = [x + c, s];
        if let Some(coupler) = last {
            add_joint(&mut scene, closing, [coupler, crank], tip);
            rates.push(0.0);
        }
        if j < n {
            let coupler = add_rod(&mut scene, tip, [1.0, 0.0]);
            add_joint(&mut scene, JointKind::Revolute, [crank, coupler], tip);
            rates.push(-RATE);
            last = Some(coupler);
        }
    }
    (scene, rates)
}

/// Times both spaces.
pub(crate) fn four_bars(n: usize, seconds: f64) -> Result<(), Failure> {
    let cranks = n as f64 + 1.0;
    let exact = -GRAVITY * ANGLE.cos() * (0.5 * cranks + n as f64) / (cranks / 3.0 + n as f64);
    print_line("reference", 0.0, exact, "exact");
    timed::<Planar>("planar", scene(n, Dimension::Planar), seconds)?;
    timed::<Spatial>("spatial", scene(n, Dimension::Spatial), seconds)
}

fn timed<S: Space<f64>>(
    name: &str,
    (scene, rates): (Scene<f64>, Vec<f64>),
    seconds: f64,
) -> Result<(), Failure> {
    let model = TreeModel::<f64, S>::new(&scene)?;
    let mut state = TreeState::at_rest(&model);
    let mut first = 0;
    for freedom in 0..model.n_freedoms() {
        if let Owner::Joint(joint) = model.owner_of_unknown(freedom) {
            state.v[freedom] = rates[joint];
            first = if joint == 0 { freedom } else { first };
        }
    }
    let (options, mut workspace) = (Options::default(), Workspace::new(&model));
    model.accelerate(&options, &mut state, &mut workspace)?;
    let value = state.a[first];
    let time = time_of(seconds, |_| {
        black_box(model.accelerate(&options, &mut state, &mut workspace).is_ok());
    });
    print_line(name, time, value, "exact");
    Ok(())
}
