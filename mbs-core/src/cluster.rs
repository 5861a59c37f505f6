//! Clusters of welded bodies. Bodies that never move relative to each other form one cluster. Bodies welded to the ground belong to no
//! cluster. A point mass on a ball joint belongs to the cluster of the body to which the joint connects it. If it has several ball joints,
//! the first one decides.

use crate::Real;
use crate::algebra::{Matrix, Vector, cross, norm};
use crate::mechanism::Scene;
use crate::scene::{Body, BodyId, Inertia, Joint, steiner};
use alloc::vec;
use alloc::vec::Vec;

/// A rigid cluster of one or more bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Cluster<T: Real> {
    /// Indices of the bodies in the scene.
    pub bodies: Vec<usize>,
    /// Mass of the cluster [kg].
    pub mass: T,
    /// Position of the centre of mass in the reference configuration [m].
    pub center: Vector<T, 3>,
    /// Inertia about the centre of mass in global axes [kg m^2].
    pub inertia: Matrix<T, 3>,
    /// End points of the rod [m] if the cluster is one slender rod, with or without point masses on its line.
    pub rod: Option<[Vector<T, 3>; 2]>,
    /// True if the cluster consists of point masses at one place only.
    pub is_point: bool,
}

impl<T: Real> Cluster<T> {
    /// Masses on which gravity acts [kg], each with its position [m]. The list has one entry, unless a body of the cluster has a gravity
    /// scale.
    pub fn weights(&self, scene: &Scene<T>) -> Vec<(T, Vector<T, 3>)> {
        let bodies = || self.bodies.iter().map(|&b| &scene.bodies[b]);
        if bodies().all(|body| body.gravity_scale.is_none()) {
            return vec![(self.mass, self.center)];
        }
        bodies().map(|body| (body.gravitational_mass(), body.mass_properties().1)).collect()
    }
}

/// All clusters of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Clusters<T: Real> {
    /// Index of the cluster of each body; `None`: the body belongs to the ground.
    pub of_body: Vec<Option<usize>>,
    /// The clusters, in the order of their first bodies.
    pub clusters: Vec<Cluster<T>>,
}

impl<T: Real> Clusters<T> {
    /// Merges the welded bodies of a scene, and each point mass with the body that a ball joint connects it to.
    pub fn new(scene: &Scene<T>) -> Self {
        let n = scene.bodies.len();
        // Union-find, with the ground as node n. The root of a set is its smallest body, or the ground if the set contains it.
        let mut parent: Vec<usize> = (0..=n).collect();
        let node = |body: BodyId| match body {
            BodyId::Ground => n,
            BodyId::Body(i) => i,
        };
        // True for a set that consists of point masses only. A ball joint holds a point mass fully, so that the point moves with the other
        // body.
        let mut is_point: Vec<bool> = scene.bodies.iter().map(Body::is_point).collect();
        is_point.push(false);
        let joins = |joint: &&Joint<T>, balls: bool| {
            if balls { joint.kind.is_ball(scene.dimension) } else { joint.kind.is_rigid() }
        };
        for balls in [false, true] {
            for joint in scene.joints.iter().filter(|joint| joins(joint, balls)) {
                let [a, b] = joint.bodies.map(|body| root(&mut parent, node(body)));
                if balls && !(is_point[a] || is_point[b]) {
                    continue;
                }
                let (keep, drop) = if a == n || (b != n && a < b) { (a, b) } else { (b, a) };
                parent[drop] = keep;
                is_point[keep] &= is_point[drop];
            }
        }
        let (mut of_body, mut members) = (vec![None; n], Vec::<Vec<usize>>::new());
        for body in 0..n {
            let first = root(&mut parent, body);
            if first < body {
                of_body[body] = of_body[first];
            } else if first == body {
                of_body[body] = Some(members.len());
                members.push(Vec::new());
            }
            if let Some(cluster) = of_body[body] {
                members[cluster].push(body);
            }
        }
        let clusters = members.into_iter().map(|bodies| merge(scene, bodies)).collect();
        Self { of_body, clusters }
    }

    /// Cluster of a body; `None` for the ground.
    pub fn of(&self, body: BodyId) -> Option<usize> {
        match body {
            BodyId::Ground => None,
            BodyId::Body(i) => self.of_body[i],
        }
    }
}

/// Root of node `i` in a union-find forest, where a root is its own parent. Path halving keeps later searches short.
///
/// # Panics
/// If `i` is not a node of the forest.
pub fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

/// Mass [kg], centre of mass [m] and inertia about it [kg m^2] of one body.
pub fn mass_properties<T: Real>(scene: &Scene<T>, body: usize) -> (T, Vector<T, 3>, Matrix<T, 3>) {
    scene.bodies[body].mass_properties()
}

fn merge<T: Real>(scene: &Scene<T>, bodies: Vec<usize>) -> Cluster<T> {
    let is_point = bodies.iter().all(|b| scene.bodies[*b].is_point());
    let rod = rod(scene, &bodies);
    if let [one] = bodies.as_slice() {
        let (mass, center, inertia) = mass_properties(scene, *one);
        return Cluster { bodies, mass, center, inertia, rod, is_point };
    }
    let (mut mass, mut moment) = (T::ZERO, Vector::<T, 3>::zeros());
    for &b in &bodies {
        let (m, c, _) = mass_properties(scene, b);
        mass += m;
        moment += c * m;
    }
    let (_, first, _) = mass_properties(scene, bodies[0]);
    let center = if mass > T::ZERO { moment * (T::ONE / mass) } else { first };
    let mut inertia = Matrix::<T, 3>::zeros();
    for &b in &bodies {
        let (m, c, i) = mass_properties(scene, b);
        inertia += i + steiner(m, &(c - center));
    }
    Cluster { bodies, mass, center, inertia, rod, is_point }
}

/// End points of the only slender rod among the bodies, if all other bodies are point masses on its line.
fn rod<T: Real>(scene: &Scene<T>, bodies: &[usize]) -> Option<[Vector<T, 3>; 2]> {
    let mut rod = None;
    for body in bodies.iter().map(|b| &scene.bodies[*b]).filter(|body| !body.is_point()) {
        let Inertia::Rod { from, to } = body.inertia else { return None };
        if rod.replace([Vector::from(from), Vector::from(to)]).is_some() {
            return None;
        }
    }
    let [from, to] = rod?;
    let mut points = bodies.iter().map(|b| &scene.bodies[*b]).filter(|body| body.is_point());
    points.all(|body| is_on_line(&[from, to], body.center)).then_some([from, to])
}

/// True if a point is on the line of a rod, up to the square root of machine precision.
pub fn is_on_line<T: Real>([from, to]: &[Vector<T, 3>; 2], point: [T; 3]) -> bool {
    let along = to - from;
    let off = T::EPSILON.sqrt() * along.dot(&along);
    norm(&cross(&(Vector::from(point) - from), &along)) <= off
}

/// Length of a scene [m]: the largest distance of a defining point from the first defining point. It is one if all points coincide.
pub fn scene_length<T: Real>(scene: &Scene<T>) -> T {
    let mut first: Option<Vector<T, 3>> = None;
    let mut length = T::ZERO;
    let mut visit = |p: Vector<T, 3>| {
        let origin = *first.get_or_insert(p);
        length = length.max(norm(&(p - origin)));
    };
    for joint in &scene.joints {
        for p in joint.points {
            visit(Vector::from(p));
        }
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        if let Inertia::Rod { from, to } = body.inertia {
            visit(Vector::from(from));
            visit(Vector::from(to));
        }
        visit(mass_properties(scene, i).1);
    }
    if length > T::ZERO { length } else { T::ONE }
}

/// Distance below which points coincide, relative to the scene's length. Also the angle below which directions coincide [-]. Chosen, not
/// tuned.
pub const TOLERANCE: f64 = 1e-9;

/// Smallest tolerance in multiples of machine precision [-]. It exceeds `TOLERANCE` only in `f32`. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

/// Tolerance of coincident points: [`TOLERANCE`], or [`ROUNDINGS`] times machine precision if that is larger.
pub(crate) fn point_tolerance<T: Real>() -> T {
    T::from_f64(TOLERANCE).max(T::EPSILON * T::from_f64(ROUNDINGS))
}
