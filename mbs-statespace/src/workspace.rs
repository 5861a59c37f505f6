//! Scratch of a step, made once at a start state, which also fixes the rank.

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

/// Scratch of the state-space step, with the independent coordinates that are chosen at present.
///
/// A step allocates nothing while the factors of a new choice fit into twice the room of the first; a choice that needs more
/// grows the store once.
#[derive(Debug, Clone)]
pub struct Workspace<T> {
    pub(crate) terms: Terms<T>,
    pub(crate) jacobian: Jacobian<T>,
    pub(crate) elimination: Elimination<T>,
    pub(crate) basis: Basis<T>,
    pub(crate) tangent: Symmetric<T>,
    pub(crate) solver: Dense<T>,
    /// Matrix C^T R, factored.
    pub(crate) turn: General<T>,
    /// C^T x of the predicted dq, v, a, and what is wanted of x now, f each.
    pub(crate) predicted: [Vec<T>; 3],
    pub(crate) wanted: Vec<T>,
    pub(crate) measured: Vec<T>,
    /// q_(n+1) - q_n and q_(n+1), v, a, extended.
    pub(crate) dq: Vec<T>,
    pub(crate) q: Vec<T>,
    pub(crate) v: Vec<T>,
    pub(crate) a: Vec<T>,
    /// A correction of all unknowns, extended; forces and M a, n.
    pub(crate) change: Vec<T>,
    pub(crate) balance: Vec<T>,
    /// Over the independent coordinates: residual, then correction.
    pub(crate) d: Vec<T>,
    /// Multipliers, the same over a', and rates, m.
    pub(crate) lambda: Vec<T>,
    pub(crate) mu: Vec<T>,
    pub(crate) rates: Vec<T>,
    /// Over the dependent unknowns; one element.
    scratch: Vec<T>,
    local: Vec<T>,
    /// Rank and smallest pivot at the start.
    pub(crate) rank: usize,
    pub(crate) usual: T,
    pub(crate) pivots: Pivots<T>,
    /// Largest entry of R at the last choice; zero: not known yet.
    pub(crate) first_basis: T,
    /// The next step chooses anew.
    pub(crate) is_stale: bool,
    /// Counts within a step.
    pub(crate) counts: Counts,
    /// Choices since the start.
    pub(crate) choices: u32,
}

impl<T: Real> Workspace<T> {
    /// Creates the scratch for `model`; `start` is a consistent state, and the rank of its constraints is the rank that stands.
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

    /// The terms as last evaluated.
    pub fn terms(&self) -> &Terms<T> {
        &self.terms
    }

    /// Terms as last evaluated, to be put back.
    pub fn terms_mut(&mut self) -> &mut Terms<T> {
        &mut self.terms
    }

    /// Elimination of the constraints: rank, independent and dependent coordinates, rows that were dropped.
    pub fn elimination(&self) -> &Elimination<T> {
        &self.elimination
    }

    /// Number of new choices of independent coordinates since the start.
    pub fn n_choices(&self) -> u32 {
        self.choices
    }

    /// change_d = -J_d^-1 rates, the other places left.
    pub(crate) fn solve(&mut self) {
        self.counts.solves += 1;
        for r in &mut self.rates {
            *r = -*r;
        }
        self.elimination.solve(&self.rates, &mut self.change, &mut self.scratch);
    }

    /// lambda from J_d^T lambda = -balance_d; zero on dropped rows.
    pub(crate) fn solve_transposed(&mut self) {
        self.counts.solves += 1;
        self.elimination.solve_transposed(&self.balance, &mut self.lambda, &mut self.scratch);
        for l in &mut self.lambda {
            *l = -*l;
        }
    }

    /// balance = M a - force Q, element by element.
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
