//! Solutions with more digits than the factor of their matrix: [`Refined`] factors in `f64` and solves in a finer scalar.
//!
//! ```text
//! T = L D L^T in f64,   x = 0,   r = b
//! d = (L D L^T)^-1 r,   x += d,   r = b - sum_e P_e^T T_e P_e x in the finer scalar        until d is rounding
//! ```
//!
//! Each correction multiplies the error by about cond(T) times the machine precision of `f64`. A double-double solution therefore has all
//! its digits after 32 / (16 - log10 cond) corrections, and cond(T) must stay below 1e15. Residuals are sums over the blocks of the
//! elements. An assembled matrix in `f64` would lose the mass that is added to a large penalty; the blocks in the finer scalar do not.
//!
//! A formulation that solves for corrections of its own residual needs no refinement, since its next residual refines the solution
//! ([`Refined::most`] is then 1). A formulation that solves for the vector itself needs it, as the published projections do [P1 (13),
//! (19)].

use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::{BlockSource, Cliques, FactorError, SpdSolver, combine};
use crate::dense::front::column;
use crate::dense::lists::Lists;
use crate::dense::scaling::subtract_product;
use alloc::vec;
use alloc::vec::Vec;
use core::cell::{Cell, RefCell};

/// A solver in the scalar `T` that uses a solver in `f64`.
///
/// Cost besides the inner solver: a factorisation copies the blocks of all elements, in the finer scalar. Each correction after the first
/// takes a product with these blocks, two operations for each entry, and one solution in `f64`.
#[derive(Debug, Clone)]
pub struct Refined<T, S> {
    solver: S,
    most: u32,
    cliques: Lists,
    /// The blocks of the last factorisation, one after the other.
    blocks: Vec<T>,
    /// Start of the block of each element, and the end of the last block.
    places: Vec<usize>,
    /// Residual of one element, while residuals are summed.
    values: Vec<T>,
    pivots: Vec<T>,
    room: RefCell<Room>,
    tally: Cell<Tally>,
}

/// Work vectors of a solution in `f64`. They are in a `RefCell`, since `solve` has no write access to the solver.
#[derive(Debug, Clone)]
struct Room {
    x: Vec<f64>,
    scratch: Vec<f64>,
}

/// Counts of the solutions since the last [`Refined::take_tally`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Number of solutions that were requested.
    pub solutions: u64,
    /// Number of corrections of the solutions that succeeded, each a solution in `f64`. The first correction of a solution is the solution
    /// with the factor alone.
    pub corrections: u64,
    /// Number of solutions that did not reach the digits of `T`.
    pub failed: u64,
    /// Error of the last solution that failed.
    pub failure: Option<RefinementError>,
}

/// Error of a refinement that did not reach the digits of the finer scalar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RefinementError {
    /// A correction was more than half of the previous one: the condition number of the matrix is too large for the precision of the
    /// factor. Remedy: a smaller penalty, or a factor in the finer scalar.
    Stalled {
        /// Number of corrections made.
        corrections: u32,
        /// The last correction relative to the previous one [-].
        contraction: f64,
        /// The last correction relative to the solution [-].
        left: f64,
    },
    /// All allowed corrections were made, and the last one was above the machine precision. Remedy: allow more.
    Unfinished {
        /// Number of corrections made.
        corrections: u32,
        /// The last correction relative to the solution [-].
        left: f64,
    },
    /// A correction was not finite.
    NotFinite,
}

impl core::fmt::Display for RefinementError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Stalled { corrections, contraction, left } => write!(
                f,
                "refinement stalled: correction {corrections} is {contraction:.1e} of the one before and {left:.1e} of the \
                 solution; the matrix is too ill-conditioned for its factor"
            ),
            Self::Unfinished { corrections, left } => {
                write!(
                    f,
                    "refinement not finished: correction {corrections} is {left:.1e} of the solution"
                )
            }
            Self::NotFinite => write!(f, "refinement failed: a correction is not a number"),
        }
    }
}

impl core::error::Error for RefinementError {}

/// Number of corrections that gives all digits of a double-double [-]: enough when each correction halves the error or does better.
pub const ALL: u32 = 100;

impl<T: Real, S: SpdSolver<f64>> Refined<T, S> {
    /// A refined solver over `solver`, which was analysed for the same `cliques`. At most `most` corrections make a solution: one gives the
    /// digits of the factor, [`ALL`] continue to the machine precision of `T`. Only this function allocates.
    pub fn new(cliques: &impl Cliques, solver: S, most: u32) -> Self {
        let n = cliques.n_unknowns();
        let cliques = Lists::of(cliques);
        let mut places = vec![0];
        places.extend(cliques.iter().scan(0, |end, clique| {
            *end += column(clique.len(), clique.len());
            Some(*end)
        }));
        Self {
            blocks: vec![T::ZERO; places.last().copied().unwrap_or(0)],
            places,
            values: vec![T::ZERO; cliques.largest()],
            cliques,
            pivots: vec![T::ZERO; n],
            room: RefCell::new(Room { x: vec![0.0; n], scratch: vec![0.0; solver.n_scratch()] }),
            tally: Cell::default(),
            solver,
            most,
        }
    }

    /// Largest number of corrections that make a solution.
    pub fn most(&self) -> u32 {
        self.most
    }

    /// Returns the counts of the solutions since the last call, and resets them.
    pub fn take_tally(&self) -> Tally {
        self.tally.take()
    }

    /// Replaces `x` (n places) by the solution of T x = b, given b in `x`, with [`n_scratch`](SpdSolver::n_scratch) places of `scratch`.
    /// Returns the number of corrections. When only one correction is allowed, its accuracy is not checked.
    ///
    /// # Errors
    /// [`RefinementError`]; `x` is then the last solution that was reached.
    pub fn refine(&self, x: &mut [T], scratch: &mut [T]) -> Result<u32, RefinementError> {
        let (residual, rest) = scratch.split_at_mut(x.len());
        let d = &mut rest[..x.len()];
        residual.copy_from_slice(x);
        x.fill(T::ZERO);
        let goal = T::EPSILON.to_f64();
        let (mut last, mut contraction) = (f64::INFINITY, 1.0);
        for corrections in 1..=self.most {
            let size = self.correction(residual, d);
            if !size.is_finite() {
                return Err(RefinementError::NotFinite);
            }
            if corrections > 1 {
                contraction = size / last;
                if contraction > 0.5 {
                    let left = last / norm_inf(x).to_f64();
                    return Err(RefinementError::Stalled { corrections, contraction, left });
                }
            }
            x.iter_mut().zip(&*d).for_each(|(x, &d)| *x += d);
            last = size;
            // The next correction would be smaller by the same factor, so it is predicted and need not be made.
            let is_rounding = size * contraction <= goal * norm_inf(x).to_f64();
            if is_rounding || self.most == 1 {
                return Ok(corrections);
            }
            if corrections < self.most {
                self.subtract_product(d, residual);
            }
        }
        let left = last / norm_inf(x).to_f64();
        Err(RefinementError::Unfinished { corrections: self.most, left })
    }

    /// Sets d = (L D L^T)^-1 r in `f64`. Returns the largest absolute value of d; it is not finite when a number in d is not.
    fn correction(&self, r: &[T], d: &mut [T]) -> f64 {
        let mut room = self.room.borrow_mut();
        let Room { x, scratch } = &mut *room;
        x.iter_mut().zip(r).for_each(|(x, r)| *x = r.to_f64());
        self.solver.solve(x, scratch);
        d.iter_mut().zip(&*x).for_each(|(d, &x)| *d = T::from_f64(x));
        norm_inf(x)
    }

    /// Subtracts T d from the residual `r`, element by element.
    fn subtract_product(&self, d: &[T], r: &mut [T]) {
        for (clique, ends) in self.cliques.iter().zip(self.places.windows(2)) {
            subtract_product(clique, &self.blocks[ends[0]..ends[1]], d, r);
        }
    }
}

/// The blocks rounded to `f64`, for the inner solver.
struct Rounded<'a, T> {
    blocks: &'a [T],
    places: &'a [usize],
}

impl<T: Real> BlockSource<f64> for Rounded<'_, T> {
    fn write_block(&self, element: usize, block: &mut [f64]) {
        let from = &self.blocks[self.places[element]..self.places[element + 1]];
        block.iter_mut().zip(from).for_each(|(low, x)| *low = x.to_f64());
    }
    fn write_residual(&self, _: usize, residual: &mut [f64]) {
        residual.fill(0.0);
    }
}

impl<T: Real, S: SpdSolver<f64>> SpdSolver<T> for Refined<T, S> {
    fn factor<B: BlockSource<T>>(&mut self, source: &B) -> Result<(), FactorError> {
        for (e, ends) in self.places.windows(2).enumerate() {
            source.write_block(e, &mut self.blocks[ends[0]..ends[1]]);
        }
        self.solver.factor(&Rounded { blocks: &self.blocks, places: &self.places })?;
        for (pivot, &low) in self.pivots.iter_mut().zip(self.solver.pivots()) {
            *pivot = T::from_f64(low);
        }
        Ok(())
    }

    /// Solves T x = b by [`refine`](Refined::refine). An error of the refinement is stored in the [`Tally`], and `x` is then the last
    /// solution that was reached.
    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        let mut tally = self.tally.get();
        tally.solutions += 1;
        match self.refine(x, scratch) {
            Ok(corrections) => tally.corrections += u64::from(corrections),
            Err(error) => {
                tally.failed += 1;
                tally.failure = Some(error);
            }
        }
        self.tally.set(tally);
    }

    fn n_scratch(&self) -> usize {
        2 * self.pivots.len()
    }
    fn assemble<B: BlockSource<T>>(&mut self, source: &B, f: &mut [T]) {
        let write = |e: usize, residual: &mut [T]| source.write_residual(e, residual);
        combine(self.cliques.iter(), (&mut self.values, f), T::ZERO, write, |sum, x| sum + x);
    }

    /// Pivots with the precision of `f64`, in the order of elimination.
    fn pivots(&self) -> &[T] {
        &self.pivots
    }
    fn elimination_order(&self) -> &[u32] {
        self.solver.elimination_order()
    }
}
