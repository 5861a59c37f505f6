//! L D L^T of a sum of element blocks, front by front; no matrix of all unknowns is ever formed. Subtrees are tasks for a [`Team`].
//!
//! ```text
//! front_s = sum of elements whose first unknown it eliminates + sum of updates of its children
//!         = [ L_11    ] [ D      ] [ L_11^T  L_21^T ]
//!           [ L_21  I ] [     U  ] [         I      ]          U: update for the parent
//! ```

use crate::graph::Lists;
use crate::options::{Counters, Options, Pivoting};
use crate::plan::{Plan, plan};
use crate::share::{Numbers, Vectors};
use crate::sweep;
use mbs_core::team::{Alone, Team, on_stretches};
use mbs_core::{BlockSource, Cliques, FactorError, Real, SpdSolver};

/// Multifrontal L D L^T: analysed once, factored many times without allocation, by one thread or by a team.
#[derive(Debug, Clone)]
pub struct Multifrontal<T: Real, W: Team = Alone> {
    plan: Plan,
    pivoting: Pivoting,
    team: W,
    /// All fronts, with room for a block beside those of each task.
    fronts: Vec<T>,
    pivots: Vec<T>,
    /// Unknowns in the order in which they were eliminated last.
    order: Vec<u32>,
    /// Whether there is one front, in the given order and without pivoting.
    is_one_block: bool,
    /// For each pivot its row in its front before the swaps of [`Pivoting::Diagonal`].
    taken: Vec<u32>,
    /// Residuals of all elements; of one where the team is one.
    residuals: Vec<T>,
    /// For each unknown where it stands in `residuals`, in the order of the elements; empty where the team is one.
    parts: Lists,
}

impl<T: Real> Multifrontal<T> {
    /// Orders the unknowns, finds the fronts and freezes every index map.
    ///
    /// Cost: near linear in the sum of the squares of the cliques' lengths plus the entries of L; the only place that
    /// allocates.
    ///
    /// # Panics
    /// When a clique names an unknown that does not exist, or one unknown twice; with more than 2^32 - 1 unknowns,
    /// elements or scattered entries.
    pub fn analyse(cliques: &impl Cliques, options: Options) -> Self {
        Self::on(Alone, cliques, options)
    }
}

impl<T: Real, W: Team> Multifrontal<T, W> {
    /// As [`analyse`](Multifrontal::analyse), for a team. What it computes has the same bits whatever the team.
    ///
    /// # Panics
    /// As [`analyse`](Multifrontal::analyse).
    pub fn on(team: W, cliques: &impl Cliques, options: Options) -> Self {
        Self::planned(team, plan(cliques, options), options.pivoting)
    }

    /// The same analysis for another team; what was factored is lost.
    pub fn with_team<V: Team>(self, team: V) -> Multifrontal<T, V> {
        Multifrontal::planned(team, self.plan, self.pivoting)
    }

    fn planned(team: W, plan: Plan, pivoting: Pivoting) -> Self {
        let n_taken = if pivoting == Pivoting::Diagonal { plan.order.len() } else { 0 };
        let is_shared = team.size() > 1;
        let parts =
            if is_shared { by_unknown(&plan.cliques, plan.order.len()) } else { Lists::default() };
        let n_residuals = if is_shared { plan.cliques.items.len() } else { plan.largest_clique };
        Self {
            pivoting,
            team,
            is_one_block: plan.fronts.len() == 1 && plan.is_natural && n_taken == 0,
            fronts: vec![T::ZERO; plan.tasks.sizes[0]],
            pivots: vec![T::ZERO; plan.order.len()],
            order: plan.order.clone(),
            taken: vec![0; n_taken],
            residuals: vec![T::ZERO; n_residuals],
            parts,
            plan,
        }
    }

    /// The exact sizes of this analysis.
    pub fn counters(&self) -> Counters {
        self.plan.counters
    }

    /// Both sweeps on a vector in the storage of the tasks, of which `x` is the right-hand side.
    fn sweep(&self, x: &[T], storage: &mut [T]) {
        let vectors = Vectors {
            plan: &self.plan,
            team: &self.team,
            fronts: &self.fronts,
            taken: &self.taken,
            order: &self.plan.order,
            x,
        };
        vectors.solve(storage);
    }
}

/// For each unknown its places in the list of all cliques.
fn by_unknown(cliques: &Lists, n: usize) -> Lists {
    let single = Lists { start: (0..=cliques.items.len()).collect(), items: cliques.items.clone() };
    single.transposed(n)
}

impl<T: Real, W: Team> SpdSolver<T> for Multifrontal<T, W> {
    /// Fails with the first pivot that is zero, negative, infinite or not a number.
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
        let (storage, stored_at) = (&*storage, &self.plan.tasks.stored_at);
        on_stretches(&self.team, [x], |first, [x]| {
            for (x, &at) in x.iter_mut().zip(&stored_at[first..]) {
                *x = storage[at as usize];
            }
        });
    }

    fn n_scratch(&self) -> usize {
        self.plan.tasks.sizes[1]
    }

    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        assert_eq!(f.len(), self.plan.order.len(), "assemble needs one place for each unknown");
        let cliques = &self.plan.cliques;
        if self.team.size() == 1 {
            f.fill(T::ZERO);
            for e in 0..cliques.len() {
                let clique = cliques.get(e);
                let residual = &mut self.residuals[..clique.len()];
                source.write_residual(e, residual);
                for (&u, &value) in clique.iter().zip(&*residual) {
                    f[u as usize] += value;
                }
            }
            return;
        }
        write_residuals(&self.team, source, cliques, (0, cliques.len()), &mut self.residuals);
        let (residuals, parts) = (&self.residuals, &self.parts);
        on_stretches(&self.team, [f], |first, [f]| {
            for (u, f) in f.iter_mut().enumerate() {
                // In the order of the elements: the same bits as above.
                let places = parts.get(first + u).iter();
                *f = places.fold(T::ZERO, |sum, &at| sum + residuals[at as usize]);
            }
        });
    }

    fn pivots(&self) -> &[T] {
        &self.pivots
    }

    fn elimination_order(&self) -> &[u32] {
        &self.order
    }
}

/// Elements whose residuals one thread writes at a time.
const ELEMENTS: usize = 128;

/// Writes the residuals of elements `from..to` one after the other.
fn write_residuals<T: Real, W: Team, S: BlockSource<T>>(
    team: &W,
    source: &S,
    cliques: &Lists,
    (from, to): (usize, usize),
    residuals: &mut [T],
) {
    if to - from > ELEMENTS {
        let half = from + (to - from) / 2;
        let (left, right) = residuals.split_at_mut(cliques.start[half] - cliques.start[from]);
        team.join(
            || write_residuals(team, source, cliques, (from, half), left),
            || write_residuals(team, source, cliques, (half, to), right),
        );
        return;
    }
    let mut rest = residuals;
    for e in from..to {
        let (residual, tail) = rest.split_at_mut(cliques.get(e).len());
        source.write_residual(e, residual);
        rest = tail;
    }
}
