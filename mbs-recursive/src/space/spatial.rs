//! Space: a motion (ω, v) has six numbers, an inertia has twenty-one.

use super::Space;
use mbs_core::Real;
use mbs_core::algebra::{Matrix, Vector, cross, norm};

/// Three-dimensional space, in which a mechanism moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spatial;

/// A symmetric 6×6 map from (ω, v) to (τ, f): [[A, H], [Hᵀ, M]].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialInertia<T> {
    /// Rotational block A: xx, xy, xz, yy, yz, zz.
    pub a: [T; 6],
    /// Coupling block H by rows.
    pub h: [T; 9],
    /// Translational block M: xx, xy, xz, yy, yz, zz.
    pub m: [T; 6],
}

/// Index of entry (i, j) of a symmetric 3×3 matrix in the list xx, xy, xz, yy, yz, zz.
const AT: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

#[inline(always)]
fn v3<T: Real>(x: T, y: T, z: T) -> Vector<T, 3> {
    Vector::<T, 3>::new(x, y, z)
}

/// Returns the product S x of a symmetric 3×3 matrix and a vector.
#[inline(always)]
fn symmetric<T: Real>(s: &[T; 6], x: &Vector<T, 3>) -> Vector<T, 3> {
    v3(
        s[0] * x[0] + s[1] * x[1] + s[2] * x[2],
        s[1] * x[0] + s[3] * x[1] + s[4] * x[2],
        s[2] * x[0] + s[4] * x[1] + s[5] * x[2],
    )
}

/// Returns the product H x.
#[inline(always)]
fn forward<T: Real>(h: &[T; 9], x: &Vector<T, 3>) -> Vector<T, 3> {
    v3(
        h[0] * x[0] + h[1] * x[1] + h[2] * x[2],
        h[3] * x[0] + h[4] * x[1] + h[5] * x[2],
        h[6] * x[0] + h[7] * x[1] + h[8] * x[2],
    )
}

/// Returns the product Hᵀ x.
#[inline(always)]
fn backward<T: Real>(h: &[T; 9], x: &Vector<T, 3>) -> Vector<T, 3> {
    v3(
        h[0] * x[0] + h[3] * x[1] + h[6] * x[2],
        h[1] * x[0] + h[4] * x[1] + h[7] * x[2],
        h[2] * x[0] + h[5] * x[1] + h[8] * x[2],
    )
}

/// Returns the quaternion in joint coordinates. Returns the identity if there are fewer than four coordinates.
#[inline(always)]
fn quaternion<T: Real>(z: &[T]) -> [T; 4] {
    z.first_chunk().copied().unwrap_or([T::ONE, T::ZERO, T::ZERO, T::ZERO])
}

/// Writes a quaternion into joint coordinates.
#[inline(always)]
fn set_quaternion<T: Real>(z: &mut [T], q: [T; 4]) {
    if let Some(z) = z.first_chunk_mut() {
        *z = q;
    }
}

/// Returns a quaternion scaled to unit length.
#[inline(always)]
fn unit<T: Real>(q: [T; 4]) -> [T; 4] {
    let square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    let scale = T::ONE / square.sqrt();
    [q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale]
}

/// Returns the rotation matrix of a quaternion (w, x, y, z) whose length is near one.
fn of_quaternion<T: Real>([w, x, y, z]: [T; 4]) -> Matrix<T, 3> {
    let s = T::TWO / (w * w + x * x + y * y + z * z);
    let one = T::ONE;
    Matrix::<T, 3>::new(
        one - s * (y * y + z * z),
        s * (x * y - w * z),
        s * (x * z + w * y),
        s * (x * y + w * z),
        one - s * (x * x + z * z),
        s * (y * z - w * x),
        s * (x * z - w * y),
        s * (y * z + w * x),
        one - s * (x * x + y * y),
    )
}

/// Returns the product p q of quaternions.
fn product<T: Real>(p: [T; 4], q: [T; 4]) -> [T; 4] {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

/// Returns the product R S, column by column.
#[inline(always)]
fn times<T: Real>(r: &Matrix<T, 3>, s: &Matrix<T, 3>) -> Matrix<T, 3> {
    let mut p = *r;
    for j in 0..3 {
        for i in 0..3 {
            p[(i, j)] = r[(i, 0)] * s[(0, j)] + r[(i, 1)] * s[(1, j)] + r[(i, 2)] * s[(2, j)];
        }
    }
    p
}

impl<T: Real> Space<T> for Spatial {
    type Point = Vector<T, 3>;
    type Spin = Vector<T, 3>;
    type Motion = Vector<T, 6>;
    type Rotation = Matrix<T, 3>;
    type Inertia = SpatialInertia<T>;
    /// Entries xx, xy, xz, yy, yz, zz.
    type Tensor = [T; 6];

    const DIMENSION: usize = 3;
    const FREE: usize = 7;

    #[inline(always)]
    fn motion(w: Self::Spin, v: Self::Point) -> Self::Motion {
        Vector::<T, 6>::new(w[0], w[1], w[2], v[0], v[1], v[2])
    }
    #[inline(always)]
    fn spin(m: &Self::Motion) -> Self::Spin {
        v3(m[0], m[1], m[2])
    }
    #[inline(always)]
    fn point(m: &Self::Motion) -> Self::Point {
        v3(m[3], m[4], m[5])
    }
    #[inline(always)]
    fn cross(spin: &Self::Spin, x: &Self::Point) -> Self::Point {
        cross(spin, x)
    }
    #[inline(always)]
    fn cross_spin(spin: &Self::Spin, n: &Self::Spin) -> Self::Spin {
        cross(spin, n)
    }
    #[inline(always)]
    fn moment(r: &Self::Point, f: &Self::Point) -> Self::Spin {
        cross(r, f)
    }

    fn identity() -> Self::Rotation {
        Matrix::<T, 3>::identity()
    }
    #[inline(always)]
    fn rotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point {
        v3(
            r[(0, 0)] * x[0] + r[(0, 1)] * x[1] + r[(0, 2)] * x[2],
            r[(1, 0)] * x[0] + r[(1, 1)] * x[1] + r[(1, 2)] * x[2],
            r[(2, 0)] * x[0] + r[(2, 1)] * x[1] + r[(2, 2)] * x[2],
        )
    }
    #[inline(always)]
    fn unrotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point {
        v3(
            r[(0, 0)] * x[0] + r[(1, 0)] * x[1] + r[(2, 0)] * x[2],
            r[(0, 1)] * x[0] + r[(1, 1)] * x[1] + r[(2, 1)] * x[2],
            r[(0, 2)] * x[0] + r[(1, 2)] * x[1] + r[(2, 2)] * x[2],
        )
    }
    #[inline(always)]
    fn rotate_spin(r: &Self::Rotation, x: &Self::Spin) -> Self::Spin {
        Self::rotate(r, x)
    }
    #[inline(always)]
    fn unrotate_spin(r: &Self::Rotation, x: &Self::Spin) -> Self::Spin {
        Self::unrotate(r, x)
    }
    #[inline(always)]
    fn turned(r: &Self::Rotation, n: &Self::Spin, angle: T) -> Self::Rotation {
        // Rodrigues' formula: Rot(n, angle) = c 1 + (1 − c) n nᵀ + s [n]
        let (s, c) = angle.sin_cos();
        let (x, y, z) = (n[0], n[1], n[2]);
        let k = T::ONE - c;
        let (kx, ky, kz) = (k * x, k * y, k * z);
        let (sx, sy, sz) = (s * x, s * y, s * z);
        let (xy, xz, yz) = (kx * y, kx * z, ky * z);
        let turn = Matrix::<T, 3>::new(
            c + kx * x,
            xy - sz,
            xz + sy,
            xy + sz,
            c + ky * y,
            yz - sx,
            xz - sy,
            yz + sx,
            c + kz * z,
        );
        times(r, &turn)
    }
    fn turned_by(r: &Self::Rotation, z: &[T]) -> Self::Rotation {
        times(r, &of_quaternion(quaternion(z)))
    }
    fn write_rotation(r: &Self::Rotation, z: &mut [T]) {
        // The branch is selected by the largest of the four squared components, so that no digits cancel.
        let (xx, yy, zz) = (r[(0, 0)], r[(1, 1)], r[(2, 2)]);
        let squares = [xx + yy + zz, xx - yy - zz, yy - xx - zz, zz - xx - yy];
        let mut k = 0;
        for i in 1..4 {
            if squares[i] > squares[k] {
                k = i;
            }
        }
        let (a, b, c) = (r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
        let (d, e, f) = (r[(0, 1)] + r[(1, 0)], r[(0, 2)] + r[(2, 0)], r[(1, 2)] + r[(2, 1)]);
        let g = T::ONE + squares[k];
        let q = match k {
            0 => [g, a, b, c],
            1 => [a, g, d, e],
            2 => [b, d, g, f],
            _ => [c, e, f, g],
        };
        let q = unit(q);
        let q = if q[0] < T::ZERO { [-q[0], -q[1], -q[2], -q[3]] } else { q };
        set_quaternion(z, q);
    }
    fn relative(r: &Self::Rotation, s: &Self::Rotation) -> Self::Rotation {
        times(&r.transpose(), s)
    }
    fn advance_rotation(z: &mut [T], delta: &[T]) {
        let Some(&[x, y, w]) = delta.first_chunk() else { return };
        let d = v3(x, y, w);
        let angle = norm(&d);
        // quaternion of the rotation vector δ: exp(δ) = (cos |δ|/2, sin(|δ|/2) δ/|δ|); the quotient tends to 1/2
        let (s, c) = (angle * T::HALF).sin_cos();
        let quotient = s / angle;
        let share = if angle > T::EPSILON { quotient } else { T::HALF };
        let q = product(quaternion(z), [c, d[0] * share, d[1] * share, d[2] * share]);
        set_quaternion(z, unit(q));
    }
    fn rotation_rate(z: &[T], spin: &[T], rate: &mut [T]) {
        let Some(&[x, y, w]) = spin.first_chunk() else { return };
        let half = [T::ZERO, x * T::HALF, y * T::HALF, w * T::HALF];
        set_quaternion(rate, product(quaternion(z), half));
    }
    fn normalise_rotation(z: &mut [T]) {
        set_quaternion(z, unit(quaternion(z)));
    }

    fn no_inertia() -> Self::Inertia {
        SpatialInertia { a: [T::ZERO; 6], h: [T::ZERO; 9], m: [T::ZERO; 6] }
    }
    #[inline(always)]
    fn body_inertia(
        mass: T,
        center: &Self::Point,
        tensor: &Self::Tensor,
        r: &Self::Rotation,
    ) -> Self::Inertia {
        // rotational block A = R I Rᵀ, row by row; coupling block H = m [c], the cross-product matrix of m c; M = m 1
        let mut a = [T::ZERO; 6];
        for i in 0..3 {
            let row = symmetric(tensor, &v3(r[(i, 0)], r[(i, 1)], r[(i, 2)]));
            for j in i..3 {
                a[AT[i][j]] = row[0] * r[(j, 0)] + row[1] * r[(j, 1)] + row[2] * r[(j, 2)];
            }
        }
        let (o, x, y, z) = (T::ZERO, mass * center[0], mass * center[1], mass * center[2]);
        SpatialInertia { a, h: [o, -z, y, z, o, -x, -y, x, o], m: [mass, o, o, mass, o, mass] }
    }
    #[inline(always)]
    fn turning_block(i: &Self::Inertia, spin: &Self::Spin) -> Self::Spin {
        symmetric(&i.a, spin)
    }
    #[inline(always)]
    fn times(i: &Self::Inertia, x: &Self::Motion) -> Self::Motion {
        let (w, v) = (<Self as Space<T>>::spin(x), <Self as Space<T>>::point(x));
        Self::motion(
            symmetric(&i.a, &w) + forward(&i.h, &v),
            backward(&i.h, &w) + symmetric(&i.m, &v),
        )
    }
    #[inline(always)]
    fn times_spin(i: &Self::Inertia, n: &Self::Spin) -> Self::Motion {
        Self::motion(symmetric(&i.a, n), backward(&i.h, n))
    }
    #[inline(always)]
    fn times_point(i: &Self::Inertia, d: &Self::Point) -> Self::Motion {
        Self::motion(forward(&i.h, d), symmetric(&i.m, d))
    }
    #[inline(always)]
    fn reduced(i: &Self::Inertia, u: &Self::Motion, w: T) -> Self::Inertia {
        let x = *u * w;
        let mut r = *i;
        for j in 0..3 {
            for k in j..3 {
                r.a[AT[j][k]] -= x[j] * u[k];
                r.m[AT[j][k]] -= x[3 + j] * u[3 + k];
            }
            for k in 0..3 {
                r.h[3 * j + k] -= x[j] * u[3 + k];
            }
        }
        r
    }
    fn add_square(i: &mut Self::Inertia, k: &Self::Motion) {
        *i = Self::reduced(i, k, -T::ONE);
    }
    #[inline(always)]
    fn add_shifted(i: &mut Self::Inertia, j: &Self::Inertia, r: &Self::Point) {
        // inertia about the new origin: H' = H + r̃ M,   A' = A + r̃ Hᵀ + H' r̃ᵀ,   M' = M; column k of r̃ M is r × (column k of M)
        let mut h = j.h;
        for k in 0..3 {
            let c = cross(r, &v3(j.m[AT[0][k]], j.m[AT[1][k]], j.m[AT[2][k]]));
            h[k] += c[0];
            h[3 + k] += c[1];
            h[6 + k] += c[2];
        }
        // column k of r̃ Hᵀ is r × (row k of H); row k of H' r̃ᵀ is r × (row k of H')
        let old: [Vector<T, 3>; 3] =
            core::array::from_fn(|k| cross(r, &v3(j.h[3 * k], j.h[3 * k + 1], j.h[3 * k + 2])));
        let new: [Vector<T, 3>; 3] =
            core::array::from_fn(|k| cross(r, &v3(h[3 * k], h[3 * k + 1], h[3 * k + 2])));
        for x in 0..3 {
            for y in x..3 {
                i.a[AT[x][y]] += j.a[AT[x][y]] + old[y][x] + new[x][y];
            }
        }
        for k in 0..9 {
            i.h[k] += h[k];
        }
        for k in 0..6 {
            i.m[k] += j.m[k];
        }
    }
    #[inline(always)]
    fn size(i: &Self::Inertia) -> (T, T) {
        (i.a[0].max(i.a[3]).max(i.a[5]), i.m[0].max(i.m[3]).max(i.m[5]))
    }

    fn factor(i: &mut Self::Inertia) -> bool {
        // Block factors: M⁻¹, G = H M⁻¹, (A − G Hᵀ)⁻¹ in the places of M, H, A.
        let Some(m) = inverse(&i.m) else { return false };
        let h = i.h;
        for r in 0..3 {
            let row = symmetric(&m, &v3(h[3 * r], h[3 * r + 1], h[3 * r + 2]));
            for k in 0..3 {
                i.h[3 * r + k] = row[k];
            }
        }
        for r in 0..3 {
            for c in r..3 {
                for k in 0..3 {
                    i.a[AT[r][c]] -= i.h[3 * r + k] * h[3 * c + k];
                }
            }
        }
        let Some(a) = inverse(&i.a) else { return false };
        (i.a, i.m) = (a, m);
        true
    }
    fn solve(i: &Self::Inertia, f: &Self::Motion) -> Self::Motion {
        // solution by the block factors: ω = (A − G Hᵀ)⁻¹ (τ − G f),   v = M⁻¹ f − Gᵀ ω
        let (t, f) = (<Self as Space<T>>::spin(f), <Self as Space<T>>::point(f));
        let w = symmetric(&i.a, &(t - forward(&i.h, &f)));
        Self::motion(w, symmetric(&i.m, &f) - backward(&i.h, &w))
    }
    fn invert_turning(i: &mut Self::Inertia) -> bool {
        let Some(a) = inverse(&i.a) else { return false };
        i.a = a;
        true
    }
    fn ball_reduced(i: &Self::Inertia) -> Self::Inertia {
        let mut left = Self::no_inertia();
        left.m = i.m;
        let column = |k: usize| v3(i.h[k], i.h[3 + k], i.h[6 + k]);
        for r in 0..3 {
            let x = symmetric(&i.a, &column(r));
            for c in r..3 {
                left.m[AT[r][c]] -= x.dot(&column(c));
            }
        }
        left
    }
    fn ball_solve(i: &Self::Inertia, x: &Self::Spin) -> Self::Spin {
        symmetric(&i.a, x)
    }
    fn ball_column(i: &Self::Inertia, x: &Self::Spin) -> Self::Point {
        backward(&i.h, x)
    }
    fn ball_row(i: &Self::Inertia, x: &Self::Point) -> Self::Spin {
        forward(&i.h, x)
    }

    fn point_from(x: &Vector<T, 3>) -> Self::Point {
        *x
    }
    fn point_into(x: &Self::Point) -> Vector<T, 3> {
        *x
    }
    fn spin_from(x: &Vector<T, 3>) -> Self::Spin {
        *x
    }
    fn spin_into(x: &Self::Spin) -> Vector<T, 3> {
        *x
    }
    fn rotation_from(r: &Matrix<T, 3>) -> Self::Rotation {
        *r
    }
    fn rotation_into(r: &Self::Rotation) -> Matrix<T, 3> {
        *r
    }
    fn tensor_from(i: &Matrix<T, 3>) -> Self::Tensor {
        [i[(0, 0)], i[(0, 1)], i[(0, 2)], i[(1, 1)], i[(1, 2)], i[(2, 2)]]
    }
}

/// Largest leading minor that counts as zero, relative to the product of its factors and in units of machine precision [-]. Chosen, not
/// tuned.
const MINOR_ROUNDINGS: f64 = 64.0;

/// Returns the inverse of a symmetric positive definite 3×3 matrix. `None` if a leading minor is zero within rounding, or negative.
fn inverse<T: Real>(s: &[T; 6]) -> Option<[T; 6]> {
    let [xx, xy, xz, yy, yz, zz] = *s;
    let two = xx * yy - xy * xy;
    let (a, b, c) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
    let determinant = xx * a + xy * b + xz * c;
    let rounding = T::EPSILON * T::from_f64(MINOR_ROUNDINGS);
    let size = xx.max(yy).max(zz);
    // A block that is singular within rounding has no inverse.
    if !(xx > rounding * size && two > rounding * size * xx && determinant > rounding * size * two)
    {
        return None;
    }
    let d = T::ONE / determinant;
    Some([a * d, b * d, c * d, (xx * zz - xz * xz) * d, (xy * xz - xx * yz) * d, two * d])
}
