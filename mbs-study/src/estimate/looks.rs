//! Sequence of comparison runs, and the estimate from them.

use super::differences;
use super::look::{End, Look, Pace, Seen};
use super::purse::{Purse, WORK_SHARE};
use mbs::{FormulationKind, IntegratorKind, Precision, ResolvedMethod, StepRule};
use mbs_scene::format::few;
use std::collections::BTreeSet;

/// Largest number of rows that are compared because an output is steepest there [-]. Equally spaced rows are not counted. Chosen, not tuned.
const STEEP: usize = 48;
/// Largest number of rows that are compared with the same method in other steps. Chosen, not tuned.
const MANY: usize = 400;
/// Ratios of the comparison run's step to the original step, with the same method [-]. The first affordable one is used.
const RATIOS: [f64; 5] = [0.5, 2.0, 3.0, 5.0, 7.0];
/// Ratio that is assumed for the iterations of a longer step to those of the original step [-]. A longer step needs up to half as many more
/// iterations.
const MORE_ITERATIONS: f64 = 1.2;
/// Comparison runs in relative coordinates: integrator, tolerance [-], and largest number of evaluations relative to the run before, over all
/// scenes [-].
type Sequence = [(IntegratorKind, f64, f64)];
/// Comparison runs by explicit integrators. The first one is cheap. If the original run has large errors, the first comparison run shows them
/// to within a third. It also predicts the work of the next one.
const EXPLICIT: &Sequence = &[
    (IntegratorKind::Rk54, 1e-4, 0.0),
    (IntegratorKind::Rk853, 1e-8, 4.0),
    (IntegratorKind::Rk853, 1e-10, 1.8),
    (IntegratorKind::Rk853, 1e-12, 1.8),
    (IntegratorKind::Rk853, FINEST, 1.3),
];
/// Comparison runs that follow the first explicit one if the second is not affordable.
const CHEAP: &Sequence = &[(IntegratorKind::Rk54, 1e-5, 1.4), (IntegratorKind::Rk54, 1e-6, 1.6)];
/// Comparison runs for scenes with stiff forces.
const IMPLICIT: &Sequence = &[
    (IntegratorKind::Radau5, 1e-6, 0.0),
    (IntegratorKind::Radau5, 1e-7, 1.6),
    (IntegratorKind::Radau5, 1e-8, 1.6),
];
/// Ratio of the tolerance of a comparison run to that of the original run, if the original integrator controls its steps itself [-]. Chosen,
/// not tuned.
const FINER: f64 = 0.01;
/// Smallest tolerance of a comparison run [-], which is close to the rounding of numbers.
const FINEST: f64 = 1e-13;
/// Tolerance of an integrator with its own step control if none is given [-]: the default of its options.
const OWN_TOLERANCE: f64 = 1e-8;
/// Exponent with which the tolerance is scaled by the ratio of steps [-]: order 5, the smallest of the integrators with their own step
/// control.
const OWN_ORDER: i32 = 5;
/// Difference of an output, relative to its range, from which it no longer decreases with the order of the method [-]. Chosen, not tuned.
const LOST: f64 = 0.1;

/// Estimate: its basis, and the errors of the components.
pub(super) struct Found {
    pub(super) basis: String,
    pub(super) errors: Vec<f64>,
    /// True if the errors of the run's iterations are added.
    pub(super) floor: bool,
}

/// Comparison runs of an original run.
pub(super) struct Looks<'a, const D: usize> {
    pub(super) look: Look<'a, D>,
    pub(super) settings: &'a ResolvedMethod,
    pub(super) purse: Purse,
    /// Speed of the motion, relative to the step of the original run.
    pub(super) pace: Pace,
    /// Reasons why comparison runs gave no estimate.
    why: Vec<String>,
}

impl<'a, const D: usize> Looks<'a, D> {
    /// Makes the sequence of comparison runs, none of which is done yet.
    pub(super) fn new(look: Look<'a, D>, settings: &'a ResolvedMethod, purse: Purse) -> Self {
        Self { look, settings, purse, pace: Pace::default(), why: Vec::new() }
    }

    /// Returns the estimate of the best affordable comparison run, or the reasons why there is none.
    pub(super) fn find(&mut self) -> Result<Found, String> {
        let instants = instants(self.look.rows, self.purse.rows(self.look.scene));
        for sequences in [&[EXPLICIT, CHEAP][..], &[IMPLICIT]] {
            match self.relative(sequences, &instants) {
                Ok(found) => return Ok(found),
                Err(End::NotStarted(_)) => break,
                Err(_) => {}
            }
        }
        let mut part = None;
        for ratio in RATIOS {
            match self.same(ratio, &instants) {
                Some((found, true)) => return Ok(found),
                Some((found, false)) => part = part.or(Some(found)),
                None => {}
            }
        }
        self.rest(part).ok_or_else(|| self.why.join("; "))
    }

    /// Makes a comparison run, and adds its nominal time to the time spent.
    fn see(
        &mut self,
        settings: &ResolvedMethod,
        (instants, step): (&[usize], Option<f64>),
        of_one: impl Fn(&Purse, [usize; 3]) -> f64,
    ) -> Seen {
        let purse = &self.purse;
        let of_one = |sizes| of_one(purse, sizes);
        let seen = self.look.at(settings, (instants, step), (purse.left(), &of_one));
        self.purse.spent += seen.seconds;
        self.purse.spent += self.purse.of_rows(seen.values.len());
        self.pace.take(&seen.pace);
        seen
    }

    /// Compares with runs in relative coordinates. Finer runs follow while they are affordable. They end when two of them differ less from each
    /// other than the original run differs from them.
    fn relative(&mut self, sequences: &[&Sequence], instants: &[usize]) -> Result<Found, End> {
        let mut best: Option<(Seen, String)> = None;
        let mut n_whole = 0;
        'all: for sequence in sequences {
            if n_whole > 1 {
                break;
            }
            for &(integrator, tolerance, work) in *sequence {
                let rows = self.purse.of_rows(instants.len());
                let seconds = |seen: &Seen| work * seen.seconds + rows;
                if best.as_ref().is_some_and(|(seen, _)| !self.purse.has(seconds(seen))) {
                    break;
                }
                let settings = self.of_relative(integrator, tolerance);
                let of_one = |purse: &Purse, sizes| purse.relative(integrator, sizes);
                let seen = self.see(&settings, (instants, None), of_one);
                let name = integrator.name();
                if seen.end != End::Whole {
                    self.why.push(reason(&format!("relative coordinates by {name}"), &seen.end));
                    match best {
                        Some(_) => break 'all,
                        None => return Err(seen.end),
                    }
                }
                let is_fine = best.is_some_and(|(last, _)| self.is_finer((&last, &seen), instants));
                let tolerance = few(settings.tolerance.unwrap_or(tolerance));
                best = Some((seen, format!("{name} with a tolerance of {tolerance}")));
                n_whole += 1;
                if is_fine {
                    break 'all;
                }
            }
        }
        let (seen, by) = best.ok_or(End::Late)?;
        let n = instants.len();
        let basis = format!("a run in relative coordinates by {by}, at {n} instants");
        Ok(Found { basis, errors: self.differences(&seen, instants), floor: false })
    }

    /// True if two successive comparison runs differ less from each other than the original run differs from the second one, in each component.
    fn is_finer(&self, (look, next): (&Seen, &Seen), instants: &[usize]) -> bool {
        let of_run = self.differences(next, instants);
        let both = || look.values.iter().zip(&next.values);
        let of_look = |c: usize| both().map(|(a, b)| (a[c] - b[c]).abs()).fold(0.0, f64::max);
        let size = |c: usize| next.values.iter().map(|row| row[c].abs()).fold(0.0, f64::max);
        let is_fine = |(c, e): (usize, &f64)| {
            of_look(c) <= e.max(differences::ROUNDINGS * f64::EPSILON * size(c))
        };
        of_run.iter().enumerate().all(is_fine)
    }

    /// Largest difference of each component between a comparison run and the original run.
    fn differences(&self, seen: &Seen, instants: &[usize]) -> Vec<f64> {
        let rows = self.look.rows;
        let both = || seen.values.iter().zip(instants.iter().map(|&i| &rows[i].1));
        let n = rows.first().map_or(0, |(_, row)| row.len());
        (0..n).map(|c| both().map(|(a, b)| (a[c] - b[c]).abs()).fold(0.0, f64::max)).collect()
    }

    /// Estimates errors by the same method with `ratio` times the step, if this is affordable. Also returns whether the comparison run
    /// reached the end.
    fn same(&mut self, ratio: f64, instants: &[usize]) -> Option<(Found, bool)> {
        let more = if ratio > 1.0 { MORE_ITERATIONS } else { 1.0 };
        if !self.purse.has(more * self.purse.of_ratio(ratio)) {
            return None;
        }
        let (settings, step) = self.of_same(ratio);
        let instants = match step {
            Some(_) => self.spaced(ratio),
            None => instants.to_vec(),
        };
        let seen = self.see(&settings, (&instants, step), |purse, _| purse.same());
        let divisor = ((ratio - 1.0) * (ratio * ratio - 1.0)).sqrt();
        // if longer steps do not resolve the motion, the difference itself is the error
        let rows = self.look.rows;
        let is_lost = |c: usize, d: f64| ratio > 1.0 && d > LOST * differences::range(rows, c);
        let of = |(c, d): (usize, f64)| if is_lost(c, d) { d } else { d / divisor };
        let errors = self.differences(&seen, &instants).into_iter().enumerate().map(of).collect();
        let mut basis = format!("the same method with {} times the step", few(ratio));
        if seen.end == End::Whole {
            return Some((Found { basis, errors, floor: true }, true));
        }
        self.why.push(reason(&format!("{} times the step", few(ratio)), &seen.end));
        let End::Stopped(t, _) = seen.end else { return None };
        let to = few(t);
        basis +=
            &format!(" up to {to} s, where it stops, and the differences of its rows, roughly");
        Some((Found { basis, errors, floor: true }, false))
    }

    /// Returns the estimate from the rows alone, combined with that of a comparison run that stopped.
    fn rest(&self, part: Option<Found>) -> Option<Found> {
        let rows = self.look.rows;
        let has_all_rows = self.look.n_steps + 1.0 <= rows.len() as f64;
        let alone = (has_all_rows && self.is_second_order()).then(|| differences::errors(rows));
        match (part, alone) {
            (Some(part), alone) => {
                let alone = alone.unwrap_or_else(|| vec![0.0; part.errors.len()]);
                let errors = part.errors.iter().zip(alone).map(|(a, b)| a.max(b)).collect();
                Some(Found { errors, ..part })
            }
            (None, Some(errors)) => {
                let basis = "the differences of its rows, roughly: no other look is affordable";
                Some(Found { basis: basis.to_owned(), errors, floor: true })
            }
            (None, None) => None,
        }
    }

    /// Settings of the original run, in relative coordinates with an integrator that controls its steps itself.
    fn of_relative(&self, integrator: IntegratorKind, tolerance: f64) -> ResolvedMethod {
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

    /// Settings of the original run with `ratio` times the step. Also returns the step, if it is fixed [s].
    fn of_same(&self, ratio: f64) -> (ResolvedMethod, Option<f64>) {
        let settings = self.settings;
        // the local error of a method of second order grows with the cube of the step
        let grown = ratio.powi(3);
        let is_fixed = settings.rule == StepRule::Fixed && !settings.integrator.controls_its_step();
        let own = ratio.powi(OWN_ORDER) * settings.tolerance.unwrap_or(OWN_TOLERANCE);
        let other = ResolvedMethod {
            precision: Precision::F64,
            step: ratio * settings.step,
            step_max: ratio * settings.step_max,
            energy_tolerance: settings.energy_tolerance.map(|x| grown * x),
            error_tolerance: grown * settings.error_tolerance,
            tolerance: match settings.integrator.controls_its_step() {
                true => Some(own.max(FINEST)),
                false => settings.tolerance,
            },
            threads: 1,
            choice: None,
            ..settings.clone()
        };
        (other, is_fixed.then_some(ratio * settings.step))
    }

    /// Rows whose distance is a multiple of the comparison run's step, if the rows allow it.
    fn spaced(&self, ratio: f64) -> Vec<usize> {
        let n_rows = self.look.rows.len();
        let a_row = self.settings.duration / (n_rows.max(2) - 1) as f64;
        let long = (ratio * self.settings.step / a_row).round().max(1.0);
        let every = long * (n_rows as f64 / long / MANY as f64).ceil().max(1.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least one")]
        let every = every as usize;
        (every..n_rows).step_by(every).filter(|i| i + 1 < n_rows).chain([n_rows - 1]).collect()
    }

    fn is_second_order(&self) -> bool {
        let kind = self.settings.integrator;
        !kind.is_of_first_order() && kind != IntegratorKind::Newmark
    }
}

/// Returns the reason why a comparison run gives no estimate.
fn reason(what: &str, end: &End) -> String {
    match end {
        End::Whole | End::Late => {
            let most = (100.0 * WORK_SHARE).round();
            format!("{what} would take more than {most} % of the run and a tenth of a second")
        }
        End::Stopped(t, why) => format!("{what} stops at {} s: {why}", few(*t)),
        End::NotStarted(why) => format!("{what} does not start: {why}"),
    }
}

/// Rows at which runs are compared, including the last one: equally spaced in time, and where an output is steepest.
fn instants(rows: &[(f64, Vec<f64>)], evenly: usize) -> Vec<usize> {
    let Some(last) = rows.len().checked_sub(1).filter(|last| *last > 0) else { return Vec::new() };
    let end = rows[last].0;
    let at = |t: f64| rows.partition_point(|(time, _)| *time < t).clamp(1, last);
    let mut places: BTreeSet<usize> =
        (1..=evenly).map(|k| at(end * k as f64 / evenly as f64)).collect();
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
