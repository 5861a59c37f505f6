//! Open mechanisms: accelerations of chains and trees, and efforts of chains.

use crate::clock::time_of;
use crate::line::{Failure, exactly, print_line};
use crate::scenes::{GRAVITY, Shape, states};
use mbs_core::Real;
use mbs_core::model::Owner;
use mbs_core::real::DoubleDouble;
use mbs_core::scene::{Dimension, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{EffortTerms, Options, Planar, Spatial, TreeModel, TreeState, Workspace};
use std::hint::black_box;

/// A tree model with the states from which every program starts.
pub(crate) struct Open<T: Real, S: Space<T>> {
    pub(crate) model: TreeModel<T, S>,
    pub(crate) states: Vec<TreeState<T>>,
    pub(crate) workspace: Workspace<T, S>,
    /// The coordinate of the first joint.
    pub(crate) first: usize,
}

impl<T: Real, S: Space<T>> Open<T, S> {
    pub(crate) fn new(scene: &Scene<T>) -> Result<Self, Failure> {
        let model = TreeModel::<T, S>::new(scene)?;
        let joint_of = |freedom| match model.owner_of_unknown(freedom) {
            Owner::Joint(joint) | Owner::Body(joint) => joint,
            Owner::Effect(_) | Owner::Coupling(_) | Owner::Rolling(_) => freedom,
        };
        let joints: Vec<usize> = (0..model.n_freedoms()).map(joint_of).collect();
        let state = |[q, v]: &[Vec<f64>; 2]| {
            let mut state = TreeState::at_rest(&model);
            for (freedom, &joint) in joints.iter().enumerate() {
                state.z[freedom] = exactly(q[joint]);
                state.v[freedom] = exactly(v[joint]);
            }
            // inverse dynamics is evaluated with accelerations equal to the rates
            state.a.copy_from_slice(&state.v);
            state
        };
        let states = states(joints.len()).iter().map(state).collect();
        let first = joints.iter().position(|&joint| joint == 0).unwrap_or(0);
        Ok(Self { workspace: Workspace::new(&model), model, states, first })
    }

    /// The acceleration of the first joint in a state.
    fn accelerate(&mut self, k: usize) -> Result<T, Failure> {
        let options = Options::default();
        self.model.accelerate(&options, &mut self.states[k], &mut self.workspace)?;
        Ok(self.states[k].a[self.first])
    }

    /// The effort of the first joint in a state.
    fn effort(&mut self, k: usize, efforts: &mut [T]) -> Result<T, Failure> {
        let terms = EffortTerms::WithEffects;
        self.model.write_efforts((&self.states[k], terms), &mut self.workspace, efforts);
        Ok(efforts[self.first])
    }
}

/// Times accelerations in the plane and in space.
pub(crate) fn forward(shape: Shape, n: usize, seconds: f64) -> Result<(), Failure> {
    let exact = |gravity| {
        let scene = shape.scene(n, Dimension::Spatial, gravity);
        Open::<DoubleDouble, Spatial>::new(&scene)?.accelerate(0).map(Real::to_f64)
    };
    print_line("reference", 0.0, exact(GRAVITY)?, "exact");
    // gravity along the joint axes causes no motion
    print_line("reference", 0.0, exact(0.0)?, "weightless");
    let scene = |dimension| shape.scene(n, dimension, GRAVITY);
    timed_forward::<Planar>("planar", &scene(Dimension::Planar), seconds)?;
    timed_forward::<Spatial>("spatial", &scene(Dimension::Spatial), seconds)
}

fn timed_forward<S: Space<f64>>(
    name: &str,
    scene: &Scene<f64>,
    seconds: f64,
) -> Result<(), Failure> {
    let mut open = Open::<f64, S>::new(scene)?;
    let value = open.accelerate(0)?;
    let time = time_of(seconds, |k| {
        black_box(open.accelerate(k).is_ok());
    });
    print_line(name, time, value, "exact");
    Ok(())
}

/// Times efforts of a chain in the plane and in space.
pub(crate) fn inverse(n: usize, seconds: f64) -> Result<(), Failure> {
    let scene = Shape::Chain.scene(n, Dimension::Spatial, GRAVITY);
    let mut exact = Open::<DoubleDouble, Spatial>::new(&scene)?;
    let value = exact.effort(0, &mut vec![DoubleDouble::ZERO; n])?;
    print_line("reference", 0.0, value.to_f64(), "exact");
    let scene = |dimension| Shape::Chain.scene(n, dimension, GRAVITY);
    timed_inverse::<Planar>("planar", &scene(Dimension::Planar), seconds)?;
    timed_inverse::<Spatial>("spatial", &scene(Dimension::Spatial), seconds)
}

fn timed_inverse<S: Space<f64>>(
    name: &str,
    scene: &Scene<f64>,
    seconds: f64,
) -> Result<(), Failure> {
    let mut open = Open::<f64, S>::new(scene)?;
    let mut efforts = vec![0.0; open.model.n_freedoms()];
    let value = open.effort(0, &mut efforts)?;
    let time = time_of(seconds, |k| {
        black_box(open.effort(k, &mut efforts).is_ok());
    });
    print_line(name, time, value, "exact");
    Ok(())
}
