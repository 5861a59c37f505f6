//! Ranges of the tables that laws share.

/// Range of a table that laws share: `n` entries from `first`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Part {
    /// Index of the first entry.
    pub first: u32,
    /// Number of entries from `first` on.
    pub n: u32,
}

impl Part {
    /// Entries of the range; empty if the table is too short.
    #[inline(always)]
    pub fn of<X>(self, table: &[X]) -> &[X] {
        let first = self.first as usize;
        table.get(first..first.saturating_add(self.n as usize)).unwrap_or(&[])
    }

    /// True if the range ends at or before `end`.
    #[must_use]
    pub const fn is_within(self, end: usize) -> bool {
        (self.first as usize).saturating_add(self.n as usize) <= end
    }
}
