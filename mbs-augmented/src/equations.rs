//! The linear equations of a step: the matrix with its factor, residuals, and products of the Jacobian.
//!
//! ```text
//! T = M + damping C + stiffness K + J^T s J,      f = M x + J^T mu - force Q
//! ```
//!
//! The rows J' from which the factored matrix was made are stored beside the factor. Projections and later corrections may use either J or
//! J'.

use alloc::vec;
use alloc::vec::Vec;
use core::mem::swap;
use mbs_core::model::{Load, Model, System, Tangent, Terms};
use mbs_core::step::Counts;
use mbs_core::{FactorError, Real, SpdSolver};

/// Matrix T of a step with its factor, the right-hand side and the terms of the model.
#[derive(Debug, Clone)]
pub(crate) struct Equations<T, S> {
    pub(crate) solver: S,
    pub(crate) terms: Terms<T>,
    /// Right-hand side f before a solution, and the negative correction -d after it; one number for each unknown.
    pub(crate) f: Vec<T>,
    /// Multipliers mu of a residual, or a product of the Jacobian; one number for each row.
    pub(crate) mu: Vec<T>,
    /// The Jacobian J' from which the factored matrix was made.
    factored_rows: Vec<T>,
    /// Stiffness and damping of each scalar measure in the factored matrix.
    pub(crate) factored_laws: Vec<[T; 2]>,
    /// Scratch for an extended vector, and scratch of the solver.
    room: Vec<T>,
    scratch: Vec<T>,
    pub(crate) counts: Counts,
}

impl<T: Real, S: SpdSolver<T>> Equations<T, S> {
    /// Creates the equations for `model` with its `terms`, and with a solver analysed for its cliques.
    pub(crate) fn new(model: &impl Model<T>, terms: Terms<T>, solver: S) -> Self {
        let zeros = |n| vec![T::ZERO; n];
        Self {
            f: zeros(model.n_unknowns()),
            mu: zeros(model.n_constraints()),
            factored_rows: terms.jacobian.clone(),
            factored_laws: vec![[T::ZERO; 2]; terms.measures.len()],
            room: zeros(model.n_extended()),
            scratch: zeros(solver.n_scratch()),
            counts: Counts::default(),
            solver,
            terms,
        }
    }

    /// Factors T with the given weights of stiffness and damping, the penalties s, and the multipliers of the geometric stiffness.
    pub(crate) fn factor<M: Model<T>>(
        &mut self,
        model: &M,
        (stiffness, damping): (T, T),
        penalty: &[T],
        geometric: Option<&[T]>,
    ) -> Result<(), FactorError> {
        self.counts.factorizations += 1;
        self.factored_rows.copy_from_slice(&self.terms.jacobian);
        for (law, measure) in self.factored_laws.iter_mut().zip(&self.terms.measures) {
            *law = [measure.stiffness, measure.damping];
        }
        let tangent = Tangent { stiffness, damping, penalty, geometric };
        let load = Load { mass: None, multipliers: None, force: T::ZERO };
        self.solver.factor(&System { model, terms: &self.terms, tangent, load })
    }

    /// Factors the projection matrix W = M + J^T s J.
    pub(crate) fn factor_mass<M: Model<T>>(
        &mut self,
        model: &M,
        penalty: &[T],
    ) -> Result<(), FactorError> {
        self.factor(model, (T::ZERO, T::ZERO), penalty, None)
    }

    /// Solves in place with the factor: f = T^-1 f.
    pub(crate) fn solve(&mut self) {
        self.counts.solves += 1;
        self.solver.solve(&mut self.f, &mut self.scratch);
    }

    /// Assembles the residual f = M x + J^T mu - force Q.
    pub(crate) fn assemble<M: Model<T>>(&mut self, model: &M, mass: Option<&[T]>, force: T) {
        let load = Load { mass, multipliers: Some(&self.mu), force };
        let (zero, penalty) = (T::ZERO, &[][..]);
        let tangent = Tangent { stiffness: zero, damping: zero, penalty, geometric: None };
        self.solver.assemble(&System { model, terms: &self.terms, tangent, load }, &mut self.f);
    }

    /// Multiplies by the Jacobian: mu = J f.
    pub(crate) fn multiply_correction<M: Model<T>>(&mut self, model: &M) {
        self.room[..self.f.len()].copy_from_slice(&self.f);
        model.multiply_jacobian(&self.terms, &self.room, &mut self.mu);
    }

    /// Runs `work` with the rows J' of the factor in place of J.
    pub(crate) fn with_factored_rows(&mut self, work: impl FnOnce(&mut Self)) {
        swap(&mut self.terms.jacobian, &mut self.factored_rows);
        work(self);
        swap(&mut self.terms.jacobian, &mut self.factored_rows);
    }

    /// Stores f, runs `work`, which makes another residual in f, and then sets f to the sum of both.
    pub(crate) fn add_to_residual<M: Model<T>>(&mut self, model: &M, work: impl FnOnce(&mut Self)) {
        let n = self.f.len();
        self.room[..n].copy_from_slice(&self.f);
        work(self);
        mbs_core::team::add(model.team(), &mut self.f, &self.room[..n]);
    }
}
