//! The saddle system of a model: coordinates and multipliers as unknowns, element by element.
//!
//! ```text
//! [ W   J^T    ]     W = M + (v'/a') C + (1/a') (K + K_geo(lambda))          [P3 (20)], divided by a' as [P3 (17)]
//! [ J  -delta  ]     unknowns 0..n are coordinates, n..n + m are the rows' multipliers
//! ```
//!
//! Every constraint row belongs to one element. The system is therefore a sum over the same elements. The clique of an element lists its
//! coordinates, then its rows.

use crate::model::{Load, Model, Tangent, Terms};
use crate::{BlockSource, Cliques, Real};
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// Sparsity of a model's saddle system: the unknowns that each element couples. Its solver is analysed for this structure.
#[derive(Debug, Clone)]
pub struct Saddle {
    n: usize,
    m: usize,
    cliques: Vec<u32>,
    /// Start of each clique in `cliques`, and the end of the last one.
    starts: Vec<usize>,
    /// Start of the Jacobian entries of each element, and the end of the last ones.
    jacobian: Vec<usize>,
}

impl Saddle {
    /// Structure of the saddle system of `model`.
    ///
    /// # Panics
    /// If there are more than 2^32 - 1 unknowns.
    pub fn new<T: Real>(model: &impl Model<T>) -> Self {
        let n = model.n_unknowns();
        let mut this = Self {
            n,
            m: model.n_constraints(),
            cliques: Vec::new(),
            starts: vec![0],
            jacobian: vec![0],
        };
        for e in 0..model.n_elements() {
            let (clique, rows) = (model.clique(e), model.rows(e));
            this.cliques.extend_from_slice(clique);
            this.jacobian.push(this.jacobian[e] + clique.len() * rows.len());
            this.cliques
                .extend(rows.map(|row| u32::try_from(n + row).expect("at most 2^32 - 1 unknowns")));
            this.starts.push(this.cliques.len());
        }
        this
    }

    /// Entries of all Jacobian rows, element by element.
    #[must_use]
    pub fn n_jacobian(&self) -> usize {
        self.jacobian[self.starts.len() - 1]
    }

    /// Start of the Jacobian entries of each element, and the end of the last ones.
    #[must_use]
    pub fn jacobian_starts(&self) -> &[usize] {
        &self.jacobian
    }

    /// Range of the Jacobian entries of `element` among those of all elements.
    #[must_use]
    pub fn jacobian(&self, element: usize) -> Range<usize> {
        self.jacobian[element]..self.jacobian[element + 1]
    }
}

impl Cliques for Saddle {
    fn n_unknowns(&self) -> usize {
        self.n + self.m
    }
    fn n_elements(&self) -> usize {
        self.starts.len() - 1
    }
    fn clique(&self, element: usize) -> &[u32] {
        &self.cliques[self.starts[element]..self.starts[element + 1]]
    }
    fn n_primal(&self) -> usize {
        self.n
    }
}

/// The saddle system at one instant.
#[derive(Debug, Clone, Copy)]
pub struct SaddleSystem<'a, T, M> {
    /// Model of the mechanism.
    pub model: &'a M,
    /// Saddle structure of the model.
    pub saddle: &'a Saddle,
    /// Evaluated terms of the model.
    pub terms: &'a Terms<T>,
    /// Weights of W, without the penalty term.
    pub tangent: Tangent<'a, T>,
    /// Jacobian entries of all elements, element by element.
    pub jacobian: &'a [T],
    /// Regularisation delta of each row. If the list is empty, delta is zero.
    pub delta: &'a [T],
    /// Upper part of the right-hand side, over the coordinates.
    pub load: Load<'a, T>,
    /// Lower part of the right-hand side, of length m. If the list is empty, this part is zero.
    pub rates: &'a [T],
}

impl<T: Real, M: Model<T>> BlockSource<T> for SaddleSystem<'_, T, M> {
    fn write_block(&self, element: usize, block: &mut [T]) {
        let (k, rows) = (self.model.clique(element).len(), self.model.rows(element));
        let (m, first) = (rows.len(), k * (k + 1) / 2);
        self.model.write_block(self.terms, &self.tangent, element, &mut block[..first]);
        // Spread the columns of W, the last one first, and write the columns of J below them.
        let jacobian = &self.jacobian[self.saddle.jacobian(element)];
        let (mut from, mut to) = (first, first + k * m);
        for j in (0..k).rev() {
            let len = k - j;
            (from, to) = (from - len, to - len - m);
            block.copy_within(from..from + len, to);
            for (i, place) in block[to + len..to + len + m].iter_mut().enumerate() {
                *place = jacobian[i * k + j];
            }
        }
        let mut rest = &mut block[first + k * m..];
        rest.fill(T::ZERO);
        for (i, row) in rows.enumerate() {
            if let Some(&delta) = self.delta.get(row) {
                rest[0] = -delta;
            }
            rest = &mut rest[m - i..];
        }
    }

    fn write_residual(&self, element: usize, residual: &mut [T]) {
        let (k, rows) = (self.model.clique(element).len(), self.model.rows(element));
        let (upper, lower) = residual.split_at_mut(k);
        self.model.write_residual(self.terms, &self.load, element, upper);
        if self.rates.is_empty() {
            lower.fill(T::ZERO);
        } else {
            lower.copy_from_slice(&self.rates[rows]);
        }
    }
}
