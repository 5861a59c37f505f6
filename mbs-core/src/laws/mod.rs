//! Laws as pure functions of numbers and slices: no allocation, no knowledge of scenes.
//!
//! One effect, one file. [`scalar`] gathers the laws along a length or about an angle, [`body`] those that act on one body and
//! ask for its place, velocity and spin. A law whose Cargo feature is off is not compiled; springs, dampers and given forces
//! always are.

pub mod body;
pub mod bumper;
pub mod calspan;
#[cfg(feature = "alloc")]
pub mod code;
pub mod entry;
pub mod guide;
pub mod kink;
pub mod operations;
pub mod own;
pub mod road;
pub mod road_contact;
pub mod scalar;
pub mod tire;

pub use crate::effects::polynomial;

use crate::Real;

/// A part of a table that laws share: `n` entries from `first`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Part {
    /// The first entry.
    pub first: u32,
    /// How many.
    pub n: u32,
}

impl Part {
    /// The entries; none where the table is too short.
    #[inline(always)]
    pub fn of<X>(self, table: &[X]) -> &[X] {
        let first = self.first as usize;
        table.get(first..first.saturating_add(self.n as usize)).unwrap_or(&[])
    }

    /// Does it end by `end`?
    #[must_use]
    pub const fn is_within(self, end: usize) -> bool {
        (self.first as usize).saturating_add(self.n as usize) <= end
    }
}

/// An entry of a table that belongs to a Cargo feature: none can be made where it is off.
macro_rules! table_entry {
    ($(#[$doc:meta])* $Name:ident = $Entry:ty, $feature:literal) => {
        $(#[$doc])*
        #[cfg(feature = $feature)]
        pub type $Name<T> = $Entry;
        $(#[$doc])*
        #[cfg(not(feature = $feature))]
        pub type $Name<T> = <core::marker::PhantomData<T> as entry::NoEntry>::Entry;
    };
}

table_entry! {
    /// A piece of a polynomial.
    PieceEntry = polynomial::Piece<T>, "polynomial"
}
table_entry! {
    /// A part of a road.
    FeatureEntry = road::Feature<T>, "tire"
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
    /// Pieces of polynomials.
    pub pieces: &'a [PieceEntry<T>],
    /// Parts of roads.
    pub features: &'a [FeatureEntry<T>],
    /// Points of roads given by tables, and their curvatures.
    pub knots: (&'a [KnotEntry<T>], &'a [CurvatureEntry<T>]),
}

/// What laws refer to by number: inputs at this instant, and tables that never change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Supplies<'a, T> {
    /// The vectors of the courses at this instant.
    pub courses: &'a [[T; 3]],
    /// Pieces of polynomials.
    #[cfg(feature = "polynomial")]
    pub pieces: &'a [polynomial::Piece<T>],
    /// Parts of roads.
    #[cfg(feature = "tire")]
    pub features: &'a [road::Feature<T>],
    /// Points (x, z) of roads given by tables, and their curvatures.
    #[cfg(feature = "tire")]
    pub knots: (&'a [[T; 2]], &'a [T]),
    /// Laws that are objects.
    #[cfg(all(feature = "alloc", feature = "own-laws"))]
    pub codes: Option<&'a code::Codes>,
}

impl<'a, T: Real> Supplies<'a, T> {
    /// The vector of a course; zero where there is none.
    #[inline(always)]
    #[must_use]
    pub fn course(&self, course: u32) -> [T; 3] {
        self.courses.get(course as usize).copied().unwrap_or([T::ZERO; 3])
    }

    /// Courses alone.
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

    /// The same courses, with these tables.
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

    /// The tables; empty ones of features that are off.
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

    /// Pieces of polynomials; none without the feature.
    #[inline(always)]
    pub(crate) const fn pieces(&self) -> &'a [polynomial::Piece<T>] {
        #[cfg(feature = "polynomial")]
        return self.pieces;
        #[cfg(not(feature = "polynomial"))]
        &[]
    }

    /// Parts of roads; none without the feature.
    #[inline(always)]
    pub(crate) const fn features(&self) -> &'a [road::Feature<T>] {
        #[cfg(feature = "tire")]
        return self.features;
        #[cfg(not(feature = "tire"))]
        &[]
    }

    /// Laws that are objects; none without the feature.
    #[cfg(feature = "alloc")]
    pub(crate) const fn codes(&self) -> Option<&'a code::Codes> {
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
