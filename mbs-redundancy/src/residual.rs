//! Residuals of the joints at a pose, one for each row; the derivative of a residual along a twist is the product of its row with the twist.
//!
//! ```text
//! force f:   f·(p₂ − p₁)   (distance: length − L)
//! moment m:  m·e,   e = a₁ × a₂ (common axis),   ½ Σ u₁ₖ × u₂ₖ (no turning, or a guide's angle),   −(a·b − cos) n (universal)
//! ```
//!
//! Angles are relative to a pose that satisfies the joints, so that guides keep their values.

use super::Vector;
use super::link::{Link, Poses, pose};
use super::parts::Part;
use mbs_core::algebra::{cross, norm, rotation_vector};
use mbs_core::scene::{Axis, Dimension, Freedom, Rotation};

/// Returns the residuals of a joint's rows [m], with angles times the part's length. `met` is a pose that satisfies the joints.
pub(crate) fn residuals(
    link: &Link,
    (part, dimension): (&Part, Dimension),
    met: &Poses,
    at: &Poses,
) -> Vec<f64> {
    let wrenches = link.wrenches(at, part.length);
    let guide = wrenches.len() - link.n_guided();
    let opened = offset(link, at);
    let row = |(i, w): (usize, &mbs_core::outputs::Wrench<f64>)| {
        let is_guide = i >= guide;
        if w.force != Vector::zeros() {
            let [now, then] = [opened, offset(link, met)];
            let is_distance = link.joint.kind.is_link();
            return match (is_guide, is_distance, i) {
                (false, true, 0) => norm(&now) - norm(&then),
                // The displacement of a guided slide must equal its value at `met`. So must the displacement of a link with a hinge, along
                // the hinge.
                (true, ..) | (false, true, _) => {
                    let number = i.saturating_sub(guide);
                    w.force.dot(&now) - along(link, (dimension, number), met, &then)
                }
                // The joint's points coincide, or differ only along directions orthogonal to f.
                _ => w.force.dot(&now),
            };
        }
        w.moment.dot(&turned(link, dimension, met, at, is_guide))
    };
    wrenches.iter().enumerate().map(row).collect()
}

/// Returns the offset p₂ − p₁ of the joint's points on its two bodies [m].
fn offset(link: &Link, at: &Poses) -> Vector {
    link.place(at, 1) - link.place(at, 0)
}

/// Returns the component of `offset` along the axis of a coordinate that a guide drives, or along the axis of the hinge.
fn along(link: &Link, (dimension, number): (Dimension, usize), at: &Poses, offset: &Vector) -> f64 {
    let driven = link.joint.kind.freedom(dimension, number).and_then(Freedom::axis);
    let axis = link.joint.direction(driven.unwrap_or(Axis::First));
    (pose(at, link.joint.bodies[0]).rotation * axis).dot(offset)
}

/// Returns the rotation of the second body relative to the first that the joint does not allow.
fn turned(link: &Link, dimension: Dimension, met: &Poses, at: &Poses, is_guide: bool) -> Vector {
    let [first, second] = link.joint.bodies.map(|body| pose(at, body).rotation);
    match link.joint.kind.rotation(dimension) {
        _ if is_guide => {
            let [first_met, second_met] = link.joint.bodies.map(|body| pose(met, body).rotation);
            // The change of the relative rotation since `met`, in present axes of the first body.
            let change = first * (first_met.transpose() * second_met);
            rotation_vector(&(second * change.transpose()))
        }
        Rotation::About(axis) => {
            let axis = link.joint.direction(axis);
            cross(&(first * axis), &(second * axis))
        }
        Rotation::Universal(axes) => {
            let [a, b] = axes.map(|axis| link.joint.direction(axis));
            let [x, y] = [first * a, second * b];
            let n = cross(&x, &y);
            n * ((a.dot(&b) - x.dot(&y)) / n.dot(&n))
        }
        Rotation::Fixed | Rotation::Free => (0..3).fold(Vector::zeros(), |e, k| {
            let [u, w] = [first, second].map(|r| r.column(k).into_owned());
            e + cross(&u, &w) * 0.5
        }),
    }
}
