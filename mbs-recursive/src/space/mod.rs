//! Algebra of motions, forces and inertias for plane and space. Every pass is written once, over the trait [`Space`].
//!
//! ```text
//! motion (ω, v)   force (τ, f)   about a link's own origin, world axes
//! arm r from the parent's origin to the child's:
//!     (ω, v) ↦ (ω, v + ω × r)        outward
//!     (τ, f) ↦ (τ + r × f, f)        inward
//! ```
//!
//! A motion has three numbers in the plane and six in space. An inertia is a symmetric matrix with 6 numbers in the plane and 21 in space.

mod planar;
mod spatial;

pub use planar::{Planar, PlanarInertia};
pub use spatial::{Spatial, SpatialInertia};

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Index, IndexMut, Mul, Neg, Sub, SubAssign};
use mbs_core::Real;
use mbs_core::algebra::Vector;

/// Vector of a few numbers, with addition and an inner product.
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
    /// Number of components of the vector.
    const N: usize;
    /// Returns the vector with zero in every component.
    fn zero() -> Self;
    /// Returns the inner product with `other`.
    fn dot(&self, other: &Self) -> T;
    /// Returns the inner product of absolute values, the scale of the inner product's rounding error.
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

/// Plane or space, with the operations that the passes use.
pub trait Space<T: Real>: Copy + Debug + Send + Sync + 'static {
    /// Vectors of points and directions.
    type Point: Numbers<T>;
    /// Angular velocities and moments.
    type Spin: Numbers<T>;
    /// A motion (ω, v) or a force (τ, f), with the rotational part first.
    type Motion: Numbers<T>;
    /// Rotation from body-fixed to world axes.
    type Rotation: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// A symmetric map from motions to forces.
    type Inertia: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// Inertia tensor of a body, in the axes of the reference configuration.
    type Tensor: Copy + Debug + PartialEq + Send + Sync + 'static;

    /// Dimension of the space: 2 or 3.
    const DIMENSION: usize;
    /// Number of coordinates of a free body: an angle or a quaternion, then the position.
    const FREE: usize;

    /// Returns the motion (ω, v).
    fn motion(spin: Self::Spin, point: Self::Point) -> Self::Motion;
    /// Returns ω of the motion (ω, v).
    fn spin(motion: &Self::Motion) -> Self::Spin;
    /// Returns v of the motion (ω, v).
    fn point(motion: &Self::Motion) -> Self::Point;
    /// Returns the cross product ω × x.
    fn cross(spin: &Self::Spin, x: &Self::Point) -> Self::Point;
    /// Returns the cross product ω × n of angular velocities. It is zero in the plane.
    fn cross_spin(spin: &Self::Spin, n: &Self::Spin) -> Self::Spin;
    /// Returns the moment r × f.
    fn moment(r: &Self::Point, f: &Self::Point) -> Self::Spin;

    /// Returns the identity rotation.
    fn identity() -> Self::Rotation;
    /// Returns a body-fixed vector in world axes.
    fn rotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point;
    /// Returns a body-fixed axial vector in world axes.
    fn rotate_spin(r: &Self::Rotation, x: &Self::Spin) -> Self::Spin;
    /// Returns a world axial vector in body axes.
    fn unrotate_spin(r: &Self::Rotation, x: &Self::Spin) -> Self::Spin;
    /// Returns a world vector in body axes.
    fn unrotate(r: &Self::Rotation, x: &Self::Point) -> Self::Point;
    /// Returns R Rot(n, angle): the rotation `r` composed with a rotation about a body-fixed unit axis n.
    fn turned(r: &Self::Rotation, axis: &Self::Spin, angle: T) -> Self::Rotation;
    /// Returns `r` composed with the body-fixed rotation of joint coordinates (a quaternion; in the plane an angle).
    fn turned_by(r: &Self::Rotation, z: &[T]) -> Self::Rotation;
    /// Writes the joint coordinates of a rotation.
    fn write_rotation(r: &Self::Rotation, z: &mut [T]);
    /// Returns the relative rotation Rᵀ S.
    fn relative(r: &Self::Rotation, s: &Self::Rotation) -> Self::Rotation;
    /// Updates the coordinates of a rotation by a body-fixed rotation vector δ: q ← q exp(δ), normalised.
    fn advance_rotation(z: &mut [T], delta: &[T]);
    /// Writes the rate of the coordinates of a rotation: q' = ½ q ω, with ω in body axes.
    fn rotation_rate(z: &[T], spin: &[T], rate: &mut [T]);
    /// Normalises the coordinates of a rotation to unit length.
    fn normalise_rotation(z: &mut [T]);

    /// Returns an inertia of zero.
    fn no_inertia() -> Self::Inertia;
    /// Returns the inertia of a body about its link's origin. `center` is the vector from that origin to the centre of mass in world axes;
    /// `tensor` is about the origin in body axes.
    fn body_inertia(
        mass: T,
        center: &Self::Point,
        tensor: &Self::Tensor,
        r: &Self::Rotation,
    ) -> Self::Inertia;
    /// Returns the rotational block of the inertia times ω: the angular momentum of a rotation about the origin.
    fn turning_block(inertia: &Self::Inertia, spin: &Self::Spin) -> Self::Spin;
    /// Returns the product I a.
    fn times(inertia: &Self::Inertia, a: &Self::Motion) -> Self::Motion;
    /// Returns the product I (n, 0).
    fn times_spin(inertia: &Self::Inertia, n: &Self::Spin) -> Self::Motion;
    /// Returns the product I (0, d).
    fn times_point(inertia: &Self::Inertia, d: &Self::Point) -> Self::Motion;
    /// Returns the inertia I − w u uᵀ, for a weight w.
    fn reduced(inertia: &Self::Inertia, u: &Self::Motion, w: T) -> Self::Inertia;
    /// Adds a rank-one term: I += k kᵀ.
    fn add_square(inertia: &mut Self::Inertia, k: &Self::Motion);
    /// Adds the inertia J to I. J is given about a point at the vector `arm` from the origin of I.
    fn add_shifted(inertia: &mut Self::Inertia, j: &Self::Inertia, arm: &Self::Point);
    /// Returns the largest diagonal entry of the rotational block, and the largest diagonal entry of the translational block.
    fn size(inertia: &Self::Inertia) -> (T, T);

    /// Replaces I by its factors. Returns false if I is not positive definite.
    fn factor(inertia: &mut Self::Inertia) -> bool;
    /// Returns I⁻¹ f, from the factors of I.
    fn solve(factors: &Self::Inertia, f: &Self::Motion) -> Self::Motion;
    /// Replaces the rotational block A of [[A, H], [Hᵀ, M]] by its inverse. Returns false if A is not positive definite.
    fn invert_turning(inertia: &mut Self::Inertia) -> bool;
    /// Returns the inertia that remains after a ball joint is eliminated: M − Hᵀ A⁻¹ H in the translational block, from [[A⁻¹, H], [Hᵀ,
    /// M]].
    fn ball_reduced(inertia: &Self::Inertia) -> Self::Inertia;
    /// Returns A⁻¹ x, from [[A⁻¹, H], ..].
    fn ball_solve(inertia: &Self::Inertia, x: &Self::Spin) -> Self::Spin;
    /// Returns Hᵀ x, from [[.., H], [Hᵀ, ..]].
    fn ball_column(inertia: &Self::Inertia, x: &Self::Spin) -> Self::Point;
    /// Returns H x, from [[.., H], ..].
    fn ball_row(inertia: &Self::Inertia, x: &Self::Point) -> Self::Spin;

    /// Returns the components of a spatial vector that exist in this space.
    fn point_from(x: &Vector<T, 3>) -> Self::Point;
    /// Returns a vector as a spatial vector. For the plane, the component normal to the plane is zero.
    fn point_into(x: &Self::Point) -> Vector<T, 3>;
    /// Returns the axial part of a spatial vector: in the plane its z component.
    fn spin_from(x: &Vector<T, 3>) -> Self::Spin;
    /// Returns an axial vector as a spatial vector.
    fn spin_into(x: &Self::Spin) -> Vector<T, 3>;
    /// Returns the rotation of a spatial rotation matrix.
    fn rotation_from(r: &mbs_core::algebra::Matrix<T, 3>) -> Self::Rotation;
    /// Returns a rotation as a spatial rotation matrix.
    fn rotation_into(r: &Self::Rotation) -> mbs_core::algebra::Matrix<T, 3>;
    /// Returns the tensor of a spatial inertia matrix.
    fn tensor_from(i: &mbs_core::algebra::Matrix<T, 3>) -> Self::Tensor;

    /// Returns the motion (ω, v + ω × r) of the point at `arm` r.
    #[inline(always)]
    fn carried(m: &Self::Motion, arm: &Self::Point) -> Self::Motion {
        let spin = Self::spin(m);
        Self::motion(spin, Self::point(m) + Self::cross(&spin, arm))
    }
    /// Returns the force (τ + r × f, f), shifted inward by `arm` r.
    #[inline(always)]
    fn gathered(f: &Self::Motion, arm: &Self::Point) -> Self::Motion {
        let push = Self::point(f);
        Self::motion(Self::spin(f) + Self::moment(arm, &push), push)
    }
    /// Returns the centripetal acceleration ω × (ω × x).
    #[inline(always)]
    fn centrifugal(spin: &Self::Spin, x: &Self::Point) -> Self::Point {
        Self::cross(spin, &Self::cross(spin, x))
    }
    /// Returns the wrench (arm × f, f) of a force f that acts at the vector `arm` from the origin.
    #[inline(always)]
    fn wrench(arm: &Self::Point, f: &Self::Point) -> Self::Motion {
        Self::motion(Self::moment(arm, f), *f)
    }
}
