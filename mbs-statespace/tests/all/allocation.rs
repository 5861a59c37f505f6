//! No step allocates memory after [`Workspace::new`]: a counting allocator counts zero calls, with effects and guides, and with new choices
//! of independent columns.

use crate::common::Bench;
use mbs_statespace::PivotChange;
use mbs_testkit::scenes::{CHAIN, DOUBLE, N_FOUR_BAR};
use mbs_testkit::{PLANAR, SPATIAL, allocations};

fn check<const D: usize>(text: &str, steps: u32) {
    for pivot_change in [PivotChange::WhenNeeded, PivotChange::EveryStep] {
        let mut bench = Bench::<f64, D>::new(text);
        bench.options.pivot_change = pivot_change;
        let before = allocations::count();
        for _ in 0..steps {
            let report = bench.try_step(1e-3);
            assert!(report.is_ok(), "{}: {report:?}", bench.scene.name);
        }
        let count = allocations::count() - before;
        assert_eq!(count, 0, "{} {pivot_change:?}", bench.scene.name);
    }
}

#[test]
fn a_step_does_not_allocate_even_when_it_chooses_anew() {
    check::<2>(PLANAR, 300);
    check::<3>(SPATIAL, 300);
    check::<3>(&CHAIN, 300);
    check::<2>(&N_FOUR_BAR, 1000);
    check::<2>(&DOUBLE, 3000);
}
