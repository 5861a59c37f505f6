//! Format of numbers, indices, tuples and arrays.

#[cfg(feature = "export")]
use super::Bytes;
use super::{Reader, Record};
use crate::check::LoadError;
#[cfg(feature = "export")]
use alloc::{format, string::String};
use mbs_core::Real;
use mbs_core::algebra::{Vector, vector};
use mbs_recursive::space::{Planar, Space, Spatial};

/// A space whose points, axial vectors and tensors can be read.
pub trait Axes<T: Real>: Space<T, Point: Record, Spin: Record, Tensor: Record> {}

impl<T: Real + Record> Axes<T> for Planar {}
impl<T: Real + Record> Axes<T> for Spatial {}

impl Record for u32 {
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
        Ok(Self::from_le_bytes(from.take()?))
    }
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool {
        to.put(&self.to_le_bytes());
        true
    }
    #[cfg(feature = "export")]
    fn source(&self, to: &mut String) {
        to.push_str(&format!("{self}"));
    }
}

impl Record for usize {
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
        Ok(u32::read(from)? as Self)
    }
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool {
        u32::try_from(*self).is_ok_and(|x| x.write(to))
    }
    #[cfg(feature = "export")]
    fn source(&self, to: &mut String) {
        to.push_str(&format!("{self}"));
    }
}

impl Record for bool {
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
        match u32::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(from.fault(4)),
        }
    }
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool {
        u32::from(*self).write(to)
    }
    #[cfg(feature = "export")]
    fn source(&self, to: &mut String) {
        to.push_str(&format!("{self}"));
    }
}

macro_rules! real {
    ($real:ty) => {
        impl Record for $real {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_lossless,
                trivial_numeric_casts,
                reason = "the nearest number of this precision"
            )]
            fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
                Ok(if from.is_double {
                    f64::from_le_bytes(from.take()?) as Self
                } else {
                    f32::from_le_bytes(from.take()?) as Self
                })
            }
            #[cfg(feature = "export")]
            fn write(&self, to: &mut Bytes) -> bool {
                to.put_real(self.to_f64());
                true
            }
            #[cfg(feature = "export")]
            fn source(&self, to: &mut String) {
                if self.is_finite() {
                    to.push_str(&format!("{self:?}"));
                } else if self.is_nan() {
                    to.push_str("Scalar::NAN");
                } else if *self > 0.0 {
                    to.push_str("Scalar::INFINITY");
                } else {
                    to.push_str("-Scalar::INFINITY");
                }
            }
        }
    };
}

real!(f64);
real!(f32);

impl<X: Record, const N: usize> Record for [X; N] {
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
        let mut all = heapless::Vec::<X, N>::new();
        for _ in 0..N {
            let x = X::read(from)?;
            all.push(x).map_err(|_| LoadError::Length)?;
        }
        all.into_array().map_err(|_| LoadError::Length)
    }
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool {
        self.iter().all(|x| x.write(to))
    }
    #[cfg(feature = "export")]
    fn source(&self, to: &mut String) {
        to.push('[');
        for (i, x) in self.iter().enumerate() {
            if i > 0 {
                to.push_str(", ");
            }
            x.source(to);
        }
        to.push(']');
    }
}

impl<T: Real + Record, const N: usize> Record for Vector<T, N> {
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
        Ok(vector(<[T; N]>::read(from)?))
    }
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool {
        self.iter().all(|x| x.write(to))
    }
    #[cfg(feature = "export")]
    fn source(&self, to: &mut String) {
        let mut numbers = [T::ZERO; N];
        for (number, x) in numbers.iter_mut().zip(self.iter()) {
            *number = *x;
        }
        to.push_str("vector(");
        numbers.source(to);
        to.push(')');
    }
}

impl<X: Record> Record for Option<X> {
    fn read(from: &mut Reader<'_>) -> Result<Self, LoadError> {
        Ok(if bool::read(from)? { Some(X::read(from)?) } else { None })
    }
    #[cfg(feature = "export")]
    fn write(&self, to: &mut Bytes) -> bool {
        self.is_some().write(to) && self.as_ref().is_none_or(|x| x.write(to))
    }
    #[cfg(feature = "export")]
    fn source(&self, to: &mut String) {
        match self {
            None => to.push_str("None"),
            Some(x) => {
                to.push_str("Some(");
                x.source(to);
                to.push(')');
            }
        }
    }
}
