//! Workspace of a step, made once: the equations, the end of the step, and the scratch of each policy.

use crate::equations::Equations;
use crate::history::History;
use crate::options::{Options, Penalty};
use crate::penalty::{PenaltyAdaptation, PenaltyScale};
use crate::projection::{Projection, Projector};
use alloc::vec;
use alloc::vec::Vec;
use core::mem::take;
use mbs_core::implicit::{ConstraintLevel, StepEnd, StepScratch, commit};
use mbs_core::integrator::{Integrator, Rule};
use mbs_core::model::{Model, State, Terms};
use mbs_core::step::{Counts, OptionError, StepReport, Stop};
use mbs_core::{Real, SpdSolver};

/// Workspace of the augmented Lagrangian steps over a solver `S`. Nothing is allocated after [`Workspace::new`].
#[derive(Debug, Clone)]
pub struct Workspace<T, S> {
    pub(crate) equations: Equations<T, S>,
    /// The end of the step. The stored accelerations are a/a' in index-3 and a in index-1.
    pub(crate) end: StepEnd<T>,
    /// Multipliers, one for each row: lambda / a' in index-3, lambda in index-1.
    pub(crate) lambda: Vec<T>,
    pub(crate) scale: PenaltyScale<T>,
    pub(crate) adaptation: PenaltyAdaptation<T>,
    pub(crate) projection: Projection<T>,
    /// Energy of the penalties after the first correction [J].
    pub(crate) penalty_energy: T,
    /// Counts of the work for a change of index that took place before the step.
    pub(crate) settled: Counts,
    saved: History<T>,
}

impl<T: Real, S: SpdSolver<T>> Workspace<T, S> {
    /// Creates a workspace for `model`, with a solver analysed for its cliques.
    pub fn new(model: &impl Model<T>, solver: S) -> Self {
        let m = model.n_constraints();
        let mut terms = model.terms();
        let start = State::at_rest(model);
        model.set_inputs(start.t, &start, &mut terms);
        model.evaluate(&start.q, &mut terms);
        let (scale, adaptation) = (PenaltyScale::new(model, &terms), PenaltyAdaptation::new(m));
        let mut this = Self {
            equations: Equations::new(model, terms, solver),
            end: StepEnd::new(model),
            lambda: vec![T::ZERO; m],
            scale,
            adaptation,
            projection: Projection::new(model),
            penalty_energy: T::ZERO,
            settled: Counts::default(),
            saved: History::default(),
        };
        this.saved = this.history();
        this
    }

    /// Saves the data that the last step leaves for the next one, so that a trial step can be undone.
    pub fn save(&mut self) {
        self.saved.penalty_factor = self.scale.factor;
        self.saved.penalty_strength = self.scale.strength;
        self.saved.contraction = self.adaptation.contraction;
        self.saved.weakest_combination.copy_from_slice(&self.adaptation.weakest_combination);
    }

    /// Restores the saved data, which undoes a trial step.
    pub fn restore(&mut self) {
        self.scale.factor = self.saved.penalty_factor;
        self.scale.strength = self.saved.penalty_strength;
        self.adaptation.contraction = self.saved.contraction;
        self.adaptation.weakest_combination.copy_from_slice(&self.saved.weakest_combination);
    }

    /// Makes penalties that are proportional to masses larger until a [`restore`](Self::restore). Call it after a step has failed, because
    /// the penalties of that step may be too small. Returns false if they were already larger.
    pub fn strengthen(&mut self) -> bool {
        self.scale.strengthen()
    }

    /// State on which the next step depends.
    #[must_use]
    pub fn history(&self) -> History<T> {
        let PenaltyAdaptation { weakest_combination, contraction, .. } = &self.adaptation;
        History {
            penalty_factor: self.scale.factor,
            penalty_strength: self.scale.strength,
            contraction: *contraction,
            weakest_combination: weakest_combination.clone(),
            settled: self.settled,
        }
    }

    /// Restores a history of the same model. Returns false, and changes nothing, if its length does not fit.
    pub fn set_history(&mut self, history: &History<T>) -> bool {
        let PenaltyAdaptation { weakest_combination, contraction, .. } = &mut self.adaptation;
        if history.weakest_combination.len() != weakest_combination.len() {
            return false;
        }
        weakest_combination.copy_from_slice(&history.weakest_combination);
        *contraction = history.contraction;
        (self.scale.factor, self.settled) = (history.penalty_factor, history.settled);
        self.scale.strength = history.penalty_strength;
        true
    }

    /// The terms of the model at the last evaluation.
    pub fn terms(&self) -> &Terms<T> {
        &self.equations.terms
    }

    /// Terms of the model at the last evaluation, for a caller that restores them.
    pub fn terms_mut(&mut self) -> &mut Terms<T> {
        &mut self.equations.terms
    }

    /// Solver of the equations.
    pub fn solver(&self) -> &S {
        &self.equations.solver
    }

    /// Begins a step: sets counts to zero, multiplies scaled penalties by `factor`, and a fixed alpha by `unit`.
    pub(crate) fn begin<M: Model<T>>(
        &mut self,
        model: &M,
        (penalty, unit, factor): (Penalty<T>, T, T),
    ) {
        self.equations.counts = Counts::default();
        self.scale.begin(model, (penalty, unit, factor));
    }

    /// Evaluates phi, J and forces at the present end of the step.
    pub(crate) fn evaluate<M: Model<T>>(
        &mut self,
        model: &M,
        (rule, compensated): (&Rule<T>, bool),
        s: &State<T>,
    ) {
        self.end.evaluate(model, compensated, s, &mut self.equations.terms);
        self.end.evaluate_rates(model, rule, &mut self.equations.terms);
        self.end.evaluate_forces(model, &mut self.equations.terms);
    }

    /// Factors the tangent T. It contains the geometric stiffness if the options require that and T remains positive definite.
    pub(crate) fn factor<M: Model<T>>(
        &mut self,
        model: &M,
        rule: &Rule<T>,
        is_geometric: bool,
    ) -> Result<(), mbs_core::FactorError> {
        let weights = (T::ONE / rule.acceleration, rule.velocity / rule.acceleration);
        let (equations, s) = (&mut self.equations, &self.scale.weights);
        if is_geometric && equations.factor(model, weights, s, Some(&self.lambda)).is_ok() {
            return Ok(());
        }
        equations.factor(model, weights, s, None)
    }

    /// Factors the projection matrix W = M + J^T s J.
    pub(crate) fn factor_mass<M: Model<T>>(
        &mut self,
        model: &M,
    ) -> Result<(), mbs_core::FactorError> {
        self.equations.factor_mass(model, &self.scale.weights)
    }

    /// Returns the projector of velocities or accelerations.
    pub(crate) fn projector<'a, M: Model<T>>(
        &'a mut self,
        model: &'a M,
        level: ConstraintLevel,
    ) -> Projector<'a, T, M, S> {
        let x = match level {
            ConstraintLevel::Velocity => &mut self.end.v,
            ConstraintLevel::Acceleration => &mut self.end.a,
        };
        let Self { equations, scale, projection: scratch, .. } = self;
        Projector { model, level, x, equations, scale, scratch }
    }
}

impl<T: Real, S: SpdSolver<T>> StepScratch<T> for Workspace<T, S> {
    fn checked(options: &Options<T>) -> Result<(&Integrator<T>, bool), OptionError> {
        options.validate()?;
        Ok((&options.integrator, options.compensated))
    }

    fn reached(&self) -> (&StepEnd<T>, &Terms<T>) {
        (&self.end, &self.equations.terms)
    }

    fn commit<M: Model<T>>(
        &mut self,
        model: &M,
        (rule, compensated, unit): (&Rule<T>, bool, T),
        s: &mut State<T>,
    ) {
        let sigma = &self.projection.sigma;
        let multipliers = (&self.lambda[..], unit, |row, lambda| lambda + sigma[row]);
        let terms = &mut self.equations.terms;
        commit(model, (rule, compensated), &self.end, multipliers, terms, s);
    }

    /// Returns the report of a step, including the work of a change of index before it.
    fn report(&mut self, newton: (u32, T, Stop), violation: [T; 3]) -> StepReport<T> {
        let (settled, counts) = (take(&mut self.settled), self.equations.counts);
        let counts = Counts {
            factorizations: counts.factorizations + settled.factorizations,
            solves: counts.solves + settled.solves,
        };
        let penalty_energy = self.penalty_energy;
        StepReport { penalty_energy, ..StepReport::of_newton(newton, counts, violation) }
    }
}
