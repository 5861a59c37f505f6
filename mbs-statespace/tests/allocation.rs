//! After [`Workspace::new`] nothing allocates: a counting allocator sees zero calls in a step, with effects and guides, and
//! when independent columns are chosen anew.

#[path = "../../mbs-core/tests/common/allocations.rs"]
mod allocations;
mod common;

use common::Bench;
use mbs_statespace::Rechoice;

fn check<const D: usize>(text: &str, steps: u32) {
    for rechoice in [Rechoice::WhenNeeded, Rechoice::EveryStep] {
        let mut bench = Bench::<f64, D>::new(text);
        bench.options.rechoice = rechoice;
        let before = allocations::count();
        for _ in 0..steps {
            let report = bench.try_step(1e-3);
            assert!(report.is_ok(), "{}: {report:?}", bench.scene.name);
        }
        let count = allocations::count() - before;
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
