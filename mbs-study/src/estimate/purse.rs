//! Work limit of comparison runs. Counts decide, not a clock, so that every machine makes the same runs.
//!
//! ```text
//! work of a run:    iterations and steps
//! its time:         (iterations + steps) (a + b unknowns)
//! time of a look:   evaluations (a + b (freedoms + effects) + c constraints),    in relative coordinates
//! ```
//!
//! The times are nominal, for a processor of 3 GHz; a, b and c are the constants of this module. Over all scenes, nominal times are between
//! half and twice the measured ones, except with outputs at every step.

use mbs::record::RunSummary;
use mbs::{FormulationKind, IntegratorKind};
use mbs_core::scene::Scene;

/// Work of all comparison runs, relative to the original run [-]. Together with their starts it stays below three tenths.
pub(super) const WORK_SHARE: f64 = 0.26;
/// Nominal time that comparison runs may always take [s]. Together with their starts, and where nominal times are too short, they take a
/// tenth of a second.
const ALWAYS: f64 = 0.078;
/// Nominal time of an iteration or a step, without the part that grows with the unknowns [s]: fitted to all scenes.
const OF_STEP: f64 = 4e-7;
/// Nominal time of an iteration or a step for each coordinate and constraint, by index-3 [s]: fitted to all scenes.
const OF_UNKNOWN_INDEX_3: f64 = 7e-8;
/// Nominal time of an iteration or a step for each coordinate and constraint, by the classical Lagrangian [s]. It factors a matrix of all
/// unknowns.
const OF_UNKNOWN_CLASSICAL: f64 = 2.8e-7;
/// Nominal time of an iteration or a step for each coordinate and constraint, by the other formulations [s]: fitted to all scenes.
const OF_UNKNOWN: f64 = 1.8e-7;
/// Fraction of its nominal time that is assumed for the original run [-]. Few runs take less.
const AT_LEAST: f64 = 0.8;
/// Multiple of its nominal time that is assumed for a comparison run by the original method [-]. Few runs take more.
const AT_MOST: f64 = 1.5;
/// Nominal time of the reactions at an instant, for each natural coordinate and constraint [s]: fitted to scenes with reactions as outputs.
const OF_REACTIONS: f64 = 1.2e-6;
/// Nominal time of an evaluation of the accelerations in relative coordinates, without the part that grows with the scene [s]: fitted to all
/// scenes.
const OF_EVALUATION: f64 = 3e-7;
/// Nominal time of an evaluation for each coordinate and each effect [s]: fitted to all scenes.
const OF_COORDINATE: f64 = 1e-7;
/// Nominal time of an evaluation for each constraint [s]: fitted to all scenes.
const OF_CONSTRAINT: f64 = 2.5e-7;
/// Ratio of all work of a step by Radau's method, including its linear equations, to the evaluations that it counts [-].
const OF_IMPLICIT: f64 = 1.5;
/// Fraction of all work for steps that must end at a compared row [-]. Chosen, not tuned.
const OF_ROWS: f64 = 0.1;
/// Number of evaluations in a step of the integrator of order 8 [-].
const OF_A_STEP: f64 = 12.0;
/// Smallest number of equally spaced rows at which runs are compared [-]. Chosen, not tuned.
const FEWEST_ROWS: usize = 100;
/// Largest number of equally spaced rows at which runs are compared [-]. Chosen, not tuned.
const MOST_ROWS: usize = 1000;

/// Nominal time of an iteration or a step for each coordinate and constraint [s].
const fn of_unknown(formulation: FormulationKind) -> f64 {
    match formulation {
        FormulationKind::Index3 | FormulationKind::MultiIndex => OF_UNKNOWN_INDEX_3,
        FormulationKind::Classical => OF_UNKNOWN_CLASSICAL,
        _ => OF_UNKNOWN,
    }
}

/// Nominal time of an iteration or a step of a model with this number of coordinates and constraints [s].
pub(crate) fn nominal_step(formulation: FormulationKind, unknowns: f64) -> f64 {
    OF_STEP + of_unknown(formulation) * unknowns
}

/// Work limit of the comparison runs: the nominal time that they may take, and that they have taken.
#[derive(Debug)]
pub(super) struct Purse {
    effects: usize,
    /// Number of iterations and steps of the original run.
    of_run: f64,
    /// Nominal time of an iteration or step in a comparison run by the same method [s].
    step: f64,
    /// Nominal time of the outputs at an instant [s].
    row: f64,
    /// Nominal time that all comparison runs may take [s].
    most: f64,
    /// Nominal time of the comparison runs that were made [s].
    pub(super) spent: f64,
}

impl Purse {
    /// Makes the work limit for a run.
    pub(super) fn new(
        (scene, natural): (&Scene<f64>, usize),
        run: &RunSummary,
        formulation: FormulationKind,
    ) -> Self {
        let of_run = (run.iterations + run.steps) as f64;
        let unknowns = (run.coordinates + run.constraints) as f64;
        let one = nominal_step(formulation, unknowns);
        let has_reactions = scene.outputs.iter().any(|o| o.quantity.row().needs_reactions);
        let row = if has_reactions { OF_REACTIONS * natural as f64 } else { 0.0 };
        let of_rows = run.steps as f64 * row;
        let most = (WORK_SHARE * AT_LEAST * (of_run * one + of_rows)).max(ALWAYS);
        // the limit is a fraction of the counts of the original run, so it does not depend on the nominal time of one iteration
        let counts = (ALWAYS / (AT_MOST * one)).max(WORK_SHARE * of_run);
        let step = most / counts;
        Self { effects: scene.effects.len(), of_run, step, row, most, spent: 0.0 }
    }

    /// Nominal time that is left [s].
    pub(super) fn left(&self) -> f64 {
        (self.most - self.spent).max(0.0)
    }

    /// Nominal time of the outputs at `n` instants [s].
    pub(super) fn of_rows(&self, n: usize) -> f64 {
        n as f64 * self.row
    }

    /// True if time is left for a comparison run of `seconds` [s].
    pub(super) fn has(&self, seconds: f64) -> bool {
        seconds <= self.left()
    }

    /// Nominal time of a comparison run by the same method with `ratio` times the step [s].
    pub(super) fn of_ratio(&self, ratio: f64) -> f64 {
        self.step * self.of_run / ratio
    }

    /// Nominal time of an iteration or step by the method of the run [s].
    pub(super) fn same(&self) -> f64 {
        self.step
    }

    /// Number of rows at which runs are compared. One step of order 8 between two rows then takes a tenth of all work.
    pub(super) fn rows(&self, scene: &Scene<f64>) -> usize {
        let parts = scene.bodies.len() + scene.joints.len() + scene.effects.len();
        let step = OF_A_STEP * (OF_EVALUATION + OF_COORDINATE * parts as f64) + self.row;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded")]
        let rows = (OF_ROWS * self.most / step) as usize;
        rows.clamp(FEWEST_ROWS, MOST_ROWS)
    }

    /// Nominal time of an evaluation in relative coordinates, for a tree of these sizes [s].
    pub(super) fn relative(&self, integrator: IntegratorKind, sizes: [usize; 3]) -> f64 {
        let [coordinates, constraints, _] = sizes.map(|n| n as f64);
        let implicit = if integrator == IntegratorKind::Radau5 { OF_IMPLICIT } else { 1.0 };
        let of_scene = OF_COORDINATE * (coordinates + self.effects as f64);
        implicit * (OF_EVALUATION + of_scene + OF_CONSTRAINT * constraints)
    }
}
