//! Timing of whole runs, interleaved, until the times are known well enough.

use super::reference::Known;
use super::store::ResultStore;
use super::{CompareError, Study, Watch};
use crate::compare::results::{Comparison, RunEntry, Status};

/// Largest relative difference of the three shortest times of a run at which its time is known well enough [-]. Chosen, not tuned.
const SETTLED: f64 = 0.005;
/// Smallest and largest number of rounds for runs that decide the ranking, in units of the requested repeats [-]. Chosen, not tuned.
const ROUNDS: [u32; 2] = [3, 8];
/// Start and length of the rounds in the progress bar, as fractions of it [-].
const PROGRESS: [f64; 2] = [0.35, 0.6];

impl Study<'_> {
    /// Times all completed runs in rounds. The order is reversed in every second round, so that a disturbance affects all runs equally. Then
    /// the runs that decide the ranking are timed again, until their three shortest times agree.
    pub(super) fn time(
        &self,
        comparison: &mut Comparison,
        known: &Known,
        store: &mut ResultStore,
        watch: &mut impl Watch,
    ) -> Result<(), CompareError> {
        let repeats = self.request.repeats;
        for round in 0..repeats * ROUNDS[1] {
            let errors = &self.request.errors;
            let mut jobs = match round {
                _ if round < repeats => completed(comparison),
                _ if round < repeats * ROUNDS[0] => comparison.decisive(errors),
                _ => unsettled(comparison, errors),
            };
            if jobs.is_empty() {
                break;
            }
            if round % 2 == 1 {
                jobs.reverse();
            }
            for (n, &(m, r)) in jobs.iter().enumerate() {
                let part = n as f64 / jobs.len() as f64;
                let usual = repeats * ROUNDS[0];
                let share = ((f64::from(round) + part) / f64::from(usual)).min(1.0);
                let doing = format!("timing, round {} of {usual}", round + 1);
                watch.doing(PROGRESS[0] + PROGRESS[1] * share, &doing);
                let method = &self.methods[m];
                let run = &mut comparison.methods[m].runs[r];
                let key = format!("time {round} {} {:e}", method.name(), run.setting);
                let setting = run.setting;
                let time = || {
                    let (settings, course) = self.course(method, setting, known).ok()?;
                    self.scenes.timed(&settings, &course, round)
                };
                run.cpu_seconds.extend(store.get(&key, time)?);
            }
        }
        Ok(())
    }
}

/// Returns the completed runs, each by the indices of its method and of the run.
pub fn completed(comparison: &Comparison) -> Vec<(usize, usize)> {
    let methods = comparison.methods.iter().enumerate();
    let runs = methods.flat_map(|(m, method)| {
        let runs = method.runs.iter().enumerate();
        runs.filter(|(_, run)| run.status == Status::Completed).map(move |(r, _)| (m, r))
    });
    runs.collect()
}

/// Returns the runs that decide the ranking at some errors and whose times are not known well enough.
pub fn unsettled(comparison: &Comparison, errors: &[f64]) -> Vec<(usize, usize)> {
    let is_apart = |run: &RunEntry| {
        let mut times = run.cpu_seconds.clone();
        times.sort_by(f64::total_cmp);
        times.get(2).is_none_or(|third| *third > (1.0 + SETTLED) * times[0])
    };
    let mut runs = comparison.decisive(errors);
    runs.retain(|&(m, r)| is_apart(&comparison.methods[m].runs[r]));
    runs
}
