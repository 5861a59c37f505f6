//! A solver with one dense matrix for all unknowns: [`Dense`]. It is for small systems, for tests, and for users who need no other crate.
//! Sparse solvers use its modules [`front`] and [`scaling`].
//!
//! ```text
//! as SpdSolver:         T = L D L^T, pivots in the given order
//! as SymmetricSolver:   S T S = P^T L D L^T P, D of 1x1 and 2x2 pivots chosen by the numbers, S an equilibration
//! ```

pub mod front;
pub(crate) mod lists;
pub mod panel;
pub mod scaling;

use crate::Real;
use crate::blocks::{
    BlockSource, Cliques, FactorError, Inertia, SpdSolver, SymmetricSolver, Weakest, combine,
};
use crate::team::Alone;
use alloc::vec;
use alloc::vec::Vec;
use front::{Places, Tally, Thresholds, column};
use lists::Lists;

/// A dense solver for any [`Cliques`]. Cost: n^3 / 6 multiply-subtracts for a factorisation, n^2 for a solution.
#[derive(Debug, Clone)]
pub struct Dense<T> {
    cliques: Lists,
    /// Block or residual of one element.
    block: Vec<T>,
    /// List of all unknowns, 0, 1, ..., n - 1, which is the clique of the whole matrix.
    natural: Vec<u32>,
    /// The matrix as a packed lower triangle; `factor` has the factor in the same order.
    matrix: Vec<T>,
    factor: Vec<T>,
    diagonal: Vec<T>,
    scale: Vec<T>,
    size: Vec<T>,
    order: Vec<u32>,
    pairs: Vec<bool>,
    pivots: Vec<T>,
    tally: Tally,
    /// Number of pivots in the last factorisation of a symmetric matrix.
    n_pivots: usize,
}

impl<T: Real> Dense<T> {
    /// A solver for the unknowns and elements of `cliques`. Only this function allocates.
    ///
    /// # Panics
    /// If there are more than 2^32 - 1 unknowns.
    pub fn new(cliques: &impl Cliques) -> Self {
        let n = cliques.n_unknowns();
        let cliques = Lists::of(cliques);
        let largest = cliques.largest();
        let natural: Vec<u32> =
            (0..n).map(|u| u32::try_from(u).expect("at most 2^32 - 1 unknowns")).collect();
        Self {
            cliques,
            block: vec![T::ZERO; largest * (largest + 1) / 2],
            order: natural.clone(),
            natural,
            matrix: vec![T::ZERO; column(n, n)],
            factor: vec![T::ZERO; column(n, n)],
            diagonal: vec![T::ZERO; n],
            scale: vec![T::ONE; n],
            size: vec![T::ZERO; n],
            pairs: vec![false; n],
            pivots: vec![T::ZERO; n],
            tally: Tally::default(),
            n_pivots: n,
        }
    }

    /// Sums the blocks into the matrix.
    fn gather<S: BlockSource<T>>(&mut self, source: &S) {
        let n = self.natural.len();
        self.matrix.fill(T::ZERO);
        for (e, clique) in self.cliques.iter().enumerate() {
            let block = &mut self.block[..column(clique.len(), clique.len())];
            source.write_block(e, block);
            let mut entries = block.iter();
            for (j, &v) in clique.iter().enumerate() {
                for &u in &clique[j..] {
                    let (row, col) = (u.max(v) as usize, u.min(v) as usize);
                    if let Some(&x) = entries.next() {
                        self.matrix[column(n, col) + row - col] += x;
                    }
                }
            }
        }
    }

    fn gather_residuals<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        let write = |e: usize, residual: &mut [T]| source.write_residual(e, residual);
        combine(self.cliques.iter(), (&mut self.block, f), T::ZERO, write, |sum, x| sum + x);
    }

    /// Replaces x by S P^T (L D L^T)^-1 P S x.
    fn sweep(&self, x: &mut [T], scratch: &mut [T]) {
        let z = &mut scratch[..x.len()];
        for (z, &u) in z.iter_mut().zip(&self.order) {
            *z = x[u as usize] * self.scale[u as usize];
        }
        let pairs = &self.pairs[..self.n_pivots];
        front::forward(&self.factor, pairs, z);
        front::backward(&self.factor, pairs, z, true);
        for (&z, &u) in z.iter().zip(&self.order) {
            x[u as usize] = z * self.scale[u as usize];
        }
    }
}

impl<T: Real> SpdSolver<T> for Dense<T> {
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError> {
        self.gather(source);
        let n = self.natural.len();
        self.factor.copy_from_slice(&self.matrix);
        self.scale.fill(T::ONE);
        self.order.copy_from_slice(&self.natural);
        self.pairs.fill(false);
        self.n_pivots = n;
        for k in 0..n {
            let (head, mut rest) = self.factor.split_at_mut(column(n, k + 1));
            let (diagonal, below) = head[column(n, k)..].split_at_mut(1);
            let pivot = diagonal[0];
            if !(pivot > T::ZERO && pivot.is_finite()) {
                return Err(FactorError { unknown: self.natural[k], pivot: pivot.to_f64() });
            }
            self.pivots[k] = pivot;
            let inverse = T::ONE / pivot;
            for j in 0..below.len() {
                let (target, next) = rest.split_at_mut(below.len() - j);
                rest = next;
                let l = below[j] * inverse;
                for (target, &a) in target.iter_mut().zip(&below[j..]) {
                    *target -= l * a;
                }
            }
            diagonal[0] = inverse;
            below.iter_mut().for_each(|l| *l *= inverse);
        }
        Ok(())
    }
    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        self.sweep(x, scratch);
    }
    fn n_scratch(&self) -> usize {
        self.natural.len()
    }
    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        self.gather_residuals(source, f);
    }
    fn pivots(&self) -> &[T] {
        &self.pivots
    }
    fn elimination_order(&self) -> &[u32] {
        &self.natural
    }
}

impl<T: Real> SymmetricSolver<T> for Dense<T> {
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError> {
        self.gather(source);
        let n = self.natural.len();
        let (natural, matrix) = (&self.natural, &self.matrix);
        let measure = |scale: &[T], rows: &mut [T]| {
            scaling::measure_rows(natural, matrix, scale, rows);
        };
        scaling::write_diagonal(matrix, &mut self.diagonal);
        let out = (&mut self.scale[..], &mut self.size[..]);
        scaling::equilibrate(&Alone, out, &self.diagonal, measure);
        measure(&self.scale, &mut self.size);
        for j in 0..n {
            let range = column(n, j)..column(n, j + 1);
            for (i, at) in (j..n).zip(range) {
                self.factor[at] = self.matrix[at] * self.scale[i] * self.scale[j];
            }
        }
        self.order.copy_from_slice(&self.natural);
        self.tally = Tally::default();
        let mut places =
            Places { order: &mut self.order, pairs: &mut self.pairs, size: &mut self.size };
        let (rules, tally) = (Thresholds::default(), &mut self.tally);
        self.n_pivots = front::eliminate(&mut self.factor, n, &mut places, &rules, tally);
        self.tally.note_left(&self.factor, &self.order, self.n_pivots, &self.size);
        self.tally.verdict()
    }
    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        self.sweep(x, scratch);
    }
    fn n_scratch(&self) -> usize {
        self.natural.len()
    }
    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        self.gather_residuals(source, f);
    }
    fn subtract_product(&self, x: &[T], b: &mut [T]) {
        scaling::subtract_product(&self.natural, &self.matrix, x, b);
    }
    fn inertia(&self) -> Inertia {
        self.tally.inertia
    }
    fn weakest(&self) -> Weakest {
        self.tally.weakest
    }
    fn null_vector(&self, x: &mut [T], scratch: &mut [T]) {
        let z = &mut scratch[..x.len()];
        for (z, &u) in z.iter_mut().zip(&self.order) {
            *z = if u == self.tally.weakest.unknown { T::ONE } else { T::ZERO };
        }
        front::backward(&self.factor, &self.pairs[..self.n_pivots], z, false);
        let unit = self.scale.get(self.tally.weakest.unknown as usize).copied();
        let unit = unit.unwrap_or(T::ONE);
        for (&z, &u) in z.iter().zip(&self.order) {
            x[u as usize] = z * self.scale[u as usize] / unit;
        }
    }
}

#[cfg(test)]
mod tests;
