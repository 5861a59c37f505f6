//! Every policy on a scripted clock. The durations of tasks are given, and the tests check the times. No real time passes.

use crate::common::{Script, at, ms, us};
use mbs_realtime::{Action, Overrun, Pace, PaceError, Pacer, Recovery};
use std::time::Duration;

fn pace(overrun: Overrun) -> Pace {
    let quiet = Recovery { tasks: 4, percent: 70, patience: 3 };
    Pace { overrun, quiet, ..Pace::every(ms(10)) }
}

/// Runs a script of durations in milliseconds.
fn run(pace: Pace, levels: usize, durations: &[u64]) -> (Script, Pacer) {
    let mut script = Script::new(durations.iter().map(|&d| ms(d)).collect());
    let mut pacer = Pacer::new(pace, levels).expect("a pace");
    let mut clock = script.clock();
    pacer.run(durations.len() as u64, &mut clock, &mut script).expect("nothing fails");
    (script, pacer)
}

#[test]
fn tasks_in_time_begin_and_publish_at_the_boundaries() {
    for overrun in [Overrun::Finish, Overrun::Hold, Overrun::Degrade] {
        let (script, pacer) = run(pace(overrun), 3, &[3, 9, 1]);
        assert_eq!(script.begins, at(&[0, 10, 20]));
        assert_eq!(script.published, [(0, ms(10)), (1, ms(20)), (2, ms(30))]);
        let report = pacer.report();
        assert!(report.held() && report.log.is_empty());
        assert_eq!((report.skipped, report.behind), (0, Duration::ZERO));
        assert_eq!((report.tasks, report.at_level), (3, vec![3, 0, 0]));
        assert_eq!((report.duration.p50, report.duration.max), (ms(3), ms(9)));
        assert!((report.margin.least - 1e-3).abs() < 1e-12, "10 - 9 ms");
        assert_eq!((report.busy, report.elapsed), (ms(13), ms(21)));
        assert!((report.real_time_factor - 30.0 / 13.0).abs() < 1e-12);
    }
}

#[test]
fn a_task_that_ends_exactly_at_its_deadline_is_in_time() {
    for overrun in [Overrun::Finish, Overrun::Hold, Overrun::Degrade] {
        let (script, pacer) = run(pace(overrun), 2, &[10, 10, 10]);
        assert_eq!(script.begins, at(&[0, 10, 20]));
        assert_eq!(script.published, [(0, ms(10)), (1, ms(20)), (2, ms(30))]);
        let report = pacer.report();
        assert!(report.held() && report.margin.least.abs() < 1e-15);
        // A task that is longer by one nanosecond is late.
        let mut script = Script::new(vec![ms(10) + Duration::from_nanos(1)]);
        let mut pacer = Pacer::new(pace(overrun), 2).expect("a pace");
        let mut clock = script.clock();
        pacer.run(1, &mut clock, &mut script).expect("nothing fails");
        assert_eq!(pacer.report().overruns, 1);
    }
}

#[test]
fn finish_publishes_late_results_at_once_and_catches_the_debt_up() {
    let (script, pacer) = run(pace(Overrun::Finish), 1, &[24, 8, 8, 2, 2]);
    // The delays are 14, 12, 10 and 2 ms for the first four tasks; the fifth begins at 42 ms and is in time.
    assert_eq!(script.begins, at(&[0, 24, 32, 40, 42]));
    let published = [(0, ms(24)), (1, ms(32)), (2, ms(40)), (3, ms(42)), (4, ms(50))];
    assert_eq!(script.published, published);
    let report = pacer.report();
    assert_eq!((report.overruns, report.latest, report.behind), (4, ms(14), Duration::ZERO));
    assert_eq!(
        report.log.iter().map(|e| e.late).collect::<Vec<_>>(),
        [ms(14), ms(12), ms(10), ms(2)]
    );
    assert!(report.log.iter().all(|e| e.action == Action::Finished && e.level == 0));
    assert_eq!(report.log[1].at, ms(32));
    // Previous tasks delayed all begins except the first. The jitter does not include such delays.
    assert_eq!(report.jitter.max, Duration::ZERO);
    assert!((report.margin.least + 14e-3).abs() < 1e-12);
}

#[test]
fn hold_publishes_late_results_at_the_next_boundary_and_puts_the_schedule_off() {
    let (script, pacer) = run(pace(Overrun::Hold), 1, &[4, 24, 3, 20]);
    // The second task is due at 20 ms, ends at 34 and is held until 40. The fourth is due at 60 and ends at 70, the end of a period.
    assert_eq!(script.begins, at(&[0, 10, 40, 50]));
    assert_eq!(script.published, [(0, ms(10)), (1, ms(40)), (2, ms(50)), (3, ms(70))]);
    let report = pacer.report();
    assert_eq!((report.overruns, report.skipped, report.behind), (2, 3, ms(30)));
    let actions: Vec<_> = report.log.iter().map(|e| e.action).collect();
    assert_eq!(actions, [Action::Held { periods: 2 }, Action::Held { periods: 1 }]);
}

#[test]
fn many_overruns_in_a_row_lose_time_in_hold_and_pile_up_in_finish() {
    let late = [15; 8];
    let (script, pacer) = run(pace(Overrun::Hold), 1, &late);
    assert_eq!(script.begins, at(&[0, 20, 40, 60, 80, 100, 120, 140]));
    assert_eq!((pacer.report().overruns, pacer.report().behind), (8, ms(80)));
    let (script, pacer) = run(pace(Overrun::Finish), 1, &late);
    assert_eq!(script.begins, at(&[0, 15, 30, 45, 60, 75, 90, 105]));
    assert_eq!((pacer.report().latest, pacer.report().behind), (ms(40), ms(40)));
}

#[test]
fn degrade_goes_down_to_the_last_level_and_stays_there_while_it_is_late() {
    let (script, pacer) = run(pace(Overrun::Degrade), 3, &[12, 12, 12, 12, 2, 2]);
    assert_eq!(script.levels, [0, 1, 2, 2, 2, 2]);
    let report = pacer.report();
    let actions: Vec<_> = report.log.iter().map(|e| e.action).collect();
    let down = |to| Action::Down { to };
    assert_eq!(actions, [down(1), down(2), Action::Finished, Action::Finished]);
    assert_eq!(report.at_level, [1, 1, 4]);
}

#[test]
fn degrade_comes_back_up_a_level_at_a_time_after_quiet_times() {
    let mut durations = vec![12, 12];
    durations.extend([2; 12]);
    let (script, pacer) = run(pace(Overrun::Degrade), 3, &durations);
    // Two late tasks go two levels down. The next one ends at 26 ms of 30, in time. Four quiet tasks are needed for each level up.
    assert_eq!(script.levels, [0, 1, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0]);
    let ups: Vec<_> = pacer
        .report()
        .log
        .iter()
        .filter(|e| e.late.is_zero())
        .map(|e| (e.task, e.action))
        .collect();
    assert_eq!(ups, [(5, Action::Up { to: 1 }), (9, Action::Up { to: 0 })]);
}

#[test]
fn tasks_that_are_in_time_but_heavy_do_not_bring_a_level_back() {
    // 8 of 10 ms are more than 70 percent; 7 of 10 ms are not.
    let (script, _) = run(pace(Overrun::Degrade), 2, &[12, 8, 8, 8, 8, 8, 8, 8]);
    assert_eq!(script.levels, [0, 1, 1, 1, 1, 1, 1, 1]);
    let (script, _) = run(pace(Overrun::Degrade), 2, &[12, 7, 7, 7, 7, 7]);
    assert_eq!(script.levels, [0, 1, 1, 1, 1, 0]);
    // A heavy task restarts the quiet time.
    let (script, _) = run(pace(Overrun::Degrade), 2, &[12, 7, 7, 7, 8, 7, 7, 7, 7, 7]);
    assert_eq!(script.levels, [0, 1, 1, 1, 1, 1, 1, 1, 1, 0]);
}

#[test]
fn a_debt_alone_does_not_degrade_until_patience_ends() {
    // A task of 41 ms causes a delay of 31 ms. The tasks after it are late but short. The patience is three tasks.
    let (script, _) = run(pace(Overrun::Degrade), 4, &[41, 2, 2, 2, 2, 2]);
    assert_eq!(script.levels, [0, 1, 1, 1, 1, 1]);
    // Tasks of a whole period each do not reduce the delay: the level goes down after the fourth.
    let (script, _) = run(pace(Overrun::Degrade), 4, &[41, 10, 10, 10, 10, 10]);
    assert_eq!(script.levels, [0, 1, 1, 1, 1, 2]);
}

#[test]
fn a_rise_that_does_not_last_doubles_the_quiet_time() {
    let up = 4;
    let mut durations = vec![12];
    durations.extend(vec![2; up]); // tasks 1 to 4 on level 1, then up
    durations.push(12); // task 5 on level 0 is late at once
    durations.extend(vec![2; 2 * up]); // now eight quiet tasks are needed
    durations.extend(vec![2; 2 * up]); // the rise lasts as long as the quiet time
    durations.push(12);
    durations.extend(vec![2; up + 1]); // four quiet tasks are enough again
    let (script, _) = run(pace(Overrun::Degrade), 2, &durations);
    let mut expected = vec![0];
    expected.extend([1; 4]);
    expected.push(0);
    expected.extend([1; 8]);
    expected.extend([0; 8]);
    expected.push(0);
    expected.extend([1; 4]);
    expected.push(0);
    assert_eq!(script.levels, expected);
}

#[test]
fn a_task_that_fails_ends_the_loop_and_keeps_what_was_measured() {
    for overrun in [Overrun::Finish, Overrun::Hold, Overrun::Degrade] {
        let mut script = Script::new(vec![ms(3); 10]);
        script.fails_at = Some(4);
        let mut pacer = Pacer::new(pace(overrun), 2).expect("a pace");
        let mut clock = script.clock();
        assert_eq!(pacer.run(10, &mut clock, &mut script), Err("broken"));
        // All four results before the failure are published, each at the end of its period.
        assert_eq!(script.published.len(), 4);
        assert_eq!(script.published[3], (3, ms(40)));
        assert_eq!(pacer.report().tasks, 4);
    }
}

#[test]
fn a_task_may_end_the_loop() {
    let mut script = Script::new(vec![ms(3); 10]);
    script.stops_at = Some(2);
    let mut pacer = Pacer::new(pace(Overrun::Finish), 1).expect("a pace");
    let mut clock = script.clock();
    pacer.run(u64::MAX, &mut clock, &mut script).expect("nothing fails");
    assert_eq!(script.published, [(0, ms(10)), (1, ms(20)), (2, ms(30))]);
}

#[test]
fn a_loop_that_is_run_again_adds_up() {
    let mut script = Script::new(vec![ms(12); 6]);
    let mut pacer = Pacer::new(pace(Overrun::Degrade), 3).expect("a pace");
    let mut clock = script.clock();
    pacer.run(2, &mut clock, &mut script).expect("nothing fails");
    pacer.run(1, &mut clock, &mut script).expect("nothing fails");
    assert_eq!(script.levels, [0, 1, 2]);
    assert_eq!((pacer.report().tasks, pacer.report().overruns), (3, 3));
}

#[test]
fn sleepers_that_wake_late_are_jitter_unless_the_loop_is_awake_before() {
    let jitter = |awake| {
        let mut script = Script::new(vec![ms(2); 50]);
        let mut pacer = Pacer::new(Pace { awake, ..pace(Overrun::Finish) }, 1).expect("a pace");
        let mut clock = script.clock();
        clock.oversleeps = us(60);
        pacer.run(50, &mut clock, &mut script).expect("nothing fails");
        pacer.report().jitter
    };
    assert_eq!((jitter(us(0)).p50, jitter(us(0)).max), (us(60), us(60)));
    // With an active wait of 100 us before a begin, the clock advances by 1 us at a time.
    assert_eq!(jitter(us(100)).max, us(0));
    assert_eq!(jitter(us(40)).max, us(20));
}

#[test]
fn the_log_is_bounded_and_counts_what_it_leaves_out() {
    let pace = Pace { log: 5, ..pace(Overrun::Hold) };
    let (_, pacer) = run(pace, 1, &[15; 12]);
    let report = pacer.report();
    assert_eq!((report.log.len(), report.log_left_out, report.overruns), (5, 7, 12));
}

#[test]
fn a_pace_that_is_none_is_refused() {
    let refused = |pace, levels| Pacer::new(pace, levels).err();
    let good = pace(Overrun::Degrade);
    assert_eq!(refused(Pace { period: Duration::ZERO, ..good }, 1), Some(PaceError::NoPeriod));
    assert_eq!(refused(good, 0), Some(PaceError::NoLevel));
    for (tasks, percent) in [(0, 70), (4, 0), (4, 101)] {
        let quiet = Recovery { tasks, percent, patience: 0 };
        assert_eq!(refused(Pace { quiet, ..good }, 1), Some(PaceError::NoQuiet));
    }
    assert_eq!(refused(good, 1), None);
}

#[test]
fn the_least_period_does_not_overflow() {
    let pace = Pace { period: Duration::from_nanos(1), ..pace(Overrun::Hold) };
    let (_, pacer) = run(pace, 1, &[15; 3]);
    assert_eq!(pacer.report().skipped, 3 * (ms(15).as_nanos() as u64 - 1));
}
