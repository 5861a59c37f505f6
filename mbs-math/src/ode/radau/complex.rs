//! Complex numbers with the operations of a factorisation, and a trait for real and complex entries.

use crate::Real;
use core::ops::{Div, Mul, Sub};

/// A number re + i im.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Complex<T> {
    pub(super) re: T,
    pub(super) im: T,
}

impl<T> Complex<T> {
    pub(super) const fn new(re: T, im: T) -> Self {
        Self { re, im }
    }
}

impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::new(self.re * b.re - self.im * b.im, self.re * b.im + self.im * b.re)
    }
}

impl<T: Real> Sub for Complex<T> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::new(self.re - b.re, self.im - b.im)
    }
}

impl<T: Real> Div for Complex<T> {
    type Output = Self;
    /// Divides by way of the larger part of the divisor, so that no square leaves the range of the scalar.
    fn div(self, b: Self) -> Self {
        if b.re.abs() >= b.im.abs() {
            let share = b.im / b.re;
            let under = b.re + b.im * share;
            Self::new((self.re + self.im * share) / under, (self.im - self.re * share) / under)
        } else {
            let share = b.re / b.im;
            let under = b.re * share + b.im;
            Self::new((self.re * share + self.im) / under, (self.im * share - self.re) / under)
        }
    }
}

/// A real or complex number over `T`.
pub(super) trait Number<T>:
    Copy + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn of(x: T) -> Self;
    /// Size |re| + |im| of the number.
    fn size(self) -> T;
}

impl<T: Real> Number<T> for T {
    fn of(x: T) -> Self {
        x
    }
    fn size(self) -> T {
        self.abs()
    }
}

impl<T: Real> Number<T> for Complex<T> {
    fn of(x: T) -> Self {
        Self::new(x, T::ZERO)
    }
    fn size(self) -> T {
        self.re.abs() + self.im.abs()
    }
}
