//! What is asked of a run: the scene's `[solver]` table, overridden by the command line, checked against what is built.

use mbs_augmented::{Options, Penalty};
use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::scene::Scene;
use mbs_scene::readable;

/// Formulations that are built, by their names in scenes and on the command line.
pub const FORMULATIONS: [&str; 3] = ["auto", "index-1", "index-3"];
/// Integrators that are built.
pub const INTEGRATORS: [&str; 4] = ["trapezoidal", "newmark", "generalised-alpha", "hht"];
/// Precisions that are built.
pub const PRECISIONS: [&str; 2] = ["f32", "f64"];
/// Names of the scene format that are not built yet.
const NOT_BUILT: [&str; 9] = [
    "multi-index",
    "classical",
    "state-space",
    "recursive",
    "rk4",
    "rk54",
    "rk853",
    "radau5",
    "dd",
];
/// Steps of a run at most: at a microsecond each they take eleven days.
const MOST_STEPS: f64 = 1e12;
/// Step when neither scene nor command line gives one [s].
const DEFAULT_STEP: f64 = 1e-3;

/// A formulation that can run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formulation {
    /// Index-3 augmented Lagrangian.
    Index3,
    /// Index-1 augmented Lagrangian.
    Index1,
}

impl Formulation {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Index3 => "index-3",
            Self::Index1 => "index-1",
        }
    }
}

/// An integrator that can run, with the parameters it is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IntegratorKind {
    /// Trapezoidal rule.
    Trapezoidal,
    /// Newmark's method with gamma = 0.6, beta = (gamma + 1/2)^2 / 4 = 0.3025: numerical damping, first order.
    Newmark,
    /// Generalised-alpha with spectral radius 0.8 at infinity.
    GeneralisedAlpha,
    /// HHT with alpha = 0.05.
    Hht,
}

impl IntegratorKind {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Trapezoidal => "trapezoidal",
            Self::Newmark => "newmark",
            Self::GeneralisedAlpha => "generalised-alpha",
            Self::Hht => "hht",
        }
    }

    /// Its coefficients.
    #[must_use]
    pub fn coefficients<T: Real>(self) -> Integrator<T> {
        match self {
            Self::Trapezoidal => Integrator::trapezoidal(),
            Self::Newmark => Integrator::newmark(T::from_f64(0.3025), T::from_f64(0.6)),
            Self::GeneralisedAlpha => Integrator::generalised_alpha(T::from_f64(0.8)),
            Self::Hht => Integrator::hht(T::from_f64(0.05)),
        }
    }
}

/// Number format of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

impl Precision {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

/// What the command line (or a caller) says; `None` leaves it to the scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Overrides {
    /// Formulation.
    pub formulation: Option<String>,
    /// Integrator.
    pub integrator: Option<String>,
    /// Precision.
    pub precision: Option<String>,
    /// Step [s].
    pub step: Option<f64>,
    /// Duration [s].
    pub duration: Option<f64>,
    /// Fixed penalty [N/m in index-3, kg in index-1].
    pub penalty: Option<f64>,
    /// Tolerance, relative to the scene's length.
    pub tolerance: Option<f64>,
    /// Threads.
    pub threads: Option<usize>,
}

/// Everything decided.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// As asked, `auto` included.
    pub asked: String,
    /// What runs.
    pub formulation: Formulation,
    /// Integrator.
    pub integrator: IntegratorKind,
    /// Precision.
    pub precision: Precision,
    /// Step [s].
    pub step: f64,
    /// Duration [s].
    pub duration: f64,
    /// Fixed penalty, if any.
    pub penalty: Option<f64>,
    /// Tolerance, if any.
    pub tolerance: Option<f64>,
}

/// A setting that is refused.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// A name that is unknown or not built yet.
    NotBuilt {
        /// The key.
        key: &'static str,
        /// The value asked for.
        value: String,
        /// What is built.
        built: &'static [&'static str],
        /// The scene asks for it, not the command line.
        from_scene: bool,
    },
    /// A number that must be positive and finite.
    NotPositive {
        /// The key.
        key: &'static str,
        /// The value.
        value: f64,
    },
    /// The step is so short that the run would not end.
    TooManySteps {
        /// Step [s].
        step: f64,
        /// Duration [s].
        duration: f64,
    },
}

impl SettingsError {
    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::NotBuilt { key: "threads", .. } => "leave it out, or write 1".to_owned(),
            Self::NotBuilt { value, built, .. } if NOT_BUILT.contains(&value.as_str()) => {
                format!("built are: {}", built.join(", "))
            }
            Self::NotBuilt { value, built, .. } => mbs_scene::suggestion(value, built, "built are"),
            Self::NotPositive { .. } => "write a number larger than zero".to_owned(),
            Self::TooManySteps { .. } => "write a longer step, or a shorter duration".to_owned(),
        }
    }
}

impl core::fmt::Display for SettingsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotBuilt { key: "threads", value, .. } => {
                write!(f, "{value} threads: runs have one thread so far")
            }
            Self::NotBuilt { key, value, .. } if NOT_BUILT.contains(&value.as_str()) => {
                write!(f, "{key} `{value}` is not built yet")
            }
            Self::NotBuilt { key, value, .. } => write!(f, "unknown {key} `{value}`"),
            Self::NotPositive { key, value } => {
                write!(f, "{key} must be positive and finite, but is {}", readable(*value))
            }
            Self::TooManySteps { step, duration } => write!(
                f,
                "a step of {} s is too short for a run of {} s: more than {MOST_STEPS:e} steps",
                readable(*step),
                readable(*duration)
            ),
        }
    }
}

impl core::error::Error for SettingsError {}

impl Settings {
    /// Decides from a scene and overrides.
    ///
    /// # Errors
    /// [`SettingsError`] for what is not built or out of range.
    pub fn new<T: Real>(scene: &Scene<T>, overrides: &Overrides) -> Result<Self, SettingsError> {
        let solver = &scene.solver;
        let (asked, formulation) = named(
            "formulation",
            (&overrides.formulation, &solver.formulation, "auto"),
            &FORMULATIONS,
            [Formulation::Index3, Formulation::Index1, Formulation::Index3],
        )?;
        let (_, integrator) = named(
            "integrator",
            (&overrides.integrator, &solver.integrator, "trapezoidal"),
            &INTEGRATORS,
            [
                IntegratorKind::Trapezoidal,
                IntegratorKind::Newmark,
                IntegratorKind::GeneralisedAlpha,
                IntegratorKind::Hht,
            ],
        )?;
        let (_, precision) = named(
            "precision",
            (&overrides.precision, &None, "f64"),
            &PRECISIONS,
            [Precision::F32, Precision::F64],
        )?;
        if let Some(threads) = overrides.threads.filter(|&n| n != 1) {
            let value = threads.to_string();
            return Err(SettingsError::NotBuilt {
                key: "threads",
                value,
                built: &["1"],
                from_scene: false,
            });
        }
        let of_scene = |x: Option<T>| x.map(Real::to_f64);
        let step = overrides.step.or(of_scene(solver.step)).unwrap_or(DEFAULT_STEP);
        let step = positive("step", step)?;
        let duration = overrides.duration.unwrap_or(scene.duration.to_f64());
        let duration = positive("duration", duration)?;
        if duration / step > MOST_STEPS {
            return Err(SettingsError::TooManySteps { step, duration });
        }
        Ok(Self {
            asked,
            formulation,
            integrator,
            precision,
            step,
            duration,
            penalty: checked("penalty", overrides.penalty.or(of_scene(solver.penalty)))?,
            tolerance: checked("tolerance", overrides.tolerance.or(of_scene(solver.tolerance)))?,
        })
    }

    /// The options of the augmented Lagrangian steps.
    #[must_use]
    pub fn options<T: Real>(&self) -> Options<T> {
        let mut options = match self.formulation {
            Formulation::Index3 => Options::index3(),
            Formulation::Index1 => Options::index1(),
        };
        options.integrator = self.integrator.coefficients();
        if let Some(alpha) = self.penalty {
            options.penalty = Penalty::Fixed(T::from_f64(alpha));
            options.adaptive_penalty = false;
        }
        if let Some(tolerance) = self.tolerance {
            options.tolerance = T::from_f64(tolerance);
        }
        options
    }

    /// Number of steps: a duration within 1e-9 steps of a multiple is one; else the last step is shorter.
    #[must_use]
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count, checked to be positive"
    )]
    pub fn n_steps(&self) -> u64 {
        let steps = self.duration / self.step;
        let whole = steps.round();
        if (steps - whole).abs() <= 1e-9 * whole.max(1.0) {
            whole.max(1.0) as u64
        } else {
            steps.ceil() as u64
        }
    }
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

fn checked(key: &'static str, value: Option<f64>) -> Result<Option<f64>, SettingsError> {
    value.map(|x| positive(key, x)).transpose()
}
