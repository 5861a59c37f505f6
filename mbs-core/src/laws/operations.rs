//! Counts of arithmetic operations, from which the time of a step on a controller is bounded.

use core::ops::{Add, AddAssign, Mul};

/// Counts of arithmetic operations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Operations {
    /// Number of products counted.
    pub products: u64,
    /// Number of sums and differences.
    pub sums: u64,
    /// Number of quotients counted.
    pub quotients: u64,
    /// Number of square roots.
    pub roots: u64,
    /// Number of sines with their cosines, and of arc tangents.
    pub turns: u64,
    /// Number of entries of Λ, l and gains that the kernels of closed loops look up. They are instructions, but no arithmetic.
    pub entries: u64,
}

impl Operations {
    /// Count of no operations.
    pub const NONE: Self = Self::new(0, 0);

    /// Returns the count of products and sums without other operations.
    #[must_use]
    pub const fn new(products: u64, sums: u64) -> Self {
        Self { products, sums, quotients: 0, roots: 0, turns: 0, entries: 0 }
    }

    /// Returns the count of entries that are looked up, without arithmetic.
    #[must_use]
    pub const fn entries(entries: u64) -> Self {
        Self { entries, ..Self::NONE }
    }

    /// Returns the count with these quotients, roots and trigonometric functions.
    #[must_use]
    pub const fn and(self, quotients: u64, roots: u64, turns: u64) -> Self {
        Self { quotients, roots, turns, ..self }
    }

    /// Total number of operations, each counted as one. Entries are not counted.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.products + self.sums + self.quotients + self.roots + self.turns
    }

    /// Upper bound of the instructions of a Cortex-M with a floating-point unit of this precision. Two products or sums count 7,
    /// with their loads, stores and part of the loops; a quotient counts 16, a looked-up entry 40. In single precision a root is
    /// one instruction between moves, and trigonometric functions need no doubles. In double precision both are functions of libm.
    /// Angles beyond 6400 rad (in double precision 1e6 rad) cost more.
    #[must_use]
    pub const fn instructions(&self, is_double: bool) -> u64 {
        let (root, turn) = if is_double { (140, 400) } else { (20, 120) };
        (self.products + self.sums) * 7 / 2
            + self.quotients * 16
            + self.roots * root
            + self.turns * turn
            + self.entries * 40
    }
}

impl Add for Operations {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            products: self.products + other.products,
            sums: self.sums + other.sums,
            quotients: self.quotients + other.quotients,
            roots: self.roots + other.roots,
            turns: self.turns + other.turns,
            entries: self.entries + other.entries,
        }
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<u64> for Operations {
    type Output = Self;
    fn mul(self, n: u64) -> Self {
        Self {
            products: self.products * n,
            sums: self.sums * n,
            quotients: self.quotients * n,
            roots: self.roots * n,
            turns: self.turns * n,
            entries: self.entries * n,
        }
    }
}

/// Length of a list as a count.
#[must_use]
pub const fn count(n: usize) -> u64 {
    n as u64
}
