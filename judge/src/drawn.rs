//! Bodies of a mesh: the carrier, in which the axes of both parts are fixed, and the bodies that rotate or slide against it.
//!
//! At the contact point the two parts of a mesh have equal velocities along their teeth, seen from the carrier. So every mesh is a sum of
//! rotations and displacements against the carrier, whatever joints connect the parts with it.

use crate::scene::{Carrier, Joint, Kind};
use crate::vector::{Vector, cross, dot, norm, scale, sub};

/// Largest sine of the angle of parallel axes, and largest distance of equal axes relative to that of the joints [-]. Chosen, not tuned.
const PARALLEL: f64 = 1e-6;

/// Line of a joint: a point and a unit direction. In the plane the line of a rotation is normal to the plane.
fn line(joint: &Joint, planar: bool) -> (Vector, Vector) {
    let axis = if planar && joint.kind == Kind::Revolute { [0.0, 0.0, 1.0] } else { joint.axes[0] };
    (joint.points[0], axis)
}

/// The unit axis of a joint.
pub(crate) fn axis(joint: &Joint, planar: bool) -> Vector {
    line(joint, planar).1
}

fn are_parallel(a: Vector, b: Vector) -> bool {
    norm(cross(a, b)) < PARALLEL
}

/// True if the line of one joint is fixed in both bodies of another joint.
fn stands(of: &Joint, in_both: &Joint, planar: bool) -> bool {
    let ((p, a), (q, b)) = (line(of, planar), line(in_both, planar));
    let off = sub(q, p);
    match in_both.kind {
        Kind::Weld => true,
        Kind::Revolute | Kind::Cylindrical if of.kind != Kind::Prismatic => {
            let across = sub(off, scale(dot(off, a), a));
            are_parallel(a, b) && norm(across) < PARALLEL * (1.0 + norm(p))
        }
        Kind::Prismatic if of.kind == Kind::Prismatic => are_parallel(a, b),
        _ => false,
    }
}

/// Bodies in which the line of a joint is fixed. The search begins at the body `from`, passes only joints that do not move the line, and
/// does not enter `without`.
fn bodies(
    joints: &[Joint],
    [one, other]: [usize; 2],
    from: Carrier,
    without: Carrier,
    planar: bool,
) -> Vec<Carrier> {
    let mut found = vec![from];
    let mut at = 0;
    while let Some(&body) = found.get(at) {
        at += 1;
        for (j, joint) in joints.iter().enumerate() {
            if j == one || j == other || !stands(&joints[one], joint, planar) {
                continue;
            }
            let [a, b] = joint.bodies;
            for (here, there) in [(a, b), (b, a)] {
                if here == body && there != without && !found.contains(&there) {
                    found.push(there);
                }
            }
        }
    }
    found
}

/// The carrier, in which the lines of two joints are fixed, and the body that each joint moves against it.
pub(crate) fn carrier(
    joints: &[Joint],
    pair: [usize; 2],
    planar: bool,
) -> Option<(Carrier, [Carrier; 2])> {
    let ends = pair.map(|j| {
        let [a, b] = joints[j].bodies;
        [(a, b), (b, a)]
    });
    for (base, moved) in ends[0] {
        for (other_base, other_moved) in ends[1] {
            if base == other_base {
                return Some((base, [moved, other_moved]));
            }
        }
    }
    for (base, moved) in ends[0] {
        let one = bodies(joints, pair, base, moved, planar);
        for (other_base, other_moved) in ends[1] {
            let other = bodies(joints, [pair[1], pair[0]], other_base, other_moved, planar);
            if let Some(&carrier) = one.iter().find(|b| other.contains(b)) {
                return Some((carrier, [moved, other_moved]));
            }
        }
    }
    None
}

/// Sign with which a joint's coordinate changes when its body `moved` moves along a direction against the joint's other body.
pub(crate) fn sense(joint: &Joint, moved: Carrier, along: Vector, planar: bool) -> f64 {
    let order = if joint.bodies[1] == moved { 1.0 } else { -1.0 };
    order * dot(axis(joint, planar), along).signum()
}

/// The body of a joint that is farther from the ground, counted in joints.
pub(crate) fn farther(joints: &[Joint], joint: usize) -> Carrier {
    let mut far: Vec<(Carrier, usize)> = vec![(None, 0)];
    let mut at = 0;
    while let Some(&(body, steps)) = far.get(at) {
        at += 1;
        for other in joints {
            let [a, b] = other.bodies;
            for (here, there) in [(a, b), (b, a)] {
                if here == body && far.iter().all(|(known, _)| *known != there) {
                    far.push((there, steps + 1));
                }
            }
        }
    }
    let steps =
        |body: Carrier| far.iter().find(|(b, _)| *b == body).map_or(usize::MAX, |(_, n)| *n);
    let [a, b] = joints[joint].bodies;
    if steps(a) > steps(b) { a } else { b }
}

/// Displacement of a rack per radian of its pinion: r (a × n)·d, with the radius r, the axis a, the normal n and the rack's direction d.
pub(crate) fn rack_sense(pinion: &Joint, rack: &Joint, planar: bool) -> Option<f64> {
    let ((p, a), (q, d)) = (line(pinion, planar), line(rack, planar));
    // from the pinion's axis to the line of the rack, perpendicular to both
    let off = sub(q, p);
    let n = sub(off, scale(dot(off, d), d));
    let n = sub(n, scale(dot(n, a), a));
    let sine = dot(cross(a, n), d);
    (sine.abs() > PARALLEL * norm(off)).then_some(sine.signum())
}
