//! Every kind of joint in every formulation: in a tree, in a closed loop, and beside a chain of massless bodies with one degree of freedom
//! each.

use crate::common::oracle::{Way, disagreement, everything, methods, rows_with_errors};
use crate::common::random;
use mbs::core::outputs::Target;
use mbs::core::scene::{Dimension, JointKind, Quantity, Scene};

/// Step and span [s].
const SPAN: (f64, f64) = (1e-3, 0.2);

/// Asserts that all methods agree with the first one, in the outputs of the first scene.
fn agree(scenes: [&Scene<f64>; 2], others: &[Way], faults: &mut Vec<String>) {
    let reference = rows_with_errors(scenes[0], methods()[0], SPAN);
    let reference = reference.unwrap_or_else(|e| panic!("{}: {e}", scenes[0].name));
    for method in others {
        let fault = match rows_with_errors(scenes[1], *method, SPAN) {
            Ok(told) => {
                let (ratio, component) = disagreement(&reference, &told);
                (!(ratio <= 1.0)).then(|| format!("{ratio:.2}, component {component}"))
            }
            Err(error) => Some(format!("{error}")),
        };
        faults.extend(fault.map(|fault| format!("{} {method:?}: {fault}", scenes[1].name)));
    }
}

/// Kinds of joints with degrees of freedom, in the plane where possible, and in space.
fn kinds() -> impl Iterator<Item = (JointKind, Dimension)> {
    let all = |dimension| JointKind::ALL.map(|kind| (kind, dimension)).into_iter();
    let all = all(Dimension::Spatial).chain(all(Dimension::Planar));
    all.filter(|(kind, d)| *d == Dimension::Spatial || !kind.is_spatial_only())
        .filter(|(kind, _)| !kind.is_rigid())
}

#[test]
fn formulations_agree_on_every_kind_of_joint_in_a_tree() {
    let mut faults = Vec::new();
    for (kind, dimension) in kinds().filter(|(kind, _)| !kind.is_link()) {
        for seed in 1..=2 {
            let scene = everything(&random::of_kind(seed, kind, dimension));
            agree([&scene, &scene], &methods()[1..], &mut faults);
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn formulations_agree_on_every_kind_of_joint_in_a_loop() {
    let mut faults = Vec::new();
    for (kind, dimension) in kinds().filter(|(kind, _)| !kind.is_free()) {
        for seed in 1..=2 {
            let scene = everything(&random::closed_by(seed, kind, dimension));
            agree([&scene, &scene], &methods()[1..], &mut faults);
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_kind_of_joint_moves_as_a_chain_of_massless_bodies_with_its_freedoms() {
    let methods = [methods()[0], Way("recursive", "rk4")];
    let mut faults = Vec::new();
    for (kind, dimension) in kinds().filter(|(kind, _)| !kind.is_link()) {
        let mut scene = everything(&random::of_kind(3, kind, dimension));
        let is_of_joint = |quantity: &Quantity<f64>| matches!(quantity.target(), Target::Joint(_));
        let is_told = |quantity: &Quantity<f64>| {
            !is_of_joint(quantity) && !matches!(quantity, Quantity::Acceleration { .. })
        };
        scene.outputs.retain(|output| is_told(&output.quantity));
        agree([&scene, &random::split(&scene)], &methods, &mut faults);
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
