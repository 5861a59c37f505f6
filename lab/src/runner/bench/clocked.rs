//! A model and a solver that call those of the library, and read a clock or another meter around each call. So the real step is timed, and
//! the library contains no clock.

use mbs_core::model::{Model, Terms};
use mbs_core::team::Team;
use mbs_core::{BlockSource, Cliques, FactorError, Real, SpdSolver};
use serde_json::{Map, Value, json};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::time::Instant;

/// Phase of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Phase {
    Evaluation,
    Forces,
    Bias,
    Residuals,
    Factorisation,
    Solves,
    Products,
}

/// Names of the phases, in the order of [`Phase`].
pub(crate) const NAMES: [&str; 7] =
    ["evaluation", "forces", "bias", "residuals", "factorisation", "solves", "products"];

/// Meter that is read before and after each phase.
pub(crate) trait Meter: Sync {
    /// Does the work of a phase, and records its cost.
    fn read<R>(&self, phase: Phase, work: impl FnOnce() -> R) -> R;
}

/// Time of each phase, of complete steps, and of the part after the last evaluation of the iteration, in nanoseconds.
#[derive(Debug)]
pub(crate) struct Clock {
    origin: Instant,
    phases: [AtomicU64; NAMES.len()],
    step: AtomicU64,
    after: AtomicU64,
    readings: AtomicU64,
    began: AtomicU64,
    evaluated: AtomicU64,
    /// True while the step may be iterating. The bias is evaluated after the iterations, and so marks their end.
    is_iterating: AtomicBool,
}

impl Clock {
    pub(crate) fn new() -> Self {
        Self {
            origin: Instant::now(),
            phases: Default::default(),
            step: AtomicU64::new(0),
            after: AtomicU64::new(0),
            readings: AtomicU64::new(0),
            began: AtomicU64::new(0),
            evaluated: AtomicU64::new(0),
            is_iterating: AtomicBool::new(false),
        }
    }

    /// Sets all sums to zero.
    pub(crate) fn reset(&self) {
        let sums = [&self.step, &self.after, &self.readings];
        self.phases.iter().chain(sums).for_each(|sum| sum.store(0, Relaxed));
    }

    fn now(&self) -> u64 {
        u64::try_from(self.origin.elapsed().as_nanos()).unwrap_or(u64::MAX)
    }

    pub(crate) fn begin(&self) {
        let now = self.now();
        self.began.store(now, Relaxed);
        self.evaluated.store(now, Relaxed);
        self.is_iterating.store(true, Relaxed);
    }

    pub(crate) fn end(&self) {
        let now = self.now();
        self.step.fetch_add(now - self.began.load(Relaxed), Relaxed);
        self.after.fetch_add(now - self.evaluated.load(Relaxed), Relaxed);
    }

    /// Seconds per step of each phase, of the rest of the step, and of the part after the last evaluation, averaged over `steps` steps.
    pub(crate) fn json(&self, steps: u64) -> Value {
        #[allow(clippy::cast_precision_loss, reason = "nanoseconds of minutes")]
        let each = |sum: &AtomicU64| sum.load(Relaxed) as f64 / steps.max(1) as f64;
        let mut phases = Map::new();
        let mut rest = each(&self.step);
        for (name, sum) in NAMES.iter().zip(&self.phases) {
            phases.insert((*name).to_owned(), json!(each(sum) * 1e-9));
            rest -= each(sum);
        }
        phases.insert("rest".to_owned(), json!(rest * 1e-9));
        json!({
            "phases": phases, "step": each(&self.step) * 1e-9,
            "after_evaluation": each(&self.after) * 1e-9, "readings": each(&self.readings),
        })
    }
}

impl Meter for Clock {
    fn read<R>(&self, phase: Phase, work: impl FnOnce() -> R) -> R {
        let start = self.now();
        let result = work();
        let end = self.now();
        self.phases[phase as usize].fetch_add(end - start, Relaxed);
        self.readings.fetch_add(2, Relaxed);
        match phase {
            Phase::Evaluation | Phase::Forces if self.is_iterating.load(Relaxed) => {
                self.evaluated.store(end, Relaxed);
            }
            Phase::Bias => self.is_iterating.store(false, Relaxed),
            _ => {}
        }
        result
    }
}

/// A solver whose calls are timed.
#[derive(Debug)]
pub(crate) struct ClockedSolver<'a, S, C = Clock> {
    pub(crate) solver: S,
    pub(crate) clock: &'a C,
}

impl<T: Real, S: SpdSolver<T>, C: Meter> SpdSolver<T> for ClockedSolver<'_, S, C> {
    fn factor<B: BlockSource<T>>(&mut self, source: &B) -> Result<(), FactorError> {
        self.clock.read(Phase::Factorisation, || self.solver.factor(source))
    }
    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        self.clock.read(Phase::Solves, || self.solver.solve(x, scratch));
    }
    fn n_scratch(&self) -> usize {
        self.solver.n_scratch()
    }
    fn assemble<B: BlockSource<T>>(&mut self, source: &B, f: &mut [T]) {
        self.clock.read(Phase::Residuals, || self.solver.assemble(source, f));
    }
    fn pivots(&self) -> &[T] {
        self.solver.pivots()
    }
    fn elimination_order(&self) -> &[u32] {
        self.solver.elimination_order()
    }
}

/// A model whose evaluations and products are timed. Blocks and residuals of elements are part of the solver's time.
#[derive(Debug)]
pub(crate) struct ClockedModel<'a, M, C = Clock> {
    pub(crate) model: M,
    pub(crate) clock: &'a C,
}

impl<M: Cliques, C> Cliques for ClockedModel<'_, M, C> {
    mbs_core::delegate_cliques!(model);
}

impl<T: Real, M: Model<T>, C: Meter> Model<T> for ClockedModel<'_, M, C> {
    mbs_core::delegate_model!(T, model);
    fn team(&self) -> &impl Team {
        self.model.team()
    }
    fn evaluate(&self, q: &[T], terms: &mut Terms<T>) {
        self.clock.read(Phase::Evaluation, || self.model.evaluate(q, terms));
    }
    fn advance(&self, q: &[T], dq: &[T], phi_n: &[T], terms: &mut Terms<T>) {
        self.clock.read(Phase::Evaluation, || self.model.advance(q, dq, phi_n, terms));
    }
    fn evaluate_forces(&self, q: &[T], v: &[T], terms: &mut Terms<T>) {
        self.clock.read(Phase::Forces, || self.model.evaluate_forces(q, v, terms));
    }
    fn evaluate_bias(&self, q: &[T], v: &[T], terms: &mut Terms<T>) {
        self.clock.read(Phase::Bias, || self.model.evaluate_bias(q, v, terms));
    }
    fn multiply_jacobian(&self, terms: &Terms<T>, x: &[T], rates: &mut [T]) {
        self.clock.read(Phase::Products, || self.model.multiply_jacobian(terms, x, rates));
    }
    fn kinetic_energy(&self, v: &[T]) -> T {
        self.model.kinetic_energy(v)
    }
    fn potential_energy(&self, q: &[T], terms: &Terms<T>) -> T {
        self.model.potential_energy(q, terms)
    }
}

/// Makes a step between two readings of the clock, if there is a clock.
pub(crate) fn watched<R>(clock: Option<&Clock>, step: impl FnOnce() -> R) -> R {
    let Some(clock) = clock else { return step() };
    clock.begin();
    let result = step();
    clock.end();
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_and_rest_make_up_the_step() {
        let clock = Clock::new();
        clock.begin();
        let work = || std::thread::sleep(std::time::Duration::from_micros(50));
        clock.read(Phase::Evaluation, work);
        clock.read(Phase::Solves, work);
        clock.read(Phase::Bias, work);
        clock.read(Phase::Forces, work);
        clock.end();
        let line = clock.json(1);
        let number = |value: &Value| value.as_f64().unwrap();
        let sum: f64 = line["phases"].as_object().unwrap().values().map(number).sum();
        assert!((sum - number(&line["step"])).abs() < 1e-12);
        let [after, evaluation] = [&line["after_evaluation"], &line["phases"]["evaluation"]];
        assert!(number(after) < number(&line["step"]) - number(evaluation) + 1e-12);
        assert!((number(&line["readings"]) - 8.0).abs() < 1e-12);
        clock.reset();
        assert!(number(&clock.json(1)["step"]).abs() < 1e-12);
    }
}
