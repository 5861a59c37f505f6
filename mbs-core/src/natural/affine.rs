//! Material points and directions of bodies as functions of the coordinates, for outputs and starts. Steps do not use them.

use super::basis::Combination;
use super::group::add_curvature;
use super::model::NaturalModel;
use crate::Real;
use crate::algebra::{Coef, Vector, add_to, load};
use crate::scene::BodyId;
use alloc::vec::Vec;

/// Point or direction of a body, x(q) = sum_k A_k e_k + c. On the ground only the constant c remains.
#[derive(Debug, Clone, PartialEq)]
pub struct Affine<T: Real, const D: usize> {
    terms: Vec<(u32, Coef<T>)>,
    constant: Vector<T, D>,
}

/// Part of a body whose rotation is known: the whole body, a line, or nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape<T: Real> {
    /// Rotation of the whole body.
    Full,
    /// Rotation of the line between two ends (reference configuration): a spatial rod held by ball joints.
    Rod([Vector<T, 3>; 2]),
    /// No rotation, as of a point mass.
    Point,
}

impl<T: Real, const D: usize> Affine<T, D> {
    /// Value at the extended coordinates `q`.
    pub fn value(&self, q: &[T]) -> Vector<T, D> {
        self.rate(q) + self.constant
    }

    /// Rate for velocities `v`. With accelerations for `v` the result is the acceleration.
    pub fn rate(&self, v: &[T]) -> Vector<T, D> {
        let mut x = Vector::<T, D>::zeros();
        for (e, c) in &self.terms {
            x += c.apply(&load::<T, D>(v, *e));
        }
        x
    }

    /// Returns this point or direction less another.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let mut terms = self.terms.clone();
        for &(e, c) in &other.terms {
            match terms.iter_mut().find(|(t, _)| *t == e) {
                Some((_, mine)) => *mine = mine.minus(c),
                None => terms.push((e, Coef::zero().minus(c))),
            }
        }
        terms.retain(|(_, c)| !c.is_zero());
        Self { terms, constant: self.constant - other.constant }
    }

    /// Adds the gradient of x.y, with y fixed, to a dense gradient over the extended coordinates.
    pub fn add_gradient(&self, y: &Vector<T, D>, gradient: &mut [T]) {
        for (e, c) in &self.terms {
            add_to(gradient, *e as usize, &c.apply_transposed(y));
        }
    }

    /// Adds the second derivatives of s x.y to a packed block over the unknowns of `clique`, which contains the entities of x and
    /// y.
    pub(crate) fn add_product_curvature(&self, y: &Self, s: T, clique: &[u32], block: &mut [T]) {
        let k = clique.len();
        let place = |e: u32| clique.iter().position(|&u| u == e).unwrap_or(k);
        for &(i, ci) in &self.terms {
            for &(j, cj) in &y.terms {
                add_curvature::<T, D>(block, k, (place(i), ci), (place(j), cj), s);
            }
        }
    }

    /// Extended coordinates at which the entities of the combination begin.
    pub fn entities(&self) -> impl Iterator<Item = u32> + '_ {
        self.terms.iter().map(|(e, _)| *e)
    }
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Material point of a body, given in the reference configuration [m].
    #[must_use]
    pub fn point(&self, body: BodyId, at: [T; 3]) -> Affine<T, D> {
        let at = Vector::from(at);
        match self.clusters.of(body) {
            Some(c) => self.affine(&self.bases[c].point(&at)),
            None => fixed(&at),
        }
    }

    /// Body-fixed direction of a body, given in the reference configuration.
    #[must_use]
    pub fn direction(&self, body: BodyId, d: [T; 3]) -> Affine<T, D> {
        let d = Vector::from(d);
        match self.clusters.of(body) {
            Some(c) => self.affine(&self.bases[c].direction(&d)),
            None => fixed(&d),
        }
    }

    /// True if the body has a full rotation. A spatial rod held by ball joints has no rotation about its line.
    #[must_use]
    pub fn has_full_rotation(&self, body: BodyId) -> bool {
        self.clusters.of(body).is_none_or(|c| self.bases[c].is_full())
    }

    /// Returns the part of a body whose rotation is known.
    pub(crate) fn shape(&self, body: BodyId) -> Shape<T> {
        let Some(c) = self.clusters.of(body) else { return Shape::Full };
        let cluster = &self.clusters.clusters[c];
        match cluster.rod {
            _ if cluster.is_point => Shape::Point,
            Some(ends) if !self.bases[c].is_full() => Shape::Rod(ends),
            _ => Shape::Full,
        }
    }

    /// True if the body is welded to the ground.
    #[must_use]
    pub fn is_ground(&self, body: BodyId) -> bool {
        self.clusters.of(body).is_none()
    }

    fn affine(&self, x: &Combination<T>) -> Affine<T, D> {
        let terms = x.iter().map(|&(e, c)| (self.entity_at[e], c)).collect();
        Affine { terms, constant: Vector::zeros() }
    }
}

fn fixed<T: Real, const D: usize>(x: &Vector<T, 3>) -> Affine<T, D> {
    Affine { terms: Vec::new(), constant: Vector::from_fn(|i, _| x[i]) }
}
