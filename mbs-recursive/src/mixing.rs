//! Iterates mixed so that what they left over cancels: the multisecant acceleration of a fixed-point iteration.
//!
//! ```text
//! x ↦ g(x),   r = x − g(x)      pairs (p, q) of past steps Δx and changes Δr, the q made orthonormal
//! next x = g − Σ (q·r) (p − q)
//! ```
//!
//! In n steps of a linear iteration n slow directions are found and left out; an iteration that contracts fast is hardly changed.
//! Source: Anderson (1965), in the form of Fang and Saad (2009), type II.

use mbs_core::Real;
use mbs_core::algebra::norm_inf;

/// Pairs that are kept.
pub const DEPTH: usize = 4;

/// Numbers that the history of an iteration in `n` unknowns takes.
#[must_use]
pub fn history(n: usize) -> usize {
    2 * (DEPTH + 1) * n
}

/// What is known of an iteration in progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Mixing {
    /// Is there a last x and r?
    has_last: bool,
    /// Pairs found.
    n_pairs: usize,
}

impl Mixing {
    /// Replaces g by the next x; `r` is x − g, `history` has [`history`] numbers: last r and x, then the pairs. Too short, it leaves
    /// g as it is.
    ///
    /// Cost: at most `4 DEPTH` products of n numbers.
    pub(crate) fn mix<T: Real>(&mut self, r: &[T], g: &mut [T], history: &mut [T]) {
        let n = r.len();
        if n == 0 || history.len() < self::history(n) {
            return;
        }
        let (last, pairs) = history.split_at_mut(2 * n);
        if self.has_last {
            if self.n_pairs == DEPTH {
                self.n_pairs = 0;
            }
            let (old, new) = pairs.split_at_mut(2 * n * self.n_pairs);
            for i in 0..n {
                (new[i], new[n + i]) = (r[i] - last[i], g[i] + r[i] - last[n + i]);
            }
            self.n_pairs += usize::from(orthonormalise(old, &mut new[..2 * n]));
        }
        for i in 0..n {
            (last[i], last[n + i]) = (r[i], g[i] + r[i]);
        }
        self.has_last = true;
        for pair in pairs.chunks_exact(2 * n).take(self.n_pairs) {
            let (q, p) = pair.split_at(n);
            let share = dot(q, r);
            for i in 0..n {
                g[i] -= share * (p[i] - q[i]);
            }
        }
    }
}

/// Takes the old pairs' directions off a new pair (q, p) and makes q a unit vector; false if nothing of q is left.
fn orthonormalise<T: Real>(old: &[T], new: &mut [T]) -> bool {
    let n = new.len() / 2;
    let before = norm_inf(&new[..n]);
    for pair in old.chunks_exact(2 * n) {
        let share = dot(&pair[..n], &new[..n]);
        for (x, &y) in new.iter_mut().zip(pair) {
            *x -= share * y;
        }
    }
    let left = norm_inf(&new[..n]);
    // What is left of a change that was seen before is rounding.
    if !(left > before * T::EPSILON.sqrt()) {
        return false;
    }
    let unit = T::ONE / dot(&new[..n], &new[..n]).sqrt();
    for x in new.iter_mut() {
        *x *= unit;
    }
    unit.is_finite()
}

fn dot<T: Real>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::ZERO, |sum, (&x, &y)| sum + x * y)
}
