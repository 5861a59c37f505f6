//! Tables that laws refer to by number.

use crate::Real;
use crate::laws::Supplies;
#[cfg(feature = "polynomial")]
use crate::laws::polynomial::Piece;
#[cfg(feature = "tire")]
use crate::laws::road::Feature;
#[cfg(any(feature = "polynomial", feature = "tire"))]
use alloc::vec::Vec;
use core::marker::PhantomData;

/// Tables that laws refer to by number; constant from then on.
#[derive(Debug, Clone, PartialEq)]
pub struct Tables<T> {
    #[cfg(feature = "polynomial")]
    pub(super) pieces: Vec<Piece<T>>,
    #[cfg(feature = "tire")]
    pub(super) features: Vec<Feature<T>>,
    #[cfg(feature = "tire")]
    pub(super) knots: Vec<[T; 2]>,
    #[cfg(feature = "tire")]
    pub(super) curvatures: Vec<T>,
    scalar: PhantomData<T>,
}

impl<T: Real> Tables<T> {
    /// No tables.
    pub(super) fn empty() -> Self {
        Self {
            #[cfg(feature = "polynomial")]
            pieces: Vec::new(),
            #[cfg(feature = "tire")]
            features: Vec::new(),
            #[cfg(feature = "tire")]
            knots: Vec::new(),
            #[cfg(feature = "tire")]
            curvatures: Vec::new(),
            scalar: PhantomData,
        }
    }

    /// What laws ask for, with the courses of this instant.
    #[inline(always)]
    pub fn supplies<'a>(&'a self, courses: &'a [[T; 3]]) -> Supplies<'a, T> {
        Supplies {
            courses,
            #[cfg(feature = "polynomial")]
            pieces: &self.pieces,
            #[cfg(feature = "tire")]
            features: &self.features,
            #[cfg(feature = "tire")]
            knots: (&self.knots, &self.curvatures),
        }
    }
}
