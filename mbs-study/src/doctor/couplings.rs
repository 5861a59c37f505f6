//! Couplings, and rolling contacts, that depend on others exactly or almost.
//!
//! ```text
//! N: motions that the joints leave, an orthonormal basis;   h_k = N^T g_k of each coupling's gradient g_k
//! ```
//!
//! A row whose h lies in the span of the rows before it removes no degree of freedom. The finding names this row together with the rows of
//! which it is a combination.

use super::finding::{Finding, Severity, Topic};
use crate::redundancy::Rank;
use mbs::inside::gradients;
use mbs_core::Cliques;
use mbs_core::model::{Model, Owner, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Entry, Scene};

/// Largest component of a gradient outside the span of others at which the gradient counts as dependent on them, relative to the gradient [-].
/// The limit is the rounding of the rank's basis. Chosen, not tuned.
const FOLLOWS: f64 = 1e-9;
/// Largest component of a gradient outside the span of others at which the gradient counts as almost dependent on them, relative to the
/// gradient [-]. Ratios in a file have six digits or more.
const ALMOST: f64 = 1e-6;
/// Largest number of elements of the examined rows [-]: about a second of work. Chosen, not tuned.
const LARGEST: usize = 250_000;

/// Returns the number of degrees of freedom that couplings and rolling contacts remove in a state. `None` if the scene is too large for this
/// examination.
pub(super) fn findings<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
    findings: &mut Vec<Finding>,
) -> Option<usize> {
    if scene.couplings.is_empty() && scene.rollings.is_empty() {
        return Some(0);
    }
    if model.n_constraints() * model.n_unknowns() > LARGEST {
        return None;
    }
    let (joints, couplings) = gradients(model, state);
    let free = Rank::of(&joints)?.free;
    let mut taken: Vec<(Owner, Vec<f64>)> = Vec::new();
    for (owner, gradient) in couplings {
        let size = norm(&gradient);
        let motion = |k: usize| (0..gradient.len()).map(|i| free[(i, k)] * gradient[i]).sum();
        let mut rest: Vec<f64> = (0..free.n_columns()).map(motion).collect();
        let mut others = Vec::new();
        for (other, direction) in &taken {
            let part: f64 = rest.iter().zip(direction).map(|(x, y)| x * y).sum();
            rest.iter_mut().zip(direction).for_each(|(x, y)| *x -= part * y);
            if part.abs() > FOLLOWS * size && !others.contains(other) {
                others.push(*other);
            }
        }
        let left = norm(&rest);
        if left <= ALMOST * size {
            findings.push(follows(scene, owner, &others, left <= FOLLOWS * size));
        }
        if left > FOLLOWS * size {
            rest.iter_mut().for_each(|x| *x /= left);
            taken.push((owner, rest));
        }
    }
    Some(taken.len())
}

fn follows(scene: &Scene<f64>, owner: Owner, others: &[Owner], is_exact: bool) -> Finding {
    let (what, place) = match owner {
        Owner::Rolling(i) => ("a row of", Entry::Rolling(i)),
        Owner::Coupling(i) => ("coupling", Entry::Coupling(i)),
        _ => ("a row of", Entry::Scene),
    };
    let name = |owner: Owner| match owner {
        Owner::Rolling(i) => format!("`{}`", scene.rollings[i].name),
        Owner::Coupling(i) => format!("`{}`", scene.couplings[i].name),
        _ => String::new(),
    };
    let names: Vec<String> = others.iter().map(|&other| name(other)).collect();
    let of = if names.is_empty() { "the joints alone".to_owned() } else { names.join(", ") };
    let (code, verb, remedy) = if matches!(owner, Owner::Rolling(_)) {
        (
            "dependent-rolling",
            if is_exact { "follows from" } else { "almost follows from" },
            "the motion stays; of its force the smallest one is given",
        )
    } else if is_exact {
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
    let message = format!("{what} {} {verb} {of}", name(owner));
    let mut finding = Finding::new(Severity::Doubt, (Topic::Dependence, code), message, remedy);
    finding.place = Some((place, "name"));
    finding
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
