//! How accurate a run is: the errors of its outputs, estimated beside it within a share of its time, and what made its steps too long.
//!
//! The first of these looks that sees the whole run within the time gives the estimate:
//!
//! ```text
//! 1. relative coordinates, order 8, then order 5:   error = |y - y₂|
//! 2. the same method with r = 7 times the step:     error = |y - y₂| / sqrt((r - 1) (r² - 1))
//! 3. the rows of the run alone (`differences`)
//! ```
//!
//! The difference of two methods is at least a third of the run's error unless the errors of both agree within a third, in size and sign. If
//! the look errs by more than the run, the estimate is too large. In the second the true divisor is r - 1 for order 1 and r² - 1 for
//! order 2: the mean of both is off by at most 2.9 either way. The results of the run are read, never changed.

pub(crate) mod differences;
mod look;

use crate::auto::Clock;
use crate::compare::results::output_scales;
use look::{End, Look, Pace, Seen};
use mbs::inside::AssembledScene;
use mbs::record::{Channel, ErrorEstimate, Outputs};
use mbs::{FormulationKind, IntegratorKind, Outcome, Precision, ResolvedMethod, StepRule};
use mbs_core::cluster::scene_length;
use mbs_core::scene::{Dimension, Scene};
use mbs_scene::format::few;
use std::collections::BTreeSet;

/// Time of all comparison runs, relative to the run [-]. Chosen, not tuned.
pub const TIME_SHARE: f64 = 0.27;
/// Rows at equal distances at which runs are compared [-]. Chosen, not tuned.
const EVENLY: usize = 100;
/// Most rows beside them at which an output is steepest [-]. Chosen, not tuned.
const STEEP: usize = 48;
/// Most rows at which the same method with longer steps is compared. Chosen, not tuned.
const MANY: usize = 400;
/// Ratio of the longer steps of the same method to the run's [-]. Long steps need up to half as many iterations more, and comparison runs before this
/// one may have taken a fifth of the time.
const COARSER: f64 = 7.0;
/// Tolerances of the looks in relative coordinates.
const TOLERANCES: [(IntegratorKind, f64); 2] =
    [(IntegratorKind::Rk853, 1e-8), (IntegratorKind::Rk54, 1e-5)];
/// Ratio of the tolerance of a finer comparison run to that of a run that controls its own steps [-]. Chosen, not tuned.
const FINER: f64 = 0.01;
/// Least tolerance of a comparison run [-]: rounding is near.
const FINEST: f64 = 1e-13;
/// Tolerance of an integrator that controls its own steps where none is given [-]: the default of its options.
const OWN_TOLERANCE: f64 = 1e-8;
/// Ratio of the tolerance of a coarser run for comparison to that of the run [-]: steps of order 5 are six times longer.
const LOOSER: f64 = 1e4;
/// Error of an output by the iterations of a run, relative to the largest range of its unit [-]: Newton's tolerance.
const ITERATION: f64 = 1e-10;
/// Turn of a body in a step above which the rule errs by much [rad]: a hundredth of the turn of each revolution with second order.
const MOST_TURN: f64 = 0.3;
/// Least steps in a period of the stiffest force [-]: with fewer its swing has a wrong period.
const FEWEST_STEPS: f64 = 20.0;
/// Difference of an output, relative to its range, from which it is no small error and follows no order [-]. Chosen, not tuned.
const LOST: f64 = 0.1;
/// Least error that a comparison run shows, in units of rounding of an output [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 8.0;

/// Estimates the errors of a run that was made with these settings, and puts them into its outcome. The looks take about [`TIME_SHARE`] of
/// `run_seconds` at most, by the clock.
///
/// `scene` is the scene in `f64`, whatever the precision of the run.
pub fn estimate(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    outcome: &mut Outcome,
    (clock, run_seconds): (&mut dyn Clock, f64),
) {
    if !outcome.summary.completed {
        let missing = Some("the run stopped before its end".to_owned());
        outcome.take_estimate(ErrorEstimate { missing, ..ErrorEstimate::default() });
        return;
    }
    let judge = Judge { scene, settings, outcome, most: TIME_SHARE * run_seconds };
    let estimate = match scene.dimension {
        Dimension::Planar => judge.estimate::<2>(clock),
        Dimension::Spatial => judge.estimate::<3>(clock),
    };
    outcome.take_estimate(estimate);
}

/// A run, and the time for looks at it [s].
struct Judge<'a> {
    scene: &'a Scene<f64>,
    settings: &'a ResolvedMethod,
    outcome: &'a Outcome,
    most: f64,
}

/// What an estimate is based on, and its errors.
struct Found {
    basis: String,
    errors: Vec<f64>,
    /// Does what iterations leave come on top?
    floor: bool,
}

impl Judge<'_> {
    fn estimate<const D: usize>(&self, clock: &mut dyn Clock) -> ErrorEstimate {
        let begun = clock.seconds();
        let mut estimate = ErrorEstimate::default();
        let Ok(ready) = AssembledScene::<f64, D>::new(self.scene) else {
            // the run has started in another precision
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
        let mut most = Pace::default();
        match self.looks(&look, &mut most, clock, begun) {
            Ok(found) => self.fill(&mut estimate, found),
            Err(_) if self.settings.interrupt.is_set() => {
                estimate.missing = Some("interrupted by a signal".to_owned());
            }
            Err(missing) => estimate.missing = Some(missing),
        }
        self.warn(&mut estimate, &most);
        estimate.cpu_seconds = clock.seconds() - begun;
        estimate
    }

    /// The first look that sees the whole run in its time; else why none does.
    fn looks<const D: usize>(
        &self,
        look: &Look<'_, D>,
        most: &mut Pace,
        clock: &mut dyn Clock,
        begun: f64,
    ) -> Result<Found, String> {
        let rows = look.rows;
        let (instants, mut why) = (instants(rows), Vec::new());
        let mut see = |settings: &ResolvedMethod, instants: &[usize], step: Option<f64>| {
            let left = self.most - (clock.seconds() - begun);
            let seen = look.at(settings, (instants, step), (&mut *clock, left.max(0.0)));
            most.take(&seen.pace);
            seen
        };
        for (integrator, tolerance) in TOLERANCES {
            let settings = self.relative(integrator, tolerance);
            let seen = see(&settings, &instants, None);
            let tolerance = settings.tolerance.unwrap_or(tolerance);
            let name = integrator.name();
            if seen.end == End::Whole {
                let basis = format!(
                    "a run in relative coordinates by {name} with a tolerance of {}, at {} instants",
                    few(tolerance),
                    instants.len()
                );
                return Ok(Found { basis, errors: seen.differences, floor: false });
            }
            let is_hopeless = matches!(seen.end, End::NotStarted(_));
            why.push(reason(&format!("relative coordinates by {name}"), seen));
            if is_hopeless {
                break;
            }
        }
        let (settings, step) = self.coarser();
        let instants = if step.is_some() { self.spaced(rows.len()) } else { instants };
        let seen = see(&settings, &instants, step);
        if seen.end == End::Whole {
            let divisor = ((COARSER - 1.0) * (COARSER * COARSER - 1.0)).sqrt();
            // where the long steps have lost the motion, they say no more than that
            let is_lost = |c: usize, d: f64| d > LOST * differences::range(rows, c);
            let of = |(c, d): (usize, &f64)| if is_lost(c, *d) { *d } else { d / divisor };
            let errors = seen.differences.iter().enumerate().map(of).collect();
            let basis = format!("the same method with {} times the step", few(COARSER));
            return Ok(Found { basis, errors, floor: true });
        }
        // where longer steps fail, those of the run are near what the motion bears: its rows say little of it
        let is_late = seen.end == End::Late;
        why.push(reason(&format!("{} times the step", few(COARSER)), seen));
        let has_all_rows = look.n_steps + 1.0 <= rows.len() as f64;
        if is_late && self.is_second_order() && has_all_rows {
            let basis = "the differences of its rows, roughly: no other look fits in the time";
            let errors = differences::errors(rows);
            return Ok(Found { basis: basis.to_owned(), errors, floor: true });
        }
        Err(why.join("; "))
    }

    /// The run in relative coordinates by an integrator that controls its own steps.
    fn relative(&self, integrator: IntegratorKind, tolerance: f64) -> ResolvedMethod {
        let settings = self.settings;
        let of_run = settings.tolerance.filter(|_| settings.integrator.controls_its_step());
        let finer = of_run.map_or(tolerance, |of_run| tolerance.min(FINER * of_run));
        ResolvedMethod {
            formulation: FormulationKind::RELATIVE,
            integrator,
            precision: Precision::F64,
            step_max: settings.duration,
            rule: StepRule::Fixed,
            events: false,
            penalty: None,
            tolerance: Some(finer.max(FINEST)),
            threads: 1,
            choice: None,
            ..settings.clone()
        }
    }

    /// The run with longer steps, and their length where it is fixed [s].
    fn coarser(&self) -> (ResolvedMethod, Option<f64>) {
        let settings = self.settings;
        // the local error of second order grows with the cube
        let grown = COARSER.powi(3);
        let is_fixed = settings.rule == StepRule::Fixed && !settings.integrator.controls_its_step();
        let coarser = ResolvedMethod {
            precision: Precision::F64,
            step: COARSER * settings.step,
            step_max: COARSER * settings.step_max,
            energy_tolerance: settings.energy_tolerance.map(|x| grown * x),
            error_tolerance: grown * settings.error_tolerance,
            tolerance: match settings.integrator.controls_its_step() {
                true => Some(LOOSER * settings.tolerance.unwrap_or(OWN_TOLERANCE)),
                false => settings.tolerance,
            },
            threads: 1,
            choice: None,
            ..settings.clone()
        };
        (coarser, is_fixed.then_some(COARSER * settings.step))
    }

    /// Rows that are whole long steps apart, where the rows allow it.
    fn spaced(&self, n_rows: usize) -> Vec<usize> {
        let a_row = self.settings.duration / (n_rows.max(2) - 1) as f64;
        let long = (COARSER * self.settings.step / a_row).round().max(1.0);
        let every = long * (n_rows as f64 / long / MANY as f64).ceil().max(1.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least one")]
        let every = every as usize;
        (every..n_rows).step_by(every).filter(|i| i + 1 < n_rows).chain([n_rows - 1]).collect()
    }

    fn is_second_order(&self) -> bool {
        let kind = self.settings.integrator;
        !kind.is_of_first_order() && kind != IntegratorKind::Newmark
    }

    /// The run's step at a time [s]; zero where its integrator controls it.
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
            left + ROUNDINGS * f64::EPSILON * size(c)
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

    /// The largest error in the scale of its output [-], and the output.
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

    /// What makes the steps too long.
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
        if let Some(steps) = most.steps_per_period.filter(|n| *n < FEWEST_STEPS) {
            estimate.warnings.push(format!(
                "a period of the stiffest force has {} steps, fewer than {FEWEST_STEPS}: where it swings, its swing is wrong; shorter steps, or \
                 --formulation recursive --integrator radau5, follow it",
                few(steps)
            ));
        }
    }
}

/// Why a look gives no estimate.
fn reason(what: &str, seen: Seen) -> String {
    match seen.end {
        End::Whole | End::Late => {
            format!("{what} would take more than {} % of the run", (100.0 * TIME_SHARE).round())
        }
        End::Stopped(t, why) => format!("{what} stops at {} s: {why}", few(t)),
        End::NotStarted(why) => format!("{what} does not start: {why}"),
    }
}

/// Rows to compare at, the last among them: at equal distances in time, and where an output is steepest.
fn instants(rows: &[(f64, Vec<f64>)]) -> Vec<usize> {
    let Some(last) = rows.len().checked_sub(1).filter(|last| *last > 0) else { return Vec::new() };
    let end = rows[last].0;
    let at = |t: f64| rows.partition_point(|(time, _)| *time < t).clamp(1, last);
    let mut places: BTreeSet<usize> =
        (1..=EVENLY).map(|k| at(end * k as f64 / EVENLY as f64)).collect();
    places.insert(last);
    let n_columns = rows[0].1.len();
    let most = STEEP.min(n_columns);
    for c in (0..most).map(|k| k * n_columns / most.max(1)) {
        let slope = |i: usize| {
            let way = rows[i].1[c] - rows[i - 1].1[c];
            (way / (rows[i].0 - rows[i - 1].0)).abs()
        };
        places.extend((1..=last).max_by(|&a, &b| slope(a).total_cmp(&slope(b))));
    }
    places.into_iter().collect()
}
