//! Tables that laws refer to by number.

use crate::Real;
use crate::laws::LawInputs;
use crate::laws::code::Codes;
use crate::laws::polynomial::Piece;
use crate::laws::road::Feature;
use alloc::vec::Vec;

/// Tables to which laws refer by number. They are constant after the effects are converted.
#[derive(Debug, Clone, PartialEq)]
pub struct Tables<T> {
    pub(crate) pieces: Vec<Piece<T>>,
    pub(super) features: Vec<Feature<T>>,
    pub(super) knots: Vec<[T; 2]>,
    pub(super) curvatures: Vec<T>,
    pub(super) codes: Codes,
}

impl<T: Real> Tables<T> {
    /// Returns tables without entries.
    pub(crate) fn empty() -> Self {
        Self {
            pieces: Vec::new(),
            features: Vec::new(),
            knots: Vec::new(),
            curvatures: Vec::new(),
            codes: Codes::default(),
        }
    }

    /// User-defined laws that are objects.
    pub fn codes(&self) -> &Codes {
        &self.codes
    }

    /// Returns the inputs of the laws: these tables, and `courses`, the vectors of the signals at the current time.
    #[inline(always)]
    pub fn law_inputs<'a>(&'a self, courses: &'a [[T; 3]]) -> LawInputs<'a, T> {
        LawInputs {
            courses,
            #[cfg(feature = "polynomial")]
            pieces: &self.pieces,
            #[cfg(feature = "tire")]
            features: &self.features,
            #[cfg(feature = "tire")]
            knots: (&self.knots, &self.curvatures),
            #[cfg(feature = "own-laws")]
            codes: Some(&self.codes),
        }
    }
}
