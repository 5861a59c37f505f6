//! The scalar trait [`Real`]: every formula of the workspace is generic over it.
//!
//! The trait requires only `Scalar` and the closed operations of nalgebra, so only its matrix *arithmetic* is used. Roots and trigonometric
//! functions come from `libm` or from this module on every target. No feature and no host therefore changes a number.

mod root;
mod turn;

use core::fmt::{Debug, Display, LowerExp};
use core::ops::Neg;
use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Scalar};
use num_traits::{One, Zero};

mod decimal;
mod double_double;
mod functions;
mod lanes;
mod pair;
mod show;
mod transforms;
mod wide;

pub use double_double::DoubleDouble;
pub use lanes::Lanes;

/// A real number type for the mechanics: `f32`, `f64`, [`DoubleDouble`], or several doubles at once ([`Lanes`]).
pub trait Real:
    Scalar
    + Copy
    + Default
    + PartialOrd
    + Neg<Output = Self>
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Zero
    + One
    + Display
    + LowerExp
    + Debug
    + Send
    + Sync
{
    /// The number zero, exact in every scalar.
    const ZERO: Self;
    /// The number one, exact in every scalar.
    const ONE: Self;
    /// The number one half, exact in every scalar.
    const HALF: Self;
    /// The number two, exact in every scalar.
    const TWO: Self;
    /// Distance from one to the next larger number, the machine precision. For a [`DoubleDouble`] it is the precision of the arithmetic.
    const EPSILON: Self;
    /// Half a turn [rad].
    const PI: Self;
    /// True if the crates with large functions compile them for this scalar when their feature `instances` is on. See [`once`](crate::once).
    const HAS_INSTANCES: bool = false;

    /// The nearest number to `x`.
    fn from_f64(x: f64) -> Self;
    /// The value of a function that was computed in `f64`. `_slopes` has an entry for each argument of the function: the derivative with
    /// respect to the argument, and the argument. A scalar that carries derivatives computes its derivatives from these entries.
    #[inline]
    #[must_use]
    fn from_f64_with(value: f64, _slopes: &[(f64, Self)]) -> Self {
        Self::from_f64(value)
    }
    /// The nearest number to a decimal text such as `9.81` or `1.0e-3`; `None` when the text is not a number.
    fn from_decimal(text: &str) -> Option<Self>;
    /// Nearest `f64` to the number.
    fn to_f64(self) -> f64;
    /// The number as the exact sum of two `f64`. The second is zero when one `f64` is enough.
    #[inline]
    fn parts(self) -> [f64; 2] {
        [self.to_f64(), 0.0]
    }
    /// The number whose [`parts`](Self::parts) are the two arguments.
    #[inline]
    #[must_use]
    fn from_parts([near, _]: [f64; 2]) -> Self {
        Self::from_f64(near)
    }
    /// Square root of the number.
    fn sqrt(self) -> Self;
    /// Sine and cosine of an angle [rad].
    fn sin_cos(self) -> (Self, Self);
    /// Angle of the point (x, y) = (`x`, `self`) from the x axis [rad], in (-pi, pi].
    fn atan2(self, x: Self) -> Self;

    /// Absolute value of the number.
    #[inline]
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }
    /// The larger of two numbers; a NaN in `self` is kept.
    #[inline]
    fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }
    /// The smaller of two numbers; a NaN in `self` is kept.
    #[inline]
    fn min(self, other: Self) -> Self {
        if self > other { other } else { self }
    }
    /// The tolerance `x` for `f64`, reduced in proportion to the machine precision of a more precise scalar. Less precise scalars get `x`;
    /// their users set larger minimum tolerances.
    #[must_use]
    fn tolerance(x: f64) -> Self {
        let finer = Self::EPSILON / Self::from_f64(f64::EPSILON);
        Self::from_f64(x) * finer.min(Self::ONE)
    }
    /// True if the number is neither infinite nor NaN.
    #[inline]
    fn is_finite(self) -> bool {
        let zero = self * Self::ZERO;
        zero.is_zero()
    }
}

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const HALF: Self = 0.5;
    const TWO: Self = 2.0;
    const EPSILON: Self = Self::EPSILON;
    const PI: Self = core::f64::consts::PI;
    const HAS_INSTANCES: bool = true;

    #[inline]
    fn from_f64(x: f64) -> Self {
        x
    }
    fn from_decimal(text: &str) -> Option<Self> {
        text.parse().ok()
    }
    #[inline]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
    #[inline]
    fn abs(self) -> Self {
        Self::abs(self)
    }
}

impl Real for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const HALF: Self = 0.5;
    const TWO: Self = 2.0;
    const EPSILON: Self = Self::EPSILON;
    const PI: Self = core::f32::consts::PI;
    const HAS_INSTANCES: bool = cfg!(feature = "f32");

    #[inline]
    #[allow(clippy::cast_possible_truncation, reason = "rounding to f32 is what is asked for")]
    fn from_f64(x: f64) -> Self {
        x as Self
    }
    fn from_decimal(text: &str) -> Option<Self> {
        text.parse().ok()
    }
    #[inline]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        root::root(self)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        turn::sin_cos(self)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        libm::atan2f(self, x)
    }
    #[inline]
    fn abs(self) -> Self {
        Self::abs(self)
    }
}
