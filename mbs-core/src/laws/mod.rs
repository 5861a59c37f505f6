//! Laws as pure functions of numbers and slices: no allocation, no knowledge of scenes.
//!
//! One effect, one file. [`scalar`] gathers the laws along a length or about an angle, [`body`] those that act on one body and
//! ask for its place, velocity and spin. A law whose Cargo feature is off is not compiled; springs, dampers and given forces
//! always are.

pub mod body;
#[cfg(any(feature = "bumper", feature = "limit", feature = "tire"))]
pub mod bumper;
pub mod calspan;
#[cfg(feature = "drag")]
pub mod drag;
#[cfg(feature = "friction")]
pub mod friction;
pub mod guide;
pub mod kink;
#[cfg(feature = "limit")]
pub mod limit;
pub mod own;
#[cfg(feature = "polynomial")]
pub mod polynomial;
#[cfg(feature = "tire")]
pub mod road;
#[cfg(feature = "tire")]
pub mod road_contact;
pub mod scalar;
#[cfg(feature = "speed-hold")]
pub mod speed_hold;
#[cfg(feature = "tire")]
pub mod tire;

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
        }
    }
}
