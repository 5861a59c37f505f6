//! A double that counts its arithmetic operations.

use core::cell::Cell;
use core::fmt;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use mbs_core::Real;
use mbs_nostd::format::{Reader, Record};
use mbs_nostd::operation_bound::Operations;
use num_traits::{One, Zero};

thread_local! {
    static DONE: Cell<Operations> = const { Cell::new(Operations::NONE) };
}

/// Returns the operations done since the last call.
pub(crate) fn done() -> Operations {
    DONE.replace(Operations::NONE)
}

fn note(change: impl Fn(&mut Operations)) {
    let mut done = DONE.get();
    change(&mut done);
    DONE.set(done);
}

/// A double that counts products, sums and differences, quotients, roots, and calls of sine and cosine or of the arc tangent.
/// Changes of sign and comparisons are not counted.
#[derive(Clone, Copy, PartialEq, PartialOrd, Default)]
pub(crate) struct Counted(pub(crate) f64);

macro_rules! operation {
    ($trait:ident $of:ident, $assign:ident $assigned:ident, $count:ident, $sign:tt) => {
        #[allow(clippy::suspicious_arithmetic_impl, reason = "what is added up is the count")]
        impl $trait for Counted {
            type Output = Self;
            fn $of(self, other: Self) -> Self {
                note(|done| done.$count += 1);
                Self(self.0 $sign other.0)
            }
        }
        impl $assign for Counted {
            fn $assigned(&mut self, other: Self) {
                *self = *self $sign other;
            }
        }
    };
}

operation!(Add add, AddAssign add_assign, sums, +);
operation!(Sub sub, SubAssign sub_assign, sums, -);
operation!(Mul mul, MulAssign mul_assign, products, *);
operation!(Div div, DivAssign div_assign, quotients, /);

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Counted {
    fn zero() -> Self {
        Self(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Counted {
    fn one() -> Self {
        Self(1.0)
    }
}

impl fmt::Debug for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}
impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}
impl fmt::LowerExp for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::LowerExp::fmt(&self.0, f)
    }
}

impl Real for Counted {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);
    const HALF: Self = Self(0.5);
    const TWO: Self = Self(2.0);
    const EPSILON: Self = Self(f64::EPSILON);
    const PI: Self = Self(core::f64::consts::PI);

    fn from_f64(x: f64) -> Self {
        Self(x)
    }
    fn from_decimal(text: &str) -> Option<Self> {
        text.parse().ok().map(Self)
    }
    fn to_f64(self) -> f64 {
        self.0
    }
    fn sqrt(self) -> Self {
        note(|done| done.roots += 1);
        Self(Real::sqrt(self.0))
    }
    fn sin_cos(self) -> (Self, Self) {
        note(|done| done.turns += 1);
        let (s, c) = Real::sin_cos(self.0);
        (Self(s), Self(c))
    }
    fn atan2(self, x: Self) -> Self {
        note(|done| done.turns += 1);
        Self(Real::atan2(self.0, x.0))
    }
    // a test for finite numbers is not counted: the mechanics does not need it
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
}

impl Record for Counted {
    fn read(from: &mut Reader<'_>) -> Result<Self, mbs_nostd::LoadError> {
        f64::read(from).map(Self)
    }
    fn write(&self, to: &mut mbs_nostd::export::Bytes) -> bool {
        self.0.write(to)
    }
    fn source(&self, to: &mut String) {
        self.0.source(to);
    }
}
