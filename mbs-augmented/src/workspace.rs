//! Scratch of a step, made once.

use crate::history::History;
use crate::projection::spread;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::integrator::Rule;
use mbs_core::model::{Load, Model, State, Tangent, Terms};
use mbs_core::step::{Counts, StepReport, Stop, add_work, take_coordinates};
use mbs_core::team::{Team, on_stretches, sum};
use mbs_core::{Real, SpdSolver};

/// A law's tangent is like another that differs by this share at most; slight ones, beside the largest, are not looked at.
const LIKE: f64 = 0.1;
const SLIGHT: f64 = 1e-3;

/// Scratch of the augmented Lagrangian steps over a solver `S`. Nothing is allocated after [`Workspace::new`].
#[derive(Debug, Clone)]
pub struct Workspace<T, S> {
    pub(crate) solver: S,
    pub(crate) terms: Terms<T>,
    /// The Jacobian that the factored matrix was made with.
    pub(crate) factored: Vec<T>,
    /// Stiffness and damping of each scalar measure in it.
    factored_laws: Vec<[T; 2]>,
    /// q_(n+1) - q_n and q_(n+1), v, a/a' (index-3) or a (index-1), extended.
    pub(crate) dq: Vec<T>,
    pub(crate) q: Vec<T>,
    pub(crate) v: Vec<T>,
    pub(crate) a: Vec<T>,
    /// Predicted increment of the position (index-1); room for a vector (index-3); extended.
    pub(crate) dq_predicted: Vec<T>,
    /// x - x* of a projection, extended.
    pub(crate) change: Vec<T>,
    /// Right-hand side and correction, n.
    pub(crate) f: Vec<T>,
    pub(crate) scratch: Vec<T>,
    /// lambda / a' (index-3) or lambda (index-1), m.
    pub(crate) lambda: Vec<T>,
    pub(crate) sigma: Vec<T>,
    pub(crate) mu: Vec<T>,
    pub(crate) rates: Vec<T>,
    /// Penalty of each row in mass units, m, and the effective masses it comes from.
    pub(crate) penalty: Vec<T>,
    pub(crate) masses: Vec<T>,
    /// Factor on a scaled penalty that adapts from step to step.
    pub(crate) boost: T,
    /// Penalty factor of the options, or what it is for a fixed alpha [effective masses].
    pub(crate) base: T,
    /// The combination of constraints that the mechanism feels least, followed from step to step, m.
    pub(crate) probe: Vec<T>,
    /// What is added to it where it is felt well, m.
    pub(crate) spread: Vec<T>,
    /// What one correction left of it in the last step.
    pub(crate) rho: T,
    pub(crate) counts: Counts,
    /// Energy that the penalties held after the first correction [J].
    pub(crate) penalty_energy: T,
    kept: Memory<T>,
    /// What a change of index did before the step.
    pub(crate) settled: Counts,
}

/// What one step tells the next, beside the state.
#[derive(Debug, Clone)]
struct Memory<T> {
    boost: T,
    rho: T,
    probe: Vec<T>,
}

impl<T: Real, S: SpdSolver<T>> Workspace<T, S> {
    /// Scratch for `model`, with a solver analysed for its cliques.
    pub fn new(model: &impl Model<T>, solver: S) -> Self {
        let (n, e, m) = (model.n_unknowns(), model.n_extended(), model.n_constraints());
        let zeros = |k| vec![T::ZERO; k];
        let mut terms = model.terms();
        let start = State::at_rest(model);
        model.set_inputs(start.t, &start, &mut terms);
        model.evaluate(&start.q, &mut terms);
        let mut masses = zeros(m);
        model.effective_masses(&terms, &mut masses);
        let scratch = zeros(solver.n_scratch());
        let factored = terms.jacobian.clone();
        let factored_laws = vec![[T::ZERO; 2]; terms.measures.len()];
        Self {
            solver,
            terms,
            factored,
            factored_laws,
            dq: zeros(e),
            q: start.q,
            v: zeros(e),
            a: zeros(e),
            dq_predicted: zeros(e),
            change: zeros(e),
            f: zeros(n),
            scratch,
            lambda: zeros(m),
            sigma: zeros(m),
            mu: zeros(m),
            rates: zeros(m),
            penalty: zeros(m),
            masses,
            boost: T::ONE,
            base: T::ONE,
            probe: vec![T::ONE; m],
            spread: spread(m),
            rho: T::ZERO,
            counts: Counts::default(),
            penalty_energy: T::ZERO,
            kept: Memory { boost: T::ONE, rho: T::ZERO, probe: vec![T::ONE; m] },
            settled: Counts::default(),
        }
    }

    /// Keeps what the last step leaves for the next one, so that a trial of that can be undone.
    pub fn keep(&mut self) {
        (self.kept.boost, self.kept.rho) = (self.boost, self.rho);
        self.kept.probe.copy_from_slice(&self.probe);
    }

    /// Goes back to what was kept: a trial leaves no trace.
    pub fn undo(&mut self) {
        (self.boost, self.rho) = (self.kept.boost, self.kept.rho);
        self.probe.copy_from_slice(&self.kept.probe);
    }

    /// State that the next step continues from.
    #[must_use]
    pub fn history(&self) -> History<T> {
        let Self { boost, rho, settled, .. } = *self;
        History { boost, rho, probe: self.probe.clone(), settled }
    }

    /// Restores the history of the same model; returns whether it is one, by its length. Else nothing is changed.
    pub fn set_history(&mut self, history: &History<T>) -> bool {
        if history.probe.len() != self.probe.len() {
            return false;
        }
        (self.boost, self.rho, self.settled) = (history.boost, history.rho, history.settled);
        self.probe.copy_from_slice(&history.probe);
        true
    }

    /// The terms as last evaluated.
    pub fn terms(&self) -> &Terms<T> {
        &self.terms
    }

    /// The same, to be put back.
    pub fn terms_mut(&mut self) -> &mut Terms<T> {
        &mut self.terms
    }

    /// The solver.
    pub fn solver(&self) -> &S {
        &self.solver
    }

    /// Factors T with the given weights of stiffness and damping.
    pub(crate) fn factor<M: Model<T>>(
        &mut self,
        model: &M,
        (stiffness, damping): (T, T),
        geometric: bool,
    ) -> Result<(), mbs_core::FactorError> {
        self.counts.factorizations += 1;
        self.factored.copy_from_slice(&self.terms.jacobian);
        for (kept, measure) in self.factored_laws.iter_mut().zip(&self.terms.measures) {
            *kept = [measure.stiffness, measure.damping];
        }
        let geometric = geometric.then_some(&self.lambda[..]);
        let tangent = Tangent { stiffness, damping, penalty: &self.penalty, geometric };
        let load = Load { mass: None, multipliers: None, force: T::ZERO };
        let system = mbs_core::model::System { model, terms: &self.terms, tangent, load };
        self.solver.factor(&system)
    }

    /// Are the laws' tangents nearly those of the factored matrix? A wheel that has left its road, or a stop that was met, is another
    /// law. Stiffness and damping are looked at, of lengths and angles by the same measure; not what a tension adds across its line.
    pub(crate) fn has_like_laws(&self, rule: &Rule<T>) -> bool {
        let weight = |[stiffness, damping]: [T; 2]| stiffness + damping * rule.velocity;
        let (mut largest, mut change) = (T::ZERO, T::ZERO);
        for (&kept, measure) in self.factored_laws.iter().zip(&self.terms.measures) {
            let (before, now) = (weight(kept), weight([measure.stiffness, measure.damping]));
            let size = before.abs().max(now.abs());
            largest = largest.max(size);
            if !((now - before).abs() <= size * T::from_f64(LIKE)) {
                change = change.max(size);
            }
        }
        !(change > largest * T::from_f64(SLIGHT))
    }

    /// Takes the finished step over; `unit` turns `lambda` into multipliers of the equations of motion.
    pub(crate) fn commit<M: Model<T>>(
        &mut self,
        model: &M,
        rule: &Rule<T>,
        compensated: bool,
        unit: T,
        s: &mut State<T>,
    ) {
        let team = model.team();
        take_coordinates(team, (rule, compensated, self.f.len()), s, (&self.dq, &self.v, &self.a));
        let (lambda, sigma, phi) = (&self.lambda, &self.sigma, &self.terms.phi);
        let rows = [&mut s.lambda_previous[..], &mut s.lambda, &mut s.reaction, &mut s.phi];
        on_stretches(team, rows, |first, [previous, last, reaction, phi_n]| {
            for k in 0..last.len() {
                let i = first + k;
                previous[k] = last[k];
                last[k] = lambda[i] * unit;
                reaction[k] = last[k] + sigma[i];
                phi_n[k] = phi[i];
            }
        });
        s.t += rule.dt;
        add_work(model, rule.dt, s, &mut self.terms);
    }

    /// What a step did, with the change of index before it.
    pub(crate) fn report(&mut self, newton: (u32, T, Stop), violation: [T; 3]) -> StepReport<T> {
        let settled = core::mem::take(&mut self.settled);
        let counts = Counts {
            factorizations: self.counts.factorizations + settled.factorizations,
            solves: self.counts.solves + settled.solves,
        };
        let penalty_energy = self.penalty_energy;
        StepReport { penalty_energy, ..StepReport::of_newton(newton, counts, violation) }
    }

    /// 1/2 x^T s x with the penalties s in mass units [P2 (29)].
    pub(crate) fn stored<W: Team>(&self, team: &W, x: &[T]) -> T {
        let penalty = &self.penalty;
        let part = |from: usize, to: usize| {
            let pairs = x[from..to].iter().zip(&penalty[from..to]);
            pairs.fold(T::ZERO, |sum, (&x, &s)| sum + s * x * x)
        };
        sum(team, x.len(), part) * T::HALF
    }

    /// f = T^-1 f.
    pub(crate) fn solve(&mut self) {
        self.counts.solves += 1;
        self.solver.solve(&mut self.f, &mut self.scratch);
    }

    /// f = M x + J^T mu - force Q.
    pub(crate) fn assemble<M: Model<T>>(&mut self, model: &M, mass: Mass, force: T) {
        let mass = match mass {
            Mass::None => None,
            Mass::Velocity => Some(&self.v[..]),
            Mass::Acceleration => Some(&self.a[..]),
            Mass::Change => Some(&self.change[..]),
        };
        let load = Load { mass, multipliers: Some(&self.mu), force };
        let tangent = Tangent {
            stiffness: T::ZERO,
            damping: T::ZERO,
            penalty: &self.penalty,
            geometric: None,
        };
        let system = mbs_core::model::System { model, terms: &self.terms, tangent, load };
        self.solver.assemble(&system, &mut self.f);
    }
}

/// Which vector stands at M in a residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mass {
    None,
    Velocity,
    Acceleration,
    Change,
}
