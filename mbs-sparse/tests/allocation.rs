//! After the analysis nothing allocates: a counting allocator sees zero calls in factor, solve and assemble.

#![allow(
    unsafe_code,
    reason = "an allocator cannot be written without; it only counts and forwards"
)]

mod common;

use common::Sum;
use mbs_sparse::{Multifrontal, Options, Pivoting, SpdSolver};
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

fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.with(Cell::get);
    work();
    ALLOCATIONS.with(Cell::get) - before
}

#[test]
fn factor_solve_and_assemble_do_not_allocate() {
    assert_eq!(allocations(|| drop(std::hint::black_box(Box::new(1)))), 1);
    for sum in [Sum::chain(1, 4, 2), Sum::chain(30, 12, 6), Sum::star(6, 5)] {
        for pivoting in [Pivoting::None, Pivoting::Diagonal] {
            let options = Options { pivoting, ..Options::default() };
            let mut solver = Multifrontal::<f64>::analyse(&sum, options);
            let (mut x, mut scratch) = (vec![0.0; sum.n], vec![0.0; solver.n_scratch()]);
            let count = allocations(|| {
                solver.assemble(&sum, &mut x);
                solver.factor(&sum).unwrap();
                solver.solve(&mut x, &mut scratch);
                assert!(!solver.pivots().is_empty() && !solver.elimination_order().is_empty());
            });
            assert_eq!(count, 0);
        }
    }
}
