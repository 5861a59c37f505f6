//! Access to entries of tables by index, without a panic: an index beyond the end of a table returns a typed error.
//!
//! The indices in a model are checked when the model is built or loaded, so this error does not occur in a valid model. The compiler cannot
//! know this. With plain indexing it would add a path to a panic at every index.

/// Error: an index in a mechanism's tables is out of range, or a scratch slice has the wrong length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outside;

/// Returns entry `i` of a table.
#[inline(always)]
pub(crate) fn at<X>(table: &[X], i: usize) -> Result<&X, Outside> {
    table.get(i).ok_or(Outside)
}

/// Returns entry `i` of a table, mutable.
#[inline(always)]
pub(crate) fn at_mut<X>(table: &mut [X], i: usize) -> Result<&mut X, Outside> {
    table.get_mut(i).ok_or(Outside)
}

/// Returns `n` entries from entry `first`.
#[inline(always)]
pub(crate) fn part<X>(table: &[X], first: usize, n: usize) -> Result<&[X], Outside> {
    table.get(first..).and_then(|rest| rest.get(..n)).ok_or(Outside)
}

/// Returns `n` entries from entry `first`, mutable.
#[inline(always)]
pub(crate) fn part_mut<X>(table: &mut [X], first: usize, n: usize) -> Result<&mut [X], Outside> {
    table.get_mut(first..).and_then(|rest| rest.get_mut(..n)).ok_or(Outside)
}

/// Returns two parts of a table at once: one to read and one to write. The parts must not overlap.
#[inline(always)]
pub(crate) fn apart<X>(
    table: &mut [X],
    (first, n): (usize, usize),
    (first_written, n_written): (usize, usize),
) -> Result<(&[X], &mut [X]), Outside> {
    if first < first_written {
        let (before, from) = table.split_at_mut_checked(first_written).ok_or(Outside)?;
        Ok((part(before, first, n)?, part_mut(from, 0, n_written)?))
    } else {
        let (before, from) = table.split_at_mut_checked(first).ok_or(Outside)?;
        Ok((part(from, 0, n)?, part_mut(before, first_written, n_written)?))
    }
}

/// Returns the entries of a range.
#[inline(always)]
pub(crate) fn range<X>(table: &[X], range: core::ops::Range<usize>) -> Result<&[X], Outside> {
    table.get(range).ok_or(Outside)
}

/// Copies all entries of one table into another of equal length.
#[inline(always)]
pub(crate) fn copy<X: Copy>(from: &[X], to: &mut [X]) -> Result<(), Outside> {
    if from.len() != to.len() {
        return Err(Outside);
    }
    to.copy_from_slice(from);
    Ok(())
}
