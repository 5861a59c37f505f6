//! Basis of a body: entities whose combinations give all points of the body, and the constant mass matrix.
//!
//! ```text
//! plane:  r(p) = e_1 + w (e_2 - e_1)  or  e_1 + w u,   w complex          M = G (x) complex 2x2
//! space:  r(p) = sum_k a_k b_k,  a = D^-1 [p; 1],  D = columns [b_k; 1 or 0]
//!         G = D^-1 [[S, m c], [m c^T, m]] D^-T,   S = tr(I)/2 1 - I,      M = G (x) 1_3
//! rod:    r(p) = e_1 + w (e_2 - e_1),  w real
//! point:  r = e_1                                                         M = m 1
//! ```
//!
//! Here r(p) is the position of the material point p, and e_k, b_k and u are entities: points, or the direction u. M is the mass
//! matrix, G its matrix over the entities, m the mass, c the centre of mass, and I the inertia about the origin.
//!
//! Entities that the body shares with others come first. The body's own point or unit vectors complete the basis. Entities on the
//! ground are preferred, because they add no unknowns. A direction is accepted only if the part of its unit vector orthogonal to
//! the accepted directions has at least the length [`INDEPENDENCE`].

use super::sharing::{Entity, EntityKind};
use crate::Real;
use crate::algebra::{Coef, Matrix, Vector, across, cross, inverse, norm};
use crate::cluster::Cluster;
use alloc::vec::Vec;

/// Least orthogonal part of a unit vector, relative to the directions before it, for which the vector enters a basis [-]: sin
/// 11.5°. Chosen, not tuned.
pub const INDEPENDENCE: f64 = 0.2;
/// Least distance of the two points of a basis, relative to the body's size [-]: rounding errors grow by its inverse. Chosen, not
/// tuned.
const LEAST_ARM: f64 = 0.05;
/// Largest coefficient that counts as a rounding error, in units of the rounding of its summands [-]. Chosen, not tuned.
const SNAP_ROUNDINGS: f64 = 32.0;
/// Factor by which a later candidate must be better [-], so that rounding errors do not decide the choice. Chosen, not tuned.
const BETTER: f64 = 1.01;

/// Combination of entities by their numbers, before the coordinates are numbered.
pub(crate) type Combination<T> = Vec<(usize, Coef<T>)>;

/// Basis of one rigid cluster.
#[derive(Debug, Clone)]
pub(crate) struct Basis<T: Real> {
    /// Entities of the basis; the first is a point.
    pub(crate) entities: Vec<usize>,
    frame: Frame<T>,
}

#[derive(Debug, Clone)]
enum Frame<T: Real> {
    /// Origin, and the vector of the second entity as a complex number. `is_point`: the second entity is a point, not a direction.
    Planar { origin: Vector<T, 3>, second: Coef<T>, is_point: bool },
    /// Two points of a rod.
    Rod { origin: Vector<T, 3>, along: Vector<T, 3> },
    /// Frame of a point mass: there is one point, and no direction.
    Point,
    /// Origin, which is subtracted before D is formed, and the inverse of D.
    Spatial { origin: Vector<T, 3>, inverse: Matrix<T, 4> },
}

impl<T: Real> Basis<T> {
    /// Chooses the basis of a planar cluster among its shared entities. Missing entities are added to `entities`.
    pub(crate) fn planar(
        cluster: &Cluster<T>,
        shared: &[usize],
        entities: &mut Vec<Entity<T>>,
    ) -> Self {
        let points = points_of(shared, entities);
        let origin = first_point(cluster, &points, entities);
        let at = entities[origin].at;
        let far = farthest(&points, &at, entities);
        let direction = shared.iter().copied().find(|&e| entities[e].kind == EntityKind::Direction);
        let size = far.map_or(T::ZERO, |(_, d)| d);
        let least = T::from_f64(LEAST_ARM);
        let (second, is_point) = match (far, direction) {
            (_, Some(d)) if entities[d].is_constant => (d, false),
            (Some((p, _)), _) if size > cluster_size(cluster, &at) * least => (p, true),
            (_, Some(d)) => (d, false),
            _ => (own_direction(Vector::<T, 3>::new(T::ONE, T::ZERO, T::ZERO), entities), false),
        };
        let v = if is_point { entities[second].at - at } else { entities[second].at };
        let frame = Frame::Planar { origin: at, second: Coef { re: v[0], im: v[1] }, is_point };
        Self { entities: alloc::vec![origin, second], frame }
    }

    /// Basis of a point mass: its point.
    pub(crate) fn point_mass(
        cluster: &Cluster<T>,
        shared: &[usize],
        entities: &mut Vec<Entity<T>>,
    ) -> Self {
        let origin = first_point(cluster, &points_of(shared, entities), entities);
        Self { entities: alloc::vec![origin], frame: Frame::Point }
    }

    /// Basis of a slender rod: two points.
    pub(crate) fn rod(
        ends: &[Vector<T, 3>; 2],
        shared: &[usize],
        entities: &mut Vec<Entity<T>>,
    ) -> Self {
        let points = points_of(shared, entities);
        let middle = (ends[0] + ends[1]) * T::HALF;
        let origin = points.first().copied().unwrap_or_else(|| own_point(ends[0], entities));
        let at = entities[origin].at;
        let length = norm(&(ends[1] - ends[0]));
        let second = match farthest(&points, &at, entities) {
            Some((p, d)) if d > length * T::from_f64(LEAST_ARM) => p,
            _ => {
                let far =
                    if norm(&(ends[0] - at)) > norm(&(ends[1] - at)) { ends[0] } else { ends[1] };
                debug_assert!(norm(&(far - middle)) > T::ZERO);
                own_point(far, entities)
            }
        };
        let along = entities[second].at - at;
        Self { entities: alloc::vec![origin, second], frame: Frame::Rod { origin: at, along } }
    }

    /// Basis of a spatial cluster: four entities. `None` if they are dependent, which does not occur with finite data.
    pub(crate) fn spatial(
        cluster: &Cluster<T>,
        shared: &[usize],
        entities: &mut Vec<Entity<T>>,
    ) -> Option<Self> {
        let points = points_of(shared, entities);
        let origin = first_point(cluster, &points, entities);
        let at = entities[origin].at;
        let mut chosen = alloc::vec![origin];
        let mut units: Vec<Vector<T, 3>> = Vec::new();
        for constants in [true, false] {
            while chosen.len() < 4 {
                let best = most_independent(shared, &chosen, &units, &at, entities, constants);
                let Some((e, unit)) = best else { break };
                chosen.push(e);
                units.push(unit);
            }
        }
        while chosen.len() < 4 {
            let unit = match units.as_slice() {
                [] => Vector::<T, 3>::new(T::ONE, T::ZERO, T::ZERO),
                [a] => across(a),
                [a, b, ..] => {
                    let c = cross(a, b);
                    c * (T::ONE / norm(&c))
                }
            };
            chosen.push(own_direction(unit, entities));
            units.push(unit);
        }
        let mut d = Matrix::<T, 4>::zeros();
        for (k, &e) in chosen.iter().enumerate() {
            let is_point = entities[e].kind == EntityKind::Point;
            let v = if is_point { entities[e].at - at } else { entities[e].at };
            for i in 0..3 {
                d[(i, k)] = v[i];
            }
            d[(3, k)] = if is_point { T::ONE } else { T::ZERO };
        }
        let inverse = inverse(&d)?;
        Some(Self { entities: chosen, frame: Frame::Spatial { origin: at, inverse } })
    }

    /// True if the basis describes a rotation about every axis. The bases of a rod and of a point do not.
    pub(crate) fn is_full(&self) -> bool {
        !matches!(self.frame, Frame::Rod { .. } | Frame::Point)
    }

    /// Combination that gives the material point `p`.
    pub(crate) fn point(&self, p: &Vector<T, 3>) -> Combination<T> {
        self.combination(p, true)
    }

    /// Combination that gives the body-fixed direction `d`.
    pub(crate) fn direction(&self, d: &Vector<T, 3>) -> Combination<T> {
        self.combination(d, false)
    }

    fn combination(&self, p: &Vector<T, 3>, is_point: bool) -> Combination<T> {
        let unit = if is_point { Coef::one() } else { Coef::zero() };
        let from = |origin: &Vector<T, 3>| {
            if is_point { (p - origin, size(p) + size(origin)) } else { (*p, size(p)) }
        };
        // Each coefficient, with the size of its summands.
        let coefs: Vec<(Coef<T>, T)> = match &self.frame {
            Frame::Point => alloc::vec![(unit, unit.re)],
            Frame::Planar { origin, second, is_point: two_points } => {
                let (v, reach) = from(origin);
                let w = quotient(Coef { re: v[0], im: v[1] }, *second);
                let reach = reach / second.norm_squared().sqrt();
                let first = if *two_points { unit.minus(w) } else { unit };
                alloc::vec![(first, reach.max(unit.re)), (w, reach)]
            }
            Frame::Rod { origin, along } => {
                let (v, reach) = from(origin);
                let square = along.dot(along);
                let w = Coef::real(v.dot(along) / square);
                let reach = reach / square.sqrt();
                alloc::vec![(unit.minus(w), reach.max(unit.re)), (w, reach)]
            }
            Frame::Spatial { origin, inverse } => {
                let (v, reach) = from(origin);
                let row = |k: usize| {
                    let last = if is_point { inverse[(k, 3)] } else { T::ZERO };
                    let entries = [inverse[(k, 0)], inverse[(k, 1)], inverse[(k, 2)]];
                    let sum = entries[0] * v[0] + entries[1] * v[1] + entries[2] * v[2] + last;
                    let largest = entries.into_iter().fold(T::ZERO, |a, x| a.max(x.abs()));
                    (Coef::real(sum), largest * reach + last.abs())
                };
                (0..4).map(row).collect()
            }
        };
        self.entities
            .iter()
            .copied()
            .zip(coefs.into_iter().map(|(c, size)| snap(c, size)))
            .filter(|(_, c)| !c.is_zero())
            .collect()
    }

    /// Matrix G of the basis entities, row by row [kg, kg m, kg m^2].
    pub(crate) fn mass_matrix(&self, cluster: &Cluster<T>) -> Vec<Coef<T>> {
        let (m, c, inertia) = (cluster.mass, &cluster.center, &cluster.inertia);
        match &self.frame {
            Frame::Point => alloc::vec![Coef::real(m)],
            Frame::Planar { origin, second, is_point } => {
                let r = c - origin;
                let polar = inertia[(2, 2)] + m * (r[0] * r[0] + r[1] * r[1]);
                let g22 = Coef::real(polar / second.norm_squared());
                let moment = quotient(Coef { re: r[0], im: r[1] }, *second).scaled(m);
                two_by_two(m, moment, g22, *is_point)
            }
            Frame::Rod { origin, along } => {
                let r = c - origin;
                let square = along.dot(along);
                // The transverse moment of a slender rod is the integral of the squared distance along the rod.
                let transverse = (inertia[(0, 0)] + inertia[(1, 1)] + inertia[(2, 2)]) * T::HALF;
                let g22 = Coef::real((transverse + m * r.dot(&r)) / square);
                two_by_two(m, Coef::real(m * r.dot(along) / square), g22, true)
            }
            Frame::Spatial { origin, inverse } => {
                let r = c - origin;
                let half_trace = (inertia[(0, 0)] + inertia[(1, 1)] + inertia[(2, 2)]) * T::HALF;
                let mut j = Matrix::<T, 4>::zeros();
                for i in 0..3 {
                    for k in 0..3 {
                        let s = if i == k { half_trace } else { T::ZERO } - inertia[(i, k)];
                        j[(i, k)] = s + m * r[i] * r[k];
                    }
                    j[(i, 3)] = m * r[i];
                    j[(3, i)] = m * r[i];
                }
                j[(3, 3)] = m;
                let g = inverse * j * inverse.transpose();
                let mut rows = Vec::with_capacity(16);
                for i in 0..4 {
                    for k in 0..4 {
                        rows.push(Coef::real((g[(i, k)] + g[(k, i)]) * T::HALF));
                    }
                }
                rows
            }
        }
    }
}

/// Matrix G of a basis of two entities. Two points: r = e_1 + w (e_2 - e_1). A point and a direction: r = e_1 + w u.
fn two_by_two<T: Real>(m: T, moment: Coef<T>, g22: Coef<T>, two_points: bool) -> Vec<Coef<T>> {
    if two_points {
        let g11 = Coef::real(m).minus(Coef::real(moment.re * T::TWO)).plus(g22);
        let g12 = moment.minus(g22);
        alloc::vec![g11, g12, g12.conj(), g22]
    } else {
        alloc::vec![Coef::real(m), moment, moment.conj(), g22]
    }
}

/// Rounds a coefficient to zero if it is a rounding error relative to `size`, the size of its summands. Elements then use no
/// coordinates without need. A coefficient that differs from one by a rounding error becomes one.
fn snap<T: Real>(c: Coef<T>, size: T) -> Coef<T> {
    let tiny = T::EPSILON * T::from_f64(SNAP_ROUNDINGS);
    let clean = |x: T| {
        if x.abs() <= tiny * size {
            T::ZERO
        } else if (x - T::ONE).abs() <= tiny {
            T::ONE
        } else {
            x
        }
    };
    Coef { re: clean(c.re), im: clean(c.im) }
}

/// Largest absolute value among the components of a vector.
fn size<T: Real>(x: &Vector<T, 3>) -> T {
    x.iter().fold(T::ZERO, |a, x| a.max(x.abs()))
}

fn quotient<T: Real>(a: Coef<T>, b: Coef<T>) -> Coef<T> {
    a.times(b.conj()).scaled(T::ONE / b.norm_squared())
}

fn points_of<T: Real>(shared: &[usize], entities: &[Entity<T>]) -> Vec<usize> {
    shared.iter().copied().filter(|&e| entities[e].kind == EntityKind::Point).collect()
}

/// Returns the first point of a basis: a ground point, else the first shared point, else a new point at the centre.
fn first_point<T: Real>(
    cluster: &Cluster<T>,
    points: &[usize],
    entities: &mut Vec<Entity<T>>,
) -> usize {
    let on_ground = points.iter().copied().find(|&e| entities[e].is_constant);
    on_ground.or(points.first().copied()).unwrap_or_else(|| own_point(cluster.center, entities))
}

fn own_point<T: Real>(at: Vector<T, 3>, entities: &mut Vec<Entity<T>>) -> usize {
    entities.push(Entity { kind: EntityKind::Point, at, is_constant: false });
    entities.len() - 1
}

fn own_direction<T: Real>(at: Vector<T, 3>, entities: &mut Vec<Entity<T>>) -> usize {
    entities.push(Entity { kind: EntityKind::Direction, at, is_constant: false });
    entities.len() - 1
}

fn farthest<T: Real>(
    points: &[usize],
    from: &Vector<T, 3>,
    entities: &[Entity<T>],
) -> Option<(usize, T)> {
    let mut best: Option<(usize, T)> = None;
    for &p in points {
        let d = norm(&(entities[p].at - from));
        if d > T::ZERO && best.is_none_or(|(_, largest)| d > largest) {
            best = Some((p, d));
        }
    }
    best
}

/// Typical length of a cluster: the larger of the distance from a point to the centre and the radius of gyration.
fn cluster_size<T: Real>(cluster: &Cluster<T>, from: &Vector<T, 3>) -> T {
    let gyration = if cluster.mass > T::ZERO {
        (cluster.inertia[(2, 2)] / cluster.mass).sqrt()
    } else {
        T::ZERO
    };
    norm(&(cluster.center - from)).max(gyration)
}

/// Candidate whose unit vector has the largest part orthogonal to the chosen ones, with the unit vector of that part.
fn most_independent<T: Real>(
    shared: &[usize],
    chosen: &[usize],
    units: &[Vector<T, 3>],
    origin: &Vector<T, 3>,
    entities: &[Entity<T>],
    constants: bool,
) -> Option<(usize, Vector<T, 3>)> {
    let mut best: Option<(usize, Vector<T, 3>, T)> = None;
    for &e in shared {
        if chosen.contains(&e) || (constants && !entities[e].is_constant) {
            continue;
        }
        let v = match entities[e].kind {
            EntityKind::Point => entities[e].at - origin,
            EntityKind::Direction => entities[e].at,
        };
        let length = norm(&v);
        if length == T::ZERO {
            continue;
        }
        let mut w = v * (T::ONE / length);
        for u in units {
            w -= u * u.dot(&w);
        }
        let new = norm(&w);
        let is_better = best.as_ref().is_none_or(|(_, _, b)| new > *b * T::from_f64(BETTER));
        if new > T::from_f64(INDEPENDENCE) && is_better {
            best = Some((e, w * (T::ONE / new), new));
        }
    }
    best.map(|(e, unit, _)| (e, unit))
}
