//! Sums over a subtree about a common point: moments, momentum P, momentum flux N, and the force f that accelerates the subtree.
//!
//! ```text
//! P = Σ m v        N x = Σ m r × (x × v)        f = Σ I a + v ×* I v
//! 2 B s = 2 (N ω_s, ω_s × P)                    the change of velocity forces by a motion s, up to what is carried along
//! ```
//!
//! m, r and v are the mass, position and velocity of a particle. In f, I is the inertia of a body, v its velocity and a its acceleration.
//!
//! The matrix B is a sum over particles. Only the rotation of the motion s changes the direction of the momentum, so the translation of s
//! cancels in B s. Twelve numbers (P and N) therefore replace the thirty-six numbers of a general matrix B.

use super::six::{Moments, Six, V3, dot};
use core::ops::AddAssign;
use mbs_core::Real;
use mbs_core::algebra::{Matrix, cross};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sums<T: Real> {
    pub(super) moments: Moments<T>,
    /// Momentum P of the subtree.
    momentum: V3<T>,
    /// Momentum flux N of the subtree, defined at the top of the file.
    stream: Matrix<T, 3>,
    pub(super) force: Six<T>,
}

impl<T: Real> Sums<T> {
    pub(super) fn zero() -> Self {
        Self {
            moments: Moments::zero(),
            momentum: V3::zeros(),
            stream: Matrix::<T, 3>::zeros(),
            force: Six::zero(),
        }
    }

    /// Returns the sums of one body with velocity v and acceleration a, all about the common point.
    #[inline(always)]
    pub(super) fn body(moments: Moments<T>, v: &Six<T>, a: &Six<T>) -> Self {
        let momentum = moments.times(v);
        let force = moments.times(a) + v.carries_force(&momentum);
        // momentum flux: N = (h·v) − v hᵀ − [ω] Q with Q = ½ tr J − J = Σ m r rᵀ
        let (h, s, w) = (&moments.first, &moments.second, &v.turn);
        let half = (s[0] + s[3] + s[5]) * T::HALF;
        let q = [
            V3::new(half - s[0], -s[1], -s[2]),
            V3::new(-s[1], half - s[3], -s[4]),
            V3::new(-s[2], -s[4], half - s[5]),
        ];
        let along = dot(h, &v.push);
        let mut stream = Matrix::<T, 3>::zeros();
        for j in 0..3 {
            let turned = cross(w, &q[j]);
            for i in 0..3 {
                stream[(i, j)] = -(v.push[i] * h[j]) - turned[i];
            }
            stream[(j, j)] += along;
        }
        Self { moments, momentum: momentum.push, stream, force }
    }

    /// Returns 2 B s, the change of the velocity-dependent forces by a motion s.
    #[inline(always)]
    pub(super) fn streams(&self, s: &Six<T>) -> Six<T> {
        let turn = self.stream * s.turn;
        Six { turn: turn * T::TWO, push: cross(&s.turn, &self.momentum) * T::TWO }
    }

    /// Returns the rotational part of 2 Bᵀ s. The translational part is zero.
    #[inline(always)]
    pub(super) fn streams_back(&self, s: &Six<T>) -> V3<T> {
        (self.stream.tr_mul(&s.turn) + cross(&self.momentum, &s.push)) * T::TWO
    }
}

impl<T: Real> AddAssign for Sums<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.moments += other.moments;
        self.momentum += other.momentum;
        self.stream += other.stream;
        self.force += other.force;
    }
}
