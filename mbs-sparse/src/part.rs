//! Parts of a front, elements and updates of children: where each lands, and how it is added.
//!
//! Most parts have one of a few sizes, multiples of the two or three coordinates of a point: with these the compiler knows
//! the lengths of all loops, which are too short to pay for anything else.

use crate::graph::index;
use crate::plan::column;
use mbs_core::Real;

/// Where a packed triangle of k unknowns lands in a packed front of f unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// Unknown i at row `f - k + i`: one stretch, from this offset to the end of the front.
    Tail(u32),
    /// Unknown i at row `first + i`: one stretch for every column.
    Shifted(u32),
    /// Entry t at `targets[start + t]`.
    Scattered(u32),
}

/// One element or one child update that is added into a front.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part {
    /// The element; of a child, where its update starts in the array of all fronts.
    pub(crate) source: usize,
    /// Unknowns of the part.
    pub(crate) size: u32,
    /// Where they are in the front.
    pub(crate) place: Place,
}

impl Part {
    /// Numbers of its packed triangle.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        triangle(self.size as usize)
    }

    #[inline(always)]
    fn is_scattered(&self) -> bool {
        matches!(self.place, Place::Scattered(_))
    }

    /// Where the entries of a scattered part go, and those of the scattered parts after it; of any other part nothing.
    #[inline(always)]
    pub(crate) fn targets<'a>(&self, all: &'a [u32]) -> &'a [u32] {
        match self.place {
            Place::Scattered(start) => &all[start as usize..],
            Place::Tail(_) | Place::Shifted(_) => &[],
        }
    }
}

/// Numbers of a packed triangle of `size` unknowns.
#[inline(always)]
pub(crate) fn triangle(size: usize) -> usize {
    size * (size + 1) / 2
}

/// Parts of at most so many unknowns are added number by number: as soon done as told.
pub(crate) const SMALL: usize = 4;

/// Finds the cheapest description of the map `map` into a front of `f` unknowns.
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
    if part.is_scattered() {
        return scatter(a, part.targets(targets), from);
    }
    match part.size {
        6 => add_sized::<T, 6>(a, f, part, from),
        9 => add_sized::<T, 9>(a, f, part, from),
        12 => add_sized::<T, 12>(a, f, part, from),
        _ => add_sized::<T, 0>(a, f, part, from),
    }
}

/// Adds a part of `K` unknowns; `K` = 0: of any number, known at run time only.
#[inline(never)]
fn add_sized<T: Real, const K: usize>(a: &mut [T], f: usize, part: &Part, from: &[T]) {
    let k = if K == 0 { part.size as usize } else { K };
    let from = &from[..k * (k + 1) / 2];
    match part.place {
        Place::Tail(offset) => {
            let to = &mut a[offset as usize..][..from.len()];
            for i in 0..from.len() {
                to[i] += from[i];
            }
        }
        Place::Shifted(first) => {
            let first = first as usize;
            let (mut at, mut rest, mut length) = (column(f, first), from, f - first);
            for j in 0..k {
                let (column, tail) = rest.split_at(k - j);
                let to = &mut a[at..at + k - j];
                for i in 0..k - j {
                    to[i] += column[i];
                }
                (at, rest, length) = (at + length, tail, length - 1);
            }
        }
        Place::Scattered(_) => {}
    }
}

/// Adds each number at its target.
#[inline(always)]
pub(crate) fn scatter<T: Real>(a: &mut [T], targets: &[u32], from: &[T]) {
    // By threes: the numbers of a triangle are a multiple of three most often.
    let (threes, rest) = from.as_chunks::<3>();
    let (places, rest_places) = targets[..from.len()].as_chunks::<3>();
    for (to, from) in places.iter().zip(threes) {
        for i in 0..3 {
            a[to[i] as usize] += from[i];
        }
    }
    for (&to, &from) in rest_places.iter().zip(rest) {
        a[to as usize] += from;
    }
}

/// Writes the packed triangle `from` of an element that has all unknowns of the front, in another order.
#[inline(never)]
pub(crate) fn permute<T: Real>(a: &mut [T], targets: &[u32], from: &[T]) {
    let (threes, rest) = from.as_chunks::<3>();
    let (places, rest_places) = targets[..from.len()].as_chunks::<3>();
    for (to, from) in places.iter().zip(threes) {
        for i in 0..3 {
            a[to[i] as usize] = from[i];
        }
    }
    for (&to, &from) in rest_places.iter().zip(rest) {
        a[to as usize] = from;
    }
}
