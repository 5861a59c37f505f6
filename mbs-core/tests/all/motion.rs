//! Motions of bodies computed from natural coordinates, and natural coordinates computed from these motions.

use mbs_core::Cliques;
use mbs_core::model::{Model, State};
use mbs_core::rigid::RigidMotion;
use mbs_testkit::{PLANAR, Random, SPATIAL, close, jacobian, model, reference, scene, start};

/// Allowed error: positions are assembled to 1e-11 of the scene's length, and directions are orthonormal to the same precision.
const ASSEMBLED: f64 = 1e-9;

fn motions_give_the_coordinates_back<const D: usize>(text: &str) {
    let scene = scene(text);
    let (model, state) = start::<D>(&scene);
    let motions: Vec<RigidMotion<f64>> =
        (0..scene.bodies.len()).map(|body| model.motion(&scene, body, &state)).collect();
    let mut written = State::at_rest(&model);
    model.write_motions(&motions, &mut written);
    assert!(state.v.iter().any(|&v| v.abs() > 1e-3), "a scene at rest shows nothing");
    close("positions", &written.q, &state.q, ASSEMBLED);
    close("velocities", &written.v, &state.v, ASSEMBLED);
    close("accelerations", &written.a, &state.a, ASSEMBLED);
}

#[test]
fn motions_of_bodies_and_natural_coordinates_tell_of_the_same_state() {
    motions_give_the_coordinates_back::<2>(PLANAR);
    motions_give_the_coordinates_back::<3>(SPATIAL);
}

fn rows_are_the_jacobian<const D: usize>(text: &str) {
    let scene = scene(text);
    let model = model::<D>(&scene);
    let mut terms = model.terms();
    let mut random = Random(7);
    let moved = random.vector(model.n_unknowns(), model.n_extended(), 0.1);
    let q = mbs_testkit::plus(&reference(&model), 1.0, &moved);
    model.set_inputs(0.1, &State::at_rest(&model), &mut terms);
    model.evaluate(&q, &mut terms);
    let mut told = vec![0; model.n_constraints()];
    let dense = jacobian(&model, &terms);
    for element in 0..model.n_elements() {
        let clique = model.clique(element);
        let range = model.rows(element);
        let mut rows = vec![f64::NAN; clique.len() * range.len()];
        model.write_jacobian(&terms, element, &mut rows);
        for (i, row) in range.enumerate() {
            told[row] += 1;
            let mut wide = vec![0.0; model.n_unknowns()];
            for (j, &unknown) in clique.iter().enumerate() {
                wide[unknown as usize] = rows[i * clique.len() + j];
            }
            close("row", &wide, &dense[row], 1e-15);
        }
    }
    assert!(told.iter().all(|&count| count == 1), "every row belongs to one element");
}

#[test]
fn rows_of_elements_are_the_rows_of_the_jacobian() {
    rows_are_the_jacobian::<2>(PLANAR);
    rows_are_the_jacobian::<3>(SPATIAL);
}
