//! Settings of a run: the scene's `[solver]` table, overridden by the command line, checked against what is built.

pub mod length;
mod method;
mod way;

use crate::choice::{INTEGRATORS, IntegratorKind, PRECISIONS, Precision, STEP_RULES, StepRule};
use crate::interrupt::Interrupt;
use crate::methods::{FORMULATIONS, FormulationKind, PenaltyUse};
use crate::precision::is_finer;
use crate::precision::{PrecisionError, not_built_hint};
use crate::record::PilotReport;
use mbs_core::control::EnergyRule;
use mbs_core::once::found;
use mbs_core::scene::{Scene, SceneError, SolverTable};
use mbs_core::{Real, instances};
use mbs_scene::format::significant;

/// Most steps of a run [-]: at a microsecond each they take eleven days.
const MOST_STEPS: f64 = 1e12;
/// Step when neither scene nor command line gives one [s].
pub const DEFAULT_STEP: f64 = 1e-3;

/// Error of a step by its estimate when neither gives one, relative to the scene's length [-]. Chosen, not tuned.
const DEFAULT_ERROR: f64 = 1e-6;
/// Largest error of the invariant before a run stops, relative to the exchanged energy [-]. Chosen, not tuned.
const DEFAULT_ALARM: f64 = 0.1;

/// Settings that the command line (or a caller) gives; `None` leaves a setting to the scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Method {
    /// Name of the formulation.
    pub formulation: Option<String>,
    /// Name of the integrator.
    pub integrator: Option<String>,
    /// Name of the precision.
    pub precision: Option<String>,
    /// Length of a step [s]; of a controlled length the first one.
    pub step: Option<f64>,
    /// Largest step of a controlled length [s].
    pub step_max: Option<f64>,
    /// Name of the rule that chooses the length of the steps; left out, the tolerances that are given.
    pub step_control: Option<String>,
    /// [U, L] of the energy rule.
    pub energy_tolerance: Option<[f64; 2]>,
    /// Error of a step by its estimate, relative to the scene's length.
    pub error_tolerance: Option<f64>,
    /// Do steps of a controlled length end at contacts and kinks of the road?
    pub events: Option<bool>,
    /// Share of the energy turned over that the invariant may be off by.
    pub energy_alarm: Option<f64>,
    /// Duration of the run [s].
    pub duration: Option<f64>,
    /// Fixed penalty [N/m in index-3, kg in index-1]; in classical the regularisation 1/alpha, in recursive the report's
    /// closure forces; state-space has none.
    pub penalty: Option<f64>,
    /// Tolerance of the iterations, relative to what accelerations move in a step; with error control the error of a step.
    pub tolerance: Option<f64>,
    /// Number of threads that share the work of a step.
    pub threads: Option<usize>,
    /// Interrupt that ends the run from outside.
    pub interrupt: Interrupt,
}

/// Settings of a run, with everything decided.
#[derive(Debug, Clone, PartialEq)]
pub struct ResolvedMethod {
    /// Formulation as asked for, `auto` included.
    pub asked: String,
    /// Formulation that the run uses.
    pub formulation: FormulationKind,
    /// Integrator that the run uses.
    pub integrator: IntegratorKind,
    /// Precision of the run.
    pub precision: Precision,
    /// Length of a step [s]; with a controlled step size the first one.
    pub step: f64,
    /// Largest step of a controlled step size [s], and the distance of recorded rows: `step` when left out.
    pub step_max: f64,
    /// Rule that chooses the length of the steps.
    pub rule: StepRule,
    /// [U, L] of the energy rule.
    pub energy_tolerance: [f64; 2],
    /// Error of a step by its estimate, relative to the scene's length.
    pub error_tolerance: f64,
    /// Do steps of a controlled length end at contacts and kinks of the road?
    pub events: bool,
    /// Share of the energy turned over that the invariant may be off by before the run stops.
    pub energy_alarm: f64,
    /// Duration of the run [s].
    pub duration: f64,
    /// Fixed penalty, if any.
    pub penalty: Option<f64>,
    /// Tolerance of the iterations, if any.
    pub tolerance: Option<f64>,
    /// Threads that share the work of a step.
    pub threads: usize,
    /// Report of a pilot, where one chose.
    pub choice: Option<Box<PilotReport>>,
    /// Interrupt that ends the run from outside.
    pub interrupt: Interrupt,
}

/// The lengths of time of a run in its own precision [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lengths<T> {
    /// Length of a step.
    pub step: T,
    /// Largest length of a step.
    pub step_max: T,
    /// Duration of the run.
    pub duration: T,
}

/// A setting that is refused.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// A name that is unknown or not built yet.
    NotBuilt {
        /// Key of the setting.
        key: &'static str,
        /// The value asked for.
        value: String,
        /// Names that are built.
        built: &'static [&'static str],
        /// The scene asks for it, not the command line.
        from_scene: bool,
    },
    /// A precision that this build does not have.
    NotInBuild(Precision),
    /// A number that must be positive and finite.
    NotPositive {
        /// Key of the setting.
        key: &'static str,
        /// Value of the setting.
        value: f64,
    },
    /// U and L of the energy rule, the smaller one first.
    LimitOrder([f64; 2]),
    /// Names that do not go together.
    NotTogether {
        /// Formulation that does not know the option.
        formulation: FormulationKind,
        /// The option that it does not know.
        option: String,
    },
    /// The scene cannot be meant in a run of this length.
    Scene(SceneError),
    /// A step of fixed length that is longer than the run.
    StepTooLong {
        /// Length of a step [s].
        step: f64,
        /// Duration of the run [s].
        duration: f64,
    },
    /// The step is so short that the run would not end.
    TooManySteps {
        /// Length of a step [s].
        step: f64,
        /// Duration of the run [s].
        duration: f64,
    },
}

impl SettingsError {
    /// The key of the setting that it is about, where that is one.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::NotBuilt { key, .. } | Self::NotPositive { key, .. } => Some(key),
            Self::NotInBuild(_) => Some("precision"),
            Self::NotTogether { option, .. } => option.split(' ').next(),
            Self::TooManySteps { .. } | Self::StepTooLong { .. } => Some("step"),
            Self::LimitOrder(_) | Self::Scene(_) => None,
        }
    }

    /// Hint for the user: what to do about the error.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::NotBuilt { value, built, .. } => mbs_scene::nearest_name(value, built, "built are"),
            Self::NotInBuild(precision) => not_built_hint(*precision),
            Self::NotPositive { .. } => "write a number larger than zero".to_owned(),
            Self::LimitOrder(_) => "write the larger one first: U, then L".to_owned(),
            Self::NotTogether { option, .. } if option.starts_with("step control") => {
                "rk54, rk853, gbs and radau5 control their own step by --tolerance; the others need an implicit one-step rule"
                    .to_owned()
            }
            Self::NotTogether { option, .. } if option == "threads" => {
                let names = FormulationKind::names(|row| row.threads, "and");
                format!("threads share the steps of {names}")
            }
            Self::NotTogether { option, .. } if option == "penalty" => {
                "leave the penalty out".to_owned()
            }
            Self::NotTogether { .. } => {
                let name = FormulationKind::RELATIVE.name();
                format!("rk4, rk54, rk853, gbs and radau5 need formulation `{name}`")
            }
            Self::TooManySteps { .. } => "write a longer step, or a shorter duration".to_owned(),
            Self::Scene(error) => error.fault.advice().to_owned(),
            Self::StepTooLong { duration, .. } => {
                format!("write a step of {} s at most, or a longer duration", significant(*duration))
            }
        }
    }
}

impl core::fmt::Display for SettingsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotBuilt { key, value, .. } => write!(f, "unknown {key} `{value}`"),
            Self::NotInBuild(precision) => PrecisionError::NotBuilt(*precision).fmt(f),
            Self::NotPositive { key, value } => {
                write!(f, "{key} must be positive and finite, but is {}", significant(*value))
            }
            Self::LimitOrder([upper, lower]) => write!(
                f,
                "energy_tolerance: U must be larger than L, but U is {} and L is {}",
                significant(*upper),
                significant(*lower)
            ),
            Self::NotTogether { formulation, option } => {
                write!(f, "formulation `{}` has no `{option}`", formulation.name())
            }
            Self::Scene(SceneError { entry, field, fault }) => {
                write!(f, "`{field}` of {entry} {fault:#}")
            }
            Self::StepTooLong { step, duration } => {
                f.write_str(&length::too_long(*step, *duration))
            }
            Self::TooManySteps { step, duration } => write!(
                f,
                "a step of {} s is too short for a run of {} s: more than {MOST_STEPS:e} steps",
                significant(*step),
                significant(*duration)
            ),
        }
    }
}

impl core::error::Error for SettingsError {}

type New<T> = fn(&Scene<T>, &Method) -> Result<ResolvedMethod, SettingsError>;
instances!(NEW: New<T> = ResolvedMethod::of::<T>, {});

impl ResolvedMethod {
    /// Decides from a scene and overrides.
    ///
    /// # Errors
    /// [`SettingsError`] for what is not built or out of range.
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
        // A scene's penalty is meant for the augmented Lagrangian.
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

    /// Step, largest step and duration in the precision of the run.
    #[must_use]
    pub fn lengths<T: Real>(&self, scene: &Scene<T>) -> Lengths<T> {
        let lengths = [self.step, self.step_max, self.duration];
        let [step, step_max, duration] = lengths.map(|x| exact(scene, x));
        Lengths { step, step_max, duration }
    }

    /// Number of recorded intervals, each of one step or of as many as the control of the step size takes. A duration within
    /// 1e-9 of a multiple is one; else the last interval is shorter.
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

/// A length of time [s] in the precision of a run: what the scene says with all its digits. Else it is the intended decimal
/// number: the shortest one that `f64` reads as this.
pub fn exact<T: Real>(scene: &Scene<T>, x: f64) -> T {
    if !is_finer::<T>() {
        return T::from_f64(x);
    }
    let written = [Some(scene.duration), scene.solver.step, scene.solver.step_max];
    let same = written.into_iter().flatten().find(|&w| w.to_f64().to_bits() == x.to_bits());
    same.or_else(|| T::from_decimal(&format!("{x:e}"))).unwrap_or(T::from_f64(x))
}

/// The formulation as asked and as it runs, and the integrator.
fn method<T>(
    solver: &SolverTable<T>,
    overrides: &Method,
) -> Result<(String, FormulationKind, IntegratorKind), SettingsError> {
    let (asked, formulation) = named(
        "formulation",
        (&overrides.formulation, &solver.formulation, "auto"),
        &FORMULATIONS,
        // `auto` stands before them.
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

/// Rule that chooses the length of the steps. The rule that the command line names comes first, then one that it gives tolerances for. Next is
/// the rule that the scene names, and last the one of its error tolerance. The energy limits of a scene are meant for multi-index, which has the
/// energy rule anyway.
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
    // A tolerance in the scene is for integrators that can use it.
    if !is_named && given == [false; 2] {
        return Ok(StepRule::Fixed);
    }
    let option = format!("step control {} beside integrator {}", rule.name(), integrator.name());
    Err(SettingsError::NotTogether { formulation, option })
}

/// U and L of the energy rule: the caller's, the scene's, or the usual ones.
fn energy_limits<T: Real>(solver: &SolverTable<T>, overrides: &Method) -> [f64; 2] {
    let of_scene = solver.energy_tolerance.map(|limits| limits.map(T::to_f64));
    let usual = EnergyRule::default();
    overrides.energy_tolerance.or(of_scene).unwrap_or([usual.upper, usual.lower])
}

/// The value that belongs to the first name given: override, scene, default.
fn named<U: Copy, const N: usize>(
    key: &'static str,
    (from_caller, from_scene, default): (&Option<String>, &Option<String>, &str),
    names: &'static [&'static str; N],
    values: [U; N],
) -> Result<(String, U), SettingsError> {
    let name = from_caller.as_deref().or(from_scene.as_deref()).unwrap_or(default);
    match names.iter().position(|n| *n == name) {
        Some(i) => Ok((name.to_owned(), values[i])),
        None => Err(SettingsError::NotBuilt {
            key,
            value: name.to_owned(),
            built: names,
            from_scene: from_caller.is_none(),
        }),
    }
}

fn positive(key: &'static str, value: f64) -> Result<f64, SettingsError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(SettingsError::NotPositive { key, value })
    }
}

/// U and L of the energy rule.
fn ordered([upper, lower]: [f64; 2]) -> Result<[f64; 2], SettingsError> {
    let limits = [positive("energy_tolerance", upper)?, positive("energy_tolerance", lower)?];
    if upper > lower { Ok(limits) } else { Err(SettingsError::LimitOrder(limits)) }
}

fn checked(key: &'static str, value: Option<f64>) -> Result<Option<f64>, SettingsError> {
    value.map(|x| positive(key, x)).transpose()
}
