//! The loop allocates nothing, for any number of overruns.

use crate::common::{Script, ms};
use mbs_realtime::{Overrun, Pace, Pacer, Recovery};
use mbs_testkit::allocations;

#[test]
fn no_policy_allocates_within_the_loop() {
    // There are more tasks than a sample stores. A third of them is late, more than the log stores.
    const TASKS: usize = 150_000;
    for overrun in [Overrun::Finish, Overrun::Hold, Overrun::Degrade] {
        let durations = (0..TASKS).map(|k| ms(if k % 100 > 66 { 12 } else { 3 })).collect();
        let mut script = Script::new(durations);
        let quiet = Recovery { tasks: 20, ..Recovery::default() };
        let pace = Pace { overrun, quiet, log: 100, ..Pace::every(ms(10)) };
        let mut pacer = Pacer::new(pace, 4).expect("a pace");
        let mut clock = script.clock();
        let before = allocations::count();
        pacer.run(TASKS as u64, &mut clock, &mut script).expect("nothing fails");
        let after = allocations::count();
        assert_eq!(after - before, 0, "{overrun:?}");
        let report = pacer.report();
        assert_eq!((report.tasks, report.log.len()), (TASKS as u64, 100));
        assert!(report.log_left_out > 0, "{overrun:?}");
    }
}
