//! Steps of controlled length, whatever the formulation.

use crate::choice::StepRule;
use crate::engine::Engine;
use crate::settings::Settings;
use crate::tree::{InSpace, Plane};
use mbs_core::Real;
use mbs_core::control::{
    Accepted, Attempt, Driver, EnergyRule, Invariant, LocalError, Rules, Stepper,
};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::step::StepError;

/// The driver of a run, with the state to which a rejected step goes back.
#[derive(Debug)]
pub(crate) struct Control<T> {
    driver: Driver<T>,
    estimate: Option<LocalError<T>>,
    saved: State<T>,
}

impl<T: Real> Control<T> {
    /// As the settings say; nothing for steps of fixed length.
    pub(crate) fn new(settings: &Settings, state: &State<T>) -> Option<Self> {
        let rule = settings.rule;
        let (energy, error) = (rule.has_energy(), rule.has_error());
        if !energy && !error {
            return None;
        }
        let estimate = error.then(|| LocalError::new(&settings.integrator.coefficients()));
        let rules = Rules {
            max_step: T::from_f64(settings.step_max),
            energy: energy.then(|| EnergyRule {
                is_printed: settings.rule == StepRule::EnergyPrinted,
                ..EnergyRule::new(settings.energy_tolerance)
            }),
            error: estimate.map(|e| (settings.error_tolerance, e.power())),
        };
        let driver = Driver::new(rules, T::from_f64(settings.step));
        Some(Self { driver, estimate, saved: state.clone() })
    }

    /// One step of at most `rest` [s].
    pub(crate) fn step<const D: usize>(
        &mut self,
        (model, engine): (&NaturalModel<T, D>, &mut Engine<T, D>),
        state: &mut State<T>,
        invariant: &mut Invariant,
        rest: T,
    ) -> Result<Accepted<T>, StepError>
    where
        Plane<D>: InSpace<T>,
    {
        self.saved.copy_from(state);
        engine.keep();
        let Self { driver, estimate, saved } = self;
        let mut trial = Trial { model, engine, state, saved, estimate: *estimate };
        driver.step(&mut trial, invariant, rest)
    }
}

/// The state that is tried, and the one to go back to.
struct Trial<'a, T: Real, const D: usize>
where
    Plane<D>: InSpace<T>,
{
    model: &'a NaturalModel<T, D>,
    engine: &'a mut Engine<T, D>,
    state: &'a mut State<T>,
    saved: &'a mut State<T>,
    estimate: Option<LocalError<T>>,
}

impl<T: Real, const D: usize> Stepper<T> for Trial<'_, T, D>
where
    Plane<D>: InSpace<T>,
{
    fn prepare(&mut self, h: T, reductions: u32) -> Result<(), StepError> {
        if self.engine.prepare(self.model, h, reductions, self.state) {
            self.saved.copy_from(self.state);
            self.engine.keep();
        }
        Ok(())
    }

    fn attempt(&mut self, h: T) -> Result<Attempt<T>, StepError> {
        let report = self.engine.step(self.model, h, self.state);
        let report = report.inspect_err(|_| self.engine.undo())?;
        let energies = self.engine.energies(self.model, self.state);
        let length = self.model.length();
        let error = self
            .estimate
            .map_or(T::ZERO, |estimate| estimate.of(h, &self.saved.a, &self.state.a) / length);
        Ok(Attempt { report, t: self.state.t, energies, error: error.to_f64() })
    }

    fn undo(&mut self) {
        self.state.copy_from(self.saved);
        self.engine.undo();
    }

    fn keep(&mut self, _: bool) {}
}
