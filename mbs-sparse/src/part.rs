//! Parts of a front, elements and updates of children: where each lands, and how it is added.
//!
//! Most parts have one of a few sizes, multiples of the two or three coordinates of a point. With these the compiler knows
//! the lengths of all loops, which are too short to pay for anything else.

use crate::front::column;
use crate::graph::index;
use mbs_math::Real;

/// Place of a packed triangle of k unknowns in a packed front of f unknowns.
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
    /// Number of the element; of a child, the start of its update in the array of all fronts.
    pub(crate) source: usize,
    /// Unknowns of the part.
    pub(crate) size: u32,
    /// Place of the unknowns in the front.
    pub(crate) place: Place,
}

impl Part {
    /// Numbers of its packed triangle.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        triangle(self.size as usize)
    }

    /// Targets of the entries of a scattered part, and of the scattered parts after it; of any other part nothing.
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

/// Most unknowns of a part that is added number by number [-]: a test of its structure costs as much. Chosen, not tuned.
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

/// Adds a part of `K` unknowns at rows `first`, ...; `K` = 0: of `k`, known at run time only.
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

/// Adds each number at its target.
#[inline(always)]
pub(crate) fn scatter<T: Real>(a: &mut [T], targets: &[u32], from: &[T]) {
    to_targets(a, targets, from, |to, x| *to += x);
}

/// Writes the packed triangle `from` of an element that has all unknowns of the front, in another order.
#[inline(never)]
pub(crate) fn permute<T: Real>(a: &mut [T], targets: &[u32], from: &[T]) {
    to_targets(a, targets, from, |to, x| *to = x);
}

/// Brings each number to its target, by threes: the numbers of a triangle are a multiple of three most often.
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
