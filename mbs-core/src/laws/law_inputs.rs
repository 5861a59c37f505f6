//! Inputs and tables that laws refer to by number.

use crate::Real;

/// Entry of a table that needs a Cargo feature. Without the feature no entry can exist.
macro_rules! table_entry {
    ($(#[$doc:meta])* $Name:ident = $Entry:ty, $feature:literal) => {
        $(#[$doc])*
        #[cfg(feature = $feature)]
        pub type $Name<T> = $Entry;
        $(#[$doc])*
        #[cfg(not(feature = $feature))]
        pub type $Name<T> = <core::marker::PhantomData<T> as super::entry::NoEntry>::Entry;
    };
}

table_entry! {
    /// Piece of a polynomial (feature `polynomial`).
    PieceEntry = super::polynomial::Piece<T>, "polynomial"
}
table_entry! {
    /// Feature of a road (Cargo feature `tire`).
    FeatureEntry = super::feature::Feature<T>, "tire"
}
table_entry! {
    /// Point (x, z) of a road that a table gives.
    KnotEntry = [T; 2], "tire"
}
table_entry! {
    /// Second derivative of the road's height at a point.
    CurvatureEntry = T, "tire"
}

/// Constant tables of laws, which steps do not change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawTables<'a, T> {
    /// Pieces of the laws' polynomials.
    pub pieces: &'a [PieceEntry<T>],
    /// Parts of the laws' roads.
    pub features: &'a [FeatureEntry<T>],
    /// Points of roads given by tables, and the second derivatives of the height there.
    pub knots: (&'a [KnotEntry<T>], &'a [CurvatureEntry<T>]),
}

/// Signals at the current time, and the constant tables, to which laws refer by number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawInputs<'a, T> {
    /// Vectors of the signals at the current time.
    pub courses: &'a [[T; 3]],
    /// Pieces of the laws' polynomials.
    #[cfg(feature = "polynomial")]
    pub pieces: &'a [super::polynomial::Piece<T>],
    /// Parts of the laws' roads.
    #[cfg(feature = "tire")]
    pub features: &'a [super::feature::Feature<T>],
    /// Points (x, z) of roads given by tables, and the second derivatives of the height there.
    #[cfg(feature = "tire")]
    pub knots: (&'a [[T; 2]], &'a [T]),
    /// Laws that are objects.
    #[cfg(all(feature = "alloc", feature = "own-laws"))]
    pub codes: Option<&'a super::code::Codes>,
}

impl<'a, T: Real> LawInputs<'a, T> {
    /// Vector of a signal; zero if there is no such signal.
    #[inline(always)]
    #[must_use]
    pub fn course(&self, course: u32) -> [T; 3] {
        self.courses.get(course as usize).copied().unwrap_or([T::ZERO; 3])
    }

    /// Returns inputs with these signals (`courses`) and without tables.
    #[must_use]
    pub const fn courses(courses: &'a [[T; 3]]) -> Self {
        Self {
            courses,
            #[cfg(feature = "polynomial")]
            pieces: &[],
            #[cfg(feature = "tire")]
            features: &[],
            #[cfg(feature = "tire")]
            knots: (&[], &[]),
            #[cfg(all(feature = "alloc", feature = "own-laws"))]
            codes: None,
        }
    }

    /// Returns inputs with the same signals and with these tables.
    #[inline(always)]
    #[must_use]
    pub const fn with(self, tables: LawTables<'a, T>) -> Self {
        let _ = tables;
        Self {
            courses: self.courses,
            #[cfg(feature = "polynomial")]
            pieces: tables.pieces,
            #[cfg(feature = "tire")]
            features: tables.features,
            #[cfg(feature = "tire")]
            knots: tables.knots,
            #[cfg(all(feature = "alloc", feature = "own-laws"))]
            codes: self.codes,
        }
    }

    /// Returns the tables of laws. Tables of Cargo features that are off are empty.
    #[must_use]
    pub const fn tables(&self) -> LawTables<'a, T> {
        LawTables {
            #[cfg(feature = "polynomial")]
            pieces: self.pieces,
            #[cfg(not(feature = "polynomial"))]
            pieces: &[],
            #[cfg(feature = "tire")]
            features: self.features,
            #[cfg(not(feature = "tire"))]
            features: &[],
            #[cfg(feature = "tire")]
            knots: self.knots,
            #[cfg(not(feature = "tire"))]
            knots: (&[], &[]),
        }
    }

    /// Returns the pieces of polynomials; empty without the Cargo feature.
    #[inline(always)]
    pub(crate) const fn pieces(&self) -> &'a [super::polynomial::Piece<T>] {
        #[cfg(feature = "polynomial")]
        return self.pieces;
        #[cfg(not(feature = "polynomial"))]
        &[]
    }

    /// Returns the features of roads; empty without the Cargo feature.
    #[inline(always)]
    pub(crate) const fn features(&self) -> &'a [super::feature::Feature<T>] {
        #[cfg(feature = "tire")]
        return self.features;
        #[cfg(not(feature = "tire"))]
        &[]
    }

    /// Returns the laws that are objects; `None` without the Cargo feature.
    #[cfg(feature = "alloc")]
    pub(crate) const fn codes(&self) -> Option<&'a super::code::Codes> {
        #[cfg(feature = "own-laws")]
        return self.codes;
        #[cfg(not(feature = "own-laws"))]
        None
    }

    /// Returns the points of roads and their curvatures; empty without the Cargo feature.
    #[inline(always)]
    pub(crate) const fn knots(&self) -> (&'a [[T; 2]], &'a [T]) {
        #[cfg(feature = "tire")]
        return self.knots;
        #[cfg(not(feature = "tire"))]
        (&[], &[])
    }
}
