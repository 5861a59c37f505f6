//! Clusters of welded bodies: bodies that never move against each other become one cluster; welded to the ground they vanish. A point
//! mass on a ball joint is part of the body that it is joined to; of several, of the first.

use crate::Real;
use crate::algebra::{Matrix, Vector, cross, norm};
use crate::mechanism::Scene;
use crate::scene::{Body, BodyId, Inertia, Joint, steiner};
use alloc::vec;
use alloc::vec::Vec;

/// A rigid cluster of one or more bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Cluster<T: Real> {
    /// Indices of the bodies.
    pub bodies: Vec<usize>,
    /// Mass of the cluster [kg].
    pub mass: T,
    /// Centre of mass, reference configuration [m].
    pub center: Vector<T, 3>,
    /// Inertia about the centre of mass, global axes [kg m^2].
    pub inertia: Matrix<T, 3>,
    /// Ends, when it is a single slender rod, with points on its line or without.
    pub rod: Option<[Vector<T, 3>; 2]>,
    /// Is it nothing but point masses in one place?
    pub is_point: bool,
}

impl<T: Real> Cluster<T> {
    /// The masses on which gravity acts [kg], each with its place: one, unless gravity has a factor on some body.
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
    /// Cluster of each body; `None`: part of the ground.
    pub of_body: Vec<Option<usize>>,
    /// The clusters, in the order of their first bodies.
    pub clusters: Vec<Cluster<T>>,
}

impl<T: Real> Clusters<T> {
    /// Merges the welded bodies of a scene, and its point masses with what holds them.
    pub fn new(scene: &Scene<T>) -> Self {
        let n = scene.bodies.len();
        // Union-find with the ground as number n; a root is the smallest body, the ground wins.
        let mut parent: Vec<usize> = (0..=n).collect();
        let node = |body: BodyId| match body {
            BodyId::Ground => n,
            BodyId::Body(i) => i,
        };
        // Is it nothing but points? What is joined to one by a ball moves with it, as all its points do.
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

    /// The cluster of a body reference; `None`: the ground.
    pub fn of(&self, body: BodyId) -> Option<usize> {
        match body {
            BodyId::Ground => None,
            BodyId::Body(i) => self.of_body[i],
        }
    }
}

/// The root of `i` in a forest where roots are their own parents (union-find); the way there is halved, so that long chains stay
/// cheap.
///
/// # Panics
/// If `i` is not in the forest.
pub fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

/// Mass, centre and inertia about the centre of one body.
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

/// The ends of a slender rod, if the other bodies are points on its line.
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

/// Does a point lie on the line of a rod?
pub fn is_on_line<T: Real>([from, to]: &[Vector<T, 3>; 2], point: [T; 3]) -> bool {
    let along = to - from;
    let off = T::EPSILON.sqrt() * along.dot(&along);
    norm(&cross(&(Vector::from(point) - from), &along)) <= off
}

/// The length of a scene [m]: the largest distance of a hard point from the first one; one if all coincide.
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

/// Distance below which features are one, relative to the scene's length (points) or as an angle (directions) [-]. Chosen, not tuned.
pub const TOLERANCE: f64 = 1e-9;

/// Least tolerance, in units of rounding [-]: it counts in `f32` alone. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

/// [`TOLERANCE`], or [`ROUNDINGS`] where the scalar has fewer digits.
pub(crate) fn point_tolerance<T: Real>() -> T {
    T::from_f64(TOLERANCE).max(T::EPSILON * T::from_f64(ROUNDINGS))
}
