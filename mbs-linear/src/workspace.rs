//! Workspace of both analyses: the saddle matrix of a model with weights, its factor, and sums of forces.
//!
//! ```text
//! [ M + s (K + K_geo(lambda))   J^T   ] ( d )     ( b )
//! [ J                          -delta ] ( e )  =  ( c ),      delta_k = 1e-9 J_k J_k^T / W_k,   W_k = max W_uu, J_ku != 0
//! ```
//!
//! Coordinates are scaled by their sizes: the scene's length for points, one for directions. So no result depends on the unit of length.
//!
//! delta allows redundant rows. Iteration of the multipliers removes the violation that delta leaves, so that no result depends on it. W_k
//! is the largest mass among the coordinates of the row. So delta is small relative to the compliance of the row in every mechanism. If W_k
//! came from a coordinate without mass, the violation would be larger than the iteration can remove.

use alloc::vec;
use alloc::vec::Vec;
use mbs_core::algebra::norm_inf;
use mbs_core::model::{Load, Model, Tangent, Terms};
use mbs_core::saddle::{Saddle, SaddleSystem};
use mbs_core::{BlockSource, FactorError, Real, SymmetricSolver};

/// Compliance δ of a constraint, relative to the compliance of its row [-]. Chosen, not tuned.
const DELTA: f64 = 1e-9;
/// Least mass of a coordinate, relative to the largest mass [-]. Smaller masses are raised to it or left out, so that an inverse mass stays
/// finite. Chosen, not tuned.
const LIGHT: f64 = 1e-6;

/// Workspace over a solver `S` that was analysed for the [`Saddle`] of the model.
#[derive(Debug, Clone)]
pub struct Workspace<T, S> {
    pub(crate) solver: S,
    saddle: Saddle,
    pub(crate) terms: Terms<T>,
    jacobian: Vec<T>,
    /// Size of each coordinate in the scene [m or -], and the largest change of each row if one coordinate moves by its size.
    pub(crate) sizes: Vec<T>,
    row_sizes: Vec<T>,
    delta: Vec<T>,
    diagonal: Vec<T>,
    /// Scratch for a block, a Jacobian or a residual of one element.
    local: Vec<T>,
    scaled: Vec<T>,
    /// Right-hand side, then solution: n coordinates, then m multipliers.
    pub(crate) f: Vec<T>,
    scratch: Vec<T>,
    pub(crate) n: usize,
    pub(crate) m: usize,
}

impl<T: Real, S: SymmetricSolver<T>> Workspace<T, S> {
    /// Creates the workspace for `model`.
    pub fn new(model: &impl Model<T>, solver: S) -> Self {
        let (n, m) = (model.n_unknowns(), model.n_constraints());
        let saddle = Saddle::new(model);
        let mut sizes = vec![T::ONE; n];
        model.write_sizes(&mut sizes);
        let largest = (0..model.n_elements()).map(|e| model.clique(e).len()).max().unwrap_or(0);
        Self {
            terms: model.terms(),
            jacobian: vec![T::ZERO; saddle.n_jacobian()],
            sizes,
            row_sizes: vec![T::ONE; m],
            delta: vec![T::ZERO; m],
            diagonal: vec![T::ZERO; n],
            local: vec![T::ZERO; largest * (largest + 1)],
            scaled: vec![T::ZERO; m],
            f: vec![T::ZERO; n + m],
            scratch: vec![T::ZERO; solver.n_scratch()],
            solver,
            saddle,
            n,
            m,
        }
    }

    /// Factors the saddle matrix at the last evaluated terms, those at `q`, with the weight `s` [s^2] of the stiffness.
    pub(crate) fn factor<M: Model<T>>(
        &mut self,
        model: &M,
        s: T,
        (q, lambda): (&[T], &[T]),
    ) -> Result<(), FactorError> {
        for (x, &l) in self.scaled.iter_mut().zip(lambda) {
            *x = l * s;
        }
        for e in 0..model.n_elements() {
            model.write_jacobian(&self.terms, e, &mut self.jacobian[self.saddle.jacobian(e)]);
        }
        let geometric = (s != T::ZERO).then_some(&self.scaled[..]);
        let tangent = Tangent { stiffness: s, damping: T::ZERO, penalty: &[], geometric };
        sum_diagonal(model, &self.terms, &tangent, &mut self.local, &mut self.diagonal);
        weigh(&self.sizes, &self.sizes, &mut self.diagonal);
        let least = norm_inf(&self.diagonal) * T::from_f64(LIGHT);
        for e in 0..model.n_elements() {
            let clique = model.clique(e);
            let rows = &self.jacobian[self.saddle.jacobian(e)];
            for (row, g) in model.rows(e).zip(rows.chunks_exact(clique.len().max(1))) {
                let (mut square, mut largest, mut weight) = (T::ZERO, T::ZERO, least);
                for (&u, &g) in clique.iter().zip(g).filter(|(_, g)| **g != T::ZERO) {
                    let g = g * self.sizes[u as usize];
                    square += g * g;
                    largest = largest.max(g.abs());
                    weight = weight.max(self.diagonal[u as usize].abs());
                }
                self.row_sizes[row] = if largest > T::ZERO { largest } else { T::ONE };
                let compliance = square / if weight > T::ZERO { weight } else { T::ONE };
                self.delta[row] = compliance * T::from_f64(DELTA);
            }
        }
        let system = SaddleSystem {
            model,
            saddle: &self.saddle,
            terms: &self.terms,
            tangent,
            jacobian: &self.jacobian,
            delta: &self.delta,
            load: Load { mass: None, multipliers: None, force: T::ZERO },
            rates: &[],
        };
        self.solver.factor(&Curved { system, at: geometric.map(|lambda| (q, lambda)) })
    }

    /// Solves with the saddle matrix, (d, e) = (saddle matrix)^-1 (b, c), in place in `f`.
    pub(crate) fn solve(&mut self) {
        self.solver.solve(&mut self.f, &mut self.scratch);
    }

    /// The diagonal of M + s (K + K_geo) at the last factorisation, times the squared sizes of the coordinates [J s^2].
    pub(crate) fn diagonal(&self) -> &[T] {
        &self.diagonal
    }

    /// Returns the largest displacement of a coordinate relative to its size [-].
    pub(crate) fn extent(&self, x: &[T]) -> T {
        let ratios = x.iter().zip(&self.sizes).map(|(&x, &size)| x / size);
        largest_of(ratios)
    }

    /// Returns the largest work of a force along the size of its coordinate [J].
    pub(crate) fn work(&self, force: &[T]) -> T {
        largest_of(force.iter().zip(&self.sizes).map(|(&f, &size)| f * size))
    }

    /// Returns the largest violation of a row, relative to the change of the row by a coordinate's size [-]. Rows are those of the last
    /// factorisation.
    pub(crate) fn openness(&self, rows: &[T]) -> T {
        largest_of(rows.iter().zip(&self.row_sizes).map(|(&x, &size)| x / size))
    }

    /// Evaluates residual = M a + J^T lambda - Q. Returns the largest sum of absolute terms, as work along a coordinate's size [J].
    pub(crate) fn residual<M: Model<T>>(
        &mut self,
        model: &M,
        mass: Option<&[T]>,
        lambda: &[T],
        residual: &mut [T],
    ) -> T {
        let nothing = Load { mass: None, multipliers: None, force: T::ZERO };
        let parts = [
            Load { mass, ..nothing },
            Load { multipliers: Some(lambda), ..nothing },
            Load { force: T::ONE, ..nothing },
        ];
        residual.fill(T::ZERO);
        self.diagonal.fill(T::ZERO);
        for load in &parts[usize::from(mass.is_none())..] {
            for e in 0..model.n_elements() {
                let clique = model.clique(e);
                let local = &mut self.local[..clique.len()];
                model.write_residual(&self.terms, load, e, local);
                for (&u, &x) in clique.iter().zip(&*local) {
                    residual[u as usize] += x;
                    self.diagonal[u as usize] += x.abs();
                }
            }
        }
        self.work(&self.diagonal)
    }

    /// Returns the largest acceleration that a single term of the last residual would cause, relative to the sizes of coordinates [1/s^2].
    /// Rounding errors are relative to it. Coordinates with little mass are left out.
    pub(crate) fn liveliness<M: Model<T>>(&mut self, model: &M) -> T {
        let forces = self.diagonal.clone();
        let tangent =
            Tangent { stiffness: T::ZERO, damping: T::ZERO, penalty: &[], geometric: None };
        sum_diagonal(model, &self.terms, &tangent, &mut self.local, &mut self.diagonal);
        weigh(&self.sizes, &self.sizes, &mut self.diagonal);
        let floor = norm_inf(&self.diagonal) * T::from_f64(LIGHT);
        let work = forces.iter().zip(&self.sizes).map(|(&f, &size)| f * size);
        work.zip(&self.diagonal)
            .fold(T::ZERO, |most, (f, &m)| if m > floor { most.max(f / m) } else { most })
    }
}

/// A saddle system, to which the second derivatives of its rows are added if positions and multipliers are given.
struct Curved<'a, T, M> {
    system: SaddleSystem<'a, T, M>,
    at: Option<(&'a [T], &'a [T])>,
}

impl<T: Real, M: Model<T>> BlockSource<T> for Curved<'_, T, M> {
    fn write_block(&self, element: usize, block: &mut [T]) {
        self.system.write_block(element, block);
        let (model, Some((q, lambda))) = (self.system.model, self.at) else { return };
        let weights = (lambda, self.system.tangent.stiffness);
        let curvature = model.row_curvature(q, self.system.terms, weights, element);
        let (k, rows) = (model.clique(element).len(), model.rows(element).len());
        // a column of the block has additional entries for the rows
        let (mut from, mut to) = (0, 0);
        for length in (1..=k).rev().take_while(|_| !curvature.is_empty()) {
            let column = block[to..to + length].iter_mut();
            column.zip(&curvature[from..]).for_each(|(to, &x)| *to += x);
            (from, to) = (from + length, to + length + rows);
        }
    }

    fn write_residual(&self, element: usize, residual: &mut [T]) {
        self.system.write_residual(element, residual);
    }
}

/// Multiplies each entry: x_u *= a_u b_u.
fn weigh<T: Real>(a: &[T], b: &[T], x: &mut [T]) {
    for (x, (&a, &b)) in x.iter_mut().zip(a.iter().zip(b)) {
        *x *= a * b;
    }
}

/// Returns the largest absolute value, or a NaN if there is one.
fn largest_of<T: Real>(x: impl Iterator<Item = T>) -> T {
    x.fold(T::ZERO, |most, x| if x.abs() <= most || !(most >= T::ZERO) { most } else { x.abs() })
}

/// Computes the diagonal of the sum of all blocks.
fn sum_diagonal<T: Real, M: Model<T>>(
    model: &M,
    terms: &Terms<T>,
    tangent: &Tangent<'_, T>,
    local: &mut [T],
    diagonal: &mut [T],
) {
    diagonal.fill(T::ZERO);
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        let k = clique.len();
        let block = &mut local[..k * (k + 1) / 2];
        model.write_block(terms, tangent, e, block);
        let mut at = 0;
        for (j, &u) in clique.iter().enumerate() {
            diagonal[u as usize] += block[at];
            at += k - j;
        }
    }
}
