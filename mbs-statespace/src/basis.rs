//! The null-space basis R, and products with R that are summed element by element.
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

/// Rows R_d of the basis in the order of elimination, with scratch for one element.
#[derive(Debug, Clone)]
pub(crate) struct Basis<T> {
    f: usize,
    rows: Vec<T>,
    block: Vec<T>,
    /// Products P_e R and T_e P_e R over the columns of R that are not zero for the element, and the indices of these columns.
    local: Vec<T>,
    product: Vec<T>,
    columns: Vec<u32>,
    sums: Vec<T>,
    /// Matrix C = M R at the middle of the step, one row for each unknown.
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
            sums: vec![T::ZERO; f],
            chart: vec![T::ZERO; model.n_unknowns() * f],
        }
    }

    /// Evaluates R for the last factored matrix. Returns its largest entry in the scaling of the choice.
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

    /// Expands independent increments: x = R d over all unknowns.
    pub(crate) fn expand(&self, elimination: &Elimination<T>, d: &[T], x: &mut [T]) {
        for (k, &column) in elimination.dependent().iter().enumerate() {
            let row = &self.rows[k * self.f..(k + 1) * self.f];
            x[column as usize] = row.iter().zip(d).fold(T::ZERO, |sum, (&r, &d)| sum + r * d);
        }
        for (&column, &d) in elimination.independent().iter().zip(d) {
            x[column as usize] = d;
        }
    }

    /// Projects a matrix: h = R^T T R, the lower triangle.
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
                let sums = &mut self.sums[..=i];
                sums.fill(T::ZERO);
                for a in 0..k {
                    add_multiple(self.local[a * c + i], &self.product[a * c..], sums);
                }
                for (&column, &sum) in self.columns.iter().zip(sums.iter()) {
                    *h.at(row as usize, column as usize) += sum;
                }
            }
        }
    }

    /// Evaluates P_e R and T_e P_e R over the columns that are not zero. Returns their numbers of rows and columns; `None` where T_e is zero.
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

    /// Sets C = M R from the mass blocks of `system`.
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

    /// Evaluates tangent coordinates: y = C^T x.
    pub(crate) fn chart(&self, x: &[T], y: &mut [T]) {
        y.fill(T::ZERO);
        for (row, &x) in self.chart.chunks_exact(self.f.max(1)).zip(x) {
            for (y, &c) in y.iter_mut().zip(row) {
                *y += c * x;
            }
        }
    }

    /// Evaluates the matrix g = C^T R.
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
                add_multiple(c, r, row);
            }
        }
    }

    /// Gathers the rows of R for the unknowns of a clique, over the columns that are not zero there. First come the ascending column
    /// indices, then the rows.
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

/// Multiplies y = A x, with A a packed lower triangle of a symmetric matrix, and x and y in rows of c numbers.
fn multiply<T: Real>(a: &[T], x: &[T], y: &mut [T], c: usize) {
    y.fill(T::ZERO);
    let mut at = 0;
    let k = x.len().checked_div(c).unwrap_or(0);
    for j in 0..k {
        for i in j..k {
            let value = a[at];
            at += 1;
            add_multiple(value, &x[j * c..], &mut y[i * c..(i + 1) * c]);
            if i > j {
                add_multiple(value, &x[i * c..], &mut y[j * c..(j + 1) * c]);
            }
        }
    }
}

/// Adds a multiple: y += s x, over the length of y.
fn add_multiple<T: Real>(s: T, x: &[T], y: &mut [T]) {
    if s != T::ZERO {
        for (y, &x) in y.iter_mut().zip(x) {
            *y += s * x;
        }
    }
}
