//! Maps of the convergence of index-3 and index-1: short runs over step and fixed penalty.

use super::course::Course;
use super::ladder::{Instants, work};
use super::pass::Scenes;
use super::reference::Known;
use crate::compare::results::{Cell, ConvergenceMap, Status};
use mbs::{FormulationKind, Method, Precision, ResolvedMethod};

/// Penalties of a map [-], two decades apart.
pub(super) const PENALTIES: [f64; 7] = [1e3, 1e5, 1e7, 1e9, 1e11, 1e13, 1e15];
/// Steps of a map, relative to the scene's step [-]: about two per decade. Each is rounded to a step that divides the interval.
const STEPS: [f64; 7] = [10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01];
/// Number of steps of a run with the longest step. Chosen, not tuned: the map shows convergence, not accuracy.
const LONGEST_STEPS: f64 = 20.0;
/// Iterations of a step, assumed for the estimate of the work. Chosen, not tuned.
const ITERATIONS: f64 = 3.0;

/// Plan of the maps: instants, steps, formulations and precisions.
#[derive(Debug, Clone)]
pub struct MapPlan {
    /// The first instants of the comparison.
    pub instants: Instants,
    /// Number of steps between two instants for each step length, from the longest step.
    pub between: Vec<u64>,
    pub(super) formulations: Vec<FormulationKind>,
    pub(super) precisions: Vec<Precision>,
}

impl MapPlan {
    /// Plans a map for each formulation and precision. Steps are removed, if necessary all, until the nominal time is at most `most` [s].
    /// `unknowns` is the number of coordinates and constraints.
    pub fn new(
        (instants, of_scene): (Instants, f64),
        (formulations, precisions): (Vec<FormulationKind>, Vec<Precision>),
        (unknowns, most): (usize, f64),
    ) -> Self {
        let mut between: Vec<u64> =
            STEPS.iter().map(|factor| instants.steps_between(factor * of_scene)).collect();
        between.dedup();
        let longest = instants.interval / between[0] as f64;
        let wanted = (LONGEST_STEPS * longest / instants.interval).ceil().max(1.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let mut n = (wanted as usize).min(instants.count);
        let maps = (formulations.len() * precisions.len() * PENALTIES.len()) as f64;
        let cost = |n: usize, between: &[u64]| {
            let steps: u64 = between.iter().sum();
            work(steps, unknowns) * ITERATIONS * n as f64 * maps
        };
        while cost(n, &between) > most && n > 1 {
            n = n.div_ceil(2);
        }
        while cost(n, &between) > most && !between.is_empty() {
            between.pop();
        }
        Self { instants: Instants { count: n, ..instants }, between, formulations, precisions }
    }

    /// Returns the steps of the map [s].
    pub fn steps(&self) -> Vec<f64> {
        self.between.iter().map(|n| self.instants.interval / *n as f64).collect()
    }

    /// Pairs of formulation and precision that have a map.
    pub(super) fn which(&self) -> impl Iterator<Item = (FormulationKind, Precision)> {
        let precisions = &self.precisions;
        self.formulations.iter().flat_map(|&f| precisions.iter().map(move |&p| (f, p)))
    }

    /// Makes the map of one formulation and precision. `cell` computes a cell from the number of steps between two instants and the penalty.
    pub(super) fn map<E>(
        &self,
        (formulation, precision): (FormulationKind, Precision),
        mut cell: impl FnMut(u64, f64) -> Result<Cell, E>,
    ) -> Result<ConvergenceMap, E> {
        let mut row = |penalty| -> Result<Vec<Cell>, E> {
            self.between.iter().map(|&between| cell(between, penalty)).collect()
        };
        Ok(ConvergenceMap {
            formulation: formulation.name().to_owned(),
            precision: precision.name().to_owned(),
            span: self.instants.time(self.instants.count),
            unit: formulation.scene_penalty().unwrap_or_default().to_owned(),
            steps: self.steps(),
            penalties: PENALTIES.to_vec(),
            cells: PENALTIES.into_iter().map(&mut row).collect::<Result<_, E>>()?,
        })
    }

    /// Computes one cell, in at most `most` seconds.
    pub(super) fn cell(
        &self,
        scenes: &Scenes,
        known: &Known,
        (formulation, precision): (FormulationKind, Precision),
        (between, penalty): (u64, f64),
        most: f64,
    ) -> Cell {
        let step = self.instants.interval / between as f64;
        let overrides = Method {
            formulation: Some(formulation.name().to_owned()),
            integrator: Some("trapezoidal".to_owned()),
            precision: Some(precision.name().to_owned()),
            step: Some(step),
            step_max: Some(step),
            step_control: Some("fixed".to_owned()),
            penalty: Some(penalty),
            ..Method::default()
        };
        let Ok(settings) = ResolvedMethod::new(&scenes.double, &overrides) else {
            return Cell { failure: "settings-refused".to_owned(), ..Cell::default() };
        };
        let course = Course { instants: self.instants, between: Some(between) };
        let recorded = scenes.recorded(&settings, &course, most);
        let entry = recorded.entry;
        let failure = match entry.failure {
            Some(error) => error.code,
            None if recorded.is_given_up => "took too long".to_owned(),
            None => String::new(),
        };
        let known = Known { rows: known.rows[..self.instants.count].to_vec(), ..known.clone() };
        let is_done = entry.status == Status::Completed && failure.is_empty();
        let error = known.errors(&recorded.rows).filter(|_| is_done).map(|[most, _]| most);
        let iterations = entry.iterations as f64 / entry.steps.max(1) as f64;
        Cell { error, iterations, failure }
    }
}
