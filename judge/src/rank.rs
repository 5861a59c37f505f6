//! Rows that depend on other rows, and the number of freedoms that remain.

use crate::dense::Square;
use crate::motion::{Mechanism, State};
use crate::rows::Row;

/// Largest length of a rest that counts as zero [-]. The rest of a row of length one is its part that is orthogonal to all other rows.
/// Dependent rows of projected states have smaller rests. Chosen, not tuned.
const DEPENDENT: f64 = 1e-8;

impl Mechanism {
    /// Marks the rows that are independent. The state must satisfy all constraints, since otherwise dependent rows are dependent only
    /// approximately.
    pub(crate) fn independent(&self, state: &State) -> Vec<bool> {
        let places = self.places(state);
        let rows = self.rows(&self.now(state, &places));
        let mut left: Vec<Vec<f64>> = Vec::with_capacity(rows.len());
        for (_, row) in &rows {
            let mut dense = vec![0.0; self.n_velocities()];
            self.dense_row(row).into_iter().for_each(|(c, x)| dense[c] += x);
            let size = norm_of(&dense);
            dense.iter_mut().for_each(|x| *x /= size.max(f64::MIN_POSITIVE));
            left.push(dense);
        }
        let mut kept = vec![false; rows.len()];
        loop {
            let free = (0..rows.len()).filter(|i| !kept[*i]);
            let largest = free.max_by(|&i, &j| norm_of(&left[i]).total_cmp(&norm_of(&left[j])));
            let Some(i) = largest.filter(|&i| norm_of(&left[i]) > DEPENDENT) else { return kept };
            kept[i] = true;
            let size = norm_of(&left[i]);
            let unit: Vec<f64> = left[i].iter().map(|x| x / size).collect();
            for (row, _) in left.iter_mut().zip(&kept).filter(|(_, kept)| !**kept) {
                let along: f64 = row.iter().zip(&unit).map(|(x, u)| x * u).sum();
                row.iter_mut().zip(&unit).for_each(|(x, u)| *x -= along * u);
            }
        }
    }

    /// Number of freedoms that the independent rows leave.
    #[must_use]
    pub fn freedoms(&self, state: &State) -> usize {
        let places = self.places(state);
        let rows: Vec<Row> =
            self.rows(&self.now(state, &places)).into_iter().map(|r| r.1).collect();
        let mut unit = Square::zero(self.n_velocities() + rows.len());
        (0..self.n_velocities()).for_each(|i| *unit.at(i, i) = 1.0);
        let dependent = self.factor_with(unit, &rows, false).factors.kernel().len();
        (self.n_velocities() + dependent).saturating_sub(rows.len())
    }
}

fn norm_of(row: &[f64]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}
