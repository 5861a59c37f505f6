//! Double-double numbers: pairs of `f64` with about 32 digits, for reference runs.
//!
//! A number is hi + lo with |lo| at most half a unit in the last place of hi. With u = 2⁻⁵³, relative errors are at most
//!
//! | operation | error | flops |
//! |---|---|---|
//! | x + y, x − y | 3 u² + 13 u³ | 20 |
//! | x y | 7 u² | 25 |
//! | x / y | 15 u² + 56 u³ | 49 |
//! | √x | 25/8 u² | 26 and a root in `f64` |
//!
//! The bounds are by Joldes, Muller and Popescu, ACM Trans. Math. Softw. 44 (2017) 15, for their algorithms 6, 10 and 17 without fused
//! multiply-add. The bound of the root is by Lefèvre, Louvet, Muller, Picot and Rideau, ACM Trans. Math. Softw. 49 (2023) 1. The bound of a
//! sum holds even when the terms cancel; the cheaper addition of 11 flops has no such bound. Bounds hold between 2⁻⁹⁶⁹ and 2⁹⁹⁶, where
//! products split exactly (`transforms.rs`). Outside this range, lo loses bits or is zero. Infinities and NaN behave as in `f64`. A zero
//! sum or product has no sign.
//! The bounds of functions, reading and writing are in `functions.rs`, `decimal.rs` and `show.rs`.
//!
//! The crate `twofloat` 0.8 has the same arithmetic. However, it calls its elementary functions preliminary, does not handle infinities and
//! NaN, and reads no decimal text.

use super::transforms::{fast_two_sum, two_product, two_sum};
use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use num_traits::{One, Zero};

/// A number of about 32 digits: the unevaluated sum hi + lo of two `f64`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DoubleDouble {
    pub(super) hi: f64,
    pub(super) lo: f64,
}

impl DoubleDouble {
    /// The number zero, with both parts zero.
    pub const ZERO: Self = Self::from_f64(0.0);
    /// The number one, with a second part of zero.
    pub const ONE: Self = Self::from_f64(1.0);
    /// Half a turn π [rad], within 2⁻¹⁰⁷.
    pub const PI: Self = Self { hi: core::f64::consts::PI, lo: 1.2246467991473532e-16 };
    /// Machine precision 2⁻¹⁰⁴, four times u²: the smallest difference from one that the arithmetic resolves.
    pub const EPSILON: Self = Self::from_f64(f64::EPSILON * f64::EPSILON);

    /// The number that equals the `f64` x.
    #[inline]
    #[must_use]
    pub const fn from_f64(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// The sum a + b of two `f64`. It is exact unless their exponents differ too much for two parts.
    #[inline]
    #[must_use]
    pub const fn from_sum(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, b);
        Self::pair(hi, lo)
    }

    /// Leading part of the number: the nearest `f64`.
    #[inline]
    #[must_use]
    pub const fn hi(self) -> f64 {
        self.hi
    }

    /// Second part of the number: the number minus its leading part.
    #[inline]
    #[must_use]
    pub const fn lo(self) -> f64 {
        self.lo
    }

    /// A number of two parts. The second part is zero when the first is not finite, so that infinities do not become NaN.
    #[inline]
    pub(super) const fn pair(hi: f64, lo: f64) -> Self {
        Self { hi, lo: if hi.is_finite() { lo } else { 0.0 } }
    }

    /// The sum x + y by algorithm 6, also for constants.
    #[inline(never)]
    pub(super) const fn plus(self, y: Self) -> Self {
        let (s, s_left) = two_sum(self.hi, y.hi);
        if !s.is_finite() {
            return Self::from_f64(s);
        }
        let (t, t_left) = two_sum(self.lo, y.lo);
        let (v, v_left) = fast_two_sum(s, s_left + t);
        let (hi, lo) = fast_two_sum(v, t_left + v_left);
        Self { hi, lo }
    }

    /// The product x y by algorithm 10, also for constants.
    #[inline(never)]
    pub(super) const fn times(self, y: Self) -> Self {
        let (p, left) = two_product(self.hi, y.hi);
        let crossed = self.hi * y.lo + self.lo * y.hi;
        let (hi, lo) = fast_two_sum(p, left + crossed);
        if hi.is_finite() { Self { hi, lo } } else { Self::from_f64(p) }
    }

    /// The product x y with an `f64` y, by algorithm 7: error 3/2 u² + 4 u³, 24 flops.
    #[inline(never)]
    pub(super) const fn times_f64(self, y: f64) -> Self {
        let (p, left) = two_product(self.hi, y);
        let (t, t_left) = fast_two_sum(p, self.lo * y);
        let (hi, lo) = fast_two_sum(t, t_left + left);
        if hi.is_finite() { Self { hi, lo } } else { Self::from_f64(p) }
    }

    /// The quotient x / y by algorithm 17, also for constants.
    #[inline(never)]
    pub(super) const fn over(self, y: Self) -> Self {
        let quotient = self.hi / y.hi;
        if !quotient.is_finite() || !y.hi.is_finite() {
            return Self::from_f64(quotient);
        }
        let back = y.times_f64(quotient);
        let left = (self.hi - back.hi) + (self.lo - back.lo);
        let (hi, lo) = fast_two_sum(quotient, left / y.hi);
        if hi.is_finite() { Self { hi, lo } } else { Self::from_f64(quotient) }
    }

    /// The negated number −x, also for constants.
    #[inline]
    pub(super) const fn minus(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }

    /// The product of the number and a power of two, exact within the range of `f64`.
    #[inline]
    pub(super) const fn scaled(self, power: f64) -> Self {
        Self::pair(self.hi * power, self.lo * power)
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(x: f64) -> Self {
        Self::from_f64(x)
    }
}

impl PartialOrd for DoubleDouble {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.hi.partial_cmp(&other.hi) {
            Some(Ordering::Equal) => self.lo.partial_cmp(&other.lo),
            order => order,
        }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.minus()
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    #[inline]
    fn add(self, y: Self) -> Self {
        self.plus(y)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, y: Self) -> Self {
        self.plus(y.minus())
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, y: Self) -> Self {
        self.times(y)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    #[inline]
    fn div(self, y: Self) -> Self {
        self.over(y)
    }
}

impl AddAssign for DoubleDouble {
    #[inline]
    fn add_assign(&mut self, y: Self) {
        *self = self.plus(y);
    }
}

impl SubAssign for DoubleDouble {
    #[inline]
    fn sub_assign(&mut self, y: Self) {
        *self = self.plus(y.minus());
    }
}

impl MulAssign for DoubleDouble {
    #[inline]
    fn mul_assign(&mut self, y: Self) {
        *self = self.times(y);
    }
}

impl DivAssign for DoubleDouble {
    #[inline]
    fn div_assign(&mut self, y: Self) {
        *self = self.over(y);
    }
}

impl Zero for DoubleDouble {
    #[inline]
    fn zero() -> Self {
        Self::ZERO
    }
    #[inline]
    fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }
}

impl One for DoubleDouble {
    #[inline]
    fn one() -> Self {
        Self::ONE
    }
}
