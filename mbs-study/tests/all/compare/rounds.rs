//! Which runs are timed again.

use mbs_study::compare::results::MethodRuns;
use mbs_study::compare::results::{Comparison, RunEntry, Status};
use mbs_study::inside::compare::{completed, unsettled};

#[test]
fn decisive_runs_are_timed_until_their_three_least_times_are_close() {
    let run = |status, error, times: &[f64]| RunEntry {
        status,
        error: Some(error),
        cpu_seconds: times.to_vec(),
        ..RunEntry::default()
    };
    let runs = vec![
        run(Status::Completed, 1e-1, &[1.0, 3.0, 1.004, 1.002]),
        run(Status::Failed, 1.0, &[]),
        run(Status::Completed, 1e-3, &[1.0, 1.001, 1.3]),
        run(Status::Completed, 1e-5, &[1.0, 1.001]),
    ];
    let methods = vec![MethodRuns { runs, ..MethodRuns::default() }];
    let comparison = Comparison { methods, ..Comparison::default() };
    assert_eq!(completed(&comparison), [(0, 0), (0, 2), (0, 3)]);
    assert_eq!(unsettled(&comparison, &[1e-2]), [(0, 2)]);
}
