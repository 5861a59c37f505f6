//! Workspace of a step, made once at a start state, which also determines the rank.

use crate::basis::Basis;
use crate::dense::{General, Symmetric};
use crate::elimination::{Elimination, Pivots};
use crate::jacobian::{Jacobian, column_scales};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::dense::Dense;
use mbs_core::model::{Load, Model, State, Terms};
use mbs_core::step::Counts;

/// Workspace of the state-space step, with the present independent coordinates.
///
/// A step allocates nothing while the factors of a new choice need at most twice the memory of the first ones. A choice that needs more
/// allocates once.
#[derive(Debug, Clone)]
pub struct Workspace<T> {
    pub(crate) terms: Terms<T>,
    pub(crate) jacobian: Jacobian<T>,
    pub(crate) elimination: Elimination<T>,
    pub(crate) basis: Basis<T>,
    pub(crate) tangent: Symmetric<T>,
    pub(crate) solver: Dense<T>,
    /// Matrix C^T R of the tangent coordinates, factored.
    pub(crate) turn: General<T>,
    /// Tangent coordinates in three vectors of f numbers: C^T x of the predicted dq, v and a. Then the correction towards the required C^T
    /// x, and d = C^T (q - q_p).
    pub(crate) predicted: [Vec<T>; 3],
    pub(crate) wanted: Vec<T>,
    pub(crate) measured: Vec<T>,
    /// Increment q_(n+1) - q_n, then q_(n+1), v and a; extended vectors, which include known coordinates.
    pub(crate) dq: Vec<T>,
    pub(crate) q: Vec<T>,
    pub(crate) v: Vec<T>,
    pub(crate) a: Vec<T>,
    /// A correction (an extended vector), and the imbalance M a - Q for each unknown.
    pub(crate) change: Vec<T>,
    pub(crate) balance: Vec<T>,
    /// Residual, and after a solution the correction, of the independent coordinates.
    pub(crate) d: Vec<T>,
    /// Multipliers, multipliers over a', and residuals of velocities or accelerations, for each row.
    pub(crate) lambda: Vec<T>,
    pub(crate) mu: Vec<T>,
    pub(crate) rates: Vec<T>,
    /// Scratch for the dependent unknowns, and scratch for one element.
    scratch: Vec<T>,
    local: Vec<T>,
    /// Rank at the start. Then, from all choices so far, the largest value of the smallest pivot.
    pub(crate) rank: usize,
    pub(crate) usual: T,
    pub(crate) pivots: Pivots<T>,
    /// Largest entry of R at the last choice; zero while unknown.
    pub(crate) first_basis: T,
    /// True if the next step chooses independent coordinates again.
    pub(crate) is_stale: bool,
    /// Counts of factorisations and solves within a step.
    pub(crate) counts: Counts,
    /// Number of choices of independent coordinates since the start.
    pub(crate) choices: u32,
}

impl<T: Real> Workspace<T> {
    /// Creates the workspace for `model`. `start` is a consistent state, and the rank of its constraints must not change in later steps.
    pub fn new(model: &impl Model<T>, start: &State<T>) -> Self {
        let (n, e, m) = (model.n_unknowns(), model.n_extended(), model.n_constraints());
        let zeros = |k| vec![T::ZERO; k];
        let mut terms = model.terms();
        model.set_inputs(start.t, start, &mut terms);
        model.evaluate(&start.q, &mut terms);
        let mut jacobian = Jacobian::new(model);
        jacobian.gather(model, &terms);
        let mut elimination = Elimination::new(jacobian.pattern(n), column_scales(model));
        let rank = elimination.select_pivots(&jacobian.values).rank;
        elimination.reserve(2 * elimination.n_entries());
        let pivots = elimination.pivots();
        let widest = (0..model.n_elements()).map(|e| model.clique(e).len()).max().unwrap_or(0);
        let tangent = Symmetric::new(n - rank);
        Self {
            basis: Basis::new(model, rank),
            solver: Dense::new(&tangent),
            tangent,
            turn: General::new(n - rank),
            predicted: [zeros(n - rank), zeros(n - rank), zeros(n - rank)],
            wanted: zeros(n - rank),
            measured: zeros(n - rank),
            terms,
            jacobian,
            elimination,
            dq: zeros(e),
            q: start.q.clone(),
            v: zeros(e),
            a: zeros(e),
            change: zeros(e),
            balance: zeros(n),
            d: zeros(n - rank),
            lambda: zeros(m),
            mu: zeros(m),
            rates: zeros(m),
            scratch: zeros(rank),
            local: zeros(widest),
            rank,
            usual: pivots.smallest,
            pivots,
            first_basis: T::ZERO,
            is_stale: false,
            counts: Counts::default(),
            choices: 0,
        }
    }

    /// The terms of the model at the last evaluation.
    pub fn terms(&self) -> &Terms<T> {
        &self.terms
    }

    /// Terms of the model at the last evaluation, for a caller that restores them.
    pub fn terms_mut(&mut self) -> &mut Terms<T> {
        &mut self.terms
    }

    /// Elimination of the constraints: rank, independent and dependent coordinates, dropped rows.
    pub fn elimination(&self) -> &Elimination<T> {
        &self.elimination
    }

    /// Number of new choices of independent coordinates since the start.
    pub fn n_choices(&self) -> u32 {
        self.choices
    }

    /// Solves change_d = -J_d^-1 rates. Other entries of `change` keep their values.
    pub(crate) fn solve(&mut self) {
        self.counts.solves += 1;
        for r in &mut self.rates {
            *r = -*r;
        }
        self.elimination.solve(&self.rates, &mut self.change, &mut self.scratch);
    }

    /// Solves J_d^T lambda = -balance_d for the multipliers, which are zero on dropped rows.
    pub(crate) fn solve_transposed(&mut self) {
        self.counts.solves += 1;
        self.elimination.solve_transposed(&self.balance, &mut self.lambda, &mut self.scratch);
        for l in &mut self.lambda {
            *l = -*l;
        }
    }

    /// Evaluates balance = M a - force Q, element by element.
    pub(crate) fn balance(&mut self, model: &impl Model<T>, force: T) {
        self.balance.fill(T::ZERO);
        let load = Load { mass: Some(&self.a[..]), multipliers: None, force };
        for e in 0..model.n_elements() {
            let clique = model.clique(e);
            let local = &mut self.local[..clique.len()];
            model.write_residual(&self.terms, &load, e, local);
            for (&u, &x) in clique.iter().zip(local.iter()) {
                self.balance[u as usize] += x;
            }
        }
    }
}
