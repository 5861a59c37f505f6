//! The plane: a motion (ω, vx, vy) has three numbers, an inertia has six.

use super::Space;
use mbs_core::Real;
use mbs_core::algebra::{Matrix, Vector};

/// The plane as the space in which a mechanism moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Planar;

/// A symmetric 3×3 map from (ω, v) to (τ, f): [[a, h], [hᵀ, m]].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanarInertia<T> {
    /// Rotational block a of the inertia.
    pub a: T,
    /// Coupling block h of the inertia.
    pub h: [T; 2],
    /// Translational block xx, xy, yy.
    pub m: [T; 3],
}

impl<T: Real> Space<T> for Planar {
    type Point = Vector<T, 2>;
    type Spin = Vector<T, 1>;
    type Motion = Vector<T, 3>;
    /// Cosine and sine of the rotation angle.
    type Rotation = [T; 2];
    type Inertia = PlanarInertia<T>;
    type Tensor = T;

    const DIMENSION: usize = 2;
    const FREE: usize = 3;

    #[inline(always)]
    fn motion(spin: Self::Spin, point: Self::Point) -> Self::Motion {
        Vector::<T, 3>::new(spin[0], point[0], point[1])
    }
    #[inline(always)]
    fn spin(m: &Self::Motion) -> Self::Spin {
        Vector::<T, 1>::new(m[0])
    }
    #[inline(always)]
    fn point(m: &Self::Motion) -> Self::Point {
        Vector::<T, 2>::new(m[1], m[2])
    }
    #[inline(always)]
    fn cross(spin: &Self::Spin, x: &Self::Point) -> Self::Point {
        Vector::<T, 2>::new(-spin[0] * x[1], spin[0] * x[0])
    }
    #[inline(always)]
    fn cross_spin(_: &Self::Spin, _: &Self::Spin) -> Self::Spin {
        Vector::<T, 1>::new(T::ZERO)
    }
    #[inline(always)]
    fn moment(r: &Self::Point, f: &Self::Point) -> Self::Spin {
        Vector::<T, 1>::new(r[0] * f[1] - r[1] * f[0])
    }

    #[inline(always)]
    fn identity() -> Self::Rotation {
        [T::ONE, T::ZERO]
    }
    #[inline(always)]
    fn rotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point {
        Vector::<T, 2>::new(r[0] * x[0] - r[1] * x[1], r[1] * x[0] + r[0] * x[1])
    }
    #[inline(always)]
    fn unrotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point {
        Vector::<T, 2>::new(r[0] * x[0] + r[1] * x[1], r[0] * x[1] - r[1] * x[0])
    }
    #[inline(always)]
    fn rotate_spin(_: &Self::Rotation, x: &Self::Spin) -> Self::Spin {
        *x
    }
    #[inline(always)]
    fn unrotate_spin(_: &Self::Rotation, x: &Self::Spin) -> Self::Spin {
        *x
    }
    #[inline(always)]
    fn turned(r: &Self::Rotation, axis: &Self::Spin, angle: T) -> Self::Rotation {
        let (s, c) = (axis[0] * angle).sin_cos();
        [r[0] * c - r[1] * s, r[1] * c + r[0] * s]
    }
    fn turned_by(r: &Self::Rotation, z: &[T]) -> Self::Rotation {
        Self::turned(r, &Vector::<T, 1>::new(T::ONE), z.first().copied().unwrap_or(T::ZERO))
    }
    fn write_rotation(r: &Self::Rotation, z: &mut [T]) {
        if let Some(z) = z.first_mut() {
            *z = r[1].atan2(r[0]);
        }
    }
    fn relative(r: &Self::Rotation, s: &Self::Rotation) -> Self::Rotation {
        [r[0] * s[0] + r[1] * s[1], r[0] * s[1] - r[1] * s[0]]
    }
    fn advance_rotation(z: &mut [T], delta: &[T]) {
        if let (Some(z), Some(&delta)) = (z.first_mut(), delta.first()) {
            *z += delta;
        }
    }
    fn rotation_rate(_: &[T], spin: &[T], rate: &mut [T]) {
        if let (Some(rate), Some(&spin)) = (rate.first_mut(), spin.first()) {
            *rate = spin;
        }
    }
    fn normalise_rotation(_: &mut [T]) {}

    #[inline(always)]
    fn no_inertia() -> Self::Inertia {
        PlanarInertia { a: T::ZERO, h: [T::ZERO; 2], m: [T::ZERO; 3] }
    }
    #[inline(always)]
    fn body_inertia(
        mass: T,
        center: &Self::Point,
        tensor: &Self::Tensor,
        _: &Self::Rotation,
    ) -> Self::Inertia {
        // coupling block from the torque τ = m c × a = m (cx ay − cy ax)
        PlanarInertia {
            a: *tensor,
            h: [-mass * center[1], mass * center[0]],
            m: [mass, T::ZERO, mass],
        }
    }
    #[inline(always)]
    fn turning_block(i: &Self::Inertia, spin: &Self::Spin) -> Self::Spin {
        Vector::<T, 1>::new(i.a * spin[0])
    }
    #[inline(always)]
    fn times(i: &Self::Inertia, x: &Self::Motion) -> Self::Motion {
        Vector::<T, 3>::new(
            i.a * x[0] + i.h[0] * x[1] + i.h[1] * x[2],
            i.h[0] * x[0] + i.m[0] * x[1] + i.m[1] * x[2],
            i.h[1] * x[0] + i.m[1] * x[1] + i.m[2] * x[2],
        )
    }
    #[inline(always)]
    fn times_spin(i: &Self::Inertia, n: &Self::Spin) -> Self::Motion {
        Vector::<T, 3>::new(i.a * n[0], i.h[0] * n[0], i.h[1] * n[0])
    }
    #[inline(always)]
    fn times_point(i: &Self::Inertia, d: &Self::Point) -> Self::Motion {
        Vector::<T, 3>::new(
            i.h[0] * d[0] + i.h[1] * d[1],
            i.m[0] * d[0] + i.m[1] * d[1],
            i.m[1] * d[0] + i.m[2] * d[1],
        )
    }
    #[inline(always)]
    fn reduced(i: &Self::Inertia, u: &Self::Motion, w: T) -> Self::Inertia {
        let uw = *u * w;
        PlanarInertia {
            a: i.a - uw[0] * u[0],
            h: [i.h[0] - uw[0] * u[1], i.h[1] - uw[0] * u[2]],
            m: [i.m[0] - uw[1] * u[1], i.m[1] - uw[1] * u[2], i.m[2] - uw[2] * u[2]],
        }
    }
    fn add_square(i: &mut Self::Inertia, k: &Self::Motion) {
        *i = Self::reduced(i, k, -T::ONE);
    }
    #[inline(always)]
    fn add_shifted(i: &mut Self::Inertia, j: &Self::Inertia, arm: &Self::Point) {
        let (x, y) = (arm[0], arm[1]);
        // inertia about the new origin: h' = h + (x m_y − y m_x),  a' = a + (x h_y − y h_x) + (x h'_y − y h'_x)
        let h = [j.h[0] + (x * j.m[1] - y * j.m[0]), j.h[1] + (x * j.m[2] - y * j.m[1])];
        i.a += j.a + (x * (j.h[1] + h[1]) - y * (j.h[0] + h[0]));
        for k in 0..2 {
            i.h[k] += h[k];
        }
        for k in 0..3 {
            i.m[k] += j.m[k];
        }
    }
    #[inline(always)]
    fn size(i: &Self::Inertia) -> (T, T) {
        (i.a, i.m[0].max(i.m[2]))
    }

    fn factor(i: &mut Self::Inertia) -> bool {
        // L D Lᵀ factors, in the order of the pivots m_xx, m_yy', a': the translational block comes first.
        let d0 = i.m[0];
        let l1 = i.m[1] / d0;
        let d1 = i.m[2] - l1 * i.m[1];
        let l2 = i.h[0] / d0;
        let w = i.h[1] - l2 * i.m[1];
        let l3 = w / d1;
        let d2 = i.a - l2 * i.h[0] - l3 * w;
        *i = PlanarInertia { a: d2, h: [l2, l3], m: [d0, l1, d1] };
        d0 > T::ZERO && d1 > T::ZERO && d2 > T::ZERO
    }
    fn solve(i: &Self::Inertia, f: &Self::Motion) -> Self::Motion {
        let ([l2, l3], [d0, l1, d1]) = (i.h, i.m);
        let x = f[1];
        let y = f[2] - l1 * x;
        let w = (f[0] - l2 * x - l3 * y) / i.a;
        let y = y / d1 - l3 * w;
        let x = x / d0 - l1 * y - l2 * w;
        Vector::<T, 3>::new(w, x, y)
    }
    fn invert_turning(i: &mut Self::Inertia) -> bool {
        let is_positive = i.a > T::ZERO;
        i.a = T::ONE / i.a;
        is_positive
    }
    fn ball_reduced(i: &Self::Inertia) -> Self::Inertia {
        let h = Vector::<T, 3>::new(T::ZERO, i.h[0], i.h[1]);
        let left = PlanarInertia { a: T::ZERO, h: [T::ZERO; 2], m: i.m };
        Self::reduced(&left, &h, i.a)
    }
    fn ball_solve(i: &Self::Inertia, x: &Self::Spin) -> Self::Spin {
        *x * i.a
    }
    fn ball_column(i: &Self::Inertia, x: &Self::Spin) -> Self::Point {
        Vector::<T, 2>::new(i.h[0] * x[0], i.h[1] * x[0])
    }
    fn ball_row(i: &Self::Inertia, x: &Self::Point) -> Self::Spin {
        Vector::<T, 1>::new(i.h[0] * x[0] + i.h[1] * x[1])
    }

    fn point_from(x: &Vector<T, 3>) -> Self::Point {
        Vector::<T, 2>::new(x[0], x[1])
    }
    fn point_into(x: &Self::Point) -> Vector<T, 3> {
        Vector::<T, 3>::new(x[0], x[1], T::ZERO)
    }
    fn spin_from(x: &Vector<T, 3>) -> Self::Spin {
        Vector::<T, 1>::new(x[2])
    }
    fn spin_into(x: &Self::Spin) -> Vector<T, 3> {
        Vector::<T, 3>::new(T::ZERO, T::ZERO, x[0])
    }
    fn rotation_from(r: &Matrix<T, 3>) -> Self::Rotation {
        [r[(0, 0)], r[(1, 0)]]
    }
    fn rotation_into(r: &Self::Rotation) -> Matrix<T, 3> {
        let mut m = Matrix::<T, 3>::identity();
        (m[(0, 0)], m[(1, 1)], m[(1, 0)], m[(0, 1)]) = (r[0], r[0], r[1], -r[1]);
        m
    }
    fn tensor_from(i: &Matrix<T, 3>) -> Self::Tensor {
        i[(2, 2)]
    }
}
