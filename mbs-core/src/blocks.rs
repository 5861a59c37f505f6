//! The border between mechanics and algebra.
//!
//! A model is a sum of small elements, each touching a few coordinates. [`Cliques`] says which, [`BlockSource`]
//! gives the numbers, a [`SpdSolver`] decides who is asked when: dense, serial multifrontal and threaded solvers
//! differ nowhere else, and formulations are generic over them.
//!
//! ```text
//! T = sum_e  P_e^T  T_e  P_e          T_e symmetric, k_e x k_e, k_e = length of clique e
//! f = sum_e  P_e^T  f_e               P_e picks the unknowns of element e
//! ```

use crate::Real;

/// Which unknowns each element couples. Fixed for the life of a model.
pub trait Cliques {
    /// Number of unknowns n.
    fn n_unknowns(&self) -> usize;
    /// Number of elements.
    fn n_elements(&self) -> usize;
    /// The distinct unknowns, each `< n_unknowns()`, of one element, in the element's own local order.
    fn clique(&self, element: usize) -> &[u32];
}

/// The numbers of a sum of elements at one state.
pub trait BlockSource<T: Real> {
    /// Writes the lower triangle of the symmetric block of `element`, packed column by column:
    /// (0,0), (1,0), ..., (k-1,0), (1,1), (2,1), ... ; `block` has k (k + 1) / 2 places, all are written.
    fn write_block(&self, element: usize, block: &mut [T]);
    /// Writes the residual of `element` in the order of its clique; `residual` has k places, all are written.
    fn write_residual(&self, element: usize, residual: &mut [T]);
}

/// A solver for the symmetric positive definite matrix of a sum of elements. Analysis has been done when the
/// solver exists; no method allocates.
pub trait SpdSolver<T: Real> {
    /// Assembles and factors T, the sum of the blocks of `source`.
    ///
    /// # Errors
    /// [`FactorError`] when a pivot is not positive; the factor is then unusable until the next success.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError>;

    /// Replaces `x` (n places) by the solution of T x = b, given b in `x`.
    fn solve(&self, x: &mut [T], scratch: &mut [T]);

    /// Places that `solve` needs in `scratch`.
    fn n_scratch(&self) -> usize;

    /// Sums the residuals of the elements of `source` into `f` (n places, overwritten), in the order of the elements.
    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]);

    /// The pivots of the last successful factorisation (D of L D L^T), in the order of elimination.
    fn pivots(&self) -> &[T];

    /// The unknown that was eliminated at each place of [`pivots`](Self::pivots).
    fn elimination_order(&self) -> &[u32];
}

/// A pivot was zero, negative or not a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FactorError {
    /// The unknown at whose elimination it happened.
    pub unknown: u32,
    /// The pivot found.
    pub pivot: f64,
}

impl core::fmt::Display for FactorError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "pivot {:e} at unknown {}: the matrix is not positive definite",
            self.pivot, self.unknown
        )
    }
}

impl core::error::Error for FactorError {}
