//! One algebra for plane and space, so that every pass is written once: [`Space`].
//!
//! ```text
//! motion (ω, v)   force (τ, f)   about a link's own origin, world axes
//! arm r from the parent's origin to the child's:
//!     (ω, v) ↦ (ω, v + ω × r)        outward
//!     (τ, f) ↦ (τ + r × f, f)        inward
//! ```
//!
//! The plane has three numbers, space six; inertias are symmetric, 6 and 21 numbers.

mod planar;
mod spatial;

pub use planar::{Planar, PlanarInertia};
pub use spatial::{Spatial, SpatialInertia};

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Index, IndexMut, Mul, Neg, Sub, SubAssign};
use mbs_core::Real;
use mbs_core::algebra::Vector;

/// A few numbers that add up and have an inner product.
pub trait Numbers<T>:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<T, Output = Self>
    + AddAssign
    + SubAssign
    + Index<usize, Output = T>
    + IndexMut<usize>
    + Send
    + Sync
    + 'static
{
    /// Number of components.
    const N: usize;
    /// Returns zero in every component.
    fn zero() -> Self;
    /// Returns the inner product with `other`.
    fn dot(&self, other: &Self) -> T;
    /// The inner product of absolute values: what rounding of the inner product is small against.
    fn parts(&self, other: &Self) -> T;
}

impl<T: Real, const N: usize> Numbers<T> for Vector<T, N> {
    const N: usize = N;
    #[inline(always)]
    fn zero() -> Self {
        Self::zeros()
    }
    #[inline(always)]
    fn dot(&self, other: &Self) -> T {
        let mut sum = self[0] * other[0];
        for i in 1..N {
            sum += self[i] * other[i];
        }
        sum
    }
    fn parts(&self, other: &Self) -> T {
        let mut sum = T::ZERO;
        for i in 0..N {
            sum += (self[i] * other[i]).abs();
        }
        sum
    }
}

/// The plane or space: what the passes need to know of it.
pub trait Space<T: Real>: Copy + Debug + Send + Sync + 'static {
    /// Vectors of points and directions.
    type Point: Numbers<T>;
    /// Angular velocities and moments.
    type Spin: Numbers<T>;
    /// A motion (ω, v) or a force (τ, f), first the turning part.
    type Motion: Numbers<T>;
    /// Rotation from body-fixed to world axes.
    type Rotation: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// A symmetric map from motions to forces.
    type Inertia: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// Inertia tensor of a body, reference axes.
    type Tensor: Copy + Debug + PartialEq + Send + Sync + 'static;

    /// Dimension of the space: 2 or 3.
    const DIMENSION: usize;
    /// Numbers that hold the coordinates of a free body: an angle or a quaternion, then the position.
    const FREE: usize;

    /// Returns the motion (ω, v).
    fn motion(spin: Self::Spin, point: Self::Point) -> Self::Motion;
    /// ω of (ω, v).
    fn spin(motion: &Self::Motion) -> Self::Spin;
    /// v of (ω, v).
    fn point(motion: &Self::Motion) -> Self::Point;
    /// Returns the cross product ω × x.
    fn cross(spin: &Self::Spin, x: &Self::Point) -> Self::Point;
    /// ω × n, for angular velocities; zero in the plane.
    fn cross_spin(spin: &Self::Spin, n: &Self::Spin) -> Self::Spin;
    /// Returns the moment r × f.
    fn moment(r: &Self::Point, f: &Self::Point) -> Self::Spin;

    /// Returns the rotation that turns nothing.
    fn identity() -> Self::Rotation;
    /// A body-fixed vector in world axes.
    fn rotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point;
    /// A body-fixed axial vector in world axes.
    fn rotate_spin(r: &Self::Rotation, x: &Self::Spin) -> Self::Spin;
    /// A world axial vector in body axes.
    fn unrotate_spin(r: &Self::Rotation, x: &Self::Spin) -> Self::Spin;
    /// A world vector in body axes.
    fn unrotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point;
    /// `r` followed inside by a turn about the body-fixed unit axis: R Rot(n, angle).
    fn turned(r: &Self::Rotation, axis: &Self::Spin, angle: T) -> Self::Rotation;
    /// `r` followed inside by the rotation of joint coordinates (a quaternion; in the plane an angle).
    fn turned_by(r: &Self::Rotation, z: &[T]) -> Self::Rotation;
    /// Writes the joint coordinates of a rotation.
    fn write_rotation(r: &Self::Rotation, z: &mut [T]);
    /// Returns the relative rotation Rᵀ S.
    fn relative(r: &Self::Rotation, s: &Self::Rotation) -> Self::Rotation;
    /// Moves the coordinates of a rotation by a rotation vector in its own axes: q ← q exp(δ), normalised.
    fn advance_rotation(z: &mut [T], delta: &[T]);
    /// Rate of the coordinates of a rotation: q' = ½ q ω, ω in its own axes.
    fn rotation_rate(z: &[T], spin: &[T], rate: &mut [T]);
    /// Makes the coordinates of a rotation unit again.
    fn normalise_rotation(z: &mut [T]);

    /// Returns an inertia of zero.
    fn no_inertia() -> Self::Inertia;
    /// The inertia of a body about its link's origin; `center` from there in world axes, `tensor` about it in body axes.
    fn body_inertia(
        mass: T,
        center: &Self::Point,
        tensor: &Self::Tensor,
        r: &Self::Rotation,
    ) -> Self::Inertia;
    /// The angular momentum of the body's own tensor: the turning block times ω.
    fn turning_block(inertia: &Self::Inertia, spin: &Self::Spin) -> Self::Spin;
    /// Returns the product I a.
    fn times(inertia: &Self::Inertia, a: &Self::Motion) -> Self::Motion;
    /// Returns the product I (n, 0).
    fn times_spin(inertia: &Self::Inertia, n: &Self::Spin) -> Self::Motion;
    /// Returns the product I (0, d).
    fn times_point(inertia: &Self::Inertia, d: &Self::Point) -> Self::Motion;
    /// I − u w uᵀ, for a weight w.
    fn reduced(inertia: &Self::Inertia, u: &Self::Motion, w: T) -> Self::Inertia;
    /// I += k kᵀ.
    fn add_square(inertia: &mut Self::Inertia, k: &Self::Motion);
    /// I += J about an origin at `arm` from I's.
    fn add_shifted(inertia: &mut Self::Inertia, j: &Self::Inertia, arm: &Self::Point);
    /// The largest diagonal numbers: of the turning and of the moving block.
    fn size(inertia: &Self::Inertia) -> (T, T);

    /// Replaces I by its factors; false if it is not positive definite.
    fn factor(inertia: &mut Self::Inertia) -> bool;
    /// I⁻¹ f by the factors.
    fn solve(factors: &Self::Inertia, f: &Self::Motion) -> Self::Motion;
    /// Replaces the turning block A of [[A, H], [Hᵀ, M]] by its inverse; false if it is not positive definite.
    fn invert_turning(inertia: &mut Self::Inertia) -> bool;
    /// From [[A⁻¹, H], [Hᵀ, M]]: what a ball leaves over, M − Hᵀ A⁻¹ H in the moving block.
    fn ball_reduced(inertia: &Self::Inertia) -> Self::Inertia;
    /// From [[A⁻¹, H], ..]: A⁻¹ x.
    fn ball_solve(inertia: &Self::Inertia, x: &Self::Spin) -> Self::Spin;
    /// From [[.., H], [Hᵀ, ..]]: Hᵀ x.
    fn ball_column(inertia: &Self::Inertia, x: &Self::Spin) -> Self::Point;
    /// From [[.., H], ..]: H x.
    fn ball_row(inertia: &Self::Inertia, x: &Self::Point) -> Self::Spin;

    /// The first components of a vector of space.
    fn point_from(x: &Vector<T, 3>) -> Self::Point;
    /// A vector of space; zero across the plane.
    fn point_into(x: &Self::Point) -> Vector<T, 3>;
    /// The axial vector of a vector of space: z in the plane.
    fn spin_from(x: &Vector<T, 3>) -> Self::Spin;
    /// An axial vector of space.
    fn spin_into(x: &Self::Spin) -> Vector<T, 3>;
    /// A rotation from a matrix of space.
    fn rotation_from(r: &mbs_core::algebra::Matrix<T, 3>) -> Self::Rotation;
    /// A rotation as a matrix of space.
    fn rotation_into(r: &Self::Rotation) -> mbs_core::algebra::Matrix<T, 3>;
    /// A tensor from a matrix of space.
    fn tensor_from(i: &mbs_core::algebra::Matrix<T, 3>) -> Self::Tensor;

    /// (ω, v + ω × r).
    #[inline(always)]
    fn carried(m: &Self::Motion, arm: &Self::Point) -> Self::Motion {
        let spin = Self::spin(m);
        Self::motion(spin, Self::point(m) + Self::cross(&spin, arm))
    }
    /// (τ + r × f, f).
    #[inline(always)]
    fn gathered(f: &Self::Motion, arm: &Self::Point) -> Self::Motion {
        let push = Self::point(f);
        Self::motion(Self::spin(f) + Self::moment(arm, &push), push)
    }
    /// ω × (ω × x).
    #[inline(always)]
    fn centrifugal(spin: &Self::Spin, x: &Self::Point) -> Self::Point {
        Self::cross(spin, &Self::cross(spin, x))
    }
    /// The force f at a point at `arm`: (arm × f, f).
    #[inline(always)]
    fn wrench(arm: &Self::Point, f: &Self::Point) -> Self::Motion {
        Self::motion(Self::moment(arm, f), *f)
    }
}
