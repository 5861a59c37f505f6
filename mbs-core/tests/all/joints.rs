//! Table of joints: for every kind, equations and freedoms together span all motions.

use crate::small::{GROUND, add_body, add_joint, hold, scene, start};
use mbs_core::Cliques;
use mbs_core::algebra::{Matrix, Vector};
use mbs_core::model::Model;
use mbs_core::outputs::{JointWrenches, Wrench};
use mbs_core::scene::{Dimension, Freedom, Inertia, JOINTS, Joint, JointKind, JointLimits};
use mbs_testkit::Random;
use std::collections::BTreeSet;

/// Rounding error of products of unit vectors.
const ROUNDING: f64 = 1e-12;
/// Smallest volume of six independent unit vectors; the volumes of random vectors are larger.
const DEPENDENT: f64 = 1e-6;

/// Joint with random axes at a random place.
fn random(kind: JointKind, dimension: Dimension, random: &mut Random) -> Joint<f64> {
    let n = dimension.count();
    let mut vector = || {
        let v = random.vector(n, 3, 1.0);
        [v[0], v[1], v[2]]
    };
    let points = [vector(); 2];
    let axes = kind.needs_axes(dimension).map(|is_needed| is_needed.then(&mut vector));
    let limits = JointLimits::NONE;
    Joint { name: String::new(), kind, bodies: [GROUND; 2], points, axes, limits }
}

/// Motions that the freedoms of a joint allow: velocity of the joint's place, and angular velocity.
fn twists(joint: &Joint<f64>, dimension: Dimension) -> Vec<[Vector<f64, 3>; 2]> {
    let zero = Vector::zeros();
    let of = |freedom: &Freedom| match *freedom {
        Freedom::Slide(axis) => vec![[joint.direction(axis), zero]],
        Freedom::Turn(axis) => vec![[zero, joint.direction(axis)]],
        Freedom::Ball => {
            (0..3).map(|i| [zero, Matrix::<f64, 3>::identity().column(i).into_owned()]).collect()
        }
    };
    joint.freedoms(dimension).iter().flat_map(of).collect()
}

fn wrenches(joint: &Joint<f64>, dimension: Dimension, is_guided: bool) -> Vec<Wrench<f64>> {
    let carries = JointWrenches::new(joint, dimension, is_guided, 1.0);
    let (mut all, still) = (Vec::new(), Matrix::<f64, 3>::identity());
    let place = |i: usize| Vector::from(joint.points[i]);
    carries.directions(place, [&still, &still], |wrench| all.push(wrench));
    assert_eq!(all.len(), carries.n_directions(), "{:?}", joint.kind);
    all
}

/// Volume that six-dimensional vectors span, by the Gram-Schmidt process.
fn volume(vectors: &[[Vector<f64, 3>; 2]]) -> f64 {
    let dot = |a: &[Vector<f64, 3>; 2], b: &[Vector<f64, 3>; 2]| a[0].dot(&b[0]) + a[1].dot(&b[1]);
    let (mut basis, mut volume) = (Vec::<[Vector<f64, 3>; 2]>::new(), 1.0);
    for x in vectors {
        let mut left = *x;
        for b in &basis {
            let share = dot(x, b);
            left = [left[0] - b[0] * share, left[1] - b[1] * share];
        }
        let size = dot(&left, &left).sqrt();
        volume *= size;
        basis.push(left.map(|x| x / size));
    }
    volume
}

#[test]
fn equations_of_every_kind_span_what_its_freedoms_leave() {
    let dice = &mut Random::new(7);
    for dimension in [Dimension::Planar, Dimension::Spatial] {
        let all = 3 * (dimension.count() - 1);
        for kind in JointKind::ALL {
            let is_known = dimension == Dimension::Spatial || !kind.is_spatial_only();
            for _ in 0..if is_known { 200 } else { 0 } {
                let joint = random(kind, dimension, dice);
                let (free, held) = (twists(&joint, dimension), wrenches(&joint, dimension, false));
                for (v, w) in free.iter().flat_map(|t| held.iter().map(move |w| (t, w))) {
                    let power = v[0].dot(&w.force) + v[1].dot(&w.moment);
                    assert!(power.abs() < ROUNDING, "{joint:?}: {power:e}");
                }
                if kind.is_link() {
                    continue;
                }
                assert_eq!(free.len() + held.len(), all, "{joint:?}");
                let held: Vec<_> = held.iter().map(|w| [w.force, w.moment]).collect();
                assert!(volume(&free) > DEPENDENT && volume(&held) > DEPENDENT, "{joint:?}");
                if kind.single(dimension).is_some() {
                    assert_eq!(wrenches(&joint, dimension, true).len(), held.len() + 1);
                }
            }
        }
    }
}

/// Checks a body on the ground by a joint, with rates of the joint's coordinates as its only motion.
fn swinging<const D: usize>(joint: &Joint<f64>, dimension: Dimension) {
    let mut s = scene(dimension, [0.0; 3]);
    let inertia = match dimension {
        Dimension::Planar => Inertia::Planar(0.2),
        Dimension::Spatial => Inertia::Spatial([0.2, 0.25, 0.3, 0.01, 0.02, -0.01]),
    };
    let body = add_body(&mut s, 1.5, [0.3, 0.2, 0.0], inertia);
    add_joint(&mut s, joint.kind, [GROUND, body], joint.points[0], joint.axes);
    let n = joint.kind.n_coordinates(dimension);
    let rates: Vec<f64> = (0..n).map(|i| 0.5 + 0.2 * i as f64).collect();
    hold(&mut s, 0, &[], &rates);
    assert!(s.check().is_ok(), "{joint:?}: {:?}", s.check());
    let (model, state) = start::<D>(&s);
    let freedoms = model.n_unknowns() as isize - model.n_constraints() as isize;
    assert_eq!(freedoms, n as isize, "{joint:?}");
    // v = sum of twists times rates: velocity of the joint's place, and angular velocity
    let motion = model.motion(&s, 0, &state);
    let place = motion.point(&Vector::from(joint.points[1]))[1];
    let mut expected = [Vector::<f64, 3>::zeros(); 2];
    for (twist, rate) in twists(joint, dimension).iter().zip(&rates) {
        expected = [expected[0] + twist[0] * *rate, expected[1] + twist[1] * *rate];
    }
    for (found, expected) in [place, motion.omega].iter().zip(expected) {
        assert!((found - expected).norm() < 1e-8, "{joint:?}: {found} is not {expected}");
    }
}

#[test]
fn a_body_on_a_joint_of_any_kind_moves_by_its_coordinates_alone() {
    let dice = &mut Random::new(11);
    for kind in JointKind::ALL.into_iter().filter(|kind| !kind.is_link() && !kind.is_rigid()) {
        for _ in 0..8 {
            swinging::<3>(&random(kind, Dimension::Spatial, dice), Dimension::Spatial);
            if !kind.is_spatial_only() {
                swinging::<2>(&random(kind, Dimension::Planar, dice), Dimension::Planar);
            }
        }
    }
}

#[test]
fn the_list_of_features_has_the_kinds_of_joint() {
    let features = include_str!("../../../docs/FEATURES.md");
    let list = features.split("with joints: ").nth(1).and_then(|rest| rest.split('.').next());
    let last = |entry: &'static str| entry.split_whitespace().last().unwrap_or_default();
    let listed: BTreeSet<_> = list.expect("a list").split(',').map(last).collect();
    assert_eq!(listed, JOINTS.iter().map(|form| form.name).collect());
}

#[test]
fn coordinates_have_names_but_components_of_a_rotation() {
    let names = |kind: JointKind, dimension| {
        let names: Vec<_> = kind.coordinate_names(dimension).collect();
        for &(number, name) in &names {
            assert_eq!(kind.coordinate_name(dimension, number), Some(name));
        }
        names.into_iter().map(|(number, name)| format!("{number} {name}")).collect::<Vec<_>>()
    };
    use Dimension::{Planar, Spatial};
    for (kind, dimension, expected) in [
        (JointKind::Revolute, Planar, &["0 turn"][..]),
        (JointKind::Spherical, Spatial, &[]),
        (JointKind::Universal, Spatial, &["0 first", "1 second"]),
        (JointKind::Prismatic, Spatial, &["0 slide"]),
        (JointKind::Cylindrical, Spatial, &["0 slide", "1 turn"]),
        (JointKind::Planar, Spatial, &["0 x", "1 y", "2 turn"]),
        (JointKind::PinInSlot, Planar, &["0 slide", "1 turn"]),
        (JointKind::PinInSlot, Spatial, &["0 slide"]),
        (JointKind::Weld, Spatial, &[]),
        (JointKind::Free, Planar, &["0 x", "1 y", "2 turn"]),
        (JointKind::Free, Spatial, &["0 x", "1 y", "2 z"]),
        (JointKind::Distance, Spatial, &[]),
    ] {
        assert_eq!(names(kind, dimension), expected, "{kind:?}");
    }
}
