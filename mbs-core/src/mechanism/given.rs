//! Joint coordinates with a known value at the start. Values come from initial conditions, guides, and couplings between coordinates.

use crate::Real;
use crate::inputs::{CouplingInput, GuideInput, SignalGraph};
use crate::mechanism::Scene;
use crate::scene::{InitialTarget, Joint};
use alloc::vec;
use alloc::vec::Vec;

/// Coordinates of each joint at time zero that the scene determines. A coupling with one unknown coordinate determines that coordinate.
///
/// Cost: one pass over joints, guides and initial conditions, and one pass over the couplings for each round that determines a coordinate.
#[must_use]
pub fn given_values<T: Real>(scene: &Scene<T>) -> Vec<Vec<Option<T>>> {
    let open = |joint: &Joint<T>| vec![None; joint.kind.n_coordinates(scene.dimension)];
    let mut values: Vec<Vec<Option<T>>> = scene.joints.iter().map(open).collect();
    let signals = SignalGraph::new(&scene.signals).values(T::ZERO);
    for guide in &scene.guides {
        let values = values.get_mut(guide.joint.index());
        if let Some(value) = values.and_then(|values| values.get_mut(guide.number)) {
            *value = Some(GuideInput::new(&guide.law).at(T::ZERO, &signals)[0]);
        }
    }
    for initial in &scene.initials {
        if let InitialTarget::Joint { joint, value: Some(value), .. } = &initial.target
            && let Some(values) = values.get_mut(joint.index())
        {
            values.iter_mut().zip(value).for_each(|(to, from)| *to = Some(*from));
        }
    }
    let mut couplings: Vec<_> = scene.couplings.iter().map(CouplingInput::new).collect();
    loop {
        let before = couplings.len();
        couplings.retain(|coupling| !propagated(coupling, (&mut values, &signals)));
        if couplings.len() == before {
            return values;
        }
    }
}

/// Computes the only unknown coordinate of a coupling. Returns `true` if it computed the coordinate, or if no coordinate is unknown.
fn propagated<T: Real>(
    coupling: &CouplingInput<T>,
    (values, signals): (&mut [Vec<Option<T>>], &[[T; 3]]),
) -> bool {
    // a relation is not solved for one of its arguments
    if coupling.relation.is_some() {
        return false;
    }
    let (mut rest, mut open) = (coupling.sum_at(T::ZERO, signals), None);
    for term in &coupling.terms {
        let Some((joint, number)) = term.coordinate else { return false };
        match values.get(joint).and_then(|list| list.get(number)).copied().flatten() {
            Some(value) => rest -= term.factor * term.curve.at(value)[0],
            None if open.is_none() && term.curve.is_identity() => {
                open = Some((joint, number, term.factor));
            }
            None => return false,
        }
    }
    if let Some((joint, number, factor)) = open
        && let Some(value) = values.get_mut(joint).and_then(|list| list.get_mut(number))
    {
        *value = Some(rest / factor);
    }
    true
}
