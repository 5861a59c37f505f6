//! Matrices of a linear system, computed from difference quotients.

use super::measured::Layout;
use super::solve;
use super::steady::{Row, Turning};
use crate::tree::Matrix;
use mbs_linear::{Linear, LinearPorts};

/// Linear motion in tangent coordinates, with the derivatives of the measured values.
pub(super) struct Parts<'a> {
    pub(super) linear: &'a Linear<f64>,
    pub(super) ports: &'a LinearPorts<f64>,
}

impl Parts<'_> {
    /// Derivatives P and Q of the measured values in the given rows: P by (z, z', s), Q by the inputs.
    fn of(&self, rows: impl Iterator<Item = usize>) -> [Matrix; 2] {
        let (rows, all) = (rows.collect::<Vec<_>>(), self.ports.values.len());
        let [by_states, by_inputs] = [&self.ports.outputs, &self.ports.feedthrough];
        [(self.linear.order(), by_states), (self.ports.n_inputs, by_inputs)]
            .map(|(n, from)| matrix(rows.len(), n, |i, j| from[j * all + rows[i]]))
    }

    /// Derivatives of one measured value: by (z, z', s), then by the inputs.
    fn row(&self, place: usize) -> Row {
        let all = self.ports.values.len();
        let of = |from: &[f64], n: usize| (0..n).map(|j| from[j * all + place]).collect::<Vec<_>>();
        let by_states = of(&self.ports.outputs, self.linear.order());
        [by_states, of(&self.ports.feedthrough, self.ports.n_inputs)].concat()
    }

    /// Matrices S and T of the states, and R and W of their time derivatives, in the given axes.
    fn states(&self, layout: &Layout, chosen: &[usize], turning: &Turning) -> [[Matrix; 2]; 2] {
        let rows = chosen.iter().map(|&i| turning.rows(layout, i, |place| self.row(place)));
        let rows: Vec<[Row; 4]> = rows.collect();
        let n = self.linear.order();
        let of = |parts: [usize; 2]| {
            let all: Vec<&Row> =
                parts.iter().flat_map(|&part| rows.iter().map(move |row| &row[part])).collect();
            let m = self.ports.n_inputs;
            [matrix(all.len(), n, |i, j| all[i][j]), matrix(all.len(), m, |i, j| all[i][n + j])]
        };
        [of([0, 1]), of([2, 3])]
    }

    /// Computes A, B, C and D; `None` if the chosen coordinates do not determine the motion.
    pub(super) fn matrices(
        &self,
        layout: &Layout,
        chosen: &[usize],
        turning: &Turning,
    ) -> Option<[Matrix; 4]> {
        let (n, m) = (self.linear.order(), self.ports.n_inputs);
        let first = 2 * self.linear.n_freedoms;
        let (a, b) = (self.linear.state_matrix(), self.ports.input_matrix(first / 2));
        let [[mut s, mut t], [mut r, mut w]] = self.states(layout, chosen, turning);
        for i in first..n {
            s.data.extend((0..n).map(|j| if i == j { 1.0 } else { 0.0 }));
            t.data.extend((0..m).map(|_| 0.0));
            r.data.extend((0..n).map(|j| a[j * n + i]));
            w.data.extend((0..m).map(|j| b[j * n + i]));
        }
        for square in [&mut s, &mut t, &mut r, &mut w] {
            square.rows = n;
        }
        let [p, q] = self.of(layout.output_rows());
        let [a, c] = solve::divided([&r, &p], &s)?;
        let [b, d] = [(&a, w), (&c, q)].map(|(by, mut own)| {
            for i in 0..own.rows {
                for j in 0..m {
                    own[(i, j)] -= (0..n).map(|k| by[(i, k)] * t[(k, j)]).sum::<f64>();
                }
            }
            own
        });
        Some([a, b, c, d])
    }
}

/// Makes a matrix from a function of row and column.
fn matrix(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Matrix {
    let entries = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    Matrix { rows, columns, data: entries.map(|(i, j)| entry(i, j)).collect() }
}
