//! Accuracy of a run: errors of its outputs by comparison runs, and reasons why its steps are too long.
//!
//! The first of these comparisons that covers the whole run gives the estimate. y is an output of the run, y₂ that of the comparison run:
//!
//! ```text
//! 1. relative coordinates, finer and finer:          error = |y - y₂|
//! 2. the same, by an integrator for stiff forces
//! 3. the same method with r times the step:          error = |y - y₂| / sqrt((r - 1) (r² - 1)),   r = 1/2, 2, 3, 5 or 7
//! 4. the rows of the run alone (`differences`)
//! ```
//!
//! Counts decide whether a comparison run is affordable: iterations, evaluations and steps, each with a nominal time (`purse`). No clock is
//! read, so every machine gives the same errors. Comparison runs may always take a tenth of a second, also for runs of less than a third of a
//! second.
//!
//! In relative coordinates, finer comparison runs follow until two of them differ less from each other than the original run differs from them.
//! In the third comparison the exact divisor is r - 1 for order 1 and r² - 1 for order 2. The geometric mean of both is wrong by a factor of at
//! most 2.9. The results of the run are read, never changed.

pub(crate) mod differences;
mod look;
mod looks;
pub(crate) mod purse;

use crate::auto::Clock;
use crate::compare::results::output_scales;
use look::{Look, Pace};
use looks::{Found, Looks};
use mbs::inside::AssembledScene;
use mbs::record::{Channel, ErrorEstimate, Outputs};
use mbs::{Outcome, ResolvedMethod, StepRule};
use mbs_core::cluster::scene_length;
use mbs_core::model::Model as _;
use mbs_core::scene::{Dimension, Scene};
use mbs_scene::format::few;
use purse::Purse;

/// Rotation of a body in a step above which the trapezoidal rule has large errors [rad]. The angle is then wrong by about a hundredth of each
/// revolution.
const MOST_TURN: f64 = 0.3;
/// Smallest number of steps in a period of the stiffest force [-]. With fewer steps its vibration has a wrong period.
const FEWEST_STEPS: f64 = 20.0;
/// Error of an output, relative to its range, from which the unresolved vibration of a stiff force is reported [-]. An estimate may be wrong
/// by a factor of two, and an error of a hundredth is worth a note.
const SWINGS: f64 = 0.02;
/// Error of an output because iterations end, relative to the largest range of its unit [-]: Newton's tolerance.
const ITERATION: f64 = 1e-10;

/// Estimates the errors of a run with these settings, and adds them to its outcome. Only counts of the run decide which comparison runs are
/// made, so every machine makes the same ones. The clock only measures the time of the estimate.
///
/// `scene` is in `f64`, whatever the precision of the run.
pub fn estimate(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    outcome: &mut Outcome,
    clock: &mut dyn Clock,
) {
    if !outcome.summary.completed {
        let missing = Some("the run stopped before its end".to_owned());
        outcome.take_estimate(ErrorEstimate { missing, ..ErrorEstimate::default() });
        return;
    }
    let begun = clock.seconds();
    let judge = Judge { scene, settings, outcome };
    let mut estimate = match scene.dimension {
        Dimension::Planar => judge.estimate::<2>(),
        Dimension::Spatial => judge.estimate::<3>(),
    };
    estimate.cpu_seconds = clock.seconds() - begun;
    outcome.take_estimate(estimate);
}

/// Data of the estimate: scene, settings and outcome of the run.
struct Judge<'a> {
    scene: &'a Scene<f64>,
    settings: &'a ResolvedMethod,
    outcome: &'a Outcome,
}

impl Judge<'_> {
    fn estimate<const D: usize>(&self) -> ErrorEstimate {
        let mut estimate = ErrorEstimate::default();
        let Ok(ready) = AssembledScene::<f64, D>::new(self.scene) else {
            // the run itself has started, but in another precision
            estimate.missing = Some("the scene does not start in f64".to_owned());
            return estimate;
        };
        let step_at = |t: f64| self.step_at(t);
        let look = Look {
            scene: self.scene,
            ready: &ready,
            rows: self.outcome.rows(),
            n_steps: self.outcome.summary.steps as f64,
            step_at: &step_at,
        };
        let natural = mbs_core::Cliques::n_unknowns(&ready.model) + ready.model.n_constraints();
        let purse =
            Purse::new((self.scene, natural), &self.outcome.summary, self.settings.formulation);
        let mut looks = Looks::new(look, self.settings, purse);
        match looks.find() {
            Ok(found) => self.fill(&mut estimate, found),
            Err(_) if self.settings.interrupt.is_set() => {
                estimate.missing = Some("interrupted by a signal".to_owned());
            }
            Err(missing) => estimate.missing = Some(missing),
        }
        self.warn(&mut estimate, &looks.pace);
        estimate
    }

    /// Step of the run at a time [s]; zero if its integrator controls the step itself.
    fn step_at(&self, t: f64) -> f64 {
        if self.settings.integrator.controls_its_step() {
            return 0.0;
        }
        if self.settings.rule == StepRule::Fixed {
            return self.settings.step;
        }
        let steps = self.outcome.steps();
        let after = steps.times.partition_point(|end| *end < t);
        steps.rows.get(after).map_or(0.0, |row| row.length)
    }

    fn fill(&self, estimate: &mut ErrorEstimate, found: Found) {
        let rows = self.outcome.rows();
        let size = |c: usize| rows.iter().fold(0.0, |most: f64, (_, row)| most.max(row[c].abs()));
        let channels = Channel::of_scene(self.scene);
        let units = || channels.iter().flat_map(|channel| &channel.components).map(|c| &c.unit);
        let ranges: Vec<f64> = (0..units().count()).map(|c| differences::range(rows, c)).collect();
        let of_unit = |unit: &String| {
            let same = units().zip(&ranges).filter(|(other, _)| *other == unit);
            same.fold(0.0, |most: f64, (_, range)| most.max(*range))
        };
        let floor = |c: usize, unit: &String| {
            let left = if found.floor { ITERATION * of_unit(unit) } else { 0.0 };
            left + differences::ROUNDINGS * f64::EPSILON * size(c)
        };
        let errors = found.errors.iter().zip(units()).enumerate();
        let errors: Vec<f64> = errors.map(|(c, (e, unit))| e + floor(c, unit)).collect();
        if let Some((share, output)) = self.largest(&errors) {
            (estimate.largest, estimate.worst_output) = (Some(share), Some(output));
        }
        let mut errors = errors.into_iter();
        let by_channel = channels.iter().map(|channel| {
            let own: Vec<f64> = errors.by_ref().take(channel.components.len()).collect();
            (!channel.is_of_run()).then(|| (channel.name.clone(), own))
        });
        let outputs: Vec<_> = by_channel.flatten().collect();
        if outputs.is_empty() {
            estimate.missing = Some("no output is one of the motion".to_owned());
            return;
        }
        (estimate.outputs, estimate.basis) = (Some(Outputs(outputs)), Some(found.basis));
    }

    /// Largest error relative to the scale of its output [-], and the name of this output.
    fn largest(&self, errors: &[f64]) -> Option<(f64, String)> {
        let values: Vec<Vec<f64>> =
            self.outcome.rows().iter().map(|(_, row)| row.clone()).collect();
        let channels = Channel::of_scene(self.scene);
        let scales = output_scales(&channels, &values, scene_length(self.scene));
        let shares = scales.into_iter().filter_map(|scale| {
            let largest = scale.columns.iter().map(|&c| errors[c]).fold(0.0, f64::max);
            Some((largest / scale.scale?, scale.output))
        });
        shares.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Adds warnings about steps that are too long for a rotation or a stiff force. A stiff force is mentioned only if outputs have large
    /// errors: without them its vibration does not matter.
    fn warn(&self, estimate: &mut ErrorEstimate, most: &Pace) {
        let (turn, body) = most.turn;
        estimate.turn_per_step = (turn > 0.0).then_some(turn);
        if turn > MOST_TURN {
            estimate.warnings.push(format!(
                "body `{}` turns by up to {} rad in a step, more than {MOST_TURN}: the step does not resolve its motion; shorter steps, or \
                 --formulation recursive --integrator rk853, do",
                self.scene.bodies.get(body).map_or("", |body| &body.name),
                few(turn)
            ));
        }
        estimate.steps_per_period = most.steps_per_period;
        let is_wrong = estimate.largest.is_some_and(|largest| largest > SWINGS);
        if let Some(steps) = most.steps_per_period.filter(|n| is_wrong && *n < FEWEST_STEPS) {
            estimate.warnings.push(format!(
                "a period of the stiffest force has {} steps, fewer than {FEWEST_STEPS}: where it swings, its swing is wrong; shorter steps, or \
                 --formulation recursive --integrator radau5, follow it",
                few(steps)
            ));
        }
    }
}
