//! One Newton iteration of index-3 composed from the public parts of the workspace.

use mbs_core::algebra::norm_inf;
use mbs_core::integrator::{Integrator, Rule};
use mbs_core::model::{Load, Model, State, System, Tangent, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::{Cliques, SpdSolver};
use mbs_sparse::Multifrontal;

/// Penalty factor of the constraints, relative to their effective masses [-].
const PENALTY: f64 = 1e6;

pub(crate) struct Iteration<'a, const D: usize> {
    model: &'a NaturalModel<f64, D>,
    solver: Multifrontal<f64>,
    rule: Rule<f64>,
    terms: Terms<f64>,
    state: &'a State<f64>,
    dq: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    pub(crate) f: Vec<f64>,
    scratch: Vec<f64>,
    lambda: Vec<f64>,
    mu: Vec<f64>,
    penalty: Vec<f64>,
}

impl<'a, const D: usize> Iteration<'a, D> {
    /// Builds the iteration at the predicted end of a step from `state`.
    pub(crate) fn new(
        model: &'a NaturalModel<f64, D>,
        state: &'a State<f64>,
        solver: Multifrontal<f64>,
    ) -> Self {
        let rule = Integrator::trapezoidal().rule(crate::DT);
        let (n, e, m) = (model.n_unknowns(), model.n_extended(), model.n_constraints());
        let mut terms = model.terms();
        model.evaluate(&state.q, &mut terms);
        let mut penalty = vec![0.0; m];
        model.effective_masses(&terms, &mut penalty);
        penalty.iter_mut().for_each(|p| *p *= PENALTY);
        let scratch = vec![0.0; solver.n_scratch()];
        let (mut dq, mut v, mut a) = (vec![0.0; e], vec![0.0; e], vec![0.0; e]);
        for i in 0..n {
            let (dq_next, v_next, a_next) = rule.predict(state.v[i], state.a[i], state.a_aux[i]);
            (dq[i], v[i], a[i]) = (dq_next, v_next, a_next / rule.acceleration);
        }
        let lambda = state.lambda.iter().map(|&x| x / rule.acceleration).collect();
        let (q, f, mu) = (state.q.clone(), vec![0.0; n], vec![0.0; m]);
        Self { model, solver, rule, terms, state, dq, q, v, a, f, scratch, lambda, mu, penalty }
    }

    /// Makes one complete iteration. Returns the size of the correction.
    #[inline(always)]
    pub(crate) fn newton(&mut self) -> f64 {
        self.advance();
        self.factor();
        self.residual();
        self.solve();
        self.update()
    }

    pub(crate) fn advance(&mut self) {
        let State { q, phi, .. } = self.state;
        self.model.advance(q, &self.dq, phi, &mut self.terms);
        if self.model.has_forces() {
            self.model.evaluate_forces(&self.q, &self.v, &mut self.terms);
        }
    }

    pub(crate) fn system(&self) -> System<'_, f64, NaturalModel<f64, D>> {
        let (stiffness, damping) =
            (1.0 / self.rule.acceleration, self.rule.velocity / self.rule.acceleration);
        let tangent = Tangent { stiffness, damping, penalty: &self.penalty, geometric: None };
        let load = Load { mass: Some(&self.a), multipliers: Some(&self.mu), force: stiffness };
        System { model: self.model, terms: &self.terms, tangent, load }
    }

    pub(crate) fn factor(&mut self) {
        let (stiffness, damping) =
            (1.0 / self.rule.acceleration, self.rule.velocity / self.rule.acceleration);
        let tangent = Tangent { stiffness, damping, penalty: &self.penalty, geometric: None };
        let load = Load { mass: None, multipliers: None, force: 0.0 };
        let system = System { model: self.model, terms: &self.terms, tangent, load };
        self.solver.factor(&system).expect("positive definite");
    }

    pub(crate) fn residual(&mut self) {
        for k in 0..self.mu.len() {
            self.mu[k] = self.lambda[k] + self.penalty[k] * self.terms.phi[k];
        }
        let stiffness = 1.0 / self.rule.acceleration;
        let tangent =
            Tangent { stiffness: 0.0, damping: 0.0, penalty: &self.penalty, geometric: None };
        let load = Load { mass: Some(&self.a), multipliers: Some(&self.mu), force: stiffness };
        let system = System { model: self.model, terms: &self.terms, tangent, load };
        self.solver.assemble(&system, &mut self.f);
    }

    pub(crate) fn solve(&mut self) {
        self.solver.solve(&mut self.f, &mut self.scratch);
    }

    /// Adds the correction to q, v, a and the multipliers. Returns its size.
    pub(crate) fn update(&mut self) -> f64 {
        for i in 0..self.f.len() {
            let d = self.f[i];
            self.dq[i] -= d;
            self.q[i] = self.state.q[i] + self.dq[i];
            self.v[i] -= self.rule.velocity * d;
            self.a[i] -= d;
        }
        for k in 0..self.lambda.len() {
            self.lambda[k] += self.penalty[k] * self.terms.phi[k];
        }
        norm_inf(&self.f)
    }
}
