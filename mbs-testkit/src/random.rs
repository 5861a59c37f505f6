//! Random mechanisms: trees of mixed joints, and closed loops. The same seed gives the same mechanism on every machine.

use crate::scenes::empty;
use mbs_core::scene::{
    Body, BodyId, Dimension, Effect, EffectKind, Freedom, Guide, Inertia, InitialCondition,
    InitialTarget, Joint, JointId, JointKind, JointLimits, Motion, Scene, SpringDamper,
};

/// Generator of pseudo-random numbers, the same on every machine (xorshift64*); its state must not be zero.
#[derive(Debug, Clone)]
pub struct Random(pub u64);

impl Random {
    /// Creates the generator from a seed, which may be any number.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// Returns the next number in [-1, 1].
    #[allow(
        clippy::should_implement_trait,
        reason = "it never ends, and is asked for single numbers"
    )]
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Returns a random whole number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (((self.next() + 1.0) * 0.5 * n as f64) as usize).min(n - 1)
    }

    /// Returns a vector of `length` numbers. The first `n` are random numbers in [-1, 1] times `size`, the others zero.
    pub fn vector(&mut self, n: usize, length: usize, size: f64) -> Vec<f64> {
        (0..length).map(|i| if i < n { size * self.next() } else { 0.0 }).collect()
    }

    fn point(&mut self, dimension: Dimension, size: f64) -> [f64; 3] {
        let [x, y, z] = [self.next(), self.next(), self.next()].map(|x| x * size);
        [x, y, if dimension == Dimension::Spatial { z } else { 0.0 }]
    }

    /// Returns a direction whose length is not close to zero.
    fn axis(&mut self, dimension: Dimension) -> [f64; 3] {
        loop {
            let a = self.point(dimension, 1.0);
            if a.iter().map(|x| x * x).sum::<f64>() > 0.2 {
                return a;
            }
        }
    }

    /// Returns principal moments of inertia that a real body can have.
    fn inertia(&mut self, dimension: Dimension, mass: f64) -> Inertia<f64> {
        let [a, b, c] = [0; 3].map(|_| 0.02 + 0.01 * self.next()).map(|x| x * mass);
        match dimension {
            Dimension::Planar => Inertia::Planar(a + b),
            Dimension::Spatial => Inertia::Spatial([b + c, c + a, a + b, 0.0, 0.0, 0.0]),
        }
    }
}

fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

const PLANAR_KINDS: [JointKind; 4] =
    [JointKind::Revolute, JointKind::Revolute, JointKind::Revolute, JointKind::Prismatic];
const SPATIAL_KINDS: [JointKind; 6] = [
    JointKind::Revolute,
    JointKind::Revolute,
    JointKind::Spherical,
    JointKind::Universal,
    JointKind::Prismatic,
    JointKind::Cylindrical,
];

/// Creates a tree of `n` bodies in gravity with initial velocities; each is attached to the ground or to an earlier body.
#[must_use]
pub fn tree(seed: u64, dimension: Dimension, n: usize) -> Scene<f64> {
    let mut random = Random::new(seed);
    let (mut bodies, mut joints, mut initials) = (Vec::<Body<f64>>::new(), Vec::new(), Vec::new());
    for i in 0..n {
        let (parent, place) = if i == 0 || random.below(5) == 0 {
            (BodyId::Ground, random.point(dimension, 0.5))
        } else {
            let parent = random.below(i);
            let from = bodies[parent].center;
            (BodyId::Body(parent), plus(from, random.point(dimension, 0.4)))
        };
        let mass = 1.5 + random.next();
        let inertia = random.inertia(dimension, mass);
        let center = plus(place, random.point(dimension, 0.4));
        bodies.push(Body { name: format!("body-{i}"), mass, center, inertia, gravity_scale: None });
        let kind = match dimension {
            Dimension::Planar => PLANAR_KINDS[random.below(PLANAR_KINDS.len())],
            Dimension::Spatial => SPATIAL_KINDS[random.below(SPATIAL_KINDS.len())],
        };
        joints.push(joint(&mut random, dimension, kind, [parent, BodyId::Body(i)], place));
        let n_rates = kind.n_coordinates(dimension);
        let rate = Some((0..n_rates).map(|_| random.next()).collect());
        initials.push(InitialCondition {
            target: InitialTarget::Joint { joint: JointId::new(i), value: None, rate },
        });
    }
    let scene = empty(&format!("random tree {seed}"), dimension, Some([0.0, -9.81, 0.0]));
    Scene { duration: 0.2, bodies, joints, initials, ..scene }
}

/// Guides joints of one coordinate, each with the probability `chances` / 4. A guided joint has no initial value.
#[must_use]
pub fn guided(scene: Scene<f64>, seed: u64, chances: usize) -> Scene<f64> {
    guided_where(scene, seed, chances, |n| n == 1)
}

/// Guides joints with several coordinates, as [`guided`] does for joints with one. All coordinates of a chosen joint are guided.
#[must_use]
pub fn guided_whole(scene: Scene<f64>, seed: u64, chances: usize) -> Scene<f64> {
    guided_where(scene, seed, chances, |n| n > 1)
}

fn guided_where(
    mut scene: Scene<f64>,
    seed: u64,
    chances: usize,
    is_meant: impl Fn(usize) -> bool,
) -> Scene<f64> {
    let mut random = Random::new(seed ^ 0x7777);
    scene.name += ", guided";
    for (joint, data) in scene.joints.iter().enumerate() {
        let n = data.kind.n_coordinates(scene.dimension);
        if !is_meant(n) || random.below(4) >= chances {
            continue;
        }
        for number in 0..n {
            let [amplitude, rate, phase] = [random.next(), random.next(), 3.0 * random.next()];
            let law = match random.below(3) {
                0 => Motion::Ramp { rate },
                _ => Motion::Sine { amplitude: 0.3 * amplitude, frequency: 1.5 + rate, phase },
            };
            scene.guides.push(Guide { joint: JointId::new(joint), number, law });
        }
    }
    let guides = &scene.guides;
    scene.initials.retain(|initial| match &initial.target {
        InitialTarget::Joint { joint, .. } => guides.iter().all(|guide| guide.joint != *joint),
        _ => true,
    });
    scene
}

/// Creates a spatial tree whose axes are parallel to those of the frame, so that many bodies have the same directions.
#[must_use]
pub fn aligned_tree(seed: u64, n: usize) -> Scene<f64> {
    let mut scene = tree(seed, Dimension::Spatial, n);
    let mut random = Random::new(seed ^ 0xAAAA);
    let unit = |i: usize| Some([0, 1, 2].map(|k| f64::from(u8::from(k == i))));
    for joint in &mut scene.joints {
        let i = random.below(3);
        if joint.axes[0].is_some() {
            joint.axes[0] = unit(i);
        }
        if joint.axes[1].is_some() {
            joint.axes[1] = unit((i + 1) % 3);
        }
    }
    scene
}

fn joint(
    random: &mut Random,
    dimension: Dimension,
    kind: JointKind,
    bodies: [BodyId; 2],
    place: [f64; 3],
) -> Joint<f64> {
    let first = random.axis(dimension);
    let [needs_first, needs_second] = kind.needs_axes(dimension);
    let second = needs_second.then(|| {
        // Orthogonal to the first axis.
        let d = random.axis(dimension);
        [
            first[1] * d[2] - first[2] * d[1],
            first[2] * d[0] - first[0] * d[2],
            first[0] * d[1] - first[1] * d[0],
        ]
    });
    let axes = [needs_first.then_some(first), second];
    Joint {
        name: format!("{}-{:?}", kind.name(), bodies[1]),
        kind,
        bodies,
        points: [place; 2],
        axes,
        limits: JointLimits::NONE,
    }
}

/// Creates two bodies at rest with joints of one kind: a body on the ground, and a second body on the first.
#[must_use]
pub fn of_kind(seed: u64, kind: JointKind, dimension: Dimension) -> Scene<f64> {
    let mut random = Random::new(seed ^ 0x1111);
    let mut scene = tree(seed, dimension, 2);
    scene.name = format!("{} {}", kind.name(), scene.name);
    scene.initials.clear();
    let place = plus(scene.bodies[0].center, random.point(dimension, 0.3));
    let pairs = [[BodyId::Ground, BodyId::Body(0)], [BodyId::Body(1), BodyId::Body(0)]];
    let places = [scene.joints[0].points[0], place];
    scene.joints.clear();
    for (bodies, place) in pairs.into_iter().zip(places) {
        scene.joints.push(joint(&mut random, dimension, kind, bodies, place));
        let name = format!("joint-{}", scene.joints.len());
        scene.joints.last_mut().into_iter().for_each(|joint| joint.name.clone_from(&name));
    }
    scene
}

/// Creates a chain of ball joints (revolute joints in the plane). A joint of the given kind connects its end to the ground.
#[must_use]
pub fn closed_by(seed: u64, kind: JointKind, dimension: Dimension) -> Scene<f64> {
    let mut random = Random::new(seed ^ 0x2222);
    let (n, pin) = match dimension {
        Dimension::Planar => (3, JointKind::Revolute),
        Dimension::Spatial => (2, JointKind::Spherical),
    };
    let mut scene = tree(seed, dimension, n);
    scene.name = format!("{} closes {}", kind.name(), scene.name);
    scene.initials.clear();
    for (i, joint) in scene.joints.iter_mut().enumerate() {
        let first = if i == 0 { BodyId::Ground } else { BodyId::Body(i - 1) };
        (joint.kind, joint.axes, joint.bodies[0]) = (pin, [None; 2], first);
        joint.name = format!("pin-{i}");
    }
    let place = plus(scene.bodies[n - 1].center, random.point(dimension, 0.3));
    let bodies = [BodyId::Body(n - 1), BodyId::Ground];
    let mut closure = joint(&mut random, dimension, kind, bodies, place);
    if kind.is_link() {
        closure.points[1] = plus(place, random.point(dimension, 0.9));
    }
    scene.joints.push(closure);
    scene
}

/// Replaces each joint by a chain of massless bodies with one freedom at each joint.
#[must_use]
pub fn split(scene: &Scene<f64>) -> Scene<f64> {
    let (mut split, dimension) = (scene.clone(), scene.dimension);
    split.joints.clear();
    for joint in &scene.joints {
        let freedoms = joint.freedoms(dimension);
        let [mut first, last] = joint.bodies;
        for (i, freedom) in freedoms.iter().enumerate() {
            let mut second = last;
            if i + 1 < freedoms.len() {
                second = BodyId::Body(split.bodies.len());
                let inertia = match dimension {
                    Dimension::Planar => Inertia::Planar(0.0),
                    Dimension::Spatial => Inertia::Spatial([0.0; 6]),
                };
                let name = format!("{} {i}", joint.name);
                let center = joint.points[0];
                split.bodies.push(Body { name, mass: 0.0, center, inertia, gravity_scale: None });
            }
            let kind = match freedom {
                Freedom::Slide(_) => JointKind::Prismatic,
                Freedom::Turn(_) => JointKind::Revolute,
                Freedom::Ball => JointKind::Spherical,
            };
            let axis = freedom.axis().map(|axis| joint.direction(axis).into());
            let axis = axis.filter(|_| kind.needs_axes(dimension)[0]);
            let name = format!("{} {i}", joint.name);
            let (bodies, axes) = ([first, second], [axis, None]);
            split.joints.push(Joint { name, kind, bodies, axes, ..joint.clone() });
            first = second;
        }
    }
    split
}

/// Creates a tree with `n_loops` closing joints between bodies that are not neighbours. The closing joints are links and ball joints
/// (revolute joints in the plane). Only one joint of the tree has an initial velocity. Assembly determines the rates of the others.
#[must_use]
pub fn loops(seed: u64, dimension: Dimension, n: usize, n_loops: usize) -> Scene<f64> {
    let mut scene = tree(seed, dimension, n);
    let mut random = Random::new(seed ^ 0x5555);
    scene.name = format!("random loops {seed}");
    scene.initials.clear();
    let mut added = 0;
    while added < n_loops {
        let [a, b] = [random.below(n), random.below(n)];
        let are_neighbours = scene.joints.iter().any(|j| {
            let pair = [BodyId::Body(a), BodyId::Body(b)];
            j.bodies == pair || j.bodies == [pair[1], pair[0]]
        });
        if a == b || are_neighbours {
            continue;
        }
        let bodies = [BodyId::Body(a), BodyId::Body(b)];
        let [p, q] = [a, b].map(|i| {
            let center = scene.bodies[i].center;
            plus(center, random.point(dimension, 0.2))
        });
        let gap = plus(p, q.map(|x| -x)).iter().map(|x| x * x).sum::<f64>();
        if gap < 0.01 {
            continue;
        }
        let middle = [0, 1, 2].map(|i| 0.5 * (p[i] + q[i]));
        let name = format!("closure-{added}");
        let is_link = added % 2 == 0;
        let (kind, points) = match (is_link, dimension) {
            (true, _) => (JointKind::Distance, [p, q]),
            (false, Dimension::Planar) => (JointKind::Revolute, [middle; 2]),
            (false, Dimension::Spatial) => (JointKind::Spherical, [middle; 2]),
        };
        scene.joints.push(Joint {
            name,
            kind,
            bodies,
            points,
            axes: [None; 2],
            limits: JointLimits::NONE,
        });
        added += 1;
    }
    scene.effects.push(spring(&mut random, &scene, dimension));
    scene
}

/// Creates a tree with closed loops. No two loops have a joint in common. Each loop has more freedoms than its closing joint removes. With
/// random points and axes the equations are therefore independent.
#[must_use]
pub fn sound(seed: u64, dimension: Dimension, n: usize) -> Scene<f64> {
    let mut scene = tree(seed, dimension, n);
    let mut random = Random::new(seed ^ 0x3333);
    scene.name = format!("sound mechanism {seed}");
    scene.initials.clear();
    let mut is_used = vec![false; n];
    for _ in 0..6 * n {
        let [a, b] = [random.below(n), random.below(n)];
        let way = between(&scene, a, b);
        if a == b || way.len() < 2 || way.iter().any(|&j| is_used[j]) {
            continue;
        }
        let kinds = || way.iter().map(|&j| scene.joints[j].kind);
        let freedoms: usize = kinds().map(|kind| kind.n_coordinates(dimension)).sum();
        let turns: usize = kinds().map(|kind| kind.n_rotations(dimension)).sum();
        let closures: &[(JointKind, usize, usize)] = match dimension {
            Dimension::Planar => &[(JointKind::Revolute, 2, 2), (JointKind::Distance, 1, 1)],
            Dimension::Spatial => &[
                (JointKind::Revolute, 5, 4),
                (JointKind::Spherical, 3, 2),
                (JointKind::Distance, 1, 1),
            ],
        };
        let fits = closures.iter().find(|(_, rows, least)| freedoms > *rows && turns >= *least);
        let Some(&(kind, ..)) = fits else { continue };
        let [p, q] = [a, b].map(|i| plus(scene.bodies[i].center, random.point(dimension, 0.3)));
        let bodies = [BodyId::Body(a), BodyId::Body(b)];
        let mut closure = joint(&mut random, dimension, kind, bodies, p);
        if kind.is_link() {
            (closure.points, closure.axes) = ([p, q], [None; 2]);
        }
        closure.name = format!("closure-{}", scene.joints.len() - n);
        way.iter().for_each(|&j| is_used[j] = true);
        scene.joints.push(closure);
    }
    scene
}

/// Returns the joints of a tree on the path between two bodies; joint i is that of body i.
fn between(scene: &Scene<f64>, a: usize, b: usize) -> Vec<usize> {
    let up = |mut body: usize| {
        let mut way = vec![body];
        while let BodyId::Body(parent) = scene.joints[body].bodies[0] {
            way.push(parent);
            body = parent;
        }
        way
    };
    let [mut first, mut second] = [up(a), up(b)];
    while first.last().is_some() && first.last() == second.last() {
        first.pop();
        second.pop();
    }
    first.extend(second);
    first
}

/// Creates a spring with a damper between the ground and the last body.
fn spring(random: &mut Random, scene: &Scene<f64>, dimension: Dimension) -> Effect<f64> {
    let last = scene.bodies.len() - 1;
    let at = plus(scene.bodies[last].center, random.point(dimension, 0.1));
    let bodies = [BodyId::Ground, BodyId::Body(last)];
    let anchor = plus(at, [0.3, 0.8, 0.0]);
    let kind = EffectKind::SpringDamper(SpringDamper {
        bodies,
        points: [anchor, at],
        stiffness: 50.0,
        damping: 1.0,
        free_length: 0.5,
    });
    Effect { name: "spring".to_owned(), enabled: true, kind }
}
