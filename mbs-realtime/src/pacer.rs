//! Loop of tasks one period apart, with a policy for late tasks.
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
    /// The late result is published at once, and the next task begins at once. The schedule does not change. No task is left out. Tasks
    /// that are shorter than a period reduce the delay until it is zero.
    #[default]
    Finish,
    /// The late result is published at the next end of a period, and the next task begins then. Until then the last result remains valid.
    /// All later tasks are shifted by these periods, and no task is left out.
    Hold,
    /// The loop continues as with [`Finish`](Self::Finish), and the level goes down one step of the ladder. [`Recovery`] decides when it goes
    /// up again.
    Degrade,
}

/// Pace of a loop: its period, and its policy for late tasks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pace {
    /// Time from the planned begin of a task to that of the next one. `> 0`.
    pub period: Duration,
    /// Policy for a task that is late.
    pub overrun: Overrun,
    /// Time before a task's begin in which the loop waits actively. Before that it sleeps. Active waiting is useful because systems wake
    /// sleepers late. With zero the loop only sleeps.
    pub awake: Duration,
    /// Condition on which a degraded loop goes up a level.
    pub quiet: Recovery,
    /// Largest number of entries of the log. Further entries are only counted.
    pub log: usize,
}

impl Pace {
    /// Returns the defaults: late tasks are finished, the loop waits actively for 0.1 ms, and the log has 1000 entries.
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

/// Error of a pace with an option out of range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PaceError {
    /// The period is zero.
    NoPeriod,
    /// The number of levels is zero, although level 0 always exists.
    NoLevel,
    /// The quiet time has no task, or its percentage of a period is not from 1 to 100.
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

/// Number and level of the task of one period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Task {
    /// Number of the task, from 0.
    pub index: u64,
    /// The level of the ladder for this task. At level 0 the task does all its work.
    pub level: usize,
}

/// Work of a paced loop, one task for each period.
pub trait Work {
    /// Error after which the work cannot continue.
    type Error;

    /// Does the work of one period, for example reads inputs and makes a step. `Break` ends the loop after this task.
    ///
    /// # Errors
    /// The error after which the work cannot continue; the loop then ends.
    fn step(&mut self, task: Task) -> Result<ControlFlow<()>, Self::Error>;

    /// Publishes the result of a task, which becomes valid at this time, for example writes outputs. It is called once for each task. The
    /// time is the end of the task's period, or a later one by the policy for late tasks.
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

/// A paced loop with all its measures, allocated before it begins.
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
    /// Creates a loop for work with `levels` levels. With one level the loop cannot degrade.
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

    /// Does at most `tasks` tasks, the first one at once, and returns when the last result is published.
    ///
    /// A task that fails is not counted. A loop may be run again. It then continues with its measures, its log and its level.
    ///
    /// Cost of a task in addition to its work: two or three readings of the clock, and some hundred operations; no allocation.
    ///
    /// # Errors
    /// The error of the work.
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

    /// Counts a task and records its measures.
    fn count(&mut self, task: Task, duration: Duration, (deadline, end): (Duration, Duration)) {
        self.tasks += 1;
        if let Some(n) = self.at_level.get_mut(task.level) {
            *n += 1;
        }
        self.busy += duration;
        self.duration.take(nanos(duration));
        self.margin.take(nanos(deadline) - nanos(end));
    }

    /// Returns the action after a task, and logs the task if it was late or changed the level.
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

    /// Returns ⌈late / P⌉, the number of periods of a delay.
    fn periods(&self, late: Duration) -> u64 {
        u64::try_from(late.as_nanos().div_ceil(self.pace.period.as_nanos())).unwrap_or(u64::MAX)
    }

    /// Returns the pace of the loop.
    #[must_use]
    pub fn pace(&self) -> &Pace {
        &self.pace
    }

    /// Level at which the next task runs.
    #[must_use]
    pub fn level(&self) -> usize {
        self.ladder.level()
    }

    /// Returns the measures so far. This sorts the samples, so do not call it within the loop.
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

/// Returns the time n P of n periods.
fn times(period: Duration, n: u64) -> Duration {
    let nanos = period.as_nanos().saturating_mul(u128::from(n));
    Duration::from_nanos(u64::try_from(nanos).unwrap_or(u64::MAX))
}
