//! Partial L D L^T factorisation of one dense front. The pivots are chosen by the values of the entries.
//!
//! ```text
//! 1x1:  d = a_kk,                    |d| >= u max_{i != k} |a_ik|
//! 2x2:  B = [ a_kk  a_rk ]           |B^-1| ( max_{i != k, r} |a_ik| )  <=  1/u         (Duff and Reid, 1983)
//!           [ a_rk  a_rr ],                  ( max_{i != k, r} |a_ir| )
//! l = a B^-1,   a_ij <- a_ij - l_i B l_j^T
//! ```
//!
//! Only the first `p` unknowns of a front are candidates for pivots. A candidate that passes the 1x1 test becomes a pivot at its present
//! place. Up to six such pivots are collected, and then applied to the later columns in one pass. A column is updated before it is tested.
//!
//! A candidate that fails both tests is left to a later front, where more of its equations are assembled. A pivot counts as zero when it is
//! at machine precision, relative to the sum of the absolute values that it was computed from. Such a pivot is never used. These sums are
//! updated with the front.
//!
//! A front of f unknowns is a lower triangle packed by columns; column j starts at [`column()`] of (f, j) with its diagonal. After the
//! elimination, the diagonal place of each column has the entry of D^-1, and the places below it have the column of L. A pair of pivots has
//! its B^-1 in the triangle of its two columns.

use super::panel::Panel;
pub use super::panel::column;
use crate::Real;
use crate::blocks::{FactorError, Inertia, Weakest};

/// Thresholds that a pivot has to pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thresholds<T> {
    /// Threshold u of growth, in (0, 0.35]: multipliers l stay below 1/u. With u up to 0.35, a pivot always exists in a front in which every
    /// unknown is a candidate.
    pub growth: T,
    /// Threshold of zero, relative to the sum of the absolute values that the pivot was computed from [-]. A smaller pivot counts as zero.
    pub zero: T,
}

impl<T: Real> Default for Thresholds<T> {
    /// Default thresholds: u = 0.01, and zero at 256 machine precisions.
    fn default() -> Self {
        /// Default of u [-]: multipliers stay below 100. Chosen, not tuned.
        const GROWTH: f64 = 0.01;
        /// Threshold of zero, in machine precisions of the sum that the pivot was computed from [-]. Chosen, not tuned.
        const ZERO_ROUNDINGS: f64 = 256.0;
        Self { growth: T::from_f64(GROWTH), zero: T::EPSILON * T::from_f64(ZERO_ROUNDINGS) }
    }
}

/// Signs of the pivots and the weakest pivot, counted over a factorisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tally {
    /// Signs of the pivots.
    pub inertia: Inertia,
    /// Weakest pivot of all.
    pub weakest: Weakest,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            inertia: Inertia::default(),
            weakest: Weakest { unknown: u32::MAX, ratio: f64::INFINITY },
        }
    }
}

impl Tally {
    fn note<T: Real>(&mut self, unknown: u32, ratio: T) {
        let ratio = ratio.to_f64();
        if !(ratio >= self.weakest.ratio) {
            self.weakest = Weakest { unknown, ratio };
        }
    }

    /// Adds the counts of a part of the factorisation that comes later in its order.
    pub fn add(&mut self, other: &Self) {
        self.inertia.positive += other.inertia.positive;
        self.inertia.negative += other.inertia.negative;
        self.inertia.zero += other.inertia.zero;
        if other.weakest.unknown != u32::MAX && !(other.weakest.ratio >= self.weakest.ratio) {
            self.weakest = other.weakest;
        }
    }

    /// Returns an error when there were zero pivots.
    ///
    /// # Errors
    /// `FactorError` with the weakest unknown.
    pub fn verdict(&self) -> Result<(), FactorError> {
        if self.inertia.zero == 0 {
            return Ok(());
        }
        Err(FactorError { unknown: self.weakest.unknown, pivot: self.weakest.ratio })
    }

    /// Counts the unknowns of a root front that have no pivot, from place `k` on, as zero pivots. `a` is the packed front.
    pub fn note_left<T: Real>(&mut self, a: &[T], order: &[u32], k: usize, size: &[T]) {
        let f = order.len();
        for c in k..f {
            let largest = (k..f).fold(T::ZERO, |m, i| {
                let x = a[at(f, i.max(c), i.min(c))].abs();
                if m >= x { m } else { x }
            });
            self.note(order[c], if size[c] > T::ZERO { largest / size[c] } else { largest });
            self.inertia.zero += 1;
        }
    }
}

/// Index of (row, col), row >= col, in a packed front of `f` unknowns.
#[inline(always)]
fn at(f: usize, row: usize, col: usize) -> usize {
    column(f, col) + row - col
}

/// The unknowns of a front while it is factored.
#[derive(Debug)]
pub struct Places<'a, T> {
    /// The unknown at each place of the front. It is permuted with the pivots, as is `size`.
    pub order: &'a mut [u32],
    /// For each place, true if its pivot is the first of a pair. Length f.
    pub pairs: &'a mut [bool],
    /// Sum of the absolute values that the diagonal was computed from, for the unknown at each place. Length f.
    pub size: &'a mut [T],
}

impl<T> Places<'_, T> {
    fn swap(&mut self, k: usize, q: usize) {
        self.order.swap(k, q);
        self.size.swap(k, q);
    }
}

/// Eliminates as many as possible of the first `p` unknowns of the packed front `a`; returns their number.
///
/// Afterwards the eliminated unknowns come first, then the other candidates. The unknowns from `p` on keep their places.
///
/// Cost: about f^2 / 2 multiply-subtracts for each pivot and f comparisons for each candidate tried; no allocation.
pub fn eliminate<T: Real>(
    a: &mut [T],
    p: usize,
    places: &mut Places<'_, T>,
    thresholds: &Thresholds<T>,
    tally: &mut Tally,
) -> usize {
    let f = places.order.len();
    let a = &mut a[..column(f, f)];
    let (mut k, mut panel) = (0, Panel::default());
    while k < p {
        if panel.is_full() {
            panel.apply(a, f, k..f);
            panel = Panel::starting_at(k);
        }
        panel.apply(a, f, k..k + 1);
        if let Some(ratio) = test_single(&a[column(f, k)..][..f - k], places.size[k], thresholds) {
            tally.note(places.order[k], ratio);
            panel.push(eliminate_single(a, f, k, places, &mut tally.inertia));
            k += 1;
            continue;
        }
        // No 1x1 pivot is at place k, so the search compares all columns. Every column is therefore updated first.
        panel.apply(a, f, k + 1..f);
        panel = Panel::starting_at(k);
        let found = (k..p).find_map(|c| test(a, f, (k, p, c), places, thresholds));
        let Some(Pivot { first, second, ratio }) = found else { break };
        swap(a, f, k, first);
        places.swap(k, first);
        tally.note(places.order[k], ratio);
        if let Some(second) = second {
            // When the second unknown of the pair was at place k, the first exchange has moved it to the place `first`.
            let second = if second == k { first } else { second };
            swap(a, f, k + 1, second);
            places.swap(k + 1, second);
            (places.pairs[k], places.pairs[k + 1]) = (true, false);
            eliminate_pair(a, f, k, places, &mut tally.inertia);
            k += 2;
            panel = Panel::starting_at(k);
        } else {
            panel.push(eliminate_single(a, f, k, places, &mut tally.inertia));
            k += 1;
        }
    }
    panel.apply(a, f, k..f);
    k
}

/// A pivot of one unknown or of two: the places of these unknowns before the exchange, and the ratio for the tally.
struct Pivot<T> {
    first: usize,
    second: Option<usize>,
    ratio: T,
}

/// The largest absolute value in column `c` over the rows from `k` on, except rows `c` and `not`, and the row of that value.
#[inline(always)]
fn largest<T: Real>(a: &[T], f: usize, k: usize, (c, not): (usize, usize)) -> (T, usize) {
    let (mut size, mut row) = (T::ZERO, c);
    let mut see = |x: T, i: usize| {
        if x.abs() > size && i != not {
            (size, row) = (x.abs(), i);
        }
    };
    for i in k..c {
        see(a[at(f, c, i)], i);
    }
    let start = column(f, c);
    for (i, &x) in a[start + 1..start + f - c].iter().enumerate() {
        see(x, c + 1 + i);
    }
    (size, row)
}

/// Size of the diagonal of a column relative to the sum of the absolute values that it was computed from. `None` when the diagonal is no
/// 1x1 pivot.
#[inline(always)]
fn test_single<T: Real>(column: &[T], size: T, thresholds: &Thresholds<T>) -> Option<T> {
    /// Number of comparisons made at the same time [-]: four doubles fill a vector register of 256 bits.
    const LANES: usize = 4;
    let d = column[0].abs();
    let mut most = [T::ZERO; LANES];
    let (fours, rest) = column[1..].as_chunks::<LANES>();
    for four in fours {
        for lane in 0..LANES {
            let x = four[lane].abs();
            most[lane] = if x > most[lane] { x } else { most[lane] };
        }
    }
    let larger = |m: T, &x: &T| if x.abs() > m { x.abs() } else { m };
    let all = rest.iter().chain(&most).fold(T::ZERO, larger);
    let is_good = d >= thresholds.growth * all && d > thresholds.zero * size && d.is_finite();
    is_good.then(|| d / size)
}

/// Finds a 1x1 pivot at candidate `c` of `k..p`, or a 2x2 pivot of `c` and another candidate.
#[inline(always)]
fn test<T: Real>(
    a: &[T],
    f: usize,
    (k, p, c): (usize, usize, usize),
    places: &Places<'_, T>,
    thresholds: &Thresholds<T>,
) -> Option<Pivot<T>> {
    let size = |i: usize| places.size[i];
    let d = a[at(f, c, c)];
    let (all, row) = largest(a, f, k, (c, c));
    if d.abs() >= thresholds.growth * all && d.abs() > thresholds.zero * size(c) && d.is_finite() {
        return Some(Pivot { first: c, second: None, ratio: d.abs() / size(c) });
    }
    let r = if row < p { row } else { largest_candidate(a, f, (k, p), c) };
    if r == c {
        return None;
    }
    let (b, e) = (a[at(f, r.max(c), r.min(c))], a[at(f, r, r)]);
    let det = d * e - b * b;
    let most = d.abs().max(b.abs()).max(e.abs());
    let ratio = det.abs() / (most * size(c).max(size(r)));
    let (off_c, off_r) = (largest(a, f, k, (c, r)).0, largest(a, f, k, (r, c)).0);
    let bound = det.abs() / thresholds.growth;
    let is_stable = e.abs() * off_c + b.abs() * off_r <= bound
        && b.abs() * off_c + d.abs() * off_r <= bound
        && ratio > thresholds.zero
        && det.is_finite();
    is_stable.then_some(Pivot { first: c, second: Some(r), ratio })
}

/// The row of `k..p` with the largest absolute value in column `c`; `c` when all are zero.
fn largest_candidate<T: Real>(a: &[T], f: usize, (k, p): (usize, usize), c: usize) -> usize {
    let entry = |i: usize| a[at(f, i.max(c), i.min(c))].abs();
    let (mut size, mut row) = (T::ZERO, c);
    for i in (k..p).filter(|&i| i != c) {
        if entry(i) > size {
            (size, row) = (entry(i), i);
        }
    }
    row
}

/// Divides the column at place `k` by its pivot, so that it becomes a column of L. Returns the pivot, for the later columns.
#[inline(always)]
fn eliminate_single<T: Real>(
    a: &mut [T],
    f: usize,
    k: usize,
    places: &mut Places<'_, T>,
    inertia: &mut Inertia,
) -> T {
    let (diagonal, below) = a[column(f, k)..][..f - k].split_at_mut(1);
    let d = diagonal[0];
    let inverse = T::ONE / d;
    for (a, size) in below.iter_mut().zip(&mut places.size[k + 1..f]) {
        let l = *a * inverse;
        *size += (l * *a).abs();
        *a = l;
    }
    if inverse > T::ZERO {
        inertia.positive += 1;
    } else {
        inertia.negative += 1;
    }
    places.pairs[k] = false;
    diagonal[0] = inverse;
    d
}

/// Eliminates the unknowns at places `k` and `k + 1` together, by a 2x2 pivot.
#[inline(always)]
fn eliminate_pair<T: Real>(
    a: &mut [T],
    f: usize,
    k: usize,
    places: &mut Places<'_, T>,
    inertia: &mut Inertia,
) {
    let (head, mut rest) = a.split_at_mut(column(f, k + 2));
    let (first, second) = head[column(f, k)..].split_at_mut(f - k);
    let (d, b, e) = (first[0], first[1], second[0]);
    let det = d * e - b * b;
    let (x, y, z) = (e / det, -b / det, d / det);
    let (first_below, second_below) = (&mut first[2..], &mut second[1..]);
    for j in 0..first_below.len() {
        let (target, next) = rest.split_at_mut(first_below.len() - j);
        rest = next;
        let (s, t) = (first_below[j], second_below[j]);
        let (l, m) = (x * s + y * t, y * s + z * t);
        places.size[k + 2 + j] += (l * s).abs() + (m * t).abs();
        for (i, target) in target.iter_mut().enumerate() {
            *target -= l * first_below[j + i] + m * second_below[j + i];
        }
    }
    if det < T::ZERO {
        inertia.positive += 1;
        inertia.negative += 1;
    } else if d + e > T::ZERO {
        inertia.positive += 2;
    } else {
        inertia.negative += 2;
    }
    for (s, t) in first_below.iter_mut().zip(second_below) {
        (*s, *t) = (x * *s + y * *t, y * *s + z * *t);
    }
    (first[0], first[1], second[0]) = (x, y, z);
}

/// Swaps the unknowns at places `k <= q` of a packed front of `f` unknowns. The swap permutes the columns from `k` on, and the rows of the
/// columns of L before `k`.
pub fn swap<T: Real>(a: &mut [T], f: usize, k: usize, q: usize) {
    if k == q {
        return;
    }
    for m in 0..k {
        a.swap(at(f, k, m), at(f, q, m));
    }
    a.swap(at(f, k, k), at(f, q, q));
    for i in k + 1..q {
        a.swap(at(f, i, k), at(f, q, i));
    }
    for i in q + 1..f {
        a.swap(at(f, i, k), at(f, i, q));
    }
}

/// Forward sweep, z <- L^-1 z, over the `pairs.len()` pivots of the packed front `a`; `z` has all unknowns of the front.
pub fn forward<T: Real>(a: &[T], pairs: &[bool], z: &mut [T]) {
    let (mut a, mut z, mut k) = (a, z, 0);
    while k < pairs.len() {
        let f = z.len();
        let width = 1 + usize::from(pairs[k]);
        let (pivots, below) = z.split_at_mut(width);
        if width == 1 {
            let x = pivots[0];
            for (z, &l) in below.iter_mut().zip(&a[1..f]) {
                *z -= l * x;
            }
        } else {
            let (x, y) = (pivots[0], pivots[1]);
            for ((z, &l), &m) in below.iter_mut().zip(&a[2..f]).zip(&a[f + 1..]) {
                *z -= l * x + m * y;
            }
        }
        a = &a[column(f, width)..];
        (z, k) = (below, k + width);
    }
}

/// Backward sweep, z_1 <- L_11^-T (D^-1 z_1 - L_21^T z_2), over the `pairs.len()` pivots of a packed front.
///
/// When `is_divided` is false, D is left out: z_1 <- L_11^-T (z_1 - L_21^T z_2).
pub fn backward<T: Real>(a: &[T], pairs: &[bool], z: &mut [T], is_divided: bool) {
    let f = z.len();
    let mut end = pairs.len();
    while end > 0 {
        let width = if end >= 2 && pairs[end - 2] { 2 } else { 1 };
        let k = end - width;
        let (head, below) = z.split_at_mut(end);
        let pivots = &mut head[k..];
        let dot = |l: &[T]| l.iter().zip(&*below).fold(T::ZERO, |sum, (&l, &z)| sum + l * z);
        let first = &a[column(f, k)..][..f - k];
        if width == 1 {
            let x = if is_divided { first[0] * pivots[0] } else { pivots[0] };
            pivots[0] = x - dot(&first[1..]);
        } else {
            let second = &a[column(f, k + 1)..][..f - k - 1];
            let (mut x, mut y) = (pivots[0], pivots[1]);
            if is_divided {
                (x, y) = (first[0] * x + first[1] * y, first[1] * x + second[0] * y);
            }
            (pivots[0], pivots[1]) = (x - dot(&first[2..]), y - dot(&second[1..]));
        }
        end = k;
    }
}
