//! Motions (ω, v), forces (τ, f) and inertias of rigid bodies about a point. They are three-dimensional also for plane mechanisms.

use core::ops::{Add, AddAssign, Mul, Neg, Sub};
use mbs_core::Real;
use mbs_core::algebra::{Matrix, Vector, cross};

pub(super) type V3<T> = Vector<T, 3>;

/// Returns the inner product a · b.
#[inline(always)]
pub(super) fn dot<T: Real>(a: &V3<T>, b: &V3<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A motion (ω, v) or a force (τ, f).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Six<T: Real> {
    pub(super) turn: V3<T>,
    pub(super) push: V3<T>,
}

impl<T: Real> Six<T> {
    pub(super) fn zero() -> Self {
        Self { turn: V3::zeros(), push: V3::zeros() }
    }

    /// Returns the power of a force along a motion. The two sums are independent, so that the processor can compute them in parallel.
    #[inline(always)]
    pub(super) fn dot(&self, other: &Self) -> T {
        let (a, b, c, d) = (&self.turn, &self.push, &other.turn, &other.push);
        let even = a[0] * c[0] + a[2] * c[2] + b[1] * d[1];
        let odd = a[1] * c[1] + b[0] * d[0] + b[2] * d[2];
        even + odd
    }

    /// Returns the cross product v × s: the rate of a motion s that is fixed in a frame with the motion v.
    #[inline(always)]
    pub(super) fn carries(&self, s: &Self) -> Self {
        let push = cross(&self.turn, &s.push) + cross(&self.push, &s.turn);
        Self { turn: cross(&self.turn, &s.turn), push }
    }

    /// Returns the dual cross product v ×* f: the rate of a force f that is fixed in a frame with the motion v.
    #[inline(always)]
    pub(super) fn carries_force(&self, f: &Self) -> Self {
        let turn = cross(&self.turn, &f.turn) + cross(&self.push, &f.push);
        Self { turn, push: cross(&self.turn, &f.push) }
    }

    /// Returns the motion about another point. `arm` is the vector from the present point to that point.
    #[inline(always)]
    pub(super) fn at(&self, arm: &V3<T>) -> Self {
        Self { turn: self.turn, push: self.push + cross(&self.turn, arm) }
    }

    /// Returns the force about another point. `arm` is the vector from that point to the present point.
    #[inline(always)]
    pub(super) fn gathered(&self, arm: &V3<T>) -> Self {
        Self { turn: self.turn + cross(arm, &self.push), push: self.push }
    }
}

impl<T: Real> Add for Six<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { turn: self.turn + other.turn, push: self.push + other.push }
    }
}

impl<T: Real> Sub for Six<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Real> Neg for Six<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { turn: -self.turn, push: -self.push }
    }
}

impl<T: Real> Mul<T> for Six<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, x: T) -> Self {
        Self { turn: self.turn * x, push: self.push * x }
    }
}

impl<T: Real> AddAssign for Six<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// Mass, first and second moments of rigid bodies about a point: m, h = Σ m r, J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moments<T: Real> {
    pub(super) mass: T,
    pub(super) first: V3<T>,
    /// Inertia tensor J: xx, xy, xz, yy, yz, zz.
    pub(super) second: [T; 6],
}

impl<T: Real> Moments<T> {
    pub(super) fn zero() -> Self {
        Self { mass: T::ZERO, first: V3::zeros(), second: [T::ZERO; 6] }
    }

    /// Returns the product J x.
    #[inline(always)]
    pub(super) fn turning(&self, x: &V3<T>) -> V3<T> {
        let s = &self.second;
        V3::new(
            s[0] * x[0] + s[1] * x[1] + s[2] * x[2],
            s[1] * x[0] + s[3] * x[1] + s[4] * x[2],
            s[2] * x[0] + s[4] * x[1] + s[5] * x[2],
        )
    }

    /// Returns the momentum of a motion.
    #[inline(always)]
    pub(super) fn times(&self, s: &Six<T>) -> Six<T> {
        Six {
            turn: self.turning(&s.turn) + cross(&self.first, &s.push),
            push: s.push * self.mass - cross(&self.first, &s.turn),
        }
    }

    /// Returns the moments about another point. `arm` is the vector from that point to the present point.
    #[inline(always)]
    pub(super) fn gathered(&self, arm: &V3<T>) -> Self {
        let (m, h) = (self.mass, &self.first);
        // J += m (r·r + 2 r·c) − m (r rᵀ + r cᵀ + c rᵀ), with half of m r in each factor: w = m r/2 + h
        let w = arm * (m * T::HALF) + h;
        let along = T::TWO * dot(arm, &w);
        let across = |i: usize, j: usize| arm[i] * w[j] + w[i] * arm[j];
        let s = &self.second;
        let second = [
            s[0] + along - across(0, 0),
            s[1] - across(0, 1),
            s[2] - across(0, 2),
            s[3] + along - across(1, 1),
            s[4] - across(1, 2),
            s[5] + along - across(2, 2),
        ];
        Self { mass: m, first: arm * m + h, second }
    }

    /// Returns the rotated tensor R J Rᵀ.
    #[inline(always)]
    pub(super) fn turned(tensor: &[T; 6], r: &Matrix<T, 3>) -> [T; 6] {
        let still = Self { mass: T::ZERO, first: V3::zeros(), second: *tensor };
        let row = |i: usize| V3::new(r[(i, 0)], r[(i, 1)], r[(i, 2)]);
        let rows = [row(0), row(1), row(2)];
        let [x, y, z] = [still.turning(&rows[0]), still.turning(&rows[1]), still.turning(&rows[2])];
        [
            dot(&rows[0], &x),
            dot(&rows[0], &y),
            dot(&rows[0], &z),
            dot(&rows[1], &y),
            dot(&rows[1], &z),
            dot(&rows[2], &z),
        ]
    }
}

impl<T: Real> AddAssign for Moments<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.mass += other.mass;
        self.first += other.first;
        for (x, y) in self.second.iter_mut().zip(other.second) {
            *x += y;
        }
    }
}
