//! Constructors for signals, motions and roads in code, one for each form.

use crate::scene::{
    Motion, NamedSignal, Number, Road, RoadFeature, Signal, SignalId, SignalKind, Vector3,
};
use alloc::string::String;
use alloc::vec::Vec;

impl Signal<Number> {
    /// A signal with a constant value.
    #[must_use]
    pub fn constant(value: impl Into<Number>) -> Self {
        Self::Constant([value.into(), Number::ZERO, Number::ZERO])
    }

    /// A signal that the program sets between steps, with its start value.
    #[must_use]
    pub fn input(start: impl Into<Number>) -> Self {
        Self::Input([start.into(), Number::ZERO, Number::ZERO])
    }
}

/// Makes the named signal the first component of a vector.
impl<T> From<SignalId> for Signal<T> {
    fn from(signal: SignalId) -> Self {
        Self::Named([Some(signal), None, None])
    }
}

impl<T> From<SignalId> for Motion<T> {
    fn from(signal: SignalId) -> Self {
        Self::Signal(signal)
    }
}

impl NamedSignal<Number> {
    /// A signal without a name.
    pub fn new(kind: impl Into<SignalKind<Number>>) -> Self {
        Self { name: String::new(), kind: kind.into() }
    }
}

impl From<SignalKind<f64>> for SignalKind<Number> {
    fn from(kind: SignalKind<f64>) -> Self {
        kind.map(&mut |x| Number::from(*x))
    }
}

impl Road<Number> {
    /// A road with features under all wheels alike; their heights add up. It moves in -x towards a stationary vehicle at a speed [m/s].
    pub fn new(
        features: impl IntoIterator<Item = RoadFeature<f64>>,
        speed: impl Into<Number>,
    ) -> Self {
        let number = &mut |x: &f64| Number::from(*x);
        let left: Vec<_> = features.into_iter().map(|feature| feature.map(number)).collect();
        Self { right: left.clone(), left, speed: speed.into() }
    }
}

/// Makes the constant the first component of a vector.
impl From<f64> for Signal<Number> {
    fn from(constant: f64) -> Self {
        Self::Constant([constant.into(), Number::ZERO, Number::ZERO])
    }
}

impl<const N: usize> From<[f64; N]> for Signal<Number>
where
    Vector3: From<[f64; N]>,
{
    fn from(constant: [f64; N]) -> Self {
        Self::Constant(Vector3::from(constant).0)
    }
}

impl From<Signal<f64>> for Signal<Number> {
    fn from(signal: Signal<f64>) -> Self {
        signal.map(&mut Number::from)
    }
}

impl From<Motion<f64>> for Motion<Number> {
    fn from(motion: Motion<f64>) -> Self {
        motion.map(&mut |x| Number::from(*x))
    }
}
