//! Operation counts of a link, by the kind of its joint. Tables for controllers have no guided balls.

use super::Operations;
use mbs_core::Real;
use mbs_recursive::link::{Link, LinkKind};
use mbs_recursive::space::Space;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// True if the model is in space, false if it is in the plane.
const fn is_spatial<T: Real, S: Space<T>>() -> bool {
    S::DIMENSION == 3
}

/// Operations for place, velocity and velocity products of a link.
pub(super) fn place<T: Real, S: Space<T>>(kind: LinkKind) -> Operations {
    match (kind, is_spatial::<T, S>()) {
        (LinkKind::Revolute | LinkKind::GuidedRevolute, true) => ops(99, 79).and(0, 0, 1),
        (LinkKind::Revolute | LinkKind::GuidedRevolute, false) => ops(22, 17).and(0, 0, 1),
        (LinkKind::Prismatic | LinkKind::GuidedPrismatic, true) => ops(64, 54),
        (LinkKind::Prismatic | LinkKind::GuidedPrismatic, false) => ops(29, 20),
        (LinkKind::Ball, _) => ops(109, 81).and(1, 0, 0),
        (LinkKind::Free, true) => ops(94, 60).and(1, 0, 0),
        (LinkKind::Free, false) => ops(15, 8).and(0, 0, 1),
        (LinkKind::GuidedBall, _) => Operations::NONE,
    }
}

/// Operations for a body's inertia and its velocity-dependent forces.
fn inertia<T: Real, S: Space<T>>() -> Operations {
    if is_spatial::<T, S>() { ops(78, 45) } else { ops(9, 0) }
}

/// Operations for the elimination of the joint.
fn eliminate<T: Real, S: Space<T>>(kind: LinkKind) -> Operations {
    match (kind, is_spatial::<T, S>()) {
        (LinkKind::Revolute | LinkKind::Prismatic, true) => ops(96, 81).and(1, 0, 0),
        (LinkKind::Revolute, false) => ops(29, 20).and(1, 0, 0),
        (LinkKind::Prismatic, false) => ops(34, 25).and(1, 0, 0),
        (LinkKind::Ball, _) => ops(127, 95).and(1, 0, 0),
        (LinkKind::Free, true) => ops(100, 52).and(2, 0, 0),
        (LinkKind::Free, false) => ops(5, 4).and(3, 0, 0),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic, true) => ops(37, 36),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic, false) => ops(10, 9),
        (LinkKind::GuidedBall, _) => Operations::NONE,
    }
}

/// Operations for joint and link accelerations, without velocity products.
fn advance<T: Real, S: Space<T>>(kind: LinkKind) -> Operations {
    match (kind, is_spatial::<T, S>()) {
        (LinkKind::Revolute | LinkKind::Prismatic, true) => ops(19, 19),
        (LinkKind::Revolute | LinkKind::Prismatic, false) => ops(9, 9),
        (LinkKind::Ball, _) => ops(33, 39),
        (LinkKind::Free, true) => ops(45, 48),
        (LinkKind::Free, false) => ops(6, 12).and(3, 0, 0),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic, true) => ops(6, 6),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic, false) => ops(2, 2),
        (LinkKind::GuidedBall, _) => Operations::NONE,
    }
}

/// Operations to add a link to a parent other than the ground. The first count is for inertia and force, the second for the force alone.
fn shift<T: Real, S: Space<T>>() -> [Operations; 2] {
    if is_spatial::<T, S>() { [ops(60, 81), ops(6, 12)] } else { [ops(8, 19), ops(2, 5)] }
}

/// Operations of a link in one evaluation.
pub(super) fn evaluation<T: Real, S: Space<T>>(link: &Link<T, S>) -> Operations {
    let kind = link.kind;
    let bias = if is_spatial::<T, S>() { ops(0, 6) } else { ops(0, 3) };
    let sum = place::<T, S>(kind) + inertia::<T, S>() + eliminate::<T, S>(kind);
    let sum = sum + advance::<T, S>(kind) + bias;
    if link.parent > 0 { sum + shift::<T, S>()[0] } else { sum }
}

/// Operations for a response to other forces.
pub(super) fn response<T: Real, S: Space<T>>(link: &Link<T, S>) -> Operations {
    let impulse = match (link.kind, is_spatial::<T, S>()) {
        (LinkKind::Revolute | LinkKind::Prismatic, true) => ops(10, 9),
        (LinkKind::Revolute, false) => ops(5, 4),
        (LinkKind::Prismatic, false) => ops(6, 5),
        (LinkKind::Ball, _) => ops(18, 15),
        (LinkKind::Free, _) => Operations::NONE,
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall, _) => {
            Operations::NONE
        }
    };
    let sum = impulse + advance::<T, S>(link.kind);
    if link.parent > 0 { sum + shift::<T, S>()[1] } else { sum }
}

/// Operations to compute the acceleration of a link from the acceleration of its joint.
pub(super) fn spread<T: Real, S: Space<T>>(kind: LinkKind) -> Operations {
    match (kind, is_spatial::<T, S>()) {
        (LinkKind::Revolute | LinkKind::Prismatic, true) => ops(12, 18),
        (LinkKind::Revolute | LinkKind::Prismatic, false) => ops(5, 8),
        (LinkKind::Ball, _) => ops(15, 24),
        (LinkKind::Free, true) => ops(9, 18),
        (LinkKind::Free, false) => ops(0, 6),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic, true) => ops(6, 18),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic, false) => ops(2, 8),
        (LinkKind::GuidedBall, _) => Operations::NONE,
    }
}

/// Operations to move coordinates along the freedoms.
pub(super) fn moved<T: Real, S: Space<T>>(kind: LinkKind) -> Operations {
    match (kind, is_spatial::<T, S>()) {
        (LinkKind::Revolute | LinkKind::Prismatic, _) => ops(0, 1),
        (LinkKind::Ball, _) => ops(31, 17).and(2, 2, 1),
        (LinkKind::Free, true) => ops(31, 20).and(2, 2, 1),
        (LinkKind::Free, false) => ops(0, 3),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall, _) => {
            Operations::NONE
        }
    }
}

/// Operations to carry a row of a loop over the joint: the products K b and K b D⁻¹, and the row on the parent's side.
pub(super) fn pass<T: Real, S: Space<T>>(kind: LinkKind) -> Operations {
    match (kind, is_spatial::<T, S>()) {
        (LinkKind::Revolute | LinkKind::Prismatic, true) => ops(10, 8),
        (LinkKind::Revolute, false) => ops(5, 3),
        (LinkKind::Prismatic, false) => ops(6, 4),
        (LinkKind::Ball, _) => ops(18, 15),
        (LinkKind::Free, true) => ops(36, 30),
        (LinkKind::Free, false) => ops(6, 6).and(3, 0, 0),
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall, _) => {
            Operations::NONE
        }
    }
}
