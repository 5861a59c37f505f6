//! No step allocates memory after [`Workspace::new`]: a counting allocator counts zero calls, with effects and guides.

use crate::common::{Index, Run};
use mbs_classical::{Options, Stabilisation, Workspace};
use mbs_testkit::scenes::{CHAIN, N_FOUR_BAR, REDUNDANT};
use mbs_testkit::{PLANAR, SPATIAL, allocations, scene};

fn check<const D: usize>(text: &str) {
    let scene = scene(text);
    let baumgarte = Stabilisation::Baumgarte { alpha: 20.0, beta: 20.0 };
    for (index, stabilisation) in [
        (Index::Three, Stabilisation::Projection),
        (Index::One, Stabilisation::Projection),
        (Index::One, Stabilisation::None),
        (Index::One, baumgarte),
    ] {
        let mut run = Run::<f64, D>::new(&scene, index);
        run.options = Options { stabilisation, regularisation: Some(1e-8), ..run.options };
        let before = allocations::count();
        for _ in 0..20 {
            let report = run.step(1e-3);
            assert!(report.is_ok(), "{}: {report:?}", scene.name);
        }
        assert_eq!(allocations::count() - before, 0, "{}, {index:?}", scene.name);
    }
}

#[test]
fn a_step_does_not_allocate_with_every_effect_and_guide() {
    check::<2>(PLANAR);
    check::<3>(SPATIAL);
    check::<3>(&CHAIN);
    check::<2>(&N_FOUR_BAR);
}

#[test]
fn a_refused_step_does_not_allocate() {
    let mut run = Run::<f64, 3>::new(&scene(&REDUNDANT), Index::Three);
    let before = allocations::count();
    assert!(run.step(1e-3).is_err());
    assert_eq!(allocations::count() - before, 0);
    let before = allocations::count();
    drop(Workspace::<f64, _>::new(&run.model, run.w.solver().clone()));
    assert!(allocations::count() > before, "the counter counts");
}
