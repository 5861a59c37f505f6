//! Factorisation L D L^T of a sum of element blocks, front by front, without a matrix of all unknowns. Subtrees are tasks for a [`Team`].
//!
//! ```text
//! front_s = sum of elements whose first unknown it eliminates + sum of updates of its children
//!         = [ L_11    ] [ D      ] [ L_11^T  L_21^T ]
//!           [ L_21  I ] [     U  ] [         I      ]          U: update for the parent
//! ```

use crate::options::{Counters, Options, Pivoting};
use crate::plan::{Plan, plan};
use crate::scatter::Scatter;
use crate::subtree::{Factor, Numbers, Vectors};
use crate::sweep;
use mbs_math::team::{Alone, Team, on_stretches};
use mbs_math::{BlockSource, Cliques, FactorError, Real, SpdSolver};

/// Multifrontal L D L^T: analysed once, factored many times without allocation, by one thread or by a team.
#[derive(Debug, Clone)]
pub struct Multifrontal<T: Real, W: Team = Alone> {
    plan: Plan,
    pivoting: Pivoting,
    team: W,
    /// All fronts, with space for one block for each task.
    fronts: Vec<T>,
    pivots: Vec<T>,
    /// Unknowns in the elimination order of the last factorisation.
    order: Vec<u32>,
    /// True if there is only one front, in the given order and without pivoting.
    is_one_block: bool,
    /// For each pivot, the row of its front from which [`Pivoting::Diagonal`] moved it.
    taken: Vec<u32>,
    residuals: Scatter<T>,
}

impl<T: Real> Multifrontal<T> {
    /// Orders the unknowns, finds the fronts and fixes all index maps.
    ///
    /// Cost: nearly linear in the sum of the squared lengths of the cliques plus the entries of L. Nothing is allocated later.
    ///
    /// # Panics
    /// When a clique names an unknown that does not exist, or one unknown twice; with more than 2^32 - 1 unknowns,
    /// elements or scattered entries.
    pub fn analyse(cliques: &impl Cliques, options: Options) -> Self {
        Self::on(Alone, cliques, options)
    }
}

impl<T: Real, W: Team> Multifrontal<T, W> {
    /// Analyses the cliques as [`analyse`](Multifrontal::analyse) does, for a team. The results have the same bits for every team.
    ///
    /// # Panics
    /// As [`analyse`](Multifrontal::analyse).
    pub fn on(team: W, cliques: &impl Cliques, options: Options) -> Self {
        Self::planned(team, plan(cliques, options), options.pivoting)
    }

    /// Returns the same analysis for another team; the factorisation is lost.
    pub fn with_team<V: Team>(self, team: V) -> Multifrontal<T, V> {
        Multifrontal::planned(team, self.plan, self.pivoting)
    }

    fn planned(team: W, plan: Plan, pivoting: Pivoting) -> Self {
        let n_taken = if pivoting == Pivoting::Diagonal { plan.order.len() } else { 0 };
        Self {
            pivoting,
            residuals: Scatter::new(&team, &plan),
            team,
            is_one_block: plan.fronts.len() == 1 && plan.is_natural && n_taken == 0,
            fronts: vec![T::ZERO; plan.tasks.sizes[0]],
            pivots: vec![T::ZERO; plan.order.len()],
            order: plan.order.clone(),
            taken: vec![0; n_taken],
            plan,
        }
    }

    /// Exact sizes of this analysis.
    pub fn counters(&self) -> Counters {
        self.plan.counters
    }

    /// Number of subtrees that threads can factor at the same time. More threads than this have no work. `≥ 1` if there are unknowns.
    pub fn n_branches(&self) -> usize {
        self.plan.tasks.n_leaves()
    }

    /// Makes both sweeps with the right-hand side `x`. Writes the solution to `storage`, in the order of the tasks.
    fn sweep(&self, x: &[T], storage: &mut [T]) {
        let fronts = Factor { plan: &self.plan, fronts: &self.fronts, taken: &self.taken };
        let vectors = Vectors { plan: &self.plan, team: &self.team, fronts };
        vectors.solve(x, storage);
    }

    /// Copies a vector from the storage of the tasks to the order of the unknowns.
    fn gather(&self, storage: &[T], x: &mut [T]) {
        on_stretches(&self.team, [x], |first, [x]| {
            for (x, &at) in x.iter_mut().zip(&self.plan.tasks.stored_at[first..]) {
                *x = storage[at as usize];
            }
        });
    }
}

impl<T: Real, W: Team> SpdSolver<T> for Multifrontal<T, W> {
    /// Factors the blocks of the source. Fails with the first pivot that is zero, negative, infinite or not a number.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError> {
        let numbers = Numbers {
            fronts: &mut self.fronts,
            pivots: &mut self.pivots,
            order: &mut self.order,
            taken: &mut self.taken,
        };
        numbers.factor((&self.plan, self.pivoting), &self.team, source)
    }

    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        let n = self.plan.order.len();
        assert_eq!(x.len(), n, "solve needs one number for each unknown");
        assert!(scratch.len() >= self.n_scratch(), "solve needs n_scratch() places");
        if self.is_one_block && sweep::solve_small(&self.fronts, x) {
            return;
        }
        let storage = &mut scratch[..self.plan.tasks.sizes[1]];
        self.sweep(x, storage);
        self.gather(storage, x);
    }

    fn n_scratch(&self) -> usize {
        self.plan.tasks.sizes[1]
    }

    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        assert_eq!(f.len(), self.plan.order.len(), "assemble needs one place for each unknown");
        self.residuals.sum(&self.team, &self.plan.cliques, source, f);
    }

    fn pivots(&self) -> &[T] {
        &self.pivots
    }

    fn elimination_order(&self) -> &[u32] {
        &self.order
    }
}
