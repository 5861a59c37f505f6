//! The border between mechanics and algebra.
//!
//! A model is a sum of small elements, each touching a few coordinates. [`Cliques`] says which, [`BlockSource`]
//! gives the numbers, a [`SpdSolver`] decides who is asked when: dense, serial multifrontal and threaded solvers
//! differ nowhere else, and formulations are generic over them. Saddle systems have a [`SymmetricSolver`].
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
    /// Unknowns from here on are multipliers: their diagonal may be zero, so that a solver of saddle systems eliminates each
    /// of them after the other unknowns of its elements. Without multipliers it is `n_unknowns()`.
    fn n_primal(&self) -> usize {
        self.n_unknowns()
    }
}

/// The numbers of a sum of elements at one state. Elements may be asked for by several threads at the same time.
pub trait BlockSource<T: Real>: Sync {
    /// Writes the lower triangle of the symmetric block of `element`, packed column by column:
    /// (0,0), (1,0), ..., (k-1,0), (1,1), (2,1), ... ; `block` has k (k + 1) / 2 places, all are written.
    fn write_block(&self, element: usize, block: &mut [T]);
    /// Writes the residual of `element` in the order of its clique; `residual` has k places, all are written.
    fn write_residual(&self, element: usize, residual: &mut [T]);
    /// Has the block of `element` a number that is not zero? One that has none need not be written and added.
    #[inline]
    fn has_block(&self, _element: usize) -> bool {
        true
    }
    /// Sums the residuals of all elements into `f` (overwritten), in the order of the elements, where the source has its own method with
    /// the same bits. Else `false`, and `f` is anything.
    #[inline]
    fn sum_residuals(&self, _f: &mut [T]) -> bool {
        false
    }
}

/// `out[u]` = `start` joined with what every element writes for u, in the order of the elements.
///
/// `write` has one place in a stretch of `values` for each unknown of the element's clique.
#[inline(always)]
pub fn combine<'a, T: Copy>(
    cliques: impl Iterator<Item = &'a [u32]>,
    (values, out): (&mut [T], &mut [T]),
    start: T,
    write: impl Fn(usize, &mut [T]),
    join: impl Fn(T, T) -> T,
) {
    out.fill(start);
    for (e, clique) in cliques.enumerate() {
        let values = &mut values[..clique.len()];
        write(e, values);
        for (&u, &value) in clique.iter().zip(&*values) {
            out[u as usize] = join(out[u as usize], value);
        }
    }
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

/// A solver for symmetric matrices that need not be definite, such as saddle systems. Analysis has been done when the
/// solver exists; it chooses its pivots by the numbers.
///
/// ```text
/// T = [ W   J^T ]      regular exactly when J has full rank and W is definite where J x = 0
///     [ J    0  ]      inertia: n positive, m negative, no zero pivots when W is positive there
/// ```
pub trait SymmetricSolver<T: Real> {
    /// Assembles and factors T, the sum of the blocks of `source`.
    ///
    /// # Errors
    /// [`FactorError`] when T is singular to rounding: names an unknown that the rest does not determine, with the largest
    /// pivot left there relative to what it was the sum of. `solve` is then unusable until the next success;
    /// [`inertia`](Self::inertia), [`weakest`](Self::weakest) and [`null_vector`](Self::null_vector) describe the failure.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError>;

    /// Replaces `x` (n places) by the solution of T x = b, given b in `x`.
    fn solve(&self, x: &mut [T], scratch: &mut [T]);

    /// Places that `solve` and `null_vector` need in `scratch`, whatever the numbers.
    fn n_scratch(&self) -> usize;

    /// Sums the residuals of the elements of `source` into `f` (n places, overwritten), in the order of the elements.
    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]);

    /// b <- b - T x with the matrix of the last factorisation, element by element.
    fn subtract_product(&self, x: &[T], b: &mut [T]);

    /// Signs of the pivots of the last factorisation.
    fn inertia(&self) -> Inertia;

    /// The pivot of the last factorisation that was smallest relative to what it was the sum of.
    fn weakest(&self) -> Weakest;

    /// x with T x nearly zero: the combination that the weakest pivot leaves nearly undetermined, 1 at its unknown.
    fn null_vector(&self, x: &mut [T], scratch: &mut [T]);

    /// One step of iterative refinement: improves the solution `x` of T x = b; `b` is used up.
    fn refine(&self, x: &mut [T], b: &mut [T], scratch: &mut [T]) {
        self.subtract_product(x, b);
        self.solve(b, scratch);
        for (x, &d) in x.iter_mut().zip(&*b) {
            *x += d;
        }
    }
}

/// Number of pivots of each sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inertia {
    /// Number of positive pivots.
    pub positive: usize,
    /// Number of negative pivots.
    pub negative: usize,
    /// Number of pivots that are zero to rounding.
    pub zero: usize,
}

/// The pivot that is smallest relative to what it was the sum of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weakest {
    /// Unknown of the pivot; `u32::MAX` without unknowns.
    pub unknown: u32,
    /// |pivot| over the sum of the absolute values that it is made of, in the equilibrated matrix [-], at most 1: the share
    /// that cancellation left. Digits of the solution are lost in this proportion.
    pub ratio: f64,
}

/// A pivot was zero, negative where it must not be, or not a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FactorError {
    /// The unknown at whose elimination it happened.
    pub unknown: u32,
    /// Pivot that was found; of a [`SymmetricSolver`] relative to what it was the sum of.
    pub pivot: f64,
}

impl core::fmt::Display for FactorError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "pivot {:e} at unknown {}: the matrix is singular, or not positive definite where it must be",
            self.pivot, self.unknown
        )
    }
}

impl core::error::Error for FactorError {}
