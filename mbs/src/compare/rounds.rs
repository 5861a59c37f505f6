//! Times of whole runs, by turns, until they are known well enough.

use super::reference::Known;
use super::store::Store;
use super::{CompareError, Study, Watch};
use mbs_scene::compare::{Comparison, RunEntry, Status};

/// The two least times of a run differ by no more than this share where it is known well enough.
const SETTLED: f64 = 0.02;
/// So many times the repeats asked for are made at most.
const MOST_ROUNDS: u32 = 4;
/// Where the rounds stand in the progress bar.
const SHARE: [f64; 2] = [0.35, 0.6];

impl Study<'_> {
    /// Times every completed run: in rounds over all, there and back, so that what disturbs a while meets all alike; then again
    /// those whose two least times are still apart.
    pub(super) fn time(
        &self,
        comparison: &mut Comparison,
        known: &Known,
        store: &mut Store,
        watch: &mut impl Watch,
    ) -> Result<(), CompareError> {
        let repeats = self.request.repeats;
        for round in 0..repeats * MOST_ROUNDS {
            let mut jobs = unsettled(comparison, round < repeats);
            if jobs.is_empty() {
                break;
            }
            if round % 2 == 1 {
                jobs.reverse();
            }
            for (n, &(m, r)) in jobs.iter().enumerate() {
                let part = super::ladder::count(n) / super::ladder::count(jobs.len());
                let share = ((f64::from(round) + part) / f64::from(repeats)).min(1.0);
                let doing = format!("timing, round {} of {repeats}", round + 1);
                watch.doing(SHARE[0] + SHARE[1] * share, &doing);
                let method = &self.methods[m];
                let run = &mut comparison.methods[m].runs[r];
                let key = format!("time {round} {} {:e}", method.name(), run.setting);
                let setting = run.setting;
                let time = || {
                    let course = self.course(method, setting, known).ok();
                    course
                        .and_then(|(settings, course)| self.scenes.timed(&settings, &course))
                        .into()
                };
                let value = store.get(&key, time).map_err(CompareError::Journal)?;
                run.cpu_seconds.extend(value.as_f64());
            }
        }
        Ok(())
    }
}

/// The runs to time next, by method and run.
fn unsettled(comparison: &Comparison, all: bool) -> Vec<(usize, usize)> {
    let is_apart = |run: &RunEntry| {
        run.two_least().is_none_or(|[least, second]| second > (1.0 + SETTLED) * least)
    };
    let mut jobs = Vec::new();
    for (m, method) in comparison.methods.iter().enumerate() {
        for (r, run) in method.runs.iter().enumerate() {
            if run.status == Status::Completed && (all || is_apart(run)) {
                jobs.push((m, r));
            }
        }
    }
    jobs
}

#[cfg(test)]
mod tests {
    use super::*;
    use mbs_scene::compare::MethodRuns;

    #[test]
    fn completed_runs_are_timed_until_their_two_least_times_are_close() {
        let run = |status, times: &[f64]| RunEntry {
            status,
            cpu_seconds: times.to_vec(),
            ..RunEntry::default()
        };
        let runs = vec![
            run(Status::Completed, &[1.0, 1.01, 3.0]),
            run(Status::Failed, &[]),
            run(Status::Completed, &[1.0, 1.3]),
        ];
        let methods = vec![MethodRuns { runs, ..MethodRuns::default() }];
        let comparison = Comparison { methods, ..Comparison::default() };
        assert_eq!(unsettled(&comparison, true), [(0, 0), (0, 2)]);
        assert_eq!(unsettled(&comparison, false), [(0, 2)]);
    }
}
