//! Several doubles as one scalar: one evaluation serves several states of a mechanism.
//!
//! ```text
//! (x₁ … x_N) ∘ (y₁ … y_N) = (x₁ ∘ y₁ … x_N ∘ y_N)          x < y  holds when it holds in every lane
//! ```
//!
//! Each lane has the same bits as a computation with a single double. This requires that the code branches on numbers only to reject them:
//! `!(x > limit)` rejects all lanes when one lane is not above the limit.

use super::Real;
use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use num_traits::{One, Zero};

/// A scalar of `N` doubles. Two, four or eight doubles fill the vector registers of processors.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub struct Lanes<const N: usize>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    /// Lanes with the same number in each.
    #[inline]
    #[must_use]
    pub const fn all(x: f64) -> Self {
        Self([x; N])
    }

    /// True if `holds` returns true for the two numbers of every lane.
    #[inline(always)]
    fn every(&self, other: &Self, holds: impl Fn(f64, f64) -> bool) -> bool {
        let mut every = true;
        for k in 0..N {
            every &= holds(self.0[k], other.0[k]);
        }
        every
    }

    /// Applies a function lane by lane.
    #[inline(always)]
    fn map(mut self, of: impl Fn(f64) -> f64) -> Self {
        for x in &mut self.0 {
            *x = of(*x);
        }
        self
    }

    /// Applies a function of two numbers lane by lane.
    #[inline(always)]
    fn with(mut self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        for k in 0..N {
            self.0[k] = of(self.0[k], other.0[k]);
        }
        self
    }
}

macro_rules! operation {
    ($trait:ident $of:ident, $assign:ident $assigned:ident, $sign:tt) => {
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $of(self, other: Self) -> Self {
                self.with(other, |x, y| x $sign y)
            }
        }
        impl<const N: usize> $assign for Lanes<N> {
            #[inline(always)]
            fn $assigned(&mut self, other: Self) {
                *self = *self $sign other;
            }
        }
    };
}

operation!(Add add, AddAssign add_assign, +);
operation!(Sub sub, SubAssign sub_assign, -);
operation!(Mul mul, MulAssign mul_assign, *);
operation!(Div div, DivAssign div_assign, /);

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

/// An order holds between two numbers when it holds in every lane.
impl<const N: usize> PartialOrd for Lanes<N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        [
            (Ordering::Less, self < other),
            (Ordering::Equal, self == other),
            (Ordering::Greater, self > other),
        ]
        .into_iter()
        .find_map(|(order, holds)| holds.then_some(order))
    }
    #[inline(always)]
    fn lt(&self, other: &Self) -> bool {
        self.every(other, |x, y| x < y)
    }
    #[inline(always)]
    fn le(&self, other: &Self) -> bool {
        self.every(other, |x, y| x <= y)
    }
    #[inline(always)]
    fn gt(&self, other: &Self) -> bool {
        self.every(other, |x, y| x > y)
    }
    #[inline(always)]
    fn ge(&self, other: &Self) -> bool {
        self.every(other, |x, y| x >= y)
    }
}

impl<const N: usize> Default for Lanes<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> Zero for Lanes<N> {
    #[inline]
    fn zero() -> Self {
        Self::ZERO
    }
    #[inline]
    fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }
}

impl<const N: usize> One for Lanes<N> {
    #[inline]
    fn one() -> Self {
        Self::ONE
    }
}

/// Writes the numbers of the lanes between brackets.
macro_rules! shown {
    ($trait:ident) => {
        impl<const N: usize> fmt::$trait for Lanes<N> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                for (k, x) in self.0.iter().enumerate() {
                    f.write_str(if k == 0 { "[" } else { ", " })?;
                    fmt::$trait::fmt(x, f)?;
                }
                f.write_str("]")
            }
        }
    };
}
shown!(Display);
shown!(LowerExp);

impl<const N: usize> Real for Lanes<N> {
    const ZERO: Self = Self::all(0.0);
    const ONE: Self = Self::all(1.0);
    const HALF: Self = Self::all(0.5);
    const TWO: Self = Self::all(2.0);
    const EPSILON: Self = Self::all(f64::EPSILON);
    const PI: Self = Self::all(core::f64::consts::PI);

    #[inline]
    fn from_f64(x: f64) -> Self {
        Self::all(x)
    }
    fn from_decimal(text: &str) -> Option<Self> {
        text.parse().ok().map(Self::all)
    }
    /// The number in the first lane.
    #[inline]
    fn to_f64(self) -> f64 {
        self.0.first().copied().unwrap_or(f64::NAN)
    }
    #[inline]
    fn sqrt(self) -> Self {
        self.map(libm::sqrt)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sine, mut cosine) = (self, self);
        for k in 0..N {
            (sine.0[k], cosine.0[k]) = libm::sincos(self.0[k]);
        }
        (sine, cosine)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        self.with(x, libm::atan2)
    }
    #[inline]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }
    #[inline]
    fn max(self, other: Self) -> Self {
        self.with(other, <f64 as Real>::max)
    }
    #[inline]
    fn min(self, other: Self) -> Self {
        self.with(other, <f64 as Real>::min)
    }
}

#[cfg(test)]
mod tests {
    use super::Lanes;
    use crate::Real;

    #[test]
    fn every_lane_has_the_bits_of_a_double_alone() {
        let (x, y) = ([0.3, -1.7, 2.5e5, 9.0], [4.0, 0.1, -2.0, 3.0]);
        let (wide_x, wide_y) = (Lanes(x), Lanes(y));
        let (sine, cosine) = wide_x.sin_cos();
        let found =
            [wide_x + wide_y, wide_x - wide_y, wide_x * wide_y, wide_x / wide_y, sine, cosine];
        let found = found.into_iter().chain([
            wide_x.abs().sqrt(),
            wide_x.max(wide_y),
            wide_x.atan2(wide_y),
        ]);
        for (i, wide) in found.enumerate() {
            for k in 0..4 {
                let (x, y) = (x[k], y[k]);
                let (sine, cosine) = Real::sin_cos(x);
                let exact = [x + y, x - y, x * y, x / y, sine, cosine];
                let exact =
                    exact.into_iter().chain([Real::sqrt(x.abs()), x.max(y), Real::atan2(x, y)]);
                assert_eq!(exact.map(f64::to_bits).nth(i), Some(wide.0[k].to_bits()), "{i} {k}");
            }
        }
    }

    #[test]
    fn a_comparison_holds_when_it_holds_in_every_lane() {
        let (low, high, mixed) = (Lanes([1.0, 2.0]), Lanes([1.5, 3.0]), Lanes([0.0, 3.0]));
        for holds in [low < high, high > low, low <= low, high >= low] {
            assert!(holds, "in every lane");
        }
        for holds in
            [low < mixed, low > mixed, mixed >= low, Lanes([1.0, f64::NAN]) > Lanes([0.0; 2])]
        {
            assert!(!holds, "not in every lane");
        }
        assert!(!Lanes([1.0, f64::INFINITY]).is_finite() && low.is_finite());
        assert_eq!(low.partial_cmp(&mixed), None);
    }
}
