//! Degradation ladder by measurement. Effects that save time and change the outputs least are omitted first.
//!
//! ```text
//! saves   = 1 − (median time of a period without it) / (that of the full scene)
//! changes = max over outputs of (largest difference of the two runs) / (range of the output)
//! ```
//!
//! Each candidate omits one effect or lengthens the steps, and runs over the beginning of the scene. It uses the loop of the paced run,
//! with a clock that does not wait. Candidates whose saving exceeds the noise are sorted by their changes. Level k omits the first k
//! candidates, and is measured again. The ladder ends before a level that changes an output by more than half of its range.

use super::error::PacingError;
use super::ladder::Sought;
use super::{Pace, Pacer};
use crate::changes::OutputRanges;
use crate::record::OutputChange;
use crate::run::{Outcome, PacedLevel, PacedSchedule, paced};
use crate::settings::ResolvedMethod;
use core::cell::Cell;
use core::time::Duration;
use mbs_core::Real;
use mbs_realtime::{Clock, SystemClock};
use std::time::Instant;

/// Time limit of all measurements [s]. Chosen, not tuned.
const SECONDS: f64 = 3.0;
/// Number of periods of the first run, and smallest number of periods of a measured run. Chosen, not tuned.
const FEWEST: u64 = 50;
/// Number of measurements of each level, interleaved. Chosen, not tuned.
const REPEATS: u32 = 3;
/// Smallest fraction of the time of a period that a candidate must save [-]. Chosen, not tuned.
const LEAST_SAVING: f64 = 0.02;
/// Largest number of levels below the full scene. If there are more effects, effects of the same kind are omitted together. Chosen, not
/// tuned.
const MAX_LEVELS: usize = 8;
/// Largest change of an output by a measured level, relative to the range of the output [-]. A user may list levels with larger changes.
/// Chosen, not tuned.
const MOST_CHANGE: f64 = 0.5;
/// Largest number of halvings of the number of steps per period [-]. With one and two halvings, steps are twice and four times as long.
const HALVINGS: u32 = 2;

/// Clock that runs during computations and skips waiting times.
struct Hurried {
    system: SystemClock,
    ahead: Cell<Duration>,
}

impl Clock for Hurried {
    fn now(&self) -> Duration {
        self.system.now() + self.ahead.get()
    }

    fn sleep(&mut self, time: Duration) {
        self.ahead.set(self.ahead.get() + time);
    }

    fn pause(&mut self) {}
}

/// Candidate or level with its measured times and its last run.
struct Trial {
    rung: PacedLevel,
    times: Vec<f64>,
    outcome: Option<Outcome>,
}

impl Trial {
    fn new(rung: PacedLevel) -> Self {
        Self { rung, times: Vec::new(), outcome: None }
    }

    /// Smallest of the measured times [s per period], and the relative difference of the second smallest time from it [-].
    fn best(&self) -> Option<[f64; 2]> {
        let mut sorted = self.times.clone();
        sorted.sort_by(f64::total_cmp);
        let best = *sorted.first().filter(|best| **best > 0.0)?;
        Some([best, sorted.get(1).map_or(0.0, |next| (next - best) / best)])
    }

    fn completes(&self) -> bool {
        self.outcome.as_ref().is_some_and(|outcome| outcome.summary.completed)
    }
}

/// Levels of the ladder with their measurements, the full scene first.
pub(super) fn measured<T: Real, const D: usize>(
    sought: &Sought<'_, T>,
) -> Result<Vec<PacedLevel>, PacingError> {
    let full = sought.rung(0, Vec::new());
    let candidates = candidates::<T, D>(sought);
    if candidates.is_empty() {
        return Err(PacingError::NoLadder);
    }
    // There are at most as many levels as candidates.
    let each = SECONDS / f64::from(REPEATS) / count(2 * candidates.len() + 2);
    let clock = Instant::now();
    let first = trial::<T, D>(sought, &full, FEWEST);
    let one = clock.elapsed().as_secs_f64() / count(FEWEST.min(sought.track.periods) as usize);
    if first.is_none_or(|outcome| !outcome.summary.completed) {
        // The full scene fails here. The run itself will report the error.
        return Ok(vec![full]);
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let periods = ((each / one.max(1e-9)) as u64).max(FEWEST);
    let alone = run_all::<T, D>(sought, &full, candidates, periods);
    let levels = run_all::<T, D>(sought, &full, ladder(sought, &alone), periods);
    let mut rungs = vec![full];
    let is_near = |trial: &Trial| {
        trial.completes()
            && trial.rung.measured.changes.is_some_and(|changes| changes <= MOST_CHANGE)
    };
    rungs.extend(levels.into_iter().skip(1).take_while(is_near).map(|trial| trial.rung));
    if rungs.len() == 1 { Err(PacingError::NoLadder) } else { Ok(rungs) }
}

/// Candidates: longer steps, and each effect. If there are too many effects, all effects of a kind are one candidate.
fn candidates<T: Real, const D: usize>(sought: &Sought<'_, T>) -> Vec<PacedLevel> {
    let effects = sought.scene.effects.iter().enumerate().filter(|(_, effect)| effect.enabled);
    let can = |off: &Vec<usize>| sought.changes::<D>(&sought.rung(0, off.clone())).is_ok();
    let alone: Vec<Vec<usize>> = effects.map(|(i, _)| vec![i]).filter(can).collect();
    let mut groups = alone;
    if groups.len() > MAX_LEVELS {
        let mut kinds: Vec<(&str, Vec<usize>)> = Vec::new();
        for effect in groups.into_iter().flatten() {
            let kind = sought.scene.effects[effect].kind.name();
            match kinds.iter_mut().find(|(name, _)| *name == kind) {
                Some((_, of_kind)) => of_kind.push(effect),
                None => kinds.push((kind, vec![effect])),
            }
        }
        groups = kinds.into_iter().map(|(_, effects)| effects).filter(can).collect();
    }
    let longer = (1..=HALVINGS).filter(|&halvings| sought.lengthens(halvings));
    let longer = longer.map(|halvings| sought.rung(halvings, Vec::new()));
    longer.chain(groups.into_iter().map(|off| sought.rung(0, off))).collect()
}

/// Levels below the full scene. Candidates that save time are sorted by their changes, and each level adds the next candidate.
fn ladder<T: Real>(sought: &Sought<'_, T>, alone: &[Trial]) -> Vec<PacedLevel> {
    let noise = |trial: &Trial| trial.best().map_or(f64::INFINITY, |[_, noise]| noise);
    let full = alone.first().map_or(f64::INFINITY, noise);
    let pays = |trial: &&Trial| {
        let least = LEAST_SAVING.max(full.max(noise(trial)));
        trial.completes() && trial.rung.measured.saves.is_some_and(|saves| saves > least)
    };
    let mut paying: Vec<&Trial> = alone.iter().skip(1).filter(pays).collect();
    let changes = |trial: &Trial| trial.rung.measured.changes.unwrap_or(f64::INFINITY);
    paying.sort_by(|a, b| changes(a).total_cmp(&changes(b)));
    let (mut halvings, mut off) = (0, Vec::new());
    let mut rungs = Vec::new();
    for trial in paying.into_iter().take(MAX_LEVELS) {
        halvings = trial.rung.halvings.max(halvings);
        off.extend(&trial.rung.off);
        rungs.push(sought.rung(halvings, off.clone()));
    }
    rungs
}

/// Runs the full scene and other levels interleaved, and computes for each level the saved time and the change of the outputs.
fn run_all<T: Real, const D: usize>(
    sought: &Sought<'_, T>,
    full: &PacedLevel,
    others: Vec<PacedLevel>,
    periods: u64,
) -> Vec<Trial> {
    let all = core::iter::once(full.clone()).chain(others);
    let mut trials: Vec<Trial> = all.map(Trial::new).collect();
    for _ in 0..REPEATS {
        for of in &mut trials {
            of.outcome = trial::<T, D>(sought, &of.rung, periods);
            let realtime = of.outcome.as_ref().and_then(|o| o.summary.realtime.as_ref());
            of.times.extend(realtime.map(|realtime| realtime.duration.p50));
        }
    }
    let Some((full, others)) = trials.split_first_mut() else { return trials };
    let outputs = full.outcome.as_ref().map(|outcome| OutputRanges::new(sought.scene, outcome));
    for other in others {
        let saves = full.best().zip(other.best()).map(|([full, _], [less, _])| 1.0 - less / full);
        other.rung.measured.saves = saves;
        other.rung.measured.measured_over = other.outcome.as_ref().map(|o| o.summary.end_time);
        let outcome = outputs.as_ref().zip(other.outcome.as_ref());
        let changes = outcome.map(|(outputs, outcome)| outputs.changes(outcome));
        if let Some((output, share)) = changes.as_deref().and_then(largest) {
            (other.rung.measured.output, other.rung.measured.changes) = (Some(output), Some(share));
        }
    }
    trials
}

/// Returns the output with the largest relative change, and that change; `None` if an output without a range changes.
fn largest(changes: &[OutputChange]) -> Option<(String, f64)> {
    let share = |change: &OutputChange| match change.relative {
        Some(share) => Some(share),
        None => change.is_rounding.then_some(0.0),
    };
    let shares: Option<Vec<f64>> = changes.iter().map(share).collect();
    let shares = shares?;
    let i = (0..shares.len()).max_by(|&i, &j| shares[i].total_cmp(&shares[j]))?;
    Some((changes[i].output.clone(), shares[i]))
}

/// Runs the first periods at one level, without waiting for the clock; `None` if the level cannot run in this scene.
fn trial<T: Real, const D: usize>(
    sought: &Sought<'_, T>,
    rung: &PacedLevel,
    periods: u64,
) -> Option<Outcome> {
    let Sought { settings, track, .. } = *sought;
    let periods = periods.min(track.periods);
    let duration = settings.duration.min(count(usize::try_from(periods).ok()?) * track.period.1);
    let settings = ResolvedMethod { duration, ..settings.clone() };
    let steps = track.steps.map(|steps| rung.steps(steps));
    let track = PacedSchedule { periods, steps, has_level: false, ..*track };
    let scene = rung.scene(sought.scene);
    let mut pacer = Pacer::new(Pace::every(Duration::from_secs_f64(track.period.1)), 1).ok()?;
    let mut clock = Hurried { system: SystemClock::new(), ahead: Cell::default() };
    let of_one = (&mut pacer, &[PacedLevel::default()][..]);
    paced::<T, D>(&scene, &settings, &track, of_one, &mut clock).ok()
}

#[allow(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
fn count(n: usize) -> f64 {
    n as f64
}
