//! Counts of arithmetic operations, by which steps on controllers are bounded.

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
    /// Sines with their cosines, and arc tangents.
    pub turns: u64,
    /// Entries of Λ, l and gains that the kernels of loops look up by number: no arithmetic, but instructions.
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

    /// Entries that are looked up.
    #[must_use]
    pub const fn entries(entries: u64) -> Self {
        Self { entries, ..Self::NONE }
    }

    /// With quotients, roots and turns.
    #[must_use]
    pub const fn and(self, quotients: u64, roots: u64, turns: u64) -> Self {
        Self { quotients, roots, turns, ..self }
    }

    /// All operations, each counted as one; entries are none.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.products + self.sums + self.quotients + self.roots + self.turns
    }

    /// The bound of instructions of a Cortex-M whose arithmetic unit has the precision. It counts 7 for two products or sums with their loads,
    /// stores and part of the loops, 16 for a quotient, 40 to find an entry. In single precision a root is an instruction between moves, and
    /// turns need no doubles; in double precision both are functions of libm. Angles beyond 6400 rad, in double precision 1e6 rad, cost more.
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

/// A length as a count.
#[must_use]
pub const fn count(n: usize) -> u64 {
    n as u64
}
