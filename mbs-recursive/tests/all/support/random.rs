//! Random mechanisms from a seed, with every kind of joint.

use mbs_core::scene::{Body, BodyId, Dimension, Inertia, Joint, JointKind, JointLimits, Scene};
use mbs_testkit::Random;
use mbs_testkit::scenes::empty;

/// Kinds of joints that carry coordinates in a spatial tree.
const SPATIAL: [JointKind; 6] = [
    JointKind::Revolute,
    JointKind::Spherical,
    JointKind::Universal,
    JointKind::Prismatic,
    JointKind::Cylindrical,
    JointKind::Planar,
];
const PLANAR: [JointKind; 2] = [JointKind::Revolute, JointKind::Prismatic];

fn vector(random: &mut Random, dimension: Dimension) -> [f64; 3] {
    let mut x = [random.next(), random.next(), random.next()];
    if dimension == Dimension::Planar {
        x[2] = 0.0;
    }
    x
}

fn body(random: &mut Random, dimension: Dimension, center: [f64; 3]) -> Body<f64> {
    let mass = 1.5 + random.next();
    let inertia = match dimension {
        Dimension::Planar => Inertia::Planar(0.3 + 0.2 * random.next()),
        Dimension::Spatial => {
            let mut small = || 0.03 * random.next();
            let products = [small(), small(), small()];
            let principal = [0.3, 0.35, 0.4].map(|i| i + small());
            let ([xx, yy, zz], [xy, yz, zx]) = (principal, products);
            Inertia::Spatial([xx, yy, zz, xy, yz, zx])
        }
    };
    Body { name: String::new(), mass, center, inertia, gravity_scale: None }
}

/// Returns a joint of a kind at a place, with random axes.
pub(crate) fn joint(
    random: &mut Random,
    dimension: Dimension,
    (kind, bodies, at): (JointKind, [BodyId; 2], [f64; 3]),
) -> Joint<f64> {
    let mut axis = || Some(vector(random, dimension));
    let [first, second] = kind.needs_axes(dimension);
    let axes = [first || kind.is_link(), second].map(|is_used| is_used.then(&mut axis).flatten());
    Joint { name: String::new(), kind, bodies, points: [at; 2], axes, limits: JointLimits::NONE }
}

/// Returns a tree of `n` bodies. Some joints have the parent as their second body.
pub(crate) fn tree(seed: u64, n: usize, dimension: Dimension) -> Scene<f64> {
    let random = &mut Random(seed);
    let mut scene = empty(&format!("tree {seed}"), dimension, Some([0.3, -9.81, 0.0]));
    for i in 0..n {
        let center = vector(random, dimension).map(|x| 2.0 * x);
        scene.bodies.push(body(random, dimension, center));
        // The second root body is free.
        if i == n / 2 {
            continue;
        }
        let parent = if i < 2 { BodyId::Ground } else { BodyId::Body(random.below(i)) };
        let kinds: &[JointKind] = if dimension == Dimension::Planar { &PLANAR } else { &SPATIAL };
        let kind = kinds[random.below(kinds.len())];
        let at: [f64; 3] = {
            let off = vector(random, dimension);
            core::array::from_fn(|k| center[k] + off[k])
        };
        let mut bodies = [parent, BodyId::Body(i)];
        if random.next() > 0.3 {
            bodies.reverse();
        }
        let joint = joint(random, dimension, (kind, bodies, at));
        scene.joints.push(joint);
    }
    scene
}

/// Kinds of joints that may be cut in a closed mechanism.
const CUTS: [JointKind; 7] = [
    JointKind::Distance,
    JointKind::Spherical,
    JointKind::Universal,
    JointKind::Cylindrical,
    JointKind::Planar,
    JointKind::Revolute,
    JointKind::Prismatic,
];

/// Returns a tree of ball joints (revolute joints in the plane) with `loops` further joints. The further joints close loops in the
/// reference configuration.
pub(crate) fn closed(seed: u64, n: usize, loops: usize, dimension: Dimension) -> Scene<f64> {
    let random = &mut Random(seed);
    let mut scene = tree(seed ^ 0x55, n, dimension);
    scene.name = format!("closed {seed}");
    for joint in &mut scene.joints {
        joint.kind = match dimension {
            Dimension::Planar => JointKind::Revolute,
            Dimension::Spatial => JointKind::Spherical,
        };
        joint.axes = [None, None];
    }
    for i in 0..loops {
        let first = random.below(n);
        let second = (first + 1 + random.below(n - 1)) % n;
        let (first, second) = (BodyId::Body(first), BodyId::Body(second));
        let first = if i % 4 == 3 { BodyId::Ground } else { first };
        let at = vector(random, dimension).map(|x| 2.0 * x);
        let kind = match dimension {
            Dimension::Planar => [JointKind::Distance, JointKind::Revolute][i % 2],
            Dimension::Spatial => CUTS[random.below(CUTS.len())],
        };
        let mut added = joint(random, dimension, (kind, [first, second], at));
        if kind == JointKind::Distance {
            added.points[1] = vector(random, dimension);
            if i % 3 > 0 || dimension == Dimension::Planar {
                added.axes = [None, None];
            }
        }
        scene.joints.push(added);
    }
    scene
}
