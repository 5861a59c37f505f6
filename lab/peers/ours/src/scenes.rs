//! Mechanisms of uniform rods of 1 m and 1 kg on revolute joints about z, and the states in which they are evaluated.

use crate::clock::STATES;
use crate::line::exactly;
use mbs_core::Real;
use mbs_core::scene::{Body, BodyId, Dimension, Inertia, Joint, JointKind, Scene};

/// Gravity in the plane of motion [m/s^2].
pub(crate) const GRAVITY: f64 = 9.81;

/// A scene without bodies.
pub(crate) fn empty<T: Real>(dimension: Dimension, gravity: f64) -> Scene<T> {
    let gravity = Some([T::ZERO, exactly(-gravity), T::ZERO]);
    Scene { gravity, ..Scene::empty("", dimension, T::ONE) }
}

/// Adds a rod from `from` along (c, s), with a moment of inertia of 0.001 kg m² about its own line. Returns the body.
pub(crate) fn add_rod<T: Real>(scene: &mut Scene<T>, from: [T; 2], [c, s]: [T; 2]) -> BodyId {
    let (thin, thick) = (exactly::<T>(1e-3), exactly::<T>(1.0 / 12.0));
    let inertia = match scene.dimension {
        Dimension::Planar => Inertia::Planar(thick),
        // R diag(thin, thick, thick) Rᵀ
        Dimension::Spatial => Inertia::Spatial([
            thin * c * c + thick * s * s,
            thin * s * s + thick * c * c,
            thick,
            (thin - thick) * c * s,
            T::ZERO,
            T::ZERO,
        ]),
    };
    let center = [from[0] + T::HALF * c, from[1] + T::HALF * s, T::ZERO];
    scene.bodies.push(Body {
        name: String::new(),
        mass: T::ONE,
        center,
        inertia,
        gravity_scale: None,
    });
    BodyId::Body(scene.bodies.len() - 1)
}

/// Adds a joint at a point.
pub(crate) fn add_joint<T: Real>(
    scene: &mut Scene<T>,
    kind: JointKind,
    bodies: [BodyId; 2],
    [x, y]: [T; 2],
) {
    let [needs_axis, _] = kind.needs_axes(scene.dimension);
    let axis = needs_axis.then_some([T::ZERO, T::ZERO, T::ONE]);
    let points = [[x, y, T::ZERO]; 2];
    scene.joints.push(Joint {
        name: String::new(),
        kind,
        bodies,
        points,
        axes: [axis, None],
        limits: Default::default(),
    });
}

/// Adds a rod along x with its joint at 1 m from the parent's joint. Returns the body.
fn hang<T: Real>(scene: &mut Scene<T>, parent: BodyId, x: f64) -> BodyId {
    let at = [exactly(x), T::ZERO];
    let body = add_rod(scene, at, [T::ONE, T::ZERO]);
    add_joint(scene, JointKind::Revolute, [parent, body], at);
    body
}

/// An open mechanism.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shape {
    /// Rods in a chain, each on the end of the one before.
    Chain,
    /// A binary tree.
    Tree,
}

impl Shape {
    /// The scene of `n` rods.
    pub(crate) fn scene<T: Real>(self, n: usize, dimension: Dimension, gravity: f64) -> Scene<T> {
        match self {
            Self::Chain => chain(n, dimension, gravity),
            Self::Tree => tree(n, dimension, gravity),
        }
    }
}

/// A chain of `n` rods.
fn chain<T: Real>(n: usize, dimension: Dimension, gravity: f64) -> Scene<T> {
    let mut scene = empty(dimension, gravity);
    let mut last = BodyId::Ground;
    for i in 0..n {
        last = hang(&mut scene, last, i as f64);
    }
    scene
}

/// A binary tree of `n` rods, numbered depth first.
fn tree<T: Real>(n: usize, dimension: Dimension, gravity: f64) -> Scene<T> {
    fn grow<T: Real>(scene: &mut Scene<T>, (i, n): (usize, usize), parent: BodyId, x: f64) {
        let body = hang(scene, parent, x);
        for child in [2 * i + 1, 2 * i + 2].into_iter().filter(|&child| child < n) {
            grow(scene, (child, n), body, x + 1.0);
        }
    }
    let mut scene = empty(dimension, gravity);
    grow(&mut scene, (0, n), BodyId::Ground, 0.0);
    scene
}

/// Angles and rates of `n` joints by a linear congruential generator. Every program uses the same numbers.
pub(crate) fn states(n: usize) -> Vec<[Vec<f64>; 2]> {
    let mut seed: u32 = 1;
    let mut next = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / 16_777_216.0 * 2.0 - 1.0
    };
    let mut numbers = |scale: f64| (0..n).map(|_| scale * next()).collect();
    (0..STATES).map(|_| [numbers(3.0), numbers(1.0)]).collect()
}
