//! Random saddle systems [[W, J^T], [J, 0]] as sums of elements with constraint rows.

use super::{Random, Sum};
use mbs_sparse::{BlockSource, Cliques, Real};

/// A sum of blocks whose unknowns from `n_primal` on are multipliers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Saddle {
    pub(crate) sum: Sum,
    pub(crate) n_primal: usize,
}

/// Returns the index of (row, col), in any order, in a packed block of k unknowns.
fn packed(k: usize, row: usize, col: usize) -> usize {
    let (row, col) = (row.max(col), row.min(col));
    col * (2 * k + 1 - col) / 2 + row - col
}

impl Saddle {
    /// Adds random constraint rows to every element of `sum`: `rows` rows over the coordinates of the element.
    fn with_rows(sum: Sum, rows: usize, seed: u64) -> Self {
        let n_primal = sum.n;
        let mut saddle = Self { sum, n_primal };
        let mut random = Random(seed);
        for e in 0..saddle.sum.cliques.len() {
            let k = saddle.sum.cliques[e].len();
            for _ in 0..rows {
                let row: Vec<f64> = (0..k).map(|_| random.next()).collect();
                saddle.add_row(e, &row);
            }
        }
        saddle
    }

    /// Creates a chain (length, size, overlap), as `Sum::chain` does, with `rows` constraint rows in each element.
    pub(crate) fn chain(
        (length, size, overlap): (usize, usize, usize),
        rows: usize,
        seed: u64,
    ) -> Self {
        Self::with_rows(Sum::chain(length, size, overlap), rows, seed)
    }

    /// Creates a star of chains with `rows` rows in each element.
    pub(crate) fn star(branches: usize, length: usize, rows: usize) -> Self {
        Self::with_rows(Sum::star(branches, length), rows, 3)
    }

    /// Adds a row, in the order of the clique of element `e`, and returns its multiplier.
    fn add_row(&mut self, e: usize, row: &[f64]) -> u32 {
        let (k, old) = (self.sum.cliques[e].len(), self.sum.blocks[e].clone());
        let mut block = Vec::new();
        for j in 0..k {
            block.extend_from_slice(&old[packed(k, j, j)..=packed(k, k - 1, j)]);
            block.push(row.get(j).copied().unwrap_or(0.0));
        }
        block.push(0.0);
        self.sum.blocks[e] = block;
        let multiplier = self.sum.n as u32;
        self.sum.cliques[e].push(multiplier);
        self.sum.residuals[e].push(0.0);
        self.sum.n += 1;
        multiplier
    }

    /// Returns the rows of element `e`: each multiplier with its entries in the order of the clique, zero at multipliers.
    fn rows_of(&self, e: usize) -> Vec<(u32, Vec<f64>)> {
        let clique = &self.sum.cliques[e];
        let k = clique.len();
        let is_multiplier = |i: usize| clique[i] as usize >= self.n_primal;
        (0..k)
            .filter(|&i| is_multiplier(i))
            .map(|i| {
                let row = (0..k).map(|j| self.sum.blocks[e][packed(k, i, j)]).collect();
                (clique[i], row)
            })
            .collect()
    }

    /// Adds a copy of the first row of element `e`, times `factor`. Returns the multipliers of the first row and of the copy.
    pub(crate) fn repeat_row(&mut self, e: usize, factor: f64) -> (u32, u32) {
        let (first, row) = self.rows_of(e).swap_remove(0);
        let row: Vec<f64> = row.iter().map(|x| x * factor).collect();
        (first, self.add_row(e, &row))
    }

    /// Adds the sum of all rows of element `e` as a row. Returns all multipliers of the element.
    pub(crate) fn add_sum_of_rows(&mut self, e: usize) -> Vec<u32> {
        let rows = self.rows_of(e);
        let k = self.sum.cliques[e].len();
        let sum: Vec<f64> = (0..k).map(|j| rows.iter().map(|(_, row)| row[j]).sum()).collect();
        let mut names: Vec<u32> = rows.iter().map(|(name, _)| *name).collect();
        names.push(self.add_row(e, &sum));
        names
    }

    /// Rotates a row: adds `angle` to its first entry and subtracts it from the second one.
    pub(crate) fn turn_row(&mut self, multiplier: u32, angle: f64) {
        for (clique, block) in self.sum.cliques.iter().zip(&mut self.sum.blocks) {
            if let Some(i) = clique.iter().position(|&u| u == multiplier) {
                block[packed(clique.len(), i, 0)] += angle;
                block[packed(clique.len(), i, 1)] -= angle;
            }
        }
    }

    /// Sets rows and columns of chosen coordinates in W to zero.
    pub(crate) fn remove_mass(&mut self, is_chosen: impl Fn(u32) -> bool) {
        let n = self.n_primal as u32;
        self.change_mass(|u, v, x| if is_chosen(u) || is_chosen(v) { 0.0 } else { x }, n);
    }

    /// Multiplies W by a factor.
    pub(crate) fn shrink_mass(&mut self, factor: f64) {
        let n = self.n_primal as u32;
        self.change_mass(|_, _, x| x * factor, n);
    }

    fn change_mass(&mut self, change: impl Fn(u32, u32, f64) -> f64, n: u32) {
        for (clique, block) in self.sum.cliques.iter().zip(&mut self.sum.blocks) {
            let k = clique.len();
            for j in 0..k {
                for i in j..k {
                    if clique[i] < n && clique[j] < n {
                        let x = &mut block[packed(k, i, j)];
                        *x = change(clique[i], clique[j], *x);
                    }
                }
            }
        }
    }

    /// Sets the entries of a coordinate in all rows to zero.
    pub(crate) fn clear_rows_at(&mut self, coordinate: u32) {
        for (clique, block) in self.sum.cliques.iter().zip(&mut self.sum.blocks) {
            let k = clique.len();
            let Some(j) = clique.iter().position(|&u| u == coordinate) else { continue };
            for i in 0..k {
                if clique[i] as usize >= self.n_primal {
                    block[packed(k, i, j)] = 0.0;
                }
            }
        }
    }

    /// Shuffles the elements of the sum, whose matrix stays the same.
    pub(crate) fn shuffled(mut self, seed: u64) -> Self {
        let mut random = Random(seed);
        for e in (1..self.sum.cliques.len()).rev() {
            let other = random.below(e + 1);
            self.sum.cliques.swap(e, other);
            self.sum.blocks.swap(e, other);
            self.sum.residuals.swap(e, other);
        }
        self
    }

    /// Returns the same matrix with every clique in reverse order.
    pub(crate) fn with_turned_cliques(&self) -> Self {
        let mut turned = self.clone();
        for (clique, block) in turned.sum.cliques.iter_mut().zip(&mut turned.sum.blocks) {
            let (k, old) = (clique.len(), block.clone());
            clique.reverse();
            for j in 0..k {
                for i in j..k {
                    block[packed(k, i, j)] = old[packed(k, k - 1 - i, k - 1 - j)];
                }
            }
        }
        turned
    }
}

impl Cliques for Saddle {
    fn n_unknowns(&self) -> usize {
        self.sum.n
    }
    fn n_elements(&self) -> usize {
        self.sum.cliques.len()
    }
    fn clique(&self, element: usize) -> &[u32] {
        &self.sum.cliques[element]
    }
    fn n_primal(&self) -> usize {
        self.n_primal
    }
}

impl<T: Real> BlockSource<T> for Saddle {
    fn write_block(&self, element: usize, block: &mut [T]) {
        self.sum.write_block(element, block);
    }
    fn write_residual(&self, element: usize, residual: &mut [T]) {
        self.sum.write_residual(element, residual);
    }
}
