//! Factorisation L D L^T of a symmetric indefinite sum of blocks, front by front, with 1x1 and 2x2 pivots and delayed pivots.
//!
//! ```text
//! front_s = sum of S_e T_e S_e of its elements + updates of its children + unknowns its children could not eliminate
//!         = [ L_11    ] [ D      ] [ L_11^T  L_21^T ]          D of 1x1 and 2x2 blocks, S an equilibration
//!           [ L_21  I ] [     U  ] [         I      ]          U: update for the parent, what was delayed comes first
//! ```
//!
//! The method is that of Duff and Reid (ACM TOMS 9, 1983). Delayed unknowns come before the planned ones of a front, so that the index maps
//! of the analysis remain valid for the planned part. A factorisation without delays uses only these maps. A root accepts every pivot above
//! rounding errors. If the root cannot eliminate an unknown, the matrix is singular, and the error names the unknown.
//!
//! Subtrees are tasks for a [`Team`], as those of [`Multifrontal`](crate::Multifrontal). Delayed pivots of a task are added to the task
//! above in the order of the plan. Therefore pivots and bits of the result are the same for every team.
//!
//! Multipliers ([`Cliques::n_primal`]) are placed right after the last coordinate of their elements. If the coordinates have mass, a pivot is
//! then delayed only where a threshold test fails for the numbers at hand.

use crate::delayed::{Delays, Factor, Job, Layout, Share, Shares};
use crate::options::{Counters, Options};
use crate::plan::plan;
use crate::scatter::Scatter;
use crate::subtree::Vectors;
use mbs_math::blocks::{Inertia, Weakest};
use mbs_math::dense::front::{Tally, Thresholds};
use mbs_math::dense::scaling::{self, larger, measure_rows};
use mbs_math::team::{Alone, Team, on_elements, on_stretches};
use mbs_math::{BlockSource, Cliques, FactorError, Real, SymmetricSolver};
use std::convert::Infallible;

/// Multifrontal L D L^T with pivoting: analysed once, factored many times, by one thread or by a team.
///
/// The analysis reserves memory for the planned fronts, and the same amount again for delayed pivots. A factorisation with more delays than
/// all earlier ones enlarges the memory. The next factorisation with as many delays allocates nothing.
#[derive(Debug, Clone)]
pub struct Indefinite<T: Real, W: Team = Alone> {
    layout: Layout,
    team: W,
    thresholds: Thresholds<T>,
    /// Blocks of all elements in the last factorisation.
    blocks: Vec<T>,
    /// Scale S, and the largest entry of each row of S T S for the matrix T; one number for each unknown.
    scale: Vec<T>,
    rows: Vec<T>,
    diagonal: Vec<T>,
    scatter: Scatter<T>,
    /// Factored fronts of each task.
    shares: Vec<Share<T>>,
    tally: Tally,
    delays: Delays,
}

impl<T: Real> Indefinite<T> {
    /// Orders the unknowns, finds the fronts and fixes all index maps. All of `options` is used except the choice of pivots.
    ///
    /// # Panics
    /// When a clique names an unknown that does not exist, or one unknown twice; with more than 2^32 - 1 unknowns,
    /// elements or scattered entries.
    pub fn analyse(cliques: &impl Cliques, options: Options) -> Self {
        Self::on(Alone, cliques, options)
    }
}

impl<T: Real, W: Team> Indefinite<T, W> {
    /// Analyses the cliques as [`analyse`](Indefinite::analyse) does, for a team. The results have the same bits for every team.
    ///
    /// # Panics
    /// As [`analyse`](Indefinite::analyse).
    pub fn on(team: W, cliques: &impl Cliques, options: Options) -> Self {
        Self::laid_out(team, Layout::new(plan(cliques, options)), Thresholds::default())
    }

    /// Returns the same analysis for another team; the factorisation is lost.
    pub fn with_team<V: Team>(self, team: V) -> Indefinite<T, V> {
        Indefinite::laid_out(team, self.layout, self.thresholds)
    }

    fn laid_out(team: W, layout: Layout, thresholds: Thresholds<T>) -> Self {
        let n = layout.plan.order.len();
        let n_blocks = layout.block_starts[layout.plan.cliques.len()];
        Self {
            thresholds,
            blocks: vec![T::ZERO; n_blocks],
            scale: vec![T::ONE; n],
            rows: vec![T::ZERO; n],
            diagonal: vec![T::ZERO; n],
            scatter: Scatter::new(&team, &layout.plan),
            shares: layout.shares(),
            tally: Tally::default(),
            delays: Delays::default(),
            team,
            layout,
        }
    }

    /// Sets other thresholds for the pivots.
    #[must_use]
    pub fn with_thresholds(self, thresholds: Thresholds<T>) -> Self {
        Self { thresholds, ..self }
    }

    /// Exact sizes of this analysis, as planned without delays.
    pub fn counters(&self) -> Counters {
        self.layout.plan.counters
    }

    /// Number of subtrees that threads can factor at the same time. More threads than this have no work. `≥ 1` if there are unknowns.
    pub fn n_branches(&self) -> usize {
        self.layout.plan.tasks.n_leaves()
    }

    /// Deviations of the last factorisation from the plan, which delayed pivots cause.
    pub fn delays(&self) -> Delays {
        self.delays
    }

    /// Copies the blocks and computes the scaling.
    fn gather<S: BlockSource<T>>(&mut self, source: &S) {
        let (team, cliques) = (&self.team, &self.layout.plan.cliques);
        let starts = &self.layout.block_starts;
        on_elements(team, starts, &mut self.blocks, |e, block| source.write_block(e, block));
        let (blocks, scatter) = (&self.blocks, &mut self.scatter);
        let write = |e: usize, diagonal: &mut [T]| {
            scaling::write_diagonal(&blocks[starts[e]..starts[e + 1]], diagonal);
        };
        scatter.combine(team, cliques, &mut self.diagonal, write, |sum, d| sum + d);
        let mut measure = |scale: &[T], rows: &mut [T]| {
            let write = |e: usize, rows: &mut [T]| {
                measure_rows(cliques.get(e), &blocks[starts[e]..starts[e + 1]], scale, rows);
            };
            scatter.combine(team, cliques, rows, write, larger);
        };
        let out = (&mut self.scale[..], &mut self.rows[..]);
        scaling::equilibrate(team, out, &self.diagonal, &mut measure);
        measure(&self.scale, &mut self.rows);
    }

    /// Returns the factored fronts for sweeps, with or without a division by D.
    fn vectors(&self, is_divided: bool) -> Vectors<'_, W, Factor<'_, T>> {
        let fronts = Factor { layout: &self.layout, shares: &self.shares, is_divided };
        Vectors { plan: &self.layout.plan, team: &self.team, fronts }
    }
}

impl<T: Real, W: Team> SymmetricSolver<T> for Indefinite<T, W> {
    /// Factors the blocks of the source. Cost: that of the planned fronts, more where pivots are delayed, and four passes over the blocks for
    /// the scaling.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError> {
        self.gather(source);
        let job = Job {
            layout: &self.layout,
            team: &self.team,
            thresholds: &self.thresholds,
            blocks: &self.blocks,
            scale: &self.scale,
            rows: &self.rows,
        };
        let work = |at, Shares(shares): Shares<'_, T>| {
            job.factor_task(at, shares);
            Ok::<(), Infallible>(())
        };
        let tasks = &self.layout.plan.tasks;
        let Ok(()) = tasks.each(&self.team, &tasks.roots, Shares(&mut self.shares), &work);
        (self.tally, self.delays) = (Tally::default(), Delays::default());
        for share in &self.shares {
            self.tally.add(&share.tally);
            self.delays = self.delays.with(share.delays);
        }
        let weakest = &mut self.tally.weakest.unknown;
        *weakest = self.layout.unknown_at.get(*weakest as usize).copied().unwrap_or(u32::MAX);
        self.tally.verdict()
    }

    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        assert_eq!(x.len(), self.scale.len(), "solve needs one number for each unknown");
        assert!(scratch.len() >= self.n_scratch(), "solve needs n_scratch() places");
        let scale = &self.scale;
        on_stretches(&self.team, [&mut *x], |first, [x]| {
            for (x, &s) in x.iter_mut().zip(&scale[first..]) {
                *x *= s;
            }
        });
        let storage = &mut scratch[..self.layout.plan.tasks.sizes[1]];
        self.vectors(true).solve(x, storage);
        let (storage, stored_at) = (&*storage, &self.layout.plan.tasks.stored_at);
        on_stretches(&self.team, [x], |first, [x]| {
            for ((x, &at), &s) in x.iter_mut().zip(&stored_at[first..]).zip(&scale[first..]) {
                *x = storage[at as usize] * s;
            }
        });
    }

    fn n_scratch(&self) -> usize {
        self.layout.plan.tasks.sizes[1]
    }

    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        assert_eq!(f.len(), self.scale.len(), "assemble needs one place for each unknown");
        self.scatter.sum(&self.team, &self.layout.plan.cliques, source, f);
    }

    fn subtract_product(&self, x: &[T], b: &mut [T]) {
        let (cliques, starts) = (&self.layout.plan.cliques, &self.layout.block_starts);
        for e in 0..cliques.len() {
            let block = &self.blocks[starts[e]..starts[e + 1]];
            scaling::subtract_product(cliques.get(e), block, x, b);
        }
    }

    fn inertia(&self) -> Inertia {
        self.tally.inertia
    }

    fn weakest(&self) -> Weakest {
        self.tally.weakest
    }

    fn null_vector(&self, x: &mut [T], scratch: &mut [T]) {
        let (unknown, tasks) = (self.tally.weakest.unknown as usize, &self.layout.plan.tasks);
        x.fill(T::ZERO);
        let Some(&unit) = self.scale.get(unknown) else { return };
        let storage = &mut scratch[..tasks.sizes[1]];
        storage.fill(T::ZERO);
        storage[tasks.stored_at[unknown] as usize] = T::ONE;
        self.vectors(false).backward_all(&tasks.roots, storage, None);
        for ((x, &at), &s) in x.iter_mut().zip(&tasks.stored_at).zip(&self.scale) {
            *x = storage[at as usize] * (s / unit);
        }
    }
}
