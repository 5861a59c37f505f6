//! Interface between the mechanics and the linear solvers.
//!
//! A model is a sum of small elements, each with a few of the unknowns. [`Cliques`] lists the unknowns of each element, and [`BlockSource`]
//! computes the numbers. A [`SpdSolver`] decides the order of the elements and the threads that compute them. Formulations are generic over
//! the solver: dense, serial multifrontal or threaded. Saddle systems are solved by a [`SymmetricSolver`].
//!
//! ```text
//! T = sum_e  P_e^T  T_e  P_e          T_e symmetric, k_e x k_e, k_e = length of clique e
//! f = sum_e  P_e^T  f_e               P_e picks the unknowns of element e
//! ```

use crate::Real;

/// Lists of the unknowns that each element couples. The lists do not change during the life of a model.
pub trait Cliques {
    /// Number of unknowns n.
    fn n_unknowns(&self) -> usize;
    /// Number of elements of the model.
    fn n_elements(&self) -> usize;
    /// The unknowns of one element, distinct and each `< n_unknowns()`, in the element's local order.
    fn clique(&self, element: usize) -> &[u32];
    /// Index of the first multiplier. The unknowns from this index on are multipliers, whose diagonal may be zero. A solver of saddle
    /// systems therefore eliminates each multiplier after the other unknowns of its elements. Without multipliers the index is
    /// `n_unknowns()`.
    fn n_primal(&self) -> usize {
        self.n_unknowns()
    }
}

/// The blocks and residuals of all elements at one state. Several threads may ask for elements at the same time.
pub trait BlockSource<T: Real>: Sync {
    /// Writes the lower triangle of the symmetric block of `element`, packed column by column:
    /// (0,0), (1,0), ..., (k-1,0), (1,1), (2,1), ... . All k (k + 1) / 2 places of `block` are written, where k is the length of the
    /// element's clique.
    fn write_block(&self, element: usize, block: &mut [T]);
    /// Writes the residual of `element` in the order of its clique. All k places of `residual` are written, where k is the length of the
    /// clique.
    fn write_residual(&self, element: usize, residual: &mut [T]);
    /// True if the block of `element` has a number that is not zero. A solver may leave out a block for which this is `false`.
    #[inline]
    fn has_block(&self, _element: usize) -> bool {
        true
    }
    /// Sums the residuals of all elements into `f` (overwritten), in the order of the elements. A source overrides this where it has a
    /// faster method whose sums are identical to the last bit. Returns `false` where the source has no such method; the contents of `f` are
    /// then undefined.
    #[inline]
    fn sum_residuals(&self, _f: &mut [T]) -> bool {
        false
    }
}

/// Accumulates values of the elements for each unknown u: `out[u]` begins as `start`. Each element that has u then replaces it by
/// `join(out[u], value)`, in the order of the elements.
///
/// `write(e, values)` writes the values of element e into a slice with one place for each unknown of its clique.
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

/// A solver for the symmetric positive definite matrix of a sum of elements. The symbolic analysis is done when the solver is made, and no
/// method allocates.
pub trait SpdSolver<T: Real> {
    /// Assembles and factors T, the sum of the blocks of `source`.
    ///
    /// # Errors
    /// [`FactorError`] when a pivot is not positive. The factor is then unusable until the next success.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError>;

    /// Replaces `x` (n places) by the solution of T x = b, given b in `x`.
    fn solve(&self, x: &mut [T], scratch: &mut [T]);

    /// Number of places that `solve` needs in `scratch`.
    fn n_scratch(&self) -> usize;

    /// Sums the residuals of the elements of `source` into `f` (n places, overwritten), in the order of the elements.
    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]);

    /// The pivots of the last successful factorisation (D of L D L^T), in the order of elimination.
    fn pivots(&self) -> &[T];

    /// The unknown that was eliminated at each place of [`pivots`](Self::pivots).
    fn elimination_order(&self) -> &[u32];
}

/// A solver for symmetric matrices that need not be definite, such as saddle systems. The symbolic analysis is done when the solver is made.
/// The pivots are chosen by the values of the entries of each matrix.
///
/// ```text
/// T = [ W   J^T ]      regular exactly when J has full rank and W is definite where J x = 0
///     [ J    0  ]      inertia: n positive, m negative, no zero pivots when W is positive there
/// ```
pub trait SymmetricSolver<T: Real> {
    /// Assembles and factors T, the sum of the blocks of `source`.
    ///
    /// # Errors
    /// [`FactorError`] when T is singular to machine precision. The error names an unknown that the other unknowns do not determine. It has
    /// the largest pivot left for that unknown, relative to the sum of the absolute values that the pivot was computed from. `solve` is
    /// then unusable until the next success, while [`inertia`](Self::inertia), [`weakest`](Self::weakest) and
    /// [`null_vector`](Self::null_vector) describe the failure.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError>;

    /// Replaces `x` (n places) by the solution of T x = b, given b in `x`.
    fn solve(&self, x: &mut [T], scratch: &mut [T]);

    /// Number of places that `solve` and `null_vector` need in `scratch`, for any numbers of the matrix.
    fn n_scratch(&self) -> usize;

    /// Sums the residuals of the elements of `source` into `f` (n places, overwritten), in the order of the elements.
    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]);

    /// Subtracts T x from `b`, element by element, with the matrix of the last factorisation.
    fn subtract_product(&self, x: &[T], b: &mut [T]);

    /// Signs of the pivots of the last factorisation.
    fn inertia(&self) -> Inertia;

    /// The pivot of the last factorisation that was smallest relative to the sum of the absolute values that it was computed from.
    fn weakest(&self) -> Weakest;

    /// Writes a vector x for which T x is nearly zero. The weakest pivot determines this combination of unknowns least; the unknown of that
    /// pivot has the value 1.
    fn null_vector(&self, x: &mut [T], scratch: &mut [T]);

    /// Improves the solution `x` of T x = b by one step of iterative refinement; `b` is overwritten.
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
    /// Number of pivots that are zero to machine precision.
    pub zero: usize,
}

/// The pivot that is smallest relative to the sum of the absolute values that it was computed from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weakest {
    /// Unknown of the pivot; `u32::MAX` when there are no unknowns.
    pub unknown: u32,
    /// |pivot| divided by the sum of the absolute values that it was computed from, in the equilibrated matrix [-], at most 1. Cancellation
    /// makes this ratio small, and the solution loses digits in the same proportion.
    pub ratio: f64,
}

/// A failed factorisation: a pivot was zero, negative where it must be positive, or not a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FactorError {
    /// The unknown whose elimination failed.
    pub unknown: u32,
    /// Pivot that was found; for a [`SymmetricSolver`] relative to the sum of the absolute values that it was computed from.
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
