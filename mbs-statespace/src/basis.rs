//! The null-space basis and what is projected on it, element by element.
//!
//! ```text
//! R = [R_d; 1],   R_d = -J_d^-1 J_i                            [P1 (21)]
//! R^T T R = sum_e (P_e R)^T T_e (P_e R)                        P_e picks the unknowns of element e
//! C = M R = sum_e P_e^T M_e (P_e R)
//! ```

use crate::dense::{General, Symmetric};
use crate::elimination::Elimination;
use crate::jacobian::largest_block;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::model::{Model, System};
use mbs_core::{BlockSource, Real};

/// R_d by rows in the order of elimination, with scratch for one element.
#[derive(Debug, Clone)]
pub(crate) struct Basis<T> {
    f: usize,
    rows: Vec<T>,
    block: Vec<T>,
    /// P_e R and T_e P_e R over the columns that are not zero, and those columns.
    local: Vec<T>,
    product: Vec<T>,
    columns: Vec<u32>,
    /// C = M R at the middle of the step, a row for each unknown.
    chart: Vec<T>,
}

impl<T: Real> Basis<T> {
    pub(crate) fn new(model: &impl Model<T>, rank: usize) -> Self {
        let f = model.n_unknowns() - rank;
        let widest = (0..model.n_elements()).map(|e| model.clique(e).len()).max().unwrap_or(0);
        Self {
            f,
            rows: vec![T::ZERO; rank * f],
            block: vec![T::ZERO; largest_block(model)],
            local: vec![T::ZERO; widest * f],
            product: vec![T::ZERO; widest * f],
            columns: Vec::with_capacity(f),
            chart: vec![T::ZERO; model.n_unknowns() * f],
        }
    }

    /// R at the matrix that was factored last. Returns its largest entry in the scaling of the choice.
    pub(crate) fn evaluate(&mut self, elimination: &Elimination<T>) -> T {
        elimination.write_basis(&mut self.rows);
        let mut largest = T::ZERO;
        for (k, &column) in elimination.dependent().iter().enumerate() {
            let inverse = T::ONE / elimination.column_scale(column as usize);
            for (&x, &i) in self.rows[k * self.f..].iter().zip(elimination.independent()) {
                largest = largest.max((x * inverse * elimination.column_scale(i as usize)).abs());
            }
        }
        largest
    }

    /// x = R d over the unknowns.
    pub(crate) fn expand(&self, elimination: &Elimination<T>, d: &[T], x: &mut [T]) {
        for (k, &column) in elimination.dependent().iter().enumerate() {
            let row = &self.rows[k * self.f..(k + 1) * self.f];
            x[column as usize] = row.iter().zip(d).fold(T::ZERO, |sum, (&r, &d)| sum + r * d);
        }
        for (&column, &d) in elimination.independent().iter().zip(d) {
            x[column as usize] = d;
        }
    }

    /// h = R^T T R, the lower triangle.
    pub(crate) fn project<M: Model<T>>(
        &mut self,
        elimination: &Elimination<T>,
        system: &System<'_, T, M>,
        h: &mut Symmetric<T>,
    ) {
        h.clear();
        for e in 0..system.model.n_elements() {
            let Some((k, c)) = self.multiply_element(elimination, system, e) else { continue };
            for (i, &row) in self.columns.iter().enumerate() {
                for (j, &column) in self.columns[..=i].iter().enumerate() {
                    let mut sum = T::ZERO;
                    for a in 0..k {
                        sum += self.local[a * c + i] * self.product[a * c + j];
                    }
                    *h.at(row as usize, column as usize) += sum;
                }
            }
        }
    }

    /// P_e R and T_e P_e R over the columns that are not zero; their numbers of rows and columns. `None`: T_e is zero.
    fn multiply_element<M: Model<T>>(
        &mut self,
        elimination: &Elimination<T>,
        system: &System<'_, T, M>,
        e: usize,
    ) -> Option<(usize, usize)> {
        let clique = system.model.clique(e);
        let k = clique.len();
        let block = &mut self.block[..k * (k + 1) / 2];
        system.write_block(e, block);
        if block.iter().all(|&x| x == T::ZERO) {
            return None;
        }
        self.pick(elimination, clique);
        let c = self.columns.len();
        multiply(&self.block, &self.local[..k * c], &mut self.product[..k * c], c);
        Some((k, c))
    }

    /// C = M R with the mass blocks of `system`.
    pub(crate) fn set_chart<M: Model<T>>(
        &mut self,
        elimination: &Elimination<T>,
        system: &System<'_, T, M>,
    ) {
        self.chart.fill(T::ZERO);
        for e in 0..system.model.n_elements() {
            let Some((_, c)) = self.multiply_element(elimination, system, e) else { continue };
            for (a, &unknown) in system.model.clique(e).iter().enumerate() {
                let row = &mut self.chart[unknown as usize * self.f..];
                for (&column, &x) in self.columns.iter().zip(&self.product[a * c..]) {
                    row[column as usize] += x;
                }
            }
        }
    }

    /// y = C^T x.
    pub(crate) fn chart(&self, x: &[T], y: &mut [T]) {
        y.fill(T::ZERO);
        for (row, &x) in self.chart.chunks_exact(self.f.max(1)).zip(x) {
            for (y, &c) in y.iter_mut().zip(row) {
                *y += c * x;
            }
        }
    }

    /// g = C^T R.
    pub(crate) fn chart_basis(&self, elimination: &Elimination<T>, g: &mut General<T>) {
        let f = self.f;
        for (i, &u) in elimination.independent().iter().enumerate() {
            for j in 0..f {
                g.values[j * f + i] = self.chart[u as usize * f + j];
            }
        }
        for (k, &u) in elimination.dependent().iter().enumerate() {
            let (c, r) = (&self.chart[u as usize * f..][..f], &self.rows[k * f..][..f]);
            for (row, &c) in g.values.chunks_exact_mut(f.max(1)).zip(c) {
                if c != T::ZERO {
                    for (g, &r) in row.iter_mut().zip(r) {
                        *g += c * r;
                    }
                }
            }
        }
    }

    /// The rows of R of a clique over the columns that are not zero there: ascending columns, rows of as many numbers.
    fn pick(&mut self, elimination: &Elimination<T>, clique: &[u32]) {
        let (rank, f, rows) = (elimination.rank(), self.f, &self.rows);
        let entry = |unknown: u32, column: usize| {
            let place = elimination.place(unknown as usize);
            if place < rank {
                rows[place * f + column]
            } else if place - rank == column {
                T::ONE
            } else {
                T::ZERO
            }
        };
        self.columns.clear();
        for column in 0..f {
            if clique.iter().any(|&u| entry(u, column) != T::ZERO) {
                self.columns.push(u32::try_from(column).unwrap_or(u32::MAX));
            }
        }
        let c = self.columns.len();
        for (a, &unknown) in clique.iter().enumerate() {
            for (to, &column) in self.local[a * c..].iter_mut().zip(&self.columns) {
                *to = entry(unknown, column as usize);
            }
        }
    }
}

/// y = A x with A a packed lower triangle, x and y by rows of c numbers.
fn multiply<T: Real>(a: &[T], x: &[T], y: &mut [T], c: usize) {
    y.fill(T::ZERO);
    let mut at = 0;
    let k = x.len().checked_div(c).unwrap_or(0);
    for j in 0..k {
        for i in j..k {
            let value = a[at];
            at += 1;
            for s in 0..c {
                y[i * c + s] += value * x[j * c + s];
            }
            if i > j {
                for s in 0..c {
                    y[j * c + s] += value * x[i * c + s];
                }
            }
        }
    }
}
