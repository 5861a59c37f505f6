//! Mass that a joint coordinate moves, in the reference configuration.
//!
//! ```text
//! m = min v^T M v   with   J v = 0,  g v = 1          = 1 / (g P g^T), P the inverse mass on the constraints
//! ```
//!
//! J is the Jacobian of the constraints, g the gradient of the coordinate. The mass is twice the kinetic energy of the smallest velocities
//! v at which the coordinate has a rate of one. The start of a simulation would compute the same velocities.

use super::hold::StartRow;
use super::problem::Problem;
use super::sweeps::Assembly;
use crate::dense::Dense;
use crate::joint::Dimension;
use crate::mechanism::{Effect, Scene};
use crate::model::{Model, State};
use crate::natural::NaturalModel;
use crate::scene::{Coupling, CouplingMeasure, CouplingTerm, Guide, JointId, Motion};
use alloc::vec;
use alloc::vec::Vec;

/// Mass that a coordinate moves if all other coordinates follow freely [kg or kg m^2]. The coordinate is given by joint and number. Guides
/// are at rest and couplings hold. `None` if the coordinate moves no mass or cannot move.
///
/// Cost: a model of the scene, and a dense factorisation of its coordinates: (12 n)^3/3 products for n bodies in space.
#[must_use]
pub fn moved_mass(scene: &Scene<f64>, of: (JointId, usize)) -> Option<f64> {
    let moving = moving(scene, of);
    let mass = match scene.dimension {
        Dimension::Planar => twice_energy::<2>(&moving),
        Dimension::Spatial => twice_energy::<3>(&moving),
    };
    mass.filter(|mass| *mass > 0.0 && mass.is_finite())
}

/// Scene without forces and start values, but with its rotors. The given coordinate has a rate of one; guides and couplings are at rest.
fn moving(scene: &Scene<f64>, (joint, number): (JointId, usize)) -> Scene<f64> {
    let guide = |guide: &Guide<f64>| Guide { law: Motion::Input([0.0; 3]), ..guide.clone() };
    let held = |coupling: &Coupling<f64>| Coupling { value: 0.0, motion: None, ..coupling.clone() };
    let of = CouplingMeasure::Coordinate { joint, number };
    let terms = vec![CouplingTerm { factor: 1.0, of, curve: None }];
    let motion = Some(Motion::Ramp { rate: 1.0 });
    let rate_of_one = Coupling { motion, ..Coupling::sum(terms, 0.0) };
    let is_rotor = |effect: &&Effect<f64>| effect.kind.rotor().is_some();
    let rotors = scene.effects.iter().filter(is_rotor);
    Scene {
        bodies: scene.bodies.clone(),
        joints: scene.joints.clone(),
        guides: scene.guides.iter().map(guide).collect(),
        couplings: scene.couplings.iter().map(held).chain([rate_of_one]).collect(),
        rollings: scene.rollings.clone(),
        gravity: None,
        signals: Vec::new(),
        effects: rotors.cloned().collect(),
        ..Scene::empty("", scene.dimension, 1.0)
    }
}

fn twice_energy<const D: usize>(scene: &Scene<f64>) -> Option<f64> {
    let model = NaturalModel::<f64, D>::new(scene).ok()?;
    let mut state = State::at_rest(&model);
    let problem = Problem::new(&model, StartRow::all(scene, &model));
    let solver = Dense::new(&problem);
    let mut assembly = Assembly::new(problem, solver, &state);
    assembly.drive(&state.q, 1.0);
    assembly.velocities(&mut state).ok()?;
    Some(2.0 * model.kinetic_energy(&state.v))
}
