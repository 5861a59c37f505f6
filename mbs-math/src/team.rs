//! Division of the work of a step among threads. The numerics know threads only by the trait [`Team`].
//!
//! ```text
//! work on 0..n  =  work on 0..n/2  and  work on n/2..n,  down to stretches of a fixed length
//! ```
//!
//! The division of the work never depends on the team, and sums are added in the order of the division. A result is therefore identical to
//! the last bit for every team. [`Alone`] needs no operating system; teams of threads are in mbs-parallel.

use crate::Real;

/// Runs two pieces of work, at the same time if the team has several threads.
pub trait Team: Sync {
    /// True if the team is always the caller's thread alone. Code for several threads is not compiled for such a type.
    const IS_ALONE: bool = false;

    /// Runs `a` and `b` and returns both results after both have ended. A panic of either is passed on.
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B);

    /// Number of threads that may work at the same time. With one thread, work is divided only where its result depends on the division.
    fn size(&self) -> usize;
}

/// Team of one thread: the caller's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Alone;

impl Team for Alone {
    const IS_ALONE: bool = true;

    #[inline(always)]
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        (a(), b())
    }
    #[inline(always)]
    fn size(&self) -> usize {
        1
    }
}

impl<W: Team> Team for &W {
    const IS_ALONE: bool = W::IS_ALONE;

    #[inline(always)]
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        (**self).join(a, b)
    }
    #[inline(always)]
    fn size(&self) -> usize {
        (**self).size()
    }
}

/// Largest number of entries in one stretch of a vector [-]. A thread adds this many entries in a few microseconds.
pub const STRETCH: usize = 4096;

/// Calls `work` with the first index and the stretch of each of `N` vectors of equal length, stretch by stretch.
///
/// `work` must treat every entry independently of the others, so that the result does not depend on the division.
#[inline(always)]
pub fn on_stretches<W: Team, T: Send, const N: usize>(
    team: &W,
    vectors: [&mut [T]; N],
    work: impl Fn(usize, [&mut [T]; N]) + Sync,
) {
    if W::IS_ALONE || team.size() == 1 {
        work(0, vectors);
    } else {
        cut(team, 0, vectors, &work);
    }
}

fn cut<W: Team, T: Send, const N: usize>(
    team: &W,
    first: usize,
    vectors: [&mut [T]; N],
    work: &(impl Fn(usize, [&mut [T]; N]) + Sync),
) {
    let len = if let Some(vector) = vectors.first() { vector.len() } else { 0 };
    if len <= STRETCH {
        return work(first, vectors);
    }
    let half = len / 2;
    let [left, right] = parted(vectors, half);
    team.join(|| cut(team, first, left, work), || cut(team, first + half, right, work));
}

/// Splits each vector in two at index `at`. The function is separate, so that it is not compiled again for each closure of work.
fn parted<T, const N: usize>(vectors: [&mut [T]; N], at: usize) -> [[&mut [T]; N]; 2] {
    let mut right: [&mut [T]; N] = core::array::from_fn(|_| Default::default());
    let mut places = right.iter_mut();
    let left = vectors.map(|v| {
        let (head, tail) = v.split_at_mut(at);
        if let Some(place) = places.next() {
            *place = tail;
        }
        head
    });
    [left, right]
}

/// Largest number of elements that one thread writes in one piece of work [-]. No result depends on it. Chosen, not tuned.
const ELEMENTS: usize = 128;

/// Calls `write` with each element e and its stretch of `out`, which is `out[starts[e]..starts[e + 1]]`.
pub fn on_elements<W: Team, T: Send>(
    team: &W,
    starts: &[usize],
    out: &mut [T],
    write: impl Fn(usize, &mut [T]) + Sync,
) {
    let n = starts.len().saturating_sub(1);
    write_elements(team, (starts, 0, n), out, &write);
}

fn write_elements<W: Team, T: Send>(
    team: &W,
    (starts, from, to): (&[usize], usize, usize),
    out: &mut [T],
    write: &(impl Fn(usize, &mut [T]) + Sync),
) {
    if !W::IS_ALONE && to - from > ELEMENTS && team.size() > 1 {
        let half = from + (to - from) / 2;
        let (left, right) = out.split_at_mut(starts[half] - starts[from]);
        team.join(
            || write_elements(team, (starts, from, half), left, write),
            || write_elements(team, (starts, half, to), right, write),
        );
        return;
    }
    let mut rest = out;
    for e in from..to {
        let (own, tail) = rest.split_at_mut(starts[e + 1] - starts[e]);
        write(e, own);
        rest = tail;
    }
}

/// Sets out = base + weight x, entry by entry.
#[inline]
pub fn set_sum<W: Team, T: Real>(team: &W, out: &mut [T], base: &[T], (weight, x): (&[T], &[T])) {
    on_stretches(team, [out], |first, [out]| {
        let n = out.len();
        let (base, weight, x) = (&base[first..][..n], &weight[first..][..n], &x[first..][..n]);
        for k in 0..n {
            out[k] = base[k] + weight[k] * x[k];
        }
    });
}

/// Adds weight x to `out`, entry by entry.
#[inline]
pub fn add_product<W: Team, T: Real>(team: &W, out: &mut [T], (weight, x): (&[T], &[T])) {
    on_stretches(team, [out], |first, [out]| {
        let n = out.len();
        let (weight, x) = (&weight[first..][..n], &x[first..][..n]);
        for k in 0..n {
            out[k] += weight[k] * x[k];
        }
    });
}

/// Sets out = weight x, entry by entry.
#[inline]
pub fn set_product<W: Team, T: Real>(team: &W, out: &mut [T], (weight, x): (&[T], &[T])) {
    on_stretches(team, [out], |first, [out]| {
        let n = out.len();
        let (weight, x) = (&weight[first..][..n], &x[first..][..n]);
        for k in 0..n {
            out[k] = weight[k] * x[k];
        }
    });
}

/// Adds x to `out`, entry by entry.
#[inline]
pub fn add<W: Team, T: Real>(team: &W, out: &mut [T], x: &[T]) {
    on_stretches(team, [out], |first, [out]| {
        for (out, &x) in out.iter_mut().zip(&x[first..]) {
            *out += x;
        }
    });
}

/// Subtracts x from `out`, entry by entry.
#[inline]
pub fn subtract<W: Team, T: Real>(team: &W, out: &mut [T], x: &[T]) {
    on_stretches(team, [out], |first, [out]| {
        for (out, &x) in out.iter_mut().zip(&x[first..]) {
            *out -= x;
        }
    });
}

/// The sum of `part(from, to)` over the stretches of 0..`n`. Partial sums are added pair by pair, so that every team gets the same result
/// to the last bit.
#[inline]
pub fn sum<W: Team, T: Real>(team: &W, n: usize, part: impl Fn(usize, usize) -> T + Sync) -> T {
    if n <= STRETCH {
        return part(0, n);
    }
    fold(team, (0, n), &part, &|a, b| a + b)
}

/// The largest absolute value of a vector; not finite when a number of the vector is not. Every team gets the same result.
#[inline]
pub fn norm_inf<W: Team, T: Real>(team: &W, x: &[T]) -> T {
    if team.size() == 1 {
        return crate::algebra::norm_inf(x);
    }
    let larger = |a: T, b: T| crate::algebra::norm_inf(&[a, b]);
    fold(team, (0, x.len()), &|from, to| crate::algebra::norm_inf(&x[from..to]), &larger)
}

fn fold<W: Team, T: Real>(
    team: &W,
    (from, to): (usize, usize),
    part: &(impl Fn(usize, usize) -> T + Sync),
    both: &(impl Fn(T, T) -> T + Sync),
) -> T {
    if to - from <= STRETCH {
        return part(from, to);
    }
    let half = from + (to - from) / 2;
    let (a, b) =
        team.join(|| fold(team, (from, half), part, both), || fold(team, (half, to), part, both));
    both(a, b)
}
