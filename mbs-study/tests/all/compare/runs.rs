//! End of a refinement of settings.

use mbs_study::compare::results::{RunEntry, Status};
use mbs_study::inside::compare::Refinement;

#[test]
fn two_finer_settings_that_are_no_better_end_the_refinement_once_the_error_is_small() {
    let mut refined = Refinement::default();
    let mut take = |error| {
        let entry =
            RunEntry { status: Status::Completed, error: Some(error), ..RunEntry::default() };
        refined.take(&entry, 1.0);
        refined.no_better
    };
    assert_eq!([0.5, 0.6, 0.7, 0.4].map(&mut take), [0, 0, 0, 0]);
    assert_eq!([1e-3, 2e-3, 1e-4, 3e-4, 2e-4].map(&mut take), [0, 1, 0, 1, 2]);
}

#[test]
fn settings_that_change_no_step_do_not_end_the_refinement() {
    let mut refined = Refinement::default();
    let mut take = |steps, error| {
        let status = Status::Completed;
        let entry = RunEntry { status, steps, error: Some(error), ..RunEntry::default() };
        refined.take(&entry, 1.0);
        refined.no_better
    };
    let held = [(102, 1.4e-6), (102, 1.4e-6), (102, 1.4e-6), (105, 9.7e-8), (105, 9.7e-8)];
    assert_eq!(held.map(|(steps, error)| take(steps, error)), [0; 5]);
    assert_eq!([(200, 2e-7), (400, 3e-7)].map(|(n, e)| take(n, e)), [1, 2]);
}
