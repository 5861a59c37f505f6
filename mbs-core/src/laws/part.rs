//! Parts of the tables that laws share.

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
