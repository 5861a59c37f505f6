//! Arithmetic in the chosen order: factors, solutions, and the basis of the null space.

use super::{Elimination, Pivots};
use mbs_core::Real;

impl<T: Real> Elimination<T> {
    /// Factors the matrix `values` in the last chosen order. Allocates nothing.
    ///
    /// Dropped rows are not used. A pivot that has become zero makes the factors infinite: check [`pivots`](Self::pivots) before using them.
    pub fn refactor(&mut self, values: &[T]) {
        self.inverses.clear();
        for k in 0..self.rank {
            let (below, above) = (self.lower.row(k), self.upper.row(k));
            for &place in &self.lower.places[below.clone()] {
                self.work[place as usize] = T::ZERO;
            }
            for &place in &self.upper.places[above.clone()] {
                self.work[place as usize] = T::ZERO;
            }
            self.work[k] = T::ZERO;
            for t in self.pattern.row(self.rows[k] as usize) {
                self.work[self.places[self.pattern.columns[t] as usize] as usize] = values[t];
            }
            for t in below {
                // l_kj = a_kj / u_jj,   row k -= l_kj row j of U
                let j = self.lower.places[t] as usize;
                let l = self.work[j] * self.inverses[j];
                self.lower.values[t] = l;
                for t in self.upper.row(j) {
                    self.work[self.upper.places[t] as usize] -= l * self.upper.values[t];
                }
            }
            for t in above {
                self.upper.values[t] = self.work[self.upper.places[t] as usize];
            }
            self.inverses.push(T::ONE / self.work[k]);
        }
    }

    /// Returns the size of pivot k in the scaled matrix.
    fn scaled_pivot(&self, k: usize) -> T {
        let (row, column) = (self.rows[k] as usize, self.unknowns[k] as usize);
        self.row_scales[row] * self.column_scales[column] / self.inverses[k].abs()
    }

    /// Stores the sizes of the pivots at the choice.
    pub(super) fn note_pivots(&mut self) {
        self.chosen.clear();
        for k in 0..self.rank {
            self.chosen.push(self.scaled_pivot(k));
        }
    }

    /// Returns the quality of the pivots of the last factorisation. A NaN counts as zero.
    #[must_use]
    pub fn pivots(&self) -> Pivots<T> {
        let mut found = Pivots { smallest: T::ONE, row: 0, decay: T::ONE };
        for k in 0..self.rank {
            let pivot = self.scaled_pivot(k);
            let pivot = if pivot >= T::ZERO { pivot } else { T::ZERO };
            if k == 0 || pivot < found.smallest {
                (found.smallest, found.row) = (pivot, self.rows[k]);
            }
            found.decay = found.decay.min(pivot / self.chosen[k]);
        }
        found
    }

    /// Solves J_d x_d = b. `b` has an entry for each row; only the pivot rows are read. `x` has an entry for each column; only the
    /// dependent columns are written. `scratch` has at least r entries, where r is the rank.
    pub fn solve(&self, b: &[T], x: &mut [T], scratch: &mut [T]) {
        let y = &mut scratch[..self.rank];
        for k in 0..self.rank {
            let row = self.lower.row(k);
            let entries = self.lower.places[row.clone()].iter().zip(&self.lower.values[row]);
            y[k] = entries
                .fold(b[self.rows[k] as usize], |sum, (&place, &l)| sum - l * y[place as usize]);
        }
        for k in (0..self.rank).rev() {
            let row = self.upper.row(k);
            let entries = self.upper.places[row.clone()].iter().zip(&self.upper.values[row]);
            let dependent = entries.take_while(|&(&place, _)| (place as usize) < self.rank);
            let sum = dependent.fold(y[k], |sum, (&place, &u)| sum - u * y[place as usize]);
            y[k] = sum * self.inverses[k];
            x[self.unknowns[k] as usize] = y[k];
        }
    }

    /// Solves J_d^T y = b. `b` has an entry for each column; only the dependent columns are read. `y` has an entry for each row, and is
    /// zero for dropped rows. `scratch` has at least r entries, where r is the rank.
    pub fn solve_transposed(&self, b: &[T], y: &mut [T], scratch: &mut [T]) {
        let x = &mut scratch[..self.rank];
        for k in 0..self.rank {
            x[k] = b[self.unknowns[k] as usize];
        }
        for k in 0..self.rank {
            let value = x[k] * self.inverses[k];
            x[k] = value;
            for t in self.upper.row(k) {
                let place = self.upper.places[t] as usize;
                if place >= self.rank {
                    break;
                }
                x[place] -= self.upper.values[t] * value;
            }
        }
        y.fill(T::ZERO);
        for k in (0..self.rank).rev() {
            let value = x[k];
            for t in self.lower.row(k) {
                x[self.lower.places[t] as usize] -= self.lower.values[t] * value;
            }
            y[self.rows[k] as usize] = value;
        }
    }

    /// Writes the rows of R for the dependent columns, -J_d^-1 J_i [P1 (21)]: r rows of n - r numbers, in the order of elimination. A
    /// back-substitution with U is enough, because L is a factor of both J_d and J_i.
    pub fn write_basis(&self, basis: &mut [T]) {
        let f = self.pattern.n_columns - self.rank;
        for k in (0..self.rank).rev() {
            let (head, solved) = basis.split_at_mut((k + 1) * f);
            let row = &mut head[k * f..];
            row.fill(T::ZERO);
            for t in self.upper.row(k) {
                let (place, u) = (self.upper.places[t] as usize, self.upper.values[t]);
                if place >= self.rank {
                    row[place - self.rank] -= u;
                } else {
                    let at = (place - k - 1) * f;
                    for (x, &r) in row.iter_mut().zip(&solved[at..at + f]) {
                        *x -= u * r;
                    }
                }
            }
            for x in row {
                *x *= self.inverses[k];
            }
        }
    }
}
