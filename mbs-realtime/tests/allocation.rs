//! The loop allocates nothing, however many overruns there are.
#![allow(
    unsafe_code,
    reason = "an allocator cannot be written without; it only counts and passes on"
)]

mod common;

use common::{Script, ms};
use mbs_realtime::{Overrun, Pace, Pacer, Quiet};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

struct Counting;

fn bump() {
    // While a thread ends its counter is gone; nobody reads it then.
    let _ = COUNT.try_with(|c| c.set(c.get() + 1));
}

// SAFETY: every call is passed on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        bump();
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        bump();
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn no_policy_allocates_within_the_loop() {
    // More tasks than the samples keep, a third of them late, more than the log keeps.
    const TASKS: usize = 150_000;
    for overrun in [Overrun::Finish, Overrun::Hold, Overrun::Degrade] {
        let durations = (0..TASKS).map(|k| ms(if k % 100 > 66 { 12 } else { 3 })).collect();
        let mut script = Script::new(durations);
        let quiet = Quiet { tasks: 20, ..Quiet::default() };
        let pace = Pace { overrun, quiet, log: 100, ..Pace::every(ms(10)) };
        let mut pacer = Pacer::new(pace, 4).expect("a pace");
        let mut clock = script.clock();
        let before = COUNT.with(Cell::get);
        pacer.run(TASKS as u64, &mut clock, &mut script).expect("nothing fails");
        let after = COUNT.with(Cell::get);
        assert_eq!(after - before, 0, "{overrun:?}");
        let report = pacer.report();
        assert_eq!((report.tasks, report.log.len()), (TASKS as u64, 100));
        assert!(report.log_left_out > 0, "{overrun:?}");
    }
}
