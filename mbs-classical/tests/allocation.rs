//! After [`Workspace::new`] nothing allocates: a counting allocator sees zero calls in a step, with effects and guides.

#![allow(
    unsafe_code,
    reason = "an allocator cannot be written without; it only counts and forwards"
)]

mod common;

use common::{Index, Run};
use mbs_classical::{Options, Stabilisation, Workspace};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

#[path = "../../mbs-core/tests/common/mod.rs"]
mod zoo;

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

fn check<const D: usize>(text: &str) {
    let scene = common::scene::<f64>(text);
    let baumgarte = Stabilisation::Baumgarte { alpha: 20.0, beta: 20.0 };
    for (index, stabilisation) in [
        (Index::Three, Stabilisation::Projection),
        (Index::One, Stabilisation::Projection),
        (Index::One, Stabilisation::None),
        (Index::One, baumgarte),
    ] {
        let mut run = Run::<f64, D>::new(&scene, index);
        run.options = Options { stabilisation, regularisation: Some(1e-8), ..run.options };
        let before = ALLOCATIONS.with(Cell::get);
        for _ in 0..20 {
            let report = run.step(1e-3);
            assert!(report.is_ok(), "{}: {report:?}", scene.name);
        }
        assert_eq!(ALLOCATIONS.with(Cell::get) - before, 0, "{}, {index:?}", scene.name);
    }
}

#[test]
fn a_step_does_not_allocate_with_every_effect_and_guide() {
    check::<2>(zoo::PLANAR);
    check::<3>(zoo::SPATIAL);
    check::<3>(common::CHAIN);
    check::<2>(common::N_FOUR_BAR);
}

#[test]
fn a_refused_step_does_not_allocate() {
    let mut run = Run::<f64, 3>::new(&common::scene(common::REDUNDANT), Index::Three);
    let before = ALLOCATIONS.with(Cell::get);
    assert!(run.step(1e-3).is_err());
    assert_eq!(ALLOCATIONS.with(Cell::get) - before, 0);
    let before = ALLOCATIONS.with(Cell::get);
    drop(Workspace::<f64, _>::new(&run.model, run.w.solver().clone()));
    assert!(ALLOCATIONS.with(Cell::get) > before, "the counter counts");
}
