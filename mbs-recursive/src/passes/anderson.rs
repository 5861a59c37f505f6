//! Iterates mixed so that what they left over cancels: the multisecant acceleration of a fixed-point iteration.
//!
//! ```text
//! x ↦ g(x),   r = x − g(x)      pairs (p, q) of past steps Δx and changes Δr, the q made orthonormal
//! next x = g − Σ (q·r) (p − q)
//! ```
//!
//! In n steps of a linear iteration n slow directions are found and left out; an iteration that contracts fast is hardly changed.
//! The newest pair takes the place of the oldest. Where r is a small part of what is missing, the length of the next move is its estimate.
//! Source: Anderson (1965), in the form of Fang and Saad (2009), type II.

use mbs_core::Real;
use mbs_core::algebra::norm_inf;

/// Pairs that are kept [-]: as many slow directions are found in as many steps. Chosen, not tuned.
pub const DEPTH: usize = 4;

/// Numbers that the history of an iteration in `n` unknowns takes.
#[must_use]
pub fn history(n: usize) -> usize {
    (2 * (DEPTH + 1) + 1) * n
}

/// State of an iteration in progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Mixing {
    /// Is there a last x and r?
    has_last: bool,
    /// Number of pairs found.
    n_pairs: usize,
    /// The place of the next one, which takes that of the oldest.
    place: usize,
}

impl Mixing {
    /// Takes an iterate in; returns how far the next x would go, which estimates what is missing. `r` is x − g, `history`
    /// has [`history`] numbers: last r and x, the pairs, the move; too short, nothing is mixed.
    ///
    /// Cost: at most `5 DEPTH` products of n numbers.
    pub(crate) fn take<T: Real>(&mut self, r: &[T], g: &[T], history: &mut [T]) -> T {
        let n = r.len();
        if n == 0 || history.len() < self::history(n) {
            return norm_inf(r);
        }
        let (last, pairs) = history.split_at_mut(2 * n);
        if self.has_last {
            let (before, rest) = pairs.split_at_mut(2 * n * self.place);
            let (new, after) = rest.split_at_mut(2 * n);
            let after = &after[..2 * n * self.n_pairs.saturating_sub(self.place + 1)];
            for i in 0..n {
                (new[i], new[n + i]) = (r[i] - last[i], g[i] + r[i] - last[n + i]);
            }
            if orthonormalise([before, after], new) {
                self.n_pairs = self.n_pairs.max(self.place + 1);
                self.place = (self.place + 1) % DEPTH;
            } else {
                // nothing new is seen, but the iteration continues: the pairs are no longer its own
                (self.n_pairs, self.place) = (0, 0);
            }
        }
        for i in 0..n {
            (last[i], last[n + i]) = (r[i], g[i] + r[i]);
        }
        self.has_last = true;
        // the move stands behind the pairs, for [`mix`](Self::mix)
        let (before, rest) = pairs.split_at_mut(2 * n * DEPTH);
        let step = &mut rest[..n];
        for (x, &r) in step.iter_mut().zip(r) {
            *x = -r;
        }
        for pair in before.chunks_exact(2 * n).take(self.n_pairs) {
            let (q, p) = pair.split_at(n);
            let share = dot(q, r);
            for i in 0..n {
                step[i] -= share * (p[i] - q[i]);
            }
        }
        norm_inf(step)
    }

    /// Replaces g by the next x after the iterate that was taken in last.
    pub(crate) fn mix<T: Real>(g: &mut [T], history: &[T]) {
        let n = g.len();
        if n == 0 || history.len() < self::history(n) {
            return;
        }
        let (x, step) = (&history[n..2 * n], &history[2 * n * (DEPTH + 1)..][..n]);
        for (g, (&x, &step)) in g.iter_mut().zip(x.iter().zip(step)) {
            *g = x + step;
        }
    }
}

/// Takes the old pairs' directions off a new pair (q, p) and makes q a unit vector; false if nothing of q is left.
fn orthonormalise<T: Real>(old: [&[T]; 2], new: &mut [T]) -> bool {
    let n = new.len() / 2;
    let before = norm_inf(&new[..n]);
    for pair in old.iter().flat_map(|pairs| pairs.chunks_exact(2 * n)) {
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

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use alloc::{vec, vec::Vec};

    /// Returns the rest r and the next iterate g = x − r of an iteration of diagonal contractions towards `solution`.
    fn left_over(x: &[f64], slow: &[f64], solution: f64) -> [Vec<f64>; 2] {
        let r: Vec<f64> = x.iter().zip(slow).map(|(x, share)| share * (x - solution)).collect();
        let g = x.iter().zip(&r).map(|(x, r)| x - r).collect();
        [r, g]
    }

    #[test]
    fn slow_directions_are_found_and_a_small_rest_does_not_hide_what_is_missing() {
        let slow = [1.0, 3e-1, 1e-2, 1e-4, 1e-5];
        let mut history = vec![0.0; history(slow.len())];
        let (mut mixing, mut x) = (Mixing::default(), vec![0.0; slow.len()]);
        for iterations in 1.. {
            let [r, mut g] = left_over(&x, &slow, 7.0);
            let far = mixing.take(&r, &g, &mut history);
            if far < 1e-9 {
                // one part in 1e5 of it is all that the slowest direction leaves over
                let missing = x.iter().fold(0.0, |most: f64, x| most.max((x - 7.0).abs()));
                assert!(missing < 1e-8, "{missing:e} is missing after {iterations} iterates");
                return;
            }
            assert!(iterations < 60, "{far:e} is missing");
            Mixing::mix(&mut g, &history);
            x = g;
        }
    }

    #[test]
    fn pairs_that_add_nothing_new_are_forgotten() {
        let mut history = vec![0.0; history(1)];
        let (mut mixing, mut x) = (Mixing::default(), vec![0.0]);
        // a contraction that changes on the way: the first pair would lead away from the new solution for ever
        for (turns, slow, solution) in [(4, 0.5, 1.0), (12, 1.4, -2.0)] {
            for _ in 0..turns {
                let [r, mut g] = left_over(&x, &[slow], solution);
                mixing.take(&r, &g, &mut history);
                Mixing::mix(&mut g, &history);
                x = g;
            }
        }
        assert!((x[0] + 2.0).abs() < 1e-9, "{}", x[0]);
    }
}
