//! After [`Workspace::new`] nothing allocates: a counting allocator sees zero calls in a step, with effects and guides, and
//! when independent columns are chosen anew.

#![allow(
    unsafe_code,
    reason = "an allocator cannot be written without; it only counts and forwards"
)]

mod common;

use common::Bench;
use mbs_statespace::Rechoice;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: every call is forwarded unchanged to the system's allocator; the counter has no destructor.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promise about `layout` is passed on.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: `pointer` came from `System` with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn check<const D: usize>(text: &str, steps: u32) {
    for rechoice in [Rechoice::WhenNeeded, Rechoice::EveryStep] {
        let mut bench = Bench::<f64, D>::new(text);
        bench.options.rechoice = rechoice;
        let before = ALLOCATIONS.with(Cell::get);
        for _ in 0..steps {
            let report = bench.try_step(1e-3);
            assert!(report.is_ok(), "{}: {report:?}", bench.scene.name);
        }
        let count = ALLOCATIONS.with(Cell::get) - before;
        assert_eq!(count, 0, "{} {rechoice:?}", bench.scene.name);
    }
}

#[test]
fn a_step_does_not_allocate_even_when_it_chooses_anew() {
    check::<2>(include_str!("../../mbs-core/tests/common/planar-zoo.toml"), 300);
    check::<3>(include_str!("../../mbs-core/tests/common/spatial-zoo.toml"), 300);
    check::<3>(include_str!("../../scenes/spatial-chain-20.toml"), 300);
    check::<2>(include_str!("../../scenes/n-four-bar-10.toml"), 1000);
    check::<2>(include_str!("../../scenes/double-pendulum.toml"), 3000);
}
