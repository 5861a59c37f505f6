//! Welds first: bodies that never move against each other become one cluster; welded to the ground they vanish.

use crate::Real;
use crate::algebra::{Matrix, Vector, norm};
use crate::scene::{BodyId, Inertia, Scene, steiner};
use alloc::vec;
use alloc::vec::Vec;

/// A rigid cluster of one or more bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Cluster<T: Real> {
    /// Indices of the bodies.
    pub bodies: Vec<usize>,
    /// Mass [kg].
    pub mass: T,
    /// Centre of mass, reference configuration [m].
    pub center: Vector<T, 3>,
    /// Inertia about the centre of mass, global axes [kg m^2].
    pub inertia: Matrix<T, 3>,
    /// Ends, when it is a single slender rod.
    pub rod: Option<[Vector<T, 3>; 2]>,
}

/// All clusters.
#[derive(Debug, Clone, PartialEq)]
pub struct Clusters<T: Real> {
    /// Cluster of each body; `None`: part of the ground.
    pub of_body: Vec<Option<usize>>,
    /// The clusters, in the order of their first bodies.
    pub clusters: Vec<Cluster<T>>,
}

impl<T: Real> Clusters<T> {
    /// Merges the welded bodies of a scene.
    pub fn new(scene: &Scene<T>) -> Self {
        let n = scene.bodies.len();
        // Union-find with the ground as number n; a root is the smallest body, the ground wins.
        let mut parent: Vec<usize> = (0..=n).collect();
        let node = |body: BodyId| match body {
            BodyId::Ground => n,
            BodyId::Body(i) => i,
        };
        for joint in scene.joints.iter().filter(|j| j.kind.is_rigid()) {
            let (a, b) = (
                root(&mut parent, node(joint.bodies[0])),
                root(&mut parent, node(joint.bodies[1])),
            );
            let (keep, drop) = if a == n || (b != n && a < b) { (a, b) } else { (b, a) };
            parent[drop] = keep;
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
    let rod = match (bodies.as_slice(), &scene.bodies[bodies[0]].inertia) {
        ([_], Inertia::Rod { from, to }) => Some([Vector::from(*from), Vector::from(*to)]),
        _ => None,
    };
    if let [one] = bodies.as_slice() {
        let (mass, center, inertia) = mass_properties(scene, *one);
        return Cluster { bodies, mass, center, inertia, rod };
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
    Cluster { bodies, mass, center, inertia, rod }
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
