//! Loop of tasks one period apart, and what happens when one is late.
//!
//! ```text
//! task k: planned begin r_k, deadline d_k = r_k + P, end e_k;  late where e_k > d_k
//! finish, degrade:  r_(k+1) = d_k
//! hold:             r_(k+1) = d_k + m P,  m = ⌈(e_k − d_k) / P⌉ where late, else 0
//! ```

use crate::clock::{Clock, wait_until};
use crate::ladder::{DegradationLadder, Recovery};
use crate::log::{Action, Entry, Log};
use crate::report::{Report, margin, spread};
use crate::sample::{Sample, nanos};
use core::ops::ControlFlow;
use std::time::Duration;

/// Policy for a task that ends after its deadline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overrun {
    /// The late result is published as soon as it is there, and the next task begins at once. The schedule stays: tasks that are
    /// shorter than a period catch the debt up, however large it is, and no task is left out.
    #[default]
    Finish,
    /// The late result is published at the next boundary of a period, and the next task begins there; until then the last result
    /// stands. The schedule is put off by these periods and they are not caught up: no task is left out, but each comes later.
    Hold,
    /// The loop continues as with [`Finish`](Self::Finish), and the level goes down one step of the ladder; it comes back up as
    /// [`Recovery`] says.
    Degrade,
}

/// Pace of a loop: its period, and what becomes of late tasks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pace {
    /// From the planned begin of a task to that of the next. `> 0`.
    pub period: Duration,
    /// Policy for a task that is late.
    pub overrun: Overrun,
    /// The loop waits asleep until so long before a begin, then awake: systems wake sleepers late. Zero: asleep only.
    pub awake: Duration,
    /// When a degraded loop comes back up.
    pub quiet: Recovery,
    /// Entries of the log at most; those beyond are counted.
    pub log: usize,
}

impl Pace {
    /// Finishes late tasks, is awake for 0.1 ms, and keeps 1000 entries.
    #[must_use]
    pub fn every(period: Duration) -> Self {
        Self {
            period,
            overrun: Overrun::Finish,
            awake: Duration::from_micros(100),
            quiet: Recovery::default(),
            log: 1000,
        }
    }
}

/// A pace that is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PaceError {
    /// The period is zero.
    NoPeriod,
    /// There is no level, not even that of everything.
    NoLevel,
    /// A quiet time of no task, or a share of a period that is not from 1 to 100 percent.
    NoQuiet,
}

impl core::fmt::Display for PaceError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NoPeriod => "the period is zero: give a longer one",
            Self::NoLevel => "there is no level: level 0 is everything",
            Self::NoQuiet => "a quiet time has at least one task, of 1 to 100 percent of a period",
        })
    }
}

impl core::error::Error for PaceError {}

/// The work of one period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Task {
    /// Number of the task, from 0.
    pub index: u64,
    /// The level of the ladder at which it is to run: 0 is everything.
    pub level: usize,
}

/// Work that a loop paces, one task for each period.
pub trait Work {
    /// Error that keeps the work from continuing.
    type Error;

    /// The work of one period: read inputs, step. `Break` ends the loop after this task.
    ///
    /// # Errors
    /// What keeps it from continuing; the loop ends then.
    fn step(&mut self, task: Task) -> Result<ControlFlow<()>, Self::Error>;

    /// Publishes the result of a task, which becomes valid now: write outputs. Called once for each task, at the end of its period, or as the
    /// policy says.
    fn publish(&mut self, task: Task) {
        let _ = task;
    }
}

impl<E, F: FnMut(Task) -> Result<ControlFlow<()>, E>> Work for F {
    type Error = E;

    fn step(&mut self, task: Task) -> Result<ControlFlow<()>, E> {
        self(task)
    }
}

/// A loop with everything that it measures, allocated before it begins.
#[derive(Debug, Clone)]
pub struct Pacer {
    pace: Pace,
    ladder: DegradationLadder,
    jitter: Sample,
    duration: Sample,
    margin: Sample,
    log: Log,
    at_level: Vec<u64>,
    tasks: u64,
    overruns: u64,
    latest: Duration,
    skipped: u64,
    behind: Duration,
    elapsed: Duration,
    busy: Duration,
}

impl Pacer {
    /// A loop over work that has `levels` levels; 1: there is nothing to degrade to.
    ///
    /// # Errors
    /// [`PaceError`].
    pub fn new(pace: Pace, levels: usize) -> Result<Self, PaceError> {
        let quiet = pace.quiet;
        if pace.period.is_zero() {
            return Err(PaceError::NoPeriod);
        }
        if levels == 0 {
            return Err(PaceError::NoLevel);
        }
        if quiet.tasks == 0 || !(1..=100).contains(&quiet.percent) {
            return Err(PaceError::NoQuiet);
        }
        Ok(Self {
            pace,
            ladder: DegradationLadder::new(quiet, pace.period, levels),
            jitter: Sample::new(),
            duration: Sample::new(),
            margin: Sample::new(),
            log: Log::new(pace.log),
            at_level: vec![0; levels],
            tasks: 0,
            overruns: 0,
            latest: Duration::ZERO,
            skipped: 0,
            behind: Duration::ZERO,
            elapsed: Duration::ZERO,
            busy: Duration::ZERO,
        })
    }

    /// Does at most `tasks` tasks, the first at once, and returns when the last result is published.
    ///
    /// A task that fails is not counted. A loop may be run again: its measures add up, its log continues, its level stays.
    ///
    /// Cost of a task beside its work: two or three readings of the clock, and some hundred operations; no allocation.
    ///
    /// # Errors
    /// That of the work.
    pub fn run<W: Work>(
        &mut self,
        tasks: u64,
        clock: &mut impl Clock,
        work: &mut W,
    ) -> Result<(), W::Error> {
        let Pace { period, awake, .. } = self.pace;
        let start = clock.now();
        let before = self.elapsed;
        let mut release = start;
        let mut is_delayed = false;
        let mut waiting = None;
        for _ in 0..tasks {
            wait_until(clock, release, awake);
            let begin = clock.now();
            if let Some(done) = waiting.take() {
                work.publish(done);
            }
            let task = Task { index: self.tasks, level: self.ladder.level() };
            let flow = work.step(task)?;
            let end = clock.now();
            let deadline = release + period;
            if !is_delayed {
                self.jitter.take(nanos(begin.saturating_sub(release)));
            }
            self.elapsed = before + end.saturating_sub(start);
            self.count(task, end.saturating_sub(begin), (deadline, end));
            let late = end.saturating_sub(deadline);
            let action = self.after(task, late, end.saturating_sub(begin));
            is_delayed = !late.is_zero();
            release = deadline;
            match action {
                Some(Action::Held { periods }) => {
                    release = deadline.saturating_add(times(period, periods));
                    is_delayed = false;
                    waiting = Some(task);
                }
                _ if is_delayed => work.publish(task),
                _ => waiting = Some(task),
            }
            if flow.is_break() {
                break;
            }
        }
        if let Some(done) = waiting {
            wait_until(clock, release, awake);
            work.publish(done);
        }
        Ok(())
    }

    /// Counts and measures of a task.
    fn count(&mut self, task: Task, duration: Duration, (deadline, end): (Duration, Duration)) {
        self.tasks += 1;
        if let Some(n) = self.at_level.get_mut(task.level) {
            *n += 1;
        }
        self.busy += duration;
        self.duration.take(nanos(duration));
        self.margin.take(nanos(deadline) - nanos(end));
    }

    /// Returns what is done about a task, late or not, and logs it where it is out of the ordinary.
    fn after(&mut self, task: Task, late: Duration, duration: Duration) -> Option<Action> {
        let is_late = !late.is_zero();
        let action = match self.pace.overrun {
            Overrun::Finish => is_late.then_some(Action::Finished),
            Overrun::Hold => is_late.then(|| Action::Held { periods: self.periods(late) }),
            Overrun::Degrade => self.ladder.after(is_late, duration),
        };
        if is_late {
            self.overruns += 1;
            self.latest = self.latest.max(late);
        }
        self.behind = late;
        if let Some(Action::Held { periods }) = action {
            self.skipped = self.skipped.saturating_add(periods);
            self.behind = Duration::ZERO;
        }
        if let Some(action) = action {
            let (at, level) = (self.elapsed, task.level);
            self.log.take(Entry { task: task.index, at, duration, late, level, action });
        }
        action
    }

    /// Returns ⌈late / P⌉, the number of periods.
    fn periods(&self, late: Duration) -> u64 {
        u64::try_from(late.as_nanos().div_ceil(self.pace.period.as_nanos())).unwrap_or(u64::MAX)
    }

    /// Returns the pace of the loop.
    #[must_use]
    pub fn pace(&self) -> &Pace {
        &self.pace
    }

    /// The level at which the next task runs.
    #[must_use]
    pub fn level(&self) -> usize {
        self.ladder.level()
    }

    /// Returns what was measured so far. Sorts: not for within the loop.
    #[must_use]
    pub fn report(&self) -> Report {
        let simulated = times(self.pace.period, self.tasks);
        let busy = self.busy.as_secs_f64();
        Report {
            tasks: self.tasks,
            jitter: spread(&self.jitter),
            duration: spread(&self.duration),
            margin: margin(&self.margin),
            overruns: self.overruns,
            latest: self.latest,
            log: self.log.entries.clone(),
            log_left_out: self.log.left_out,
            at_level: self.at_level.clone(),
            skipped: self.skipped,
            behind: times(self.pace.period, self.skipped) + self.behind,
            elapsed: self.elapsed,
            busy: self.busy,
            real_time_factor: if busy > 0.0 { simulated.as_secs_f64() / busy } else { 0.0 },
        }
    }
}

/// Returns n P, the time of n periods.
fn times(period: Duration, n: u64) -> Duration {
    let nanos = period.as_nanos().saturating_mul(u128::from(n));
    Duration::from_nanos(u64::try_from(nanos).unwrap_or(u64::MAX))
}
