//! Numbers of a scene: decimal texts, which are converted when a run chooses its precision.
//!
//! A scene is read and built once, as [`Scene<Number>`](crate::scene::Scene). Then [`resolve`](crate::scene::Scene::resolve)
//! converts it to the scalar type of a run. Some defaults follow from other numbers, such as the middle of a rod. They are stored
//! as a sum or product, and computed in that scalar type.

use crate::Real;
use crate::real::DoubleDouble;
use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use core::fmt::{self, Display, Formatter};
use core::ops::{Add, Mul};

/// Number of digits that every `f64` preserves: the shortest text of such a number is the text that it was read from.
const KEPT_DIGITS: usize = 15;
/// Digits after the first in the text of a computed number. The text reads back as the same pair of doubles.
const COMPUTED_DIGITS: usize = 40;

/// Number of a scene: its decimal text and the nearest `f64`.
///
/// A number given in code means its shortest decimal text: 9.81 in a run of 32 digits is exactly 9.81, not the nearest double. Two
/// numbers are equal if their first 32 digits are.
#[derive(Debug, Clone, Default)]
pub struct Number {
    near: f64,
    /// Origin of the number; `None` for the shortest text of `near`.
    source: Option<Box<Source>>,
}

/// Origin of a number.
#[derive(Debug, Clone)]
enum Source {
    /// Decimal text with more digits than `f64` preserves.
    Text(Box<str>),
    /// Sum of two numbers.
    Sum(Number, Number),
    /// Product of two numbers.
    Product(Number, Number),
    /// Exact double in every precision, whatever its decimal text.
    Double,
    /// Assumed number that was not given: the third component of a vector of two numbers.
    Absent,
    /// Open number that was not given: it follows from the scene when the scene is resolved.
    Open,
}

impl Number {
    /// Number zero, in every precision.
    pub const ZERO: Self = Self { near: 0.0, source: None };
    /// Number one half, in every precision.
    pub const HALF: Self = Self { near: 0.5, source: None };

    /// Number of a decimal text such as `9.81` or `1.0e-3`. `None` if the text is no number, or a number that scene files must not
    /// contain.
    #[must_use]
    pub fn from_decimal(text: &str) -> Option<Self> {
        let is_digit = |c: Option<u8>| c.is_some_and(|c| c.is_ascii_digit());
        let digits = text.trim_start_matches(['+', '-']).as_bytes();
        let has_bare_point = digits.iter().enumerate().any(|(i, &c)| {
            c == b'.'
                && !(i > 0
                    && is_digit(digits.get(i - 1).copied())
                    && is_digit(digits.get(i + 1).copied()))
        });
        if has_bare_point || !is_digit(digits.first().copied()) {
            return None;
        }
        let near = text.parse().ok()?;
        let mantissa = digits.split(|c| matches!(c, b'e' | b'E')).next().unwrap_or(digits);
        let n = mantissa.iter().filter(|c| c.is_ascii_digit()).count();
        let source = (n > KEPT_DIGITS).then(|| Box::new(Source::Text(text.into())));
        Some(Self { near, source })
    }

    /// Number that is exactly this double in every precision, for data that was always computed from doubles.
    #[must_use]
    pub(crate) fn double(near: f64) -> Self {
        Self { near, source: Some(Box::new(Source::Double)) }
    }

    /// Assumed number that was not given, such as zero for the third component of a vector of two numbers.
    #[must_use]
    pub fn assumed(near: f64) -> Self {
        Self { near, source: Some(Box::new(Source::Absent)) }
    }

    /// Open number, which is computed when the scene is [resolved](crate::scene::Scene::resolve), and zero before.
    #[must_use]
    pub fn open() -> Self {
        Self { near: 0.0, source: Some(Box::new(Source::Open)) }
    }

    /// True if the number follows from the scene.
    #[must_use]
    pub fn is_open(&self) -> bool {
        matches!(self.source.as_deref(), Some(Source::Open))
    }

    /// True if the number was assumed instead of given.
    #[must_use]
    pub fn is_absent(&self) -> bool {
        matches!(self.source.as_deref(), Some(Source::Absent))
    }

    /// True if the number follows from other numbers, as the default of a key may.
    #[must_use]
    pub fn is_computed(&self) -> bool {
        matches!(self.source.as_deref(), Some(Source::Sum(..) | Source::Product(..)))
    }

    /// `f64` nearest to the number.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        self.near
    }

    /// True if the number is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.near == 0.0
    }

    /// Number in the precision `T`: the nearest to its decimal text. Computed numbers use the arithmetic of `T`.
    ///
    /// Cost: nothing in `f64`; in other precisions, reading the text.
    #[must_use]
    pub fn value<T: Real>(&self) -> T {
        let read = |text: &str| T::from_decimal(text).unwrap_or(T::from_f64(self.near));
        match self.source.as_deref() {
            None if T::EPSILON == T::from_f64(f64::EPSILON) => T::from_f64(self.near),
            None => read(&format!("{:e}", self.near)),
            Some(Source::Text(text)) => read(text),
            Some(Source::Sum(a, b)) => a.value::<T>() + b.value::<T>(),
            Some(Source::Product(a, b)) => a.value::<T>() * b.value::<T>(),
            Some(Source::Double | Source::Absent | Source::Open) => T::from_f64(self.near),
        }
    }

    /// Decimal text of the number, as in scene files.
    #[must_use]
    pub fn text(&self) -> String {
        match self.source.as_deref() {
            None | Some(Source::Double | Source::Absent | Source::Open) => {
                format!("{:?}", self.near)
            }
            Some(Source::Text(text)) => String::from(&**text),
            Some(Source::Sum(..) | Source::Product(..)) => {
                let text = format!("{:.COMPUTED_DIGITS$e}", self.value::<DoubleDouble>());
                let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
                format!("{}0e{exponent}", mantissa.trim_end_matches('0'))
            }
        }
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(&self.text())
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        let is_short = self.source.is_none() && other.source.is_none();
        self.near == other.near
            && (is_short || self.value::<DoubleDouble>() == other.value::<DoubleDouble>())
    }
}

impl From<f64> for Number {
    fn from(near: f64) -> Self {
        Self { near, source: None }
    }
}

impl From<i32> for Number {
    fn from(near: i32) -> Self {
        f64::from(near).into()
    }
}

impl Add for Number {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { near: self.near + other.near, source: Some(Box::new(Source::Sum(self, other))) }
    }
}

impl Mul for Number {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { near: self.near * other.near, source: Some(Box::new(Source::Product(self, other))) }
    }
}

/// Point or vector of a scene in global axes: two numbers in the plane, three in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Vector3(pub [Number; 3]);

impl From<[f64; 3]> for Vector3 {
    fn from(x: [f64; 3]) -> Self {
        Self(x.map(Number::from))
    }
}

impl From<[f64; 2]> for Vector3 {
    fn from(x: [f64; 2]) -> Self {
        x.map(Number::from).into()
    }
}

impl From<[Number; 3]> for Vector3 {
    fn from(x: [Number; 3]) -> Self {
        Self(x)
    }
}

impl From<[Number; 2]> for Vector3 {
    fn from([x, y]: [Number; 2]) -> Self {
        Self([x, y, Number::assumed(0.0)])
    }
}
