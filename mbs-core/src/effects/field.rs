//! Fields and values that describe effects. A field has a key, a form, a unit and a default; a value has one of the forms.
//!
//! Reader, writer, checks, documents and tests use fields and values. None of them has a list of the kinds of effect.

use crate::joint::Dimension;
use crate::laws::code::{BodyLaw, Code, ForceLaw};
use crate::scene::{
    AxisFrame, BodyId, CalspanCoefficients, CouplingTerm, JointId, LongitudinalSlip,
    PolynomialPiece, Signal,
};
use alloc::vec::Vec;

/// One key of an effect in scene files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Key in scene files. For a [`Form::Signal`] it is the first of four keys.
    pub key: &'static str,
    /// Form of the value at the key.
    pub form: Form,
    /// SI unit of the value; empty for a value without unit.
    pub unit: &'static str,
    /// Rule for a key that is left out.
    pub default: Default,
    /// Meaning of the field, in one sentence.
    pub meaning: &'static str,
}

impl Field {
    /// Returns the keys of the field in scene files.
    pub fn keys(&self) -> impl Iterator<Item = &'static str> {
        let keys = match self.form {
            Form::Signal(_) => [Some(self.key), Some("table"), Some("input"), Some("signal")],
            Form::Side => [Some(self.key), Some("coefficients"), None, None],
            Form::Name(_) | Form::ForceLaw | Form::BodyLaw => [None; 4],
            _ => [Some(self.key), None, None, None],
        };
        keys.into_iter().flatten()
    }
}

/// Form of the value at a key. It also says which values are refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Form {
    /// Two different bodies, or a body and the ground.
    Bodies,
    /// A body that moves.
    Body,
    /// Joint, with the requirement that it must satisfy if no coordinate is given.
    Joint(JointNeed),
    /// Coordinate of the joint, by name or by number from 0. `None`: the coordinate that the requirement on the joint determines.
    Coordinate,
    /// Terms of a sum of joint coordinates and lengths, as in a coupling.
    Terms,
    /// A place in the reference configuration.
    Point,
    /// Two places, one per body. If the Boolean is true, the places must differ.
    Points(bool),
    /// Line through two or more places, each with its body.
    Line,
    /// A direction.
    Axis,
    /// A direction, or none.
    MaybeAxis,
    /// Number, with the signs that are allowed.
    Number(Sign),
    /// Length, or `"reference"` for the length of the line in the reference configuration.
    Length,
    /// True or false.
    Flag,
    /// Six numbers along and about x, y, z, none of them negative. In the plane, the numbers along x and y and about z are used.
    Six,
    /// Pieces of a polynomial, `[lower, upper, c0, c1, ...]`.
    Pieces,
    /// Signal: `value`, `value` with `input = true` (set between steps), `table` (over time), or `signal` (by name).
    Signal(SignalForm),
    /// Axes of a vector: `"global"` or `"body"`.
    Frame,
    /// Side force of a tire: `"none"`, or `"calspan"` with its `coefficients`.
    Side,
    /// A joint with one rotation, about which a wheel spins, or none.
    Spin,
    /// Slip of a tire: a table with `stiffness` and `friction`, or none.
    Slip,
    /// Boolean that is true if the effect has this name. A kind of effect may have several names.
    Name(&'static str),
    /// A user-defined law along a line or on a joint.
    ForceLaw,
    /// A user-defined law on a body.
    BodyLaw,
}

/// Requirement of an effect on its joint, if no coordinate is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointNeed {
    /// One rotation as the coordinate. A joint without rotation must have one coordinate.
    Rotation,
    /// One rotation; a joint without rotation is refused.
    Spin,
    /// One coordinate.
    Coordinate,
}

/// Which numbers are refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// Any finite number passes.
    Any,
    /// Numbers below zero are refused.
    NotNegative,
    /// Zero is refused too.
    Positive,
}

/// Number and meaning of the components of a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SignalForm {
    /// One number.
    Scalar,
    /// A vector of the scene's dimension.
    Vector,
    /// Moment: one number in the plane, a vector in space.
    Moment,
    /// Three numbers of any meaning.
    Three,
}

impl SignalForm {
    /// Returns the number of components in a scene of this dimension.
    #[must_use]
    pub fn n_components(self, dimension: Dimension) -> usize {
        match (self, dimension) {
            (Self::Scalar, _) | (Self::Moment, Dimension::Planar) => 1,
            (Self::Vector, _) | (Self::Moment, Dimension::Spatial) => dimension.count(),
            (Self::Three, _) => 3,
        }
    }
}

/// Rule for a key that is left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Default {
    /// The key must be written.
    Needed,
    /// Decimal number that is the default. For [`Form::Six`] all six numbers have this value.
    Number(&'static str),
    /// The value of an earlier key.
    As(&'static str),
    /// The decimal number times the value of an earlier key.
    Times(&'static str, &'static str),
    /// Zero if the value of an earlier key is zero. Otherwise the key must be written.
    NeededWith(&'static str),
    /// The key must be written unless an earlier key is true. Both together are refused.
    NeededWithout(&'static str),
    /// The value is computed from the scene.
    Open,
    /// The value is computed from the scene if the value of an earlier key is. Otherwise it is zero.
    OpenWith(&'static str),
    /// No value, or the first of the allowed words.
    Nothing,
}

/// Value of a field of an effect.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Value<T> {
    /// Value in the form [`Form::Bodies`].
    Bodies([BodyId; 2]),
    /// Value in the form [`Form::Body`].
    Body(BodyId),
    /// Value in the form [`Form::Joint`].
    Joint(JointId),
    /// Value in the form [`Form::Coordinate`].
    Coordinate(Option<usize>),
    /// Value in the form [`Form::Terms`].
    Terms(Vec<CouplingTerm<T>>),
    /// Value in the form [`Form::Point`].
    Point([T; 3]),
    /// Value in the form [`Form::Points`].
    Points([[T; 3]; 2]),
    /// Value in the form [`Form::Line`].
    Line(Vec<(BodyId, [T; 3])>),
    /// Value in the form [`Form::Axis`].
    Axis([T; 3]),
    /// Value in the form [`Form::MaybeAxis`].
    MaybeAxis(Option<[T; 3]>),
    /// Value in the form [`Form::Number`].
    Number(T),
    /// Value in the form [`Form::Length`]; `None`: the length in the reference configuration.
    Length(Option<T>),
    /// Value in the form [`Form::Flag`].
    Flag(bool),
    /// Value in the form [`Form::Six`].
    Six([T; 6]),
    /// Value in the form [`Form::Pieces`].
    Pieces(Vec<PolynomialPiece<T>>),
    /// Value in the form [`Form::Signal`].
    Signal(Signal<T>),
    /// Value in the form [`Form::Frame`].
    Frame(AxisFrame),
    /// Value in the form [`Form::Side`].
    Side(Option<CalspanCoefficients<T>>),
    /// Value in the form [`Form::Spin`].
    Spin(Option<JointId>),
    /// Value in the form [`Form::Slip`].
    Slip(Option<LongitudinalSlip<T>>),
    /// Value in the form [`Form::Name`].
    Name(bool),
    /// Value in the form [`Form::ForceLaw`].
    ForceLaw(Code<dyn ForceLaw>),
    /// Value in the form [`Form::BodyLaw`].
    BodyLaw(Code<dyn BodyLaw>),
}

impl<T: Clone> Value<T> {
    /// Returns the value with every number converted by `f`.
    pub fn map<U>(self, f: &mut impl FnMut(T) -> U) -> Value<U> {
        match self {
            Self::Bodies(bodies) => Value::Bodies(bodies),
            Self::Body(body) => Value::Body(body),
            Self::Joint(joint) => Value::Joint(joint),
            Self::Coordinate(number) => Value::Coordinate(number),
            Self::Terms(terms) => {
                let mut f = |x: &T| f(x.clone());
                Value::Terms(terms.iter().map(|term| term.map(&mut f)).collect())
            }
            Self::Point(x) => Value::Point(x.map(f)),
            Self::Points(x) => Value::Points(x.map(|x| x.map(&mut *f))),
            Self::Line(points) => {
                let place = |(body, x): (BodyId, [T; 3])| (body, x.map(&mut *f));
                Value::Line(points.into_iter().map(place).collect())
            }
            Self::Axis(x) => Value::Axis(x.map(f)),
            Self::MaybeAxis(x) => Value::MaybeAxis(x.map(|x| x.map(f))),
            Self::Number(x) => Value::Number(f(x)),
            Self::Length(x) => Value::Length(x.map(f)),
            Self::Flag(x) => Value::Flag(x),
            Self::Six(x) => Value::Six(x.map(f)),
            Self::Pieces(pieces) => {
                let piece = |p: PolynomialPiece<T>| PolynomialPiece {
                    lower: f(p.lower),
                    upper: f(p.upper),
                    coefficients: p.coefficients.into_iter().map(&mut *f).collect(),
                };
                Value::Pieces(pieces.into_iter().map(piece).collect())
            }
            Self::Signal(signal) => Value::Signal(signal.map(f)),
            Self::Frame(frame) => Value::Frame(frame),
            Self::Side(side) => Value::Side(side.map(|c| CalspanCoefficients {
                a: c.a.map(&mut *f),
                omega: f(c.omega),
                b: c.b.map(&mut *f),
                skid: f(c.skid),
                trail: c.trail.map(&mut *f),
            })),
            Self::Spin(joint) => Value::Spin(joint),
            Self::Slip(slip) => Value::Slip(slip.map(|slip| LongitudinalSlip {
                stiffness: f(slip.stiffness),
                friction: f(slip.friction),
            })),
            Self::Name(is) => Value::Name(is),
            Self::ForceLaw(law) => Value::ForceLaw(law),
            Self::BodyLaw(law) => Value::BodyLaw(law),
        }
    }
}

impl<T> Signal<T> {
    /// Returns the signal with every number converted by `f`.
    pub fn map<U>(self, f: &mut impl FnMut(T) -> U) -> Signal<U> {
        match self {
            Self::Constant(x) => Signal::Constant(x.map(f)),
            Self::Input(x) => Signal::Input(x.map(f)),
            Self::Table(rows) => {
                Signal::Table(rows.into_iter().map(|(t, x)| (f(t), x.map(&mut *f))).collect())
            }
            Self::Named(signals) => Signal::Named(signals),
        }
    }
}

/// Data of a kind of effect. The macro [`effect!`](super::effect) implements this trait.
pub(crate) trait EffectData<T>: Sized {
    /// Names of the kind in scene files. An effect has the first name, unless its model chooses another one.
    const NAMES: &'static [&'static str];
    /// Fields of the kind, in order.
    const FIELDS: &'static [Field];

    /// Returns the values of the fields, in their order.
    fn values(&self) -> Vec<Value<T>>
    where
        T: Clone;

    /// Returns the effect with these values. `None` if a value has another form, or if the kind does not consist of values.
    fn of(values: &mut dyn Iterator<Item = Value<T>>) -> Option<Self>;
}

/// Declares the data of a kind: its names, and each field with key, form, unit and default.
macro_rules! effect {
    (@key $field:ident) => { stringify!($field) };
    (@key $field:ident $key:literal) => { $key };
    (
        $(#[$doc:meta])*
        pub struct $Kind:ident<T> = [$($name:expr),*] {
            $(
                $(#[doc = $meaning:literal])+
                $field:ident $(as $key:literal)?: $Type:ty =
                    $Form:ident $(($need:expr))?, $unit:literal, $default:expr;
            )*
        }
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $Kind<T> {
            $(
                $(#[doc = $meaning])+
                #[doc = concat!("[", $unit, "]")]
                pub $field: $Type,
            )*
        }

        impl<T> $crate::effects::EffectData<T> for $Kind<T> {
            const NAMES: &'static [&'static str] = &[$($name),*];
            const FIELDS: &'static [$crate::effects::Field] = &[$(
                $crate::effects::Field {
                    key: $crate::effects::field::effect!(@key $field $($key)?),
                    form: $crate::effects::Form::$Form $(($need))?,
                    unit: $unit,
                    default: $default,
                    meaning: concat!($($meaning),+),
                },
            )*];

            fn values(&self) -> alloc::vec::Vec<$crate::effects::Value<T>>
            where
                T: Clone,
            {
                alloc::vec![$($crate::effects::Value::$Form(self.$field.clone())),*]
            }

            fn of(values: &mut dyn Iterator<Item = $crate::effects::Value<T>>) -> Option<Self> {
                $(
                    let Some($crate::effects::Value::$Form($field)) = values.next() else {
                        return None;
                    };
                )*
                Some(Self { $($field),* })
            }
        }
    };
}
pub(crate) use effect;
