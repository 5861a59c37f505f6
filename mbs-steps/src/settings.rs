//! Settings of a run: the scene's `[solver]` table, overridden by the command line, and checked against the available methods.

mod error;
pub mod length;
mod range;
mod way;

use crate::choice::{INTEGRATORS, IntegratorKind, PRECISIONS, Precision, STEP_RULES, StepRule};
use crate::interrupt::Interrupt;
use crate::methods::{FORMULATIONS, FormulationKind, PenaltyUse};
use crate::precision::is_finer;
use crate::record::PilotReport;
pub use error::SettingsError;
use length::MOST_STEPS;
use mbs_core::control::EnergyRule;
use mbs_core::once::found;
use mbs_core::scene::{NotASetting, Scene, SettingSlot, SettingValue, SolverTable};
use mbs_core::{Real, instances};
use range::{checked, named, ordered, positive};

/// Length of a step if neither the scene nor the command line gives one [s].
pub const DEFAULT_STEP: f64 = 1e-3;

/// Default tolerance of the estimated local error of a step, relative to the scene's length [-]. Chosen, not tuned.
const DEFAULT_ERROR: f64 = 1e-6;
/// Default error of the energy invariant at which a run stops, relative to the exchanged energy [-]. Chosen, not tuned.
const DEFAULT_ALARM: f64 = 0.1;

/// Settings from the command line or from a caller; `None` leaves a setting to the scene. [`SETTINGS`](mbs_core::scene::SETTINGS) lists the
/// defaults, and the methods that use each setting.
///
/// ```
/// use mbs::{FormulationKind, IntegratorKind, Method};
/// let method = Method::new(FormulationKind::Recursive).integrator(IntegratorKind::Rk4).step(1e-3);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Method {
    /// Formulation of the equations of motion.
    pub formulation: Option<String>,
    /// Integrator of the equations of motion.
    pub integrator: Option<String>,
    /// Precision of the numbers.
    pub precision: Option<String>,
    /// Length of a step; of the first one where lengths are controlled [s].
    pub step: Option<f64>,
    /// Longest step, and the distance of recorded rows [s].
    pub step_max: Option<f64>,
    /// Rule for the length of steps.
    pub step_control: Option<String>,
    /// Limits U and L of the invariant's change in a step, relative to the energy that moves.
    pub energy_tolerance: Option<[f64; 2]>,
    /// Tolerance of the estimated local error of a step, relative to the scene's length.
    pub error_tolerance: Option<f64>,
    /// Whether steps end where contacts begin or end, and at kinks of the road and of signals.
    pub events: Option<bool>,
    /// Largest error of the energy invariant, relative to the exchanged energy; beyond it the run stops.
    pub energy_alarm: Option<f64>,
    /// Duration of the run [s].
    pub duration: Option<f64>,
    /// Fixed penalty of the augmented Lagrangian, the printed alpha [N/m; index-1: kg].
    pub penalty: Option<f64>,
    /// Tolerance of the iterations, relative to the displacement by accelerations in a step.
    pub tolerance: Option<f64>,
    /// Threads that share the work of a step.
    pub threads: Option<usize>,
    /// Interrupt that ends the run from outside.
    pub interrupt: Interrupt,
}

impl Method {
    /// Field that stores a setting; `None` for a name that is not in [`SETTINGS`](mbs_core::scene::SETTINGS).
    pub fn slot(&mut self, name: &str) -> Option<SettingSlot<'_, f64>> {
        Some(match name {
            "formulation" => SettingSlot::Word(&mut self.formulation),
            "integrator" => SettingSlot::Word(&mut self.integrator),
            "precision" => SettingSlot::Word(&mut self.precision),
            "step" => SettingSlot::Number(&mut self.step),
            "step_max" => SettingSlot::Number(&mut self.step_max),
            "step_control" => SettingSlot::Word(&mut self.step_control),
            "energy_tolerance" => SettingSlot::Pair(&mut self.energy_tolerance),
            "error_tolerance" => SettingSlot::Number(&mut self.error_tolerance),
            "events" => SettingSlot::Flag(&mut self.events),
            "energy_alarm" => SettingSlot::Number(&mut self.energy_alarm),
            "duration" => SettingSlot::Number(&mut self.duration),
            "penalty" => SettingSlot::Number(&mut self.penalty),
            "tolerance" => SettingSlot::Number(&mut self.tolerance),
            "threads" => SettingSlot::Count(&mut self.threads),
            _ => return None,
        })
    }

    /// Value of a setting; `None` if it is not given. Cost: a copy of the method.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<SettingValue<f64>> {
        self.clone().slot(name)?.take()
    }

    /// Sets a setting by its name.
    ///
    /// # Errors
    /// [`NotASetting`] if no setting has the name, or if the value has another type.
    pub fn set(&mut self, name: &str, value: SettingValue<f64>) -> Result<(), NotASetting> {
        self.slot(name).ok_or(NotASetting)?.set(value)
    }

    /// Makes a method with this formulation. All other settings come from the scene or are defaults.
    #[must_use]
    pub fn new(formulation: FormulationKind) -> Self {
        Self::default().formulation(formulation)
    }

    /// Sets [`formulation`](Self#structfield.formulation) of the method.
    #[must_use]
    pub fn formulation(self, formulation: FormulationKind) -> Self {
        Self { formulation: Some(formulation.name().to_owned()), ..self }
    }

    /// Sets [`integrator`](Self#structfield.integrator) of the method. The integrators of first order (`rk4`, `rk54`, `rk853`, `gbs`,
    /// `radau5`) need relative coordinates. If no formulation is given, they select `recursive`.
    #[must_use]
    pub fn integrator(self, integrator: IntegratorKind) -> Self {
        Self { integrator: Some(integrator.name().to_owned()), ..self }
    }

    /// Sets [`precision`](Self#structfield.precision) of the method.
    #[must_use]
    pub fn precision(self, precision: Precision) -> Self {
        Self { precision: Some(precision.name().to_owned()), ..self }
    }

    /// Sets [`step`](Self#structfield.step) of the method [s].
    #[must_use]
    pub fn step(self, dt: f64) -> Self {
        Self { step: Some(dt), ..self }
    }

    /// Sets [`step_max`](Self#structfield.step_max) of the method [s].
    #[must_use]
    pub fn step_max(self, dt: f64) -> Self {
        Self { step_max: Some(dt), ..self }
    }

    /// Sets [`step_control`](Self#structfield.step_control) of the method. Steps do not become longer than the first step, unless
    /// [`step_max`](Self::step_max) allows longer steps.
    ///
    /// ```
    /// use mbs::{Method, StepRule};
    /// let method = Method::default().control(StepRule::Error).error_tolerance(1e-7).step(1e-4).step_max(1e-2);
    /// ```
    #[must_use]
    pub fn control(self, control: StepRule) -> Self {
        Self { step_control: Some(control.name().to_owned()), ..self }
    }

    /// Sets [`energy_tolerance`](Self#structfield.energy_tolerance) of the method, the larger limit first.
    #[must_use]
    pub fn energy_tolerance(self, limits: [f64; 2]) -> Self {
        Self { energy_tolerance: Some(limits), ..self }
    }

    /// Sets [`error_tolerance`](Self#structfield.error_tolerance) of the method.
    #[must_use]
    pub fn error_tolerance(self, error: f64) -> Self {
        Self { error_tolerance: Some(error), ..self }
    }

    /// Sets [`events`](Self#structfield.events) of the method.
    #[must_use]
    pub fn events(self, are_located: bool) -> Self {
        Self { events: Some(are_located), ..self }
    }

    /// Sets [`energy_alarm`](Self#structfield.energy_alarm) of the method.
    #[must_use]
    pub fn energy_alarm(self, ratio: f64) -> Self {
        Self { energy_alarm: Some(ratio), ..self }
    }

    /// Sets [`duration`](Self#structfield.duration) of the method [s].
    #[must_use]
    pub fn duration(self, duration: f64) -> Self {
        Self { duration: Some(duration), ..self }
    }

    /// Sets [`penalty`](Self#structfield.penalty) of the method [N/m in index-3, kg in index-1].
    #[must_use]
    pub fn penalty(self, alpha: f64) -> Self {
        Self { penalty: Some(alpha), ..self }
    }

    /// Sets [`tolerance`](Self#structfield.tolerance) of the method.
    #[must_use]
    pub fn tolerance(self, tolerance: f64) -> Self {
        Self { tolerance: Some(tolerance), ..self }
    }

    /// Sets [`threads`](Self#structfield.threads) of the method.
    #[must_use]
    pub fn threads(self, n: usize) -> Self {
        Self { threads: Some(n), ..self }
    }
}

/// Settings of a run, all resolved to values.
#[derive(Debug, Clone, PartialEq)]
pub struct ResolvedMethod {
    /// Formulation as requested; it may be `auto`.
    pub asked: String,
    /// Formulation that the run uses.
    pub formulation: FormulationKind,
    /// Integrator that the run uses.
    pub integrator: IntegratorKind,
    /// Precision of the run.
    pub precision: Precision,
    /// Length of a step; with step control, length of the first step [s].
    pub step: f64,
    /// Largest length of a step, and interval of recorded rows [s].
    pub step_max: f64,
    /// Rule for the length of steps.
    pub rule: StepRule,
    /// Limits U and L of the change of the energy invariant in a step, relative to the energy that moves.
    pub energy_tolerance: [f64; 2],
    /// Tolerance of the estimated local error of a step, relative to the scene's length.
    pub error_tolerance: f64,
    /// True if steps end where contacts begin or end, and at kinks of the road and of signals.
    pub events: bool,
    /// Largest allowed error of the energy invariant, relative to the exchanged energy. The run stops if the error is larger.
    pub energy_alarm: f64,
    /// Duration of the run [s].
    pub duration: f64,
    /// Fixed penalty alpha of the augmented Lagrangian, as published [N/m; index-1: kg]; `None`: the formulation chooses it.
    pub penalty: Option<f64>,
    /// Tolerance of the iterations, relative to the displacement that accelerations cause in a step. `None`: the default of the formulation
    /// or the integrator.
    pub tolerance: Option<f64>,
    /// Number of threads of a step.
    pub threads: usize,
    /// Report of the pilot; `None` if no pilot chose the method.
    pub choice: Option<Box<PilotReport>>,
    /// Interrupt that ends the run from outside.
    pub interrupt: Interrupt,
}

/// Step, largest step and duration of a run, in the precision of the run [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lengths<T> {
    /// Length of a step.
    pub step: T,
    /// Largest length of a step.
    pub step_max: T,
    /// Duration of the run.
    pub duration: T,
}

type New<T> = fn(&Scene<T>, &Method) -> Result<ResolvedMethod, SettingsError>;
instances!(NEW: New<T> = ResolvedMethod::of::<T>, {});

impl ResolvedMethod {
    /// Resolves the settings of a run from a scene and overrides.
    ///
    /// # Errors
    /// [`SettingsError`] for a method that this build does not have, or for a value out of range.
    pub fn new<T: Real>(scene: &Scene<T>, overrides: &Method) -> Result<Self, SettingsError> {
        if T::HAS_INSTANCES {
            return found::<New<T>>(NEW)(scene, overrides);
        }
        Self::of(scene, overrides)
    }

    fn of<T: Real>(scene: &Scene<T>, overrides: &Method) -> Result<Self, SettingsError> {
        let solver = &scene.solver;
        let (asked, formulation, integrator) = method(solver, overrides)?;
        let (_, precision) =
            named("precision", (&overrides.precision, &None, "f64"), &PRECISIONS, Precision::ALL)?;
        if !precision.is_built() {
            return Err(SettingsError::NotInBuild(precision));
        }
        let threads = overrides.threads.unwrap_or(1);
        if threads == 0 {
            return Err(SettingsError::NotPositive { key: "threads", value: 0.0 });
        }
        if threads > 1 && !formulation.row().threads {
            let option = "threads".to_owned();
            return Err(SettingsError::NotTogether { formulation, option });
        }
        let of_scene = |x: Option<T>| x.map(Real::to_f64);
        let step = overrides.step.or(of_scene(solver.step)).unwrap_or(DEFAULT_STEP);
        let step = positive("step", step)?;
        let step_max = overrides.step_max.or(of_scene(solver.step_max)).unwrap_or(step);
        let step_max = positive("step_max", step_max)?;
        let rule = step_rule(solver, overrides, (formulation, integrator))?;
        let is_controlled = length::is_controlled(integrator, rule);
        let limits = energy_limits(solver, overrides);
        let duration = overrides.duration.unwrap_or(scene.duration.to_f64());
        let duration = positive("duration", duration)?;
        scene.check_run(T::from_f64(duration)).map_err(SettingsError::Scene)?;
        let shorter = step.min(step_max);
        if duration / shorter > MOST_STEPS {
            return Err(SettingsError::TooManySteps { step: shorter, duration });
        }
        // The penalty in a scene file applies only to formulations of the augmented Lagrangian.
        let of_file = of_scene(solver.penalty).filter(|_| formulation.scene_penalty().is_some());
        let penalty = overrides.penalty.or(of_file);
        Ok(Self {
            asked,
            formulation,
            integrator,
            precision,
            step,
            step_max: if is_controlled { step_max.min(duration) } else { step },
            rule,
            energy_tolerance: ordered(limits)?,
            error_tolerance: positive(
                "error_tolerance",
                overrides
                    .error_tolerance
                    .or(of_scene(solver.error_tolerance))
                    .unwrap_or(DEFAULT_ERROR),
            )?,
            events: overrides.events.or(solver.locate_events).unwrap_or(is_controlled),
            energy_alarm: positive(
                "energy_alarm",
                overrides.energy_alarm.or(of_scene(solver.energy_alarm)).unwrap_or(DEFAULT_ALARM),
            )?,
            duration,
            penalty: checked("penalty", penalty)?,
            tolerance: checked("tolerance", overrides.tolerance.or(of_scene(solver.tolerance)))?,
            threads,
            choice: None,
            interrupt: overrides.interrupt.clone(),
        })
    }

    /// Returns a method in which every resolved setting is given.
    #[must_use]
    pub fn decided(&self) -> Method {
        let name = |name: &str| Some(name.to_owned());
        Method {
            formulation: name(self.formulation.name()),
            integrator: name(self.integrator.name()),
            precision: name(self.precision.name()),
            step: Some(self.step),
            step_max: Some(self.step_max),
            step_control: name(self.rule.name()),
            energy_tolerance: Some(self.energy_tolerance),
            error_tolerance: Some(self.error_tolerance),
            events: Some(self.events),
            energy_alarm: Some(self.energy_alarm),
            duration: Some(self.duration),
            penalty: self.penalty,
            tolerance: self.tolerance,
            threads: Some(self.threads),
            interrupt: self.interrupt.clone(),
        }
    }

    /// Step, largest step and duration in the precision of the run.
    #[must_use]
    pub fn lengths<T: Real>(&self, scene: &Scene<T>) -> Lengths<T> {
        let lengths = [self.step, self.step_max, self.duration];
        let [step, step_max, duration] = lengths.map(|x| exact(scene, x));
        Lengths { step, step_max, duration }
    }

    /// Number of recorded intervals. Each interval is one step, or several steps of controlled length. If the duration is a multiple of
    /// `step_max` within 1e-9 (relative), all intervals are equal. Otherwise the last interval is shorter.
    #[must_use]
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count, checked to be positive"
    )]
    pub fn n_steps(&self) -> u64 {
        let steps = self.duration / self.step_max;
        let whole = steps.round();
        if (steps - whole).abs() <= length::SAME_LENGTH * whole.max(1.0) {
            whole.max(1.0) as u64
        } else {
            steps.ceil() as u64
        }
    }
}

/// Converts a length of time [s] to the precision of a run. If this precision is finer than `f64`, the digits beyond `f64` are restored.
/// They are taken from the scene's value that rounds to `x`, or else from the shortest decimal number that `f64` reads as `x`.
pub fn exact<T: Real>(scene: &Scene<T>, x: f64) -> T {
    if !is_finer::<T>() {
        return T::from_f64(x);
    }
    let written = [Some(scene.duration), scene.solver.step, scene.solver.step_max];
    let same = written.into_iter().flatten().find(|&w| w.to_f64().to_bits() == x.to_bits());
    same.or_else(|| T::from_decimal(&format!("{x:e}"))).unwrap_or(T::from_f64(x))
}

/// Returns the requested formulation, the formulation that runs, and the integrator.
fn method<T>(
    solver: &SolverTable<T>,
    overrides: &Method,
) -> Result<(String, FormulationKind, IntegratorKind), SettingsError> {
    let (asked, formulation) = named(
        "formulation",
        (&overrides.formulation, &solver.formulation, "auto"),
        &FORMULATIONS,
        // In the list of names, `auto` comes before the formulations.
        core::array::from_fn(|i| i.checked_sub(1).map(|i| FormulationKind::ALL[i])),
    )?;
    let (_, integrator) = named(
        "integrator",
        (&overrides.integrator, &solver.integrator, "trapezoidal"),
        &INTEGRATORS,
        IntegratorKind::ALL,
    )?;
    let formulation = match formulation {
        Some(formulation) => formulation,
        None if integrator.is_of_first_order() => FormulationKind::RELATIVE,
        None => FormulationKind::DEFAULT,
    };
    if !formulation.runs_with(integrator) {
        let option = format!("integrator {}", integrator.name());
        return Err(SettingsError::NotTogether { formulation, option });
    }
    if formulation.row().penalty == PenaltyUse::None && overrides.penalty.is_some() {
        let option = "penalty".to_owned();
        return Err(SettingsError::NotTogether { formulation, option });
    }
    Ok((asked, formulation, integrator))
}

/// Chooses the rule for the length of the steps. A rule that the caller names has priority over the rule of the caller's tolerances. Then
/// comes a rule that the scene names, and then the rule of the scene's error tolerance. The energy limits of a scene select no rule,
/// because they are intended for `multi-index`, whose default is the energy rule.
fn step_rule<T>(
    solver: &SolverTable<T>,
    overrides: &Method,
    (formulation, integrator): (FormulationKind, IntegratorKind),
) -> Result<StepRule, SettingsError> {
    let of_formulation = formulation.row().energy_rule;
    let given = [overrides.energy_tolerance.is_some(), overrides.error_tolerance.is_some()];
    let is_named = overrides.step_control.is_some() || solver.step_control.is_some();
    let (from_caller, default) = if overrides.step_control.is_none() && given != [false; 2] {
        let rule = StepRule::of(given[0] || of_formulation, given[1]);
        (Some(rule.name().to_owned()), rule)
    } else {
        let default = StepRule::of(of_formulation, solver.error_tolerance.is_some());
        (overrides.step_control.clone(), default)
    };
    let [from_caller, from_scene] = [&from_caller, &solver.step_control]
        .map(|name| name.as_deref().map(|name| StepRule::canonical(name).to_owned()));
    let names = (&from_caller, &from_scene, default.name());
    let (_, rule) = named("step_control", names, &STEP_RULES, StepRule::ALL)?;
    if rule == StepRule::Fixed || !integrator.is_of_first_order() {
        return Ok(rule);
    }
    // A tolerance in the scene is intended for integrators that use it, so for other integrators it is no error.
    if !is_named && given == [false; 2] {
        return Ok(StepRule::Fixed);
    }
    let option = format!("step control {} beside integrator {}", rule.name(), integrator.name());
    Err(SettingsError::NotTogether { formulation, option })
}

/// Limits U and L of the energy rule. The caller's limits have priority over the scene's limits, and these over the defaults.
fn energy_limits<T: Real>(solver: &SolverTable<T>, overrides: &Method) -> [f64; 2] {
    let of_scene = solver.energy_tolerance.map(|limits| limits.map(T::to_f64));
    let usual = EnergyRule::default();
    overrides.energy_tolerance.or(of_scene).unwrap_or([usual.upper, usual.lower])
}
