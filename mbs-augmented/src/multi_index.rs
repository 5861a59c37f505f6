//! Multi-index steps of variable length [P2].

use crate::index_change::IndexChange;
use crate::inputs::take_inputs;
use crate::workspace::Workspace;
use mbs_core::control::{Accepted, Driver, Invariant, LocalError, Rules, Stepper, TrialStep};
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError};
use mbs_core::{Real, SpdSolver};

/// Steps whose length and index are chosen from what the last steps did.
///
/// The energy invariant and the estimate of the local error steer, as the [`Rules`] say; the index follows the length.
#[derive(Debug, Clone)]
pub struct MultiIndex<T> {
    /// Which index a step is made in.
    pub change: IndexChange<T>,
    driver: Driver<T>,
    invariant: Invariant,
    estimate: Option<LocalError<T>>,
    saved: State<T>,
}

impl<T: Real> MultiIndex<T> {
    /// Begins at the consistent state `s` of `model` with a step of `first` [s]. `ground` [J] is the energy that the scene's
    /// loads have anyway, such as its weight times its length: rounding is judged by it.
    ///
    /// # Panics
    /// If a step is not positive and finite.
    pub fn new<M: Model<T>>(
        model: &M,
        change: IndexChange<T>,
        rules: Rules<T>,
        (first, ground): (T, f64),
        s: &State<T>,
    ) -> Self {
        let mut terms = model.terms();
        model.set_inputs(s.t, s, &mut terms);
        model.evaluate(&s.q, &mut terms);
        model.evaluate_forces(&s.q, &s.v, &mut terms);
        let energies = [model.kinetic_energy(&s.v), model.potential_energy(&s.q, &terms), s.work];
        let invariant = Invariant::new(energies.map(T::to_f64), ground, T::EPSILON.to_f64());
        Self {
            driver: Driver::new(rules, first),
            invariant,
            estimate: rules.error.map(|_| LocalError::new(&change.index3.integrator)),
            change,
            saved: s.clone(),
        }
    }

    /// The invariant so far.
    #[must_use]
    pub fn invariant(&self) -> &Invariant {
        &self.invariant
    }

    /// The step that will be tried next [s].
    #[must_use]
    pub fn next_step(&self) -> T {
        self.driver.next()
    }

    /// Makes one step of at most `dt` [s], in as many trials as it takes.
    ///
    /// No allocation. A rejected trial leaves no trace.
    ///
    /// # Errors
    /// [`StepError`] of the last trial; the state is then that of the last accepted step.
    pub fn step<M: Model<T>, S: SpdSolver<T>>(
        &mut self,
        model: &M,
        step: Step<T>,
        s: &mut State<T>,
        w: &mut Workspace<T, S>,
    ) -> Result<Accepted<T>, StepError> {
        let Step { dt: rest, length } = step.checked()?;
        take_inputs(model, s, w)?;
        self.saved.copy_from(s);
        w.save();
        let Self { change, driver, invariant, estimate, saved } = self;
        let mut trial = Trial { model, length, change, estimate: *estimate, s, saved, w };
        let t = trial.s.t;
        driver.step(&mut trial, invariant, (t, rest))
    }
}

/// The state that is tried, and the one to go back to.
struct Trial<'a, T, M, S> {
    model: &'a M,
    length: T,
    change: &'a mut IndexChange<T>,
    estimate: Option<LocalError<T>>,
    s: &'a mut State<T>,
    saved: &'a mut State<T>,
    w: &'a mut Workspace<T, S>,
}

impl<T: Real, M: Model<T>, S: SpdSolver<T>> Stepper<T> for Trial<'_, T, M, S> {
    fn prepare(&mut self, h: T, reductions: u32) -> Result<(), StepError> {
        let step = Step { dt: h, length: self.length };
        if self.change.prepare(self.model, step, reductions, self.s, self.w) {
            self.saved.copy_from(self.s);
            self.w.save();
        }
        Ok(())
    }

    fn attempt(&mut self, h: T) -> Result<TrialStep<T>, StepError> {
        let step = Step { dt: h, length: self.length };
        let report = self.change.step(self.model, step, self.s, self.w);
        let report = report.inspect_err(|_| self.w.restore())?;
        let s = &*self.s;
        let potential = self.model.potential_energy(&s.q, self.w.terms());
        let energies = [self.model.kinetic_energy(&s.v), potential, s.work].map(T::to_f64);
        let error = self.estimate.map_or(T::ZERO, |e| e.of(h, &self.saved.a, &s.a) / self.length);
        let acceleration_energy =
            [&self.saved.a, &s.a].map(|a| self.model.kinetic_energy(a).to_f64());
        self.change.tried(h);
        Ok(TrialStep { report, t: s.t, energies, error: error.to_f64(), acceleration_energy })
    }

    fn undo(&mut self) {
        self.s.copy_from(self.saved);
        self.w.restore();
    }

    fn keep(&mut self, _: bool) {
        self.change.accept();
    }
}
