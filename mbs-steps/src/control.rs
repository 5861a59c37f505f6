//! Steps of controlled length, for every formulation.

use crate::checkpoint::ControlSnapshot;
use crate::choice::StepRule;
use crate::settings::ResolvedMethod;
use crate::signal_ends::SignalEnds;
use mbs_core::Real;
use mbs_core::control::{
    Accepted, Driver, EnergyRule, Event, Invariant, Limit, LocalError, Rules, Stepper, TrialStep,
};
use mbs_core::formulation::Formulation;
use mbs_core::laws::code::CodeOwner;
use mbs_core::model::{Model, State};
use mbs_core::natural::{ModelError, NaturalModel};
use mbs_core::outputs::{Events, Turns};
use mbs_core::scene::Scene;
use mbs_core::step::{Step, StepError};

/// Step control of a run, with the state that is restored after a rejected step.
#[derive(Debug, Clone)]
pub struct Control<T: Real, const D: usize> {
    driver: Driver<T>,
    estimate: Option<LocalError<T>>,
    events: Option<Events<T, D>>,
    /// Tracked joint angles with full turns, for natural coordinates. With relative coordinates, the formulation counts the turns.
    turns: Option<Turns<T, D>>,
    saved: State<T>,
    /// Last user-defined law or relation that failed in a trial step, and the time of that trial [s].
    failed: Option<(CodeOwner, T)>,
    /// The largest step [s].
    max_step: T,
    /// Times at which signals jump or have corners, if steps end at events.
    ends: Option<SignalEnds<T>>,
}

impl<T: Real, const D: usize> Control<T, D> {
    /// Creates the step control that the settings request; `None` for steps of fixed length.
    ///
    /// # Errors
    /// [`ModelError`] if the model of the scene cannot be built.
    pub fn new(
        scene: &Scene<T>,
        settings: &ResolvedMethod,
        model: &NaturalModel<T, D>,
        state: &State<T>,
    ) -> Result<Option<Self>, ModelError> {
        let rule = settings.rule;
        let (energy, error) = (rule.has_energy(), rule.has_error());
        if !energy && !error {
            return Ok(None);
        }
        let estimate = error.then(|| LocalError::new(&settings.integrator.coefficients()));
        let lengths = settings.lengths(scene);
        let rules = Rules {
            max_step: lengths.step_max,
            energy: energy.then(|| EnergyRule {
                is_printed: settings.rule == StepRule::EnergyPrinted,
                ..EnergyRule::new(settings.energy_tolerance)
            }),
            error: estimate.map(|e| (settings.error_tolerance, e.power())),
        };
        let driver = Driver::new(rules, lengths.step);
        let mut events = settings.events.then(|| Events::new(scene, model)).transpose()?;
        events.iter_mut().for_each(|events| events.start(state));
        let is_tree = settings.formulation.row().relative;
        let turns = (!is_tree).then(|| Turns::new(scene, model));
        Ok(Some(Self {
            driver,
            estimate,
            events,
            turns,
            saved: state.clone(),
            failed: None,
            max_step: lengths.step_max,
            ends: settings.events.then(|| SignalEnds::new(model)),
        }))
    }

    /// Data of the step control that the next step depends on.
    pub fn snapshot(&self) -> ControlSnapshot<T> {
        let events = self.events.as_ref().map(Events::history);
        ControlSnapshot { driver: self.driver.history(), events }
    }

    /// Restores a snapshot; returns false if the snapshot belongs to other rules or effects.
    pub fn restore(&mut self, snapshot: &ControlSnapshot<T>) -> bool {
        let is_ours = match (&mut self.events, &snapshot.events) {
            (Some(events), Some(history)) => events.set_history(history),
            (events, history) => events.is_none() && history.is_none(),
        };
        is_ours && self.driver.set_history(snapshot.driver)
    }

    /// Restarts the detection of events at a state that was set by other code than a step.
    pub fn restart(&mut self, state: &State<T>) {
        self.events.iter_mut().for_each(|events| events.start(state));
    }

    /// Makes one step of at most `rest` [s]. The step ends at the next jump or corner of a signal, if there is one within `rest`.
    pub fn step(
        &mut self,
        (model, formulation): (&NaturalModel<T, D>, &mut dyn Formulation<T, D>),
        state: &mut State<T>,
        invariant: &mut Invariant,
        rest: T,
    ) -> Result<Accepted<T>, StepError> {
        let ahead = self.ends.as_ref().and_then(|ends| ends.ahead(state.t, rest));
        self.saved.copy_from(state);
        formulation.save_trial();
        let Self { driver, estimate, events, turns, saved, .. } = self;
        let (estimate, turns) = (*estimate, turns.as_ref());
        let mut trial = Trial { model, formulation, state, saved, estimate, events, turns };
        let length = ahead.map_or(rest, |(_, length)| length);
        let t = trial.state.t;
        let made = driver.step(&mut trial, invariant, (t, length))?;
        let Some((at, _)) = ahead.filter(|_| made.is_last) else { return Ok(made) };
        SignalEnds::pass(&at, (model, &mut *trial.formulation), trial.state)?;
        if let Some(events) = trial.events {
            events.start(trial.state);
        }
        let attempt = TrialStep { t: trial.state.t, ..made.attempt };
        Ok(Accepted { attempt, limit: Limit::Event, is_last: false, ..made })
    }

    /// Stores the user-defined law or relation that failed in a trial step to time `t` [s]; `None`: none failed.
    pub fn note(&mut self, failed: Option<CodeOwner>, t: T) {
        if let Some(failed) = failed {
            self.failed = Some((failed, t));
        }
    }

    /// Returns the user-defined law or relation that failed last, if it failed at most one largest step before time `t` [s]. If steps
    /// become too small at `t`, this failure is the cause.
    pub fn failed_before(&self, t: T) -> Option<CodeOwner> {
        self.failed.filter(|(_, at)| t - *at <= self.max_step).map(|(failed, _)| failed)
    }
}

/// Trial state, and the saved state that is restored after a rejected trial.
struct Trial<'a, T: Real, const D: usize> {
    model: &'a NaturalModel<T, D>,
    formulation: &'a mut dyn Formulation<T, D>,
    state: &'a mut State<T>,
    saved: &'a mut State<T>,
    estimate: Option<LocalError<T>>,
    events: &'a mut Option<Events<T, D>>,
    turns: Option<&'a Turns<T, D>>,
}

impl<T: Real, const D: usize> Trial<'_, T, D> {
    /// Returns a trial step of length `h` [s].
    fn length(&self, h: T) -> Step<T> {
        Step { dt: h, length: self.model.length() }
    }
}

impl<T: Real, const D: usize> Stepper<T> for Trial<'_, T, D> {
    fn prepare(&mut self, h: T, reductions: u32) -> Result<(), StepError> {
        let step = self.length(h);
        if self.formulation.prepare(self.model, step, reductions, self.state) {
            self.saved.copy_from(self.state);
            self.formulation.save_trial();
        }
        Ok(())
    }

    fn attempt(&mut self, h: T) -> Result<TrialStep<T>, StepError> {
        let step = self.length(h);
        let report = self.formulation.step(self.model, step, self.state);
        let report = report.inspect_err(|_| self.formulation.restore_trial())?;
        if let Some(turns) = self.turns {
            let checked = turns.check([self.saved, self.state]);
            checked.inspect_err(|_| self.undo())?;
        }
        let energies = self.formulation.energies(self.model, self.state);
        let length = self.model.length();
        let error = self
            .estimate
            .map_or(T::ZERO, |estimate| estimate.of(h, &self.saved.a, &self.state.a) / length);
        let acceleration_energy =
            [&self.saved.a, &self.state.a].map(|a| self.model.kinetic_energy(a).to_f64());
        self.formulation.tried(h);
        let (t, error) = (self.state.t, error.to_f64());
        Ok(TrialStep { report, t, energies, error, acceleration_energy })
    }

    fn undo(&mut self) {
        self.state.copy_from(self.saved);
        self.formulation.restore_trial();
    }

    fn first_event(&mut self, _: T) -> Option<Event> {
        self.events.as_mut()?.first_event(self.state)
    }

    fn keep(&mut self, at_event: bool) {
        self.formulation.accept();
        if let Some(events) = self.events {
            events.accept(self.state);
        }
        if at_event {
            // The multipliers have a corner at an event, so a length of zero prevents extrapolation across it.
            self.state.dt = T::ZERO;
        }
    }
}
