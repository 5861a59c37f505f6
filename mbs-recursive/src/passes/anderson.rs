//! Anderson mixing: a multisecant acceleration of a fixed-point iteration. The next iterate is a combination of earlier iterates, chosen so
//! that the combination of their residuals is as small as possible.
//!
//! ```text
//! x ↦ g(x),   r = x − g(x)      pairs (p, q) of past steps Δx and changes Δr, the q made orthonormal
//! next x = g − Σ (q·r) (p − q)
//! ```
//!
//! In a linear iteration with n slowly converging directions, the errors in these directions are removed after n iterates. A fast iteration
//! is hardly changed. A new pair replaces the oldest pair. In a slow iteration r is much smaller than the error. The length of the next
//! move is therefore used as the estimate of the error. Source: Anderson (1965), in the form of Fang and Saad (2009), type II.

use mbs_core::Real;
use mbs_core::algebra::norm_inf;

/// Number of pairs that are stored [-]. Each pair removes one slowly converging direction. Chosen, not tuned.
pub const DEPTH: usize = 4;

/// Number of values in the history of an iteration with `n` unknowns.
#[must_use]
pub fn history(n: usize) -> usize {
    (2 * (DEPTH + 1) + 1) * n
}

/// State of an iteration in progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Mixing {
    /// True if the history contains the last iterate x and the last residual r.
    has_last: bool,
    /// Number of pairs found so far.
    n_pairs: usize,
    /// Index at which the next pair is stored. It overwrites the oldest pair.
    place: usize,
}

impl Mixing {
    /// Adds an iterate to the history and returns the length of the next move, an estimate of the error. `r` is the residual x − g.
    /// `history` has [`history`] values: the last r and x, the pairs, and the next move. If `history` is too short, nothing is mixed.
    ///
    /// Cost: at most `5 DEPTH` inner products of vectors with n entries.
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
                // the change of r has no new direction: the old pairs no longer describe this iteration and are dropped
                (self.n_pairs, self.place) = (0, 0);
            }
        }
        for i in 0..n {
            (last[i], last[n + i]) = (r[i], g[i] + r[i]);
        }
        self.has_last = true;
        // the next move is stored after the pairs, where [`mix`](Self::mix) reads it
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

    /// Replaces g by the next x that was computed from the last iterate.
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

/// Makes q of a new pair (q, p) orthogonal to the q of the old pairs and scales it to unit length. Returns false if only rounding errors
/// remain of q.
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
    // If the change has no new direction, only rounding errors remain.
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

    /// Returns the residual r and the next iterate g = x − r of a test iteration. The iteration contracts each component towards `solution`
    /// by a factor of this component.
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
                // the residual of the slowest direction is 1e-5 of its error
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
        // The contraction changes during the iteration. The first pair alone would lead away from the new solution.
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
