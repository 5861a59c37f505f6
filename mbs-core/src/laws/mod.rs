//! Laws as pure functions of numbers and slices: no allocation, no knowledge of scenes.
//!
//! One effect, one file. [`scalar`] gathers the laws along a length or about an angle, [`body`] those that act on one body and
//! ask for its place, velocity and spin.

pub mod body;
pub mod bumper;
pub mod calspan;
pub mod drag;
pub mod friction;
pub mod guide;
pub mod limit;
pub mod own;
pub mod polynomial;
pub mod road;
pub mod scalar;
pub mod speed_hold;
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
        table.get(self.first as usize..(self.first + self.n) as usize).unwrap_or(&[])
    }
}

/// What laws refer to by number: inputs at this instant, and tables that never change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Supplies<'a, T> {
    /// The vectors of the courses at this instant.
    pub courses: &'a [[T; 3]],
    /// Pieces of polynomials.
    pub pieces: &'a [polynomial::Piece<T>],
    /// Parts of roads.
    pub features: &'a [road::Feature<T>],
    /// Points (x, z) of roads given by tables, and their curvatures.
    pub knots: (&'a [[T; 2]], &'a [T]),
}

impl<'a, T: Real> Supplies<'a, T> {
    /// Courses alone.
    #[must_use]
    pub fn courses(courses: &'a [[T; 3]]) -> Self {
        Self { courses, pieces: &[], features: &[], knots: (&[], &[]) }
    }
}
