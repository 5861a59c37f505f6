//! Quantities of a model at a given state, for studies: poses of the bodies, and gradients of the constraints. They are compiled here in
//! `f64`.

use mbs_core::model::{Model, Owner, State};
use mbs_core::natural::NaturalModel;
use mbs_core::once::found;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_core::{Cliques, instances};
use mbs_linear::Matrix;

/// Returns the positions, rotations and velocities of the bodies of a scene at a state.
pub fn poses<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> Vec<RigidMotion<f64>> {
    found::<Poses<D>>(POSES)(scene, model, state)
}

type Poses<const D: usize> =
    fn(&Scene<f64>, &NaturalModel<f64, D>, &State<f64>) -> Vec<RigidMotion<f64>>;
instances!(f64 POSES: Poses<D> = poses_here::<D>);

fn poses_here<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> Vec<RigidMotion<f64>> {
    (0..scene.bodies.len()).map(|b| model.motion(scene, b, state)).collect()
}

/// Owner of a constraint row (a coupling or a rolling contact), and the gradient of the row.
pub type Gradient = (Owner, Vec<f64>);

/// Returns the gradients of the constraint rows at a state. The rows of joints and bodies come first. The rows of couplings and rolling
/// contacts follow, each with its owner.
///
/// Cost: number of rows times number of unknowns, because the matrix is dense; allocates.
pub fn gradients<const D: usize>(
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> (Matrix, Vec<Gradient>) {
    found::<Gradients<D>>(GRADIENTS)(model, state)
}

type Gradients<const D: usize> = fn(&NaturalModel<f64, D>, &State<f64>) -> (Matrix, Vec<Gradient>);
instances!(f64 GRADIENTS: Gradients<D> = gradients_here::<D>);

fn gradients_here<const D: usize>(
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> (Matrix, Vec<Gradient>) {
    let n = model.n_unknowns();
    let mut terms = model.terms();
    model.set_inputs(state.t, state, &mut terms);
    model.evaluate(&state.q, &mut terms);
    let (mut joints, mut couplings) = (Vec::new(), Vec::new());
    for element in 0..model.n_elements() {
        let clique = model.clique(element);
        let range = model.rows(element);
        let mut local = vec![0.0; clique.len() * range.len()];
        model.write_jacobian(&terms, element, &mut local);
        for (row, local) in range.zip(local.chunks_exact(clique.len().max(1))) {
            let mut gradient = vec![0.0; n];
            for (&u, &g) in clique.iter().zip(local) {
                gradient[u as usize] = g;
            }
            match model.owner_of_row(row) {
                owner @ (Owner::Coupling(_) | Owner::Rolling(_)) => {
                    couplings.push((owner, gradient));
                }
                _ => joints.push(gradient),
            }
        }
    }
    couplings.sort_by_key(|(owner, _)| match owner {
        Owner::Coupling(number) => (0, *number),
        Owner::Rolling(number) => (1, *number),
        _ => (2, 0),
    });
    let matrix = Matrix::from_fn(joints.len(), n, |i, j| joints[i][j]);
    (matrix, couplings)
}
