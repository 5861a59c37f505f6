//! Selection of pivots for a matrix, and the patterns of the resulting factors.

use super::choose::{NONE, rank_tolerance};
use super::pattern::index;
use super::{Elimination, PivotSelection};
use mbs_core::Real;

/// Least ratio u of a pivot to the largest remaining entry [-]. Entries of L stay below 1/u. Chosen, not tuned.
const THRESHOLD: f64 = 0.3;

impl<T: Real> Elimination<T> {
    /// Chooses pivots for the matrix `values` and stores the order. Call [`refactor`](Self::refactor) for the factors.
    ///
    /// Cost: one elimination, and for each pivot a comparison of all rows. Allocates only when the factors need more memory than was
    /// reserved.
    pub fn select_pivots(&mut self, values: &[T]) -> PivotSelection<T> {
        let (m, n) = (self.pattern.n_rows(), self.pattern.n_columns);
        self.scale_rows(values);
        let scales = (&self.row_scales[..], &self.column_scales[..]);
        let chooser = &mut self.chooser;
        chooser.load(&self.pattern, values);
        for r in 0..m {
            chooser.measure(r, (scales.0[r], scales.1));
        }
        let tolerance = rank_tolerance::<T>(m.max(n));
        let mut last = (0, T::ONE);
        let mut rank = 0;
        self.rows.clear();
        self.unknowns.clear();
        while rank < m.min(n) {
            let (_, largest) = chooser.rest();
            if !(largest > tolerance) {
                break;
            }
            let Some(at) = chooser.pivot(largest * T::from_f64(THRESHOLD), scales) else { break };
            let e = chooser.entries[at as usize];
            let (r, c) = (e.row as usize, e.column as usize);
            last = (e.row, e.value.abs() * scales.0[r] * scales.1[c]);
            chooser.eliminate(at, index(rank), scales);
            self.rows.push(e.row);
            self.unknowns.push(e.column);
            rank += 1;
        }
        let rest = chooser.rest();
        self.rank = rank;
        self.close_order();
        self.refactor(values);
        self.note_pivots();
        PivotSelection { rank, last, rest }
    }

    /// Completes the order with the remaining rows and columns, and stores the patterns of the factors.
    pub(super) fn close_order(&mut self) {
        let (m, n, chooser) = (self.pattern.n_rows(), self.pattern.n_columns, &self.chooser);
        self.rows.extend((0..m).filter(|&r| chooser.row_steps[r] == NONE).map(index));
        self.unknowns.extend((0..n).filter(|&c| chooser.column_steps[c] == NONE).map(index));
        for (place, &column) in self.unknowns.iter().enumerate() {
            self.places[column as usize] = index(place);
        }
        self.note_order();
    }

    /// Sets the row scales D, with which rows of D J E have unit length. Rows of zeros have the scale one.
    fn scale_rows(&mut self, values: &[T]) {
        for (r, scale) in self.row_scales.iter_mut().enumerate() {
            let square = self.pattern.row(r).fold(T::ZERO, |sum, t| {
                let x = values[t] * self.column_scales[self.pattern.columns[t] as usize];
                sum + x * x
            });
            *scale = if square > T::ZERO { T::ONE / square.sqrt() } else { T::ONE };
        }
    }

    /// Stores the patterns of L and U from the eliminated entries.
    fn note_order(&mut self) {
        self.lower.clear();
        self.upper.clear();
        for k in 0..self.rank {
            let mut next = self.chooser.row_heads[self.rows[k] as usize];
            while let Some((_, e)) = self.chooser.along(next) {
                next = e.next_in_row;
                let place = self.places[e.column as usize];
                match (place as usize).cmp(&k) {
                    core::cmp::Ordering::Less => self.lower.places.push(place),
                    core::cmp::Ordering::Equal => {}
                    core::cmp::Ordering::Greater => self.upper.places.push(place),
                }
            }
            for triangle in [&mut self.lower, &mut self.upper] {
                let start = triangle.starts[k] as usize;
                triangle.places[start..].sort_unstable();
                triangle.close_row();
            }
        }
    }
}
