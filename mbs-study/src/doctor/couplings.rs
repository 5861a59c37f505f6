//! Couplings that follow from others, or almost do.
//!
//! ```text
//! N: motions that the joints leave, an orthonormal basis;   h_k = N^T g_k of each coupling's gradient g_k
//! ```
//!
//! A coupling whose h lies in the span of those before it takes no freedom. Those that it is made of are named with it.

use super::finding::{Finding, Severity, Topic};
use crate::redundancy::Rank;
use mbs_core::Cliques;
use mbs_core::model::{Model, Owner, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Entry, Scene};
use mbs_linear::Matrix;

/// Part of a gradient that others do not give, relative to it, below which it follows from them [-]: rounding of the rank's basis. Chosen,
/// not tuned.
const FOLLOWS: f64 = 1e-9;
/// The same, below which it almost does [-]: ratios are written with six digits or more.
const ALMOST: f64 = 1e-6;
/// Most numbers of the rows that are looked at [-]: a second of work. Chosen, not tuned.
const LARGEST: usize = 250_000;

/// How many freedoms the couplings take at a state; nothing where the scene is too large for it.
pub(super) fn findings<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
    findings: &mut Vec<Finding>,
) -> Option<usize> {
    if scene.couplings.is_empty() {
        return Some(0);
    }
    let (joints, couplings) = rows(model, state)?;
    let free = Rank::of(&joints)?.free;
    let mut taken: Vec<(usize, Vec<f64>)> = Vec::new();
    for (number, gradient) in couplings {
        let size = norm(&gradient);
        let motion = |k: usize| (0..gradient.len()).map(|i| free[(i, k)] * gradient[i]).sum();
        let mut rest: Vec<f64> = (0..free.n_columns()).map(motion).collect();
        let mut others = Vec::new();
        for (other, direction) in &taken {
            let part: f64 = rest.iter().zip(direction).map(|(x, y)| x * y).sum();
            rest.iter_mut().zip(direction).for_each(|(x, y)| *x -= part * y);
            if part.abs() > FOLLOWS * size {
                others.push(*other);
            }
        }
        let left = norm(&rest);
        if left <= ALMOST * size {
            findings.push(follows(scene, number, &others, left <= FOLLOWS * size));
        }
        if left > FOLLOWS * size {
            rest.iter_mut().for_each(|x| *x /= left);
            taken.push((number, rest));
        }
    }
    Some(taken.len())
}

fn follows(scene: &Scene<f64>, number: usize, others: &[usize], is_exact: bool) -> Finding {
    let name = |c: usize| format!("`{}`", scene.couplings[c].name);
    let names: Vec<String> = others.iter().map(|&c| name(c)).collect();
    let of = if names.is_empty() { "the joints alone".to_owned() } else { names.join(", ") };
    let (code, verb, remedy) = if is_exact {
        (
            "dependent-coupling",
            "follows from",
            "leave it out: the motion stays, and every effort is determined",
        )
    } else {
        (
            "almost-dependent",
            "almost follows from",
            "give ratios as teeth, or with all their digits",
        )
    };
    let message = format!("coupling {} {verb} {of}", name(number));
    let mut finding = Finding::new(Severity::Doubt, (Topic::Dependence, code), message, remedy);
    finding.place = Some((Entry::Coupling(number), "name"));
    finding
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The number of a coupling, and the gradient of its row.
type Gradient = (usize, Vec<f64>);

/// The rows of all but couplings, and the gradient of each coupling.
fn rows<const D: usize>(
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> Option<(Matrix, Vec<Gradient>)> {
    let (m, n) = (model.n_constraints(), model.n_unknowns());
    if m * n > LARGEST {
        return None;
    }
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
                Owner::Coupling(number) => couplings.push((number, gradient)),
                _ => joints.push(gradient),
            }
        }
    }
    couplings.sort_by_key(|(number, _)| *number);
    let matrix = Matrix::from_fn(joints.len(), n, |i, j| joints[i][j]);
    Some((matrix, couplings))
}
