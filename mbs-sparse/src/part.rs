//! Parts of a front (elements and updates of children): the position of each in the front, and its addition.
//!
//! Most parts have one of a few sizes, multiples of the two or three coordinates of a point. For these sizes the lengths of all loops are
//! constants. The loops are so short that the overhead of variable lengths would dominate.

use crate::front::column;
use crate::graph::index;
use mbs_math::Real;

/// Position of a packed triangle of k unknowns in a packed front of f unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// Unknown i is row `f - k + i`: one contiguous range, from this offset to the end of the front.
    Tail(u32),
    /// Unknown i is row `first + i`: one contiguous range for every column.
    Shifted(u32),
    /// Entry t is added at `targets[start + t]`.
    Scattered(u32),
}

/// One element or one child update that is added into a front.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part {
    /// Index of the element; for a child, the start of its update in the array of all fronts.
    pub(crate) source: usize,
    /// Unknowns of the part.
    pub(crate) size: u32,
    /// Position of the unknowns in the front.
    pub(crate) place: Place,
}

impl Part {
    /// Returns the number of entries of the part's packed triangle.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        triangle(self.size as usize)
    }

    /// Returns the targets of a scattered part, followed by those of later parts. Returns an empty slice for any other part.
    #[inline(always)]
    pub(crate) fn targets<'a>(&self, all: &'a [u32]) -> &'a [u32] {
        match self.place {
            Place::Scattered(start) => &all[start as usize..],
            Place::Tail(_) | Place::Shifted(_) => &[],
        }
    }
}

/// Returns the number of entries of a packed triangle of `size` unknowns.
#[inline(always)]
pub(crate) fn triangle(size: usize) -> usize {
    size * (size + 1) / 2
}

/// Largest number of unknowns of a part that is added entry by entry [-]. A test of the structure of such a part would cost as much as the
/// addition. Chosen, not tuned.
pub(crate) const SMALL: usize = 4;

/// Finds the cheapest description of the index map `map` into a front of `f` unknowns.
pub(crate) fn place_of(map: &[u32], f: usize, targets: &mut Vec<u32>) -> Place {
    let first = map[0] as usize;
    let is_small = map.len() <= SMALL && map.len() < f;
    if !is_small && map.iter().enumerate().all(|(i, &row)| row as usize == first + i) {
        return if first + map.len() == f {
            Place::Tail(index(column(f, first)))
        } else {
            Place::Shifted(index(first))
        };
    }
    let start = targets.len();
    for (j, &a) in map.iter().enumerate() {
        for &b in &map[j..] {
            let (col, row) = (a.min(b) as usize, a.max(b) as usize);
            targets.push(index(column(f, col) + row - col));
        }
    }
    Place::Scattered(index(start))
}

/// Adds the packed triangle `from` of a part into the packed front `a` of `f` unknowns.
#[inline]
pub(crate) fn add<T: Real>(a: &mut [T], f: usize, part: &Part, targets: &[u32], from: &[T]) {
    match (part.place, part.size) {
        (Place::Tail(offset), _) => {
            for (to, &x) in a[offset as usize..].iter_mut().zip(from) {
                *to += x;
            }
        }
        (Place::Scattered(start), _) => scatter(a, &targets[start as usize..], from),
        (Place::Shifted(first), 6) => add_shifted::<T, 6>(a, f, (first as usize, 6), from),
        (Place::Shifted(first), 9) => add_shifted::<T, 9>(a, f, (first as usize, 9), from),
        (Place::Shifted(first), 12) => add_shifted::<T, 12>(a, f, (first as usize, 12), from),
        (Place::Shifted(first), k) => {
            add_shifted::<T, 0>(a, f, (first as usize, k as usize), from);
        }
    }
}

/// Adds a part of `K` unknowns at rows `first`, `first + 1`, ...; for `K` = 0 the size is `k`, known at run time only.
#[inline(never)]
fn add_shifted<T: Real, const K: usize>(
    a: &mut [T],
    f: usize,
    (first, k): (usize, usize),
    from: &[T],
) {
    let k = if K == 0 { k } else { K };
    let (mut at, mut rest, mut length) = (column(f, first), &from[..triangle(k)], f - first);
    for j in 0..k {
        let (column, tail) = rest.split_at(k - j);
        let to = &mut a[at..at + k - j];
        for i in 0..k - j {
            to[i] += column[i];
        }
        (at, rest, length) = (at + length, tail, length - 1);
    }
}

/// Adds each entry at its target.
#[inline(always)]
pub(crate) fn scatter<T: Real>(a: &mut [T], targets: &[u32], from: &[T]) {
    to_targets(a, targets, from, |to, x| *to += x);
}

/// Writes the packed triangle `from` of an element that has all unknowns of the front, in another order.
#[inline(never)]
pub(crate) fn permute<T: Real>(a: &mut [T], targets: &[u32], from: &[T]) {
    to_targets(a, targets, from, |to, x| *to = x);
}

/// Applies `put` to each entry and its target, three at a time, because most triangles have a multiple of three entries.
#[inline(always)]
fn to_targets<T: Real>(a: &mut [T], targets: &[u32], from: &[T], put: impl Fn(&mut T, T)) {
    let (threes, rest) = from.as_chunks::<3>();
    let (places, rest_places) = targets[..from.len()].as_chunks::<3>();
    for (to, from) in places.iter().zip(threes) {
        for i in 0..3 {
            put(&mut a[to[i] as usize], from[i]);
        }
    }
    for (&to, &from) in rest_places.iter().zip(rest) {
        put(&mut a[to as usize], from);
    }
}
