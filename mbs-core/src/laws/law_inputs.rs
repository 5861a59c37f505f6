//! Inputs and tables that laws refer to by number.

use crate::Real;

/// An entry of a table that belongs to a Cargo feature: none can be made where it is off.
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
    /// A piece of a polynomial.
    PieceEntry = super::polynomial::Piece<T>, "polynomial"
}
table_entry! {
    /// A part of a road.
    FeatureEntry = super::feature::Feature<T>, "tire"
}
table_entry! {
    /// A point (x, z) of a road given by a table.
    KnotEntry = [T; 2], "tire"
}
table_entry! {
    /// The road's curvature there.
    CurvatureEntry = T, "tire"
}

/// The tables of laws that never change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawTables<'a, T> {
    /// Pieces of the laws' polynomials.
    pub pieces: &'a [PieceEntry<T>],
    /// Parts of the laws' roads.
    pub features: &'a [FeatureEntry<T>],
    /// Points of roads given by tables, and their curvatures.
    pub knots: (&'a [KnotEntry<T>], &'a [CurvatureEntry<T>]),
}

/// Inputs at this instant and tables that never change, which laws refer to by number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawInputs<'a, T> {
    /// The vectors of the courses at this instant.
    pub courses: &'a [[T; 3]],
    /// Pieces of the laws' polynomials.
    #[cfg(feature = "polynomial")]
    pub pieces: &'a [super::polynomial::Piece<T>],
    /// Parts of the laws' roads.
    #[cfg(feature = "tire")]
    pub features: &'a [super::feature::Feature<T>],
    /// Points (x, z) of roads given by tables, and their curvatures.
    #[cfg(feature = "tire")]
    pub knots: (&'a [[T; 2]], &'a [T]),
    /// Laws that are objects.
    #[cfg(all(feature = "alloc", feature = "own-laws"))]
    pub codes: Option<&'a super::code::Codes>,
}

impl<'a, T: Real> LawInputs<'a, T> {
    /// The vector of a course; zero where there is none.
    #[inline(always)]
    #[must_use]
    pub fn course(&self, course: u32) -> [T; 3] {
        self.courses.get(course as usize).copied().unwrap_or([T::ZERO; 3])
    }

    /// Returns inputs with these `courses` alone, without tables.
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

    /// Returns inputs with the same `courses`, and with these tables.
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

    /// Returns the tables of laws; those of features that are off are empty.
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

    /// Returns the pieces of polynomials; none without the feature.
    #[inline(always)]
    pub(crate) const fn pieces(&self) -> &'a [super::polynomial::Piece<T>] {
        #[cfg(feature = "polynomial")]
        return self.pieces;
        #[cfg(not(feature = "polynomial"))]
        &[]
    }

    /// Returns the parts of roads; none without the feature.
    #[inline(always)]
    pub(crate) const fn features(&self) -> &'a [super::feature::Feature<T>] {
        #[cfg(feature = "tire")]
        return self.features;
        #[cfg(not(feature = "tire"))]
        &[]
    }

    /// Laws that are objects; none without the feature.
    #[cfg(feature = "alloc")]
    pub(crate) const fn codes(&self) -> Option<&'a super::code::Codes> {
        #[cfg(feature = "own-laws")]
        return self.codes;
        #[cfg(not(feature = "own-laws"))]
        None
    }

    /// Points of roads and their curvatures; none without the feature.
    #[inline(always)]
    pub(crate) const fn knots(&self) -> (&'a [[T; 2]], &'a [T]) {
        #[cfg(feature = "tire")]
        return self.knots;
        #[cfg(not(feature = "tire"))]
        (&[], &[])
    }
}
