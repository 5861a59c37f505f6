//! Rank of a sparse matrix with short rows, by elimination of the products of its rows.
//!
//! ```text
//! S = J J^T, rows of J of unit length        s_kk: square of the distance of row k from the span of the rows eliminated before it
//! S <- S - s_k s_k^T / s_kk                  order: large distances first, among these the rows with the fewest products
//! ```
//!
//! s_k is row k of S. S is positive semidefinite, and so is the remaining matrix after each elimination. Entries therefore do not grow, in
//! any order. A row that depends on others keeps only a rounding error on its diagonal. Distances below about 5e-7 count as zero (in double
//! precision).

use crate::Real;
use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

/// Largest pivot that counts as zero, in multiples of machine precision [-]. It exceeds the error of some dozen updates of a diagonal. It
/// is below the squared distances in chains of a million rows.
const ROUNDINGS: f64 = 1000.0;

/// Ratio, in powers of ten, within which diagonals are equally suitable as pivots [-]. A small pivot increases later rounding errors.
/// Chosen, not tuned.
const DECADES: f64 = 2.0;

/// Entries of a row in ascending order of columns.
pub(crate) type Row<T> = Vec<(u32, T)>;

/// Number of linearly independent rows. Columns are below `n`, and distinct within a row.
pub fn sparse_rank<T: Real>(rows: Vec<Row<T>>, n: usize) -> usize {
    let mut left = products(rows, n);
    let mut turns: BinaryHeap<Reverse<Turn>> =
        left.iter().enumerate().filter_map(|(k, row)| turn(row, k)).map(Reverse).collect();
    let (mut rank, mut scratch) = (0, Vec::new());
    while let Some(Reverse(now)) = turns.pop() {
        let k = now.2;
        // A row that has changed has a newer turn in the queue.
        if turn(&left[k], k) != Some(now) {
            continue;
        }
        let used = core::mem::take(&mut left[k]);
        let pivot = entry(&used, k);
        for &(other, x) in used.iter().filter(|(other, _)| *other as usize != k) {
            let row = &mut left[other as usize];
            subtract(row, (&used, k), x / pivot, &mut scratch);
            turns.extend(turn(row, other as usize).map(Reverse));
        }
        rank += 1;
    }
    rank
}

/// Turn of a row in the order of elimination: class of its diagonal (larger diagonals first), its length, and its index.
type Turn = (u32, usize, usize);

/// Turn of a row in the order of elimination; `None` if its diagonal is only a rounding error.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number")]
fn turn<T: Real>(row: &Row<T>, k: usize) -> Option<Turn> {
    let square = entry(row, k);
    if !(square > T::EPSILON * T::from_f64(ROUNDINGS)) {
        return None;
    }
    let class = (-libm::log10(square.to_f64()) / DECADES).max(0.0);
    Some((class as u32, row.len(), k))
}

/// Matrix S = J J^T, with the rows of J scaled to unit length. Rows of zeros stay empty.
fn products<T: Real>(mut rows: Vec<Row<T>>, n: usize) -> Vec<Row<T>> {
    let mut columns = vec![Vec::new(); n];
    for (k, row) in rows.iter_mut().enumerate() {
        let length = row.iter().fold(T::ZERO, |sum, (_, x)| sum + *x * *x).sqrt();
        for (column, x) in row {
            *x /= length;
            columns[*column as usize].push((crate::natural::index(k), *x));
        }
    }
    let (mut sum, mut is_met) = (vec![T::ZERO; rows.len()], vec![false; rows.len()]);
    let mut met: Vec<u32> = Vec::new();
    let product = |row: &Row<T>| {
        for (column, x) in row {
            for (other, y) in &columns[*column as usize] {
                let o = *other as usize;
                if !core::mem::replace(&mut is_met[o], true) {
                    met.push(*other);
                }
                sum[o] += *x * *y;
            }
        }
        met.sort_unstable();
        let take = |other: u32| {
            is_met[other as usize] = false;
            (other, core::mem::replace(&mut sum[other as usize], T::ZERO))
        };
        met.drain(..).map(take).collect()
    };
    rows.iter().map(product).collect()
}

/// Entry of a row in a column; zero if it is not stored.
fn entry<T: Real>(row: &Row<T>, column: usize) -> T {
    let place = row.binary_search_by_key(&column, |(c, _)| *c as usize);
    place.map_or(T::ZERO, |place| row[place].1)
}

/// Subtracts factor times the eliminated row `used` from `row`, and removes the pivot column.
fn subtract<T: Real>(
    row: &mut Row<T>,
    (used, pivot): (&Row<T>, usize),
    factor: T,
    merged: &mut Row<T>,
) {
    merged.clear();
    let (mut a, mut b) = (row.iter().copied().peekable(), used.iter().copied().peekable());
    loop {
        let column = match (a.peek(), b.peek()) {
            (Some((x, _)), Some((y, _))) => *x.min(y),
            (Some((x, _)), None) | (None, Some((x, _))) => *x,
            (None, None) => break,
        };
        let mine = a.next_if(|(c, _)| *c == column).map_or(T::ZERO, |(_, x)| x);
        let theirs = b.next_if(|(c, _)| *c == column).map_or(T::ZERO, |(_, x)| x);
        if column as usize != pivot {
            merged.push((column, mine - factor * theirs));
        }
    }
    // The memory of the old row is the scratch memory of the next subtraction.
    core::mem::swap(row, merged);
}
