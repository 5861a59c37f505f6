//! Entries of tables by number, without a panic: a number that its table does not have is a typed error.
//!
//! A model's numbers are checked when it is built or loaded, so that the error is not met. A compiler cannot know that, and would
//! leave a path to a panic at every index.

/// A number in a mechanism's tables, or the length of a scratch, that does not fit the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outside;

/// Returns entry `i` of a table.
#[inline(always)]
pub(crate) fn at<X>(table: &[X], i: usize) -> Result<&X, Outside> {
    table.get(i).ok_or(Outside)
}

/// Entry `i`, to be written.
#[inline(always)]
pub(crate) fn at_mut<X>(table: &mut [X], i: usize) -> Result<&mut X, Outside> {
    table.get_mut(i).ok_or(Outside)
}

/// `n` entries from `first`.
#[inline(always)]
pub(crate) fn part<X>(table: &[X], first: usize, n: usize) -> Result<&[X], Outside> {
    table.get(first..).and_then(|rest| rest.get(..n)).ok_or(Outside)
}

/// `n` entries from `first`, to be written.
#[inline(always)]
pub(crate) fn part_mut<X>(table: &mut [X], first: usize, n: usize) -> Result<&mut [X], Outside> {
    table.get_mut(first..).and_then(|rest| rest.get_mut(..n)).ok_or(Outside)
}

/// Some entries, and others to be written, which are all before or all behind them.
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

/// The entries of a range.
#[inline(always)]
pub(crate) fn range<X>(table: &[X], range: core::ops::Range<usize>) -> Result<&[X], Outside> {
    table.get(range).ok_or(Outside)
}

/// All entries of one table over another of the same length.
#[inline(always)]
pub(crate) fn copy<X: Copy>(from: &[X], to: &mut [X]) -> Result<(), Outside> {
    if from.len() != to.len() {
        return Err(Outside);
    }
    to.copy_from_slice(from);
    Ok(())
}
