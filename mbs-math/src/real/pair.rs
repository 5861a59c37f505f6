//! Double-double as the scalar of a computation.

use super::Real;
use super::decimal;
use super::double_double::DoubleDouble;
use super::functions;

impl Real for DoubleDouble {
    const ZERO: Self = Self::ZERO;
    const ONE: Self = Self::ONE;
    const HALF: Self = Self::from_f64(0.5);
    const TWO: Self = Self::from_f64(2.0);
    const EPSILON: Self = Self::EPSILON;
    const PI: Self = Self::PI;
    const HAS_INSTANCES: bool = cfg!(feature = "dd");

    #[inline]
    fn from_f64(x: f64) -> Self {
        Self::from_f64(x)
    }
    fn from_decimal(text: &str) -> Option<Self> {
        decimal::read(text)
    }
    #[inline]
    fn to_f64(self) -> f64 {
        self.hi
    }
    #[inline]
    fn parts(self) -> [f64; 2] {
        [self.hi, self.lo]
    }
    #[inline]
    fn from_parts([hi, lo]: [f64; 2]) -> Self {
        Self { hi, lo }
    }
    #[inline]
    fn sqrt(self) -> Self {
        functions::sqrt(self)
    }
    fn sin_cos(self) -> (Self, Self) {
        functions::sin_cos(self)
    }
    fn atan2(self, x: Self) -> Self {
        functions::atan2(self, x)
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.hi.is_finite()
    }
}
