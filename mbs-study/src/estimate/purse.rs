//! Work that comparison runs may take: by counts, never by a clock, so that every machine makes the same ones.
//!
//! ```text
//! work of a run:    iterations and steps
//! its time:         (iterations + steps) (a + b unknowns)
//! time of a look:   evaluations (a + b (freedoms + effects) + c constraints),    in relative coordinates
//! ```
//!
//! The times are nominal, for a processor of 3 GHz. Over all scenes they are between a half and twice the measured ones, but for outputs at
//! every step.

use mbs::record::RunSummary;
use mbs::{FormulationKind, IntegratorKind};
use mbs_core::scene::Scene;

/// Work of all comparison runs, relative to the run [-]: with what starts them it stays below three tenths.
pub(super) const WORK_SHARE: f64 = 0.26;
/// Nominal time that comparison runs may always take [s]: with what starts them, and where nominal times are too short, a tenth of a second.
const ALWAYS: f64 = 0.078;
/// Nominal time of an iteration or a step of a run, beside what grows with its unknowns [s]: fitted to all scenes.
const OF_STEP: f64 = 4e-7;
/// Nominal time of an iteration or a step for each coordinate and constraint, by index-3 [s]: fitted to all scenes.
const OF_UNKNOWN_INDEX_3: f64 = 7e-8;
/// Nominal time of an iteration or a step for each coordinate and constraint, by the classical Lagrangian [s]: it factors a matrix of all.
const OF_UNKNOWN_CLASSICAL: f64 = 2.8e-7;
/// Nominal time of an iteration or a step for each coordinate and constraint, by the other formulations [s]: fitted to all scenes.
const OF_UNKNOWN: f64 = 1.8e-7;
/// Time of a run that counts, relative to its nominal time [-]: few runs take less.
const AT_LEAST: f64 = 0.8;
/// Time of a comparison run by the method of the run that counts, relative to its nominal time [-]: few take more.
const AT_MOST: f64 = 1.5;
/// Nominal time of reactions at an instant for each natural coordinate and constraint [s]: fitted to scenes with an output of one.
const OF_REACTIONS: f64 = 1.2e-6;
/// Nominal time of an evaluation of the accelerations in relative coordinates, beside what grows with the scene [s]: fitted to all scenes.
const OF_EVALUATION: f64 = 3e-7;
/// Nominal time of an evaluation for each coordinate and each effect [s]: fitted to all scenes.
const OF_COORDINATE: f64 = 1e-7;
/// Nominal time of an evaluation for each constraint [s]: fitted to all scenes.
const OF_CONSTRAINT: f64 = 2.5e-7;
/// Evaluations that a step by Radau's method takes for its equations, relative to those that it counts and with these [-].
const OF_IMPLICIT: f64 = 1.5;
/// Fraction of all work for steps that end at a row to compare at [-]. Chosen, not tuned.
const OF_ROWS: f64 = 0.1;
/// Evaluations of a step of order 8 [-].
const OF_A_STEP: f64 = 12.0;
/// Least rows at equal distances at which runs are compared [-]. Chosen, not tuned.
const FEWEST_ROWS: usize = 100;
/// Most rows at equal distances at which runs are compared [-]. Chosen, not tuned.
const MOST_ROWS: usize = 1000;

/// Nominal time of an iteration or a step for each coordinate and constraint [s].
const fn of_unknown(formulation: FormulationKind) -> f64 {
    match formulation {
        FormulationKind::Index3 | FormulationKind::MultiIndex => OF_UNKNOWN_INDEX_3,
        FormulationKind::Classical => OF_UNKNOWN_CLASSICAL,
        _ => OF_UNKNOWN,
    }
}

/// Nominal time of an iteration or a step of a run with so many coordinates and constraints [s].
pub(crate) fn nominal_step(formulation: FormulationKind, unknowns: f64) -> f64 {
    OF_STEP + of_unknown(formulation) * unknowns
}

/// Budget of the comparison runs: the nominal time that they may take, and have taken.
#[derive(Debug)]
pub(super) struct Purse {
    effects: usize,
    /// Iterations and steps of the run.
    of_run: f64,
    /// Nominal time of one of them in a comparison run by the same method [s].
    step: f64,
    /// Nominal time of the outputs at an instant [s].
    row: f64,
    /// Nominal time of all comparison runs [s].
    most: f64,
    /// Nominal time of those made [s].
    pub(super) spent: f64,
}

impl Purse {
    /// For looks at a run.
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
        // a share of the run is one of its counts, whatever one takes
        let counts = (ALWAYS / (AT_MOST * one)).max(WORK_SHARE * of_run);
        let step = most / counts;
        Self { effects: scene.effects.len(), of_run, step, row, most, spent: 0.0 }
    }

    /// Nominal time that is left [s].
    pub(super) fn left(&self) -> f64 {
        (self.most - self.spent).max(0.0)
    }

    /// Nominal time of the outputs at so many instants [s].
    pub(super) fn of_rows(&self, n: usize) -> f64 {
        n as f64 * self.row
    }

    /// Is there time for a look that takes so much?
    pub(super) fn has(&self, seconds: f64) -> bool {
        seconds <= self.left()
    }

    /// Nominal time of the run by the same method with `ratio` times its steps [s].
    pub(super) fn of_ratio(&self, ratio: f64) -> f64 {
        self.step * self.of_run / ratio
    }

    /// Nominal time of an iteration or step by the method of the run [s].
    pub(super) fn same(&self) -> f64 {
        self.step
    }

    /// Rows to compare at: one step of order 8 between two of them takes a tenth of all.
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
