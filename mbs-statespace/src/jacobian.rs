//! The constraint Jacobian as a sparse matrix, gathered element by element.

use crate::elimination::Pattern;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::model::{Model, Tangent, Terms};

/// The matrix J by rows, without the entries that are always zero.
#[derive(Debug, Clone)]
pub(crate) struct Jacobian<T> {
    starts: Vec<u32>,
    columns: Vec<u32>,
    /// Index of each entry in the rows of its element.
    sources: Vec<u32>,
    pub(crate) values: Vec<T>,
    /// Scratch for the rows of one element.
    rows: Vec<T>,
}

impl<T: Real> Jacobian<T> {
    /// Creates the pattern of `model`: the entries that are not zero at one of two random configurations. An entry that is zero at both is
    /// zero everywhere, except by a coincidence of probability zero. Rows of curves have all entries in the pattern, because a curve may be
    /// flat over a range.
    pub(crate) fn new(model: &impl Model<T>) -> Self {
        let size = |e| model.rows(e).len() * model.clique(e).len();
        let largest = (0..model.n_elements()).map(size).max().unwrap_or(0);
        let total = (0..model.n_elements()).map(size).sum();
        let mut new = Self {
            starts: vec![0],
            columns: Vec::new(),
            sources: Vec::new(),
            values: Vec::new(),
            rows: vec![T::ZERO; largest],
        };
        let mut is_filled = vec![false; total];
        let (mut terms, mut q) = (model.terms(), vec![T::ZERO; model.n_extended()]);
        let mut random = Random(1);
        for _ in 0..2 {
            model.write_reference(&mut q);
            for x in &mut q[..model.n_unknowns()] {
                *x += random.next();
            }
            for guide in &mut terms.guides {
                *guide = core::array::from_fn(|_| random.next());
            }
            model.evaluate(&q, &mut terms);
            let mut at = 0;
            for e in 0..model.n_elements() {
                let rows = &mut new.rows[..size(e)];
                model.write_jacobian(&terms, e, rows);
                let k = model.clique(e).len().max(1);
                let filled = is_filled[at..].chunks_exact_mut(k).zip(rows.chunks_exact(k));
                for (row, (filled, values)) in model.rows(e).zip(filled) {
                    let is_level = model.may_be_level(row);
                    for (is_filled, &x) in filled.iter_mut().zip(values) {
                        *is_filled |= is_level || x != T::ZERO;
                    }
                }
                at += size(e);
            }
        }
        new.note(model, &is_filled);
        new.values = vec![T::ZERO; new.columns.len()];
        new
    }

    /// Stores the pattern of the filled entries, row by row.
    fn note(&mut self, model: &impl Model<T>, is_filled: &[bool]) {
        // Element, index of its first entry in `is_filled`, and row within the element.
        let mut homes = vec![(0, 0, 0); model.n_constraints()];
        let mut at = 0;
        for e in 0..model.n_elements() {
            for (i, row) in model.rows(e).enumerate() {
                homes[row] = (e, at, i);
            }
            at += model.rows(e).len() * model.clique(e).len();
        }
        for (e, at, row) in homes {
            let clique = model.clique(e);
            for (i, &column) in clique.iter().enumerate() {
                let source = row * clique.len() + i;
                if is_filled[at + source] {
                    self.columns.push(column);
                    self.sources.push(u32::try_from(source).unwrap_or(u32::MAX));
                }
            }
            self.starts.push(u32::try_from(self.columns.len()).unwrap_or(u32::MAX));
        }
    }

    pub(crate) fn pattern(&self, n_columns: usize) -> Pattern {
        Pattern { n_columns, starts: self.starts.clone(), columns: self.columns.clone() }
    }

    /// Gathers the entries of J from the last evaluation of `terms`.
    pub(crate) fn gather(&mut self, model: &impl Model<T>, terms: &Terms<T>) {
        for e in 0..model.n_elements() {
            let range = model.rows(e);
            if range.is_empty() {
                continue;
            }
            let rows = &mut self.rows[..range.len() * model.clique(e).len()];
            model.write_jacobian(terms, e, rows);
            let entries = self.starts[range.start] as usize..self.starts[range.end] as usize;
            for t in entries {
                self.values[t] = rows[self.sources[t] as usize];
            }
        }
    }

    /// Adds a product with the transpose: x += J^T y.
    pub(crate) fn add_transposed(&self, y: &[T], x: &mut [T]) {
        for (row, &y) in y.iter().enumerate() {
            let entries = self.starts[row] as usize..self.starts[row + 1] as usize;
            for t in entries {
                x[self.columns[t] as usize] += self.values[t] * y;
            }
        }
    }
}

/// Smallest mass of an unknown in the scaling, relative to the largest mass [-]. This limit makes every inverse mass finite. Chosen, not
/// tuned.
const LIGHT: f64 = 1e-6;

/// Returns the column scales 1 / sqrt(diagonal of M). With these scales, light unknowns become dependent first.
pub(crate) fn column_scales<T: Real>(model: &impl Model<T>) -> Vec<T> {
    let mut diagonal = vec![T::ZERO; model.n_unknowns()];
    let (terms, mut block) = (model.terms(), vec![T::ZERO; largest_block(model)]);
    let mass = Tangent { stiffness: T::ZERO, damping: T::ZERO, penalty: &[], geometric: None };
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        model.write_block(&terms, &mass, e, &mut block);
        let mut at = 0;
        for (i, &u) in clique.iter().enumerate() {
            diagonal[u as usize] += block[at];
            at += clique.len() - i;
        }
    }
    let largest = diagonal.iter().fold(T::ZERO, |a, &b| a.max(b));
    let floor = if largest > T::ZERO { largest * T::from_f64(LIGHT) } else { T::ONE };
    diagonal.iter().map(|&d| T::ONE / d.max(floor).sqrt()).collect()
}

/// Returns the number of entries in the largest packed block of an element.
pub(crate) fn largest_block<T: Real>(model: &impl Model<T>) -> usize {
    let size = |e| model.clique(e).len() * (model.clique(e).len() + 1) / 2;
    (0..model.n_elements()).map(size).max().unwrap_or(0)
}

/// Generator of pseudo-random numbers in (-1/2, 1/2), the same on every machine.
struct Random(u32);

impl Random {
    fn next<T: Real>(&mut self) -> T {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        T::from_f64(f64::from(self.0) / f64::from(u32::MAX) - 0.5)
    }
}
