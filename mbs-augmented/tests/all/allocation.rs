//! No step allocates memory after [`Workspace::new`]: a counting allocator counts zero calls, with effects and guides.

use mbs_augmented::{Options, Workspace, index1, index3};
use mbs_core::step::Step;
use mbs_testkit::{PLANAR, SPATIAL, allocations, scene, solver, start};

fn check<const D: usize>(text: &str) {
    let scene = scene(text);
    let (model, start) = start::<D>(&scene);
    let mut w = Workspace::new(&model, solver(&model));
    for is_index1 in [false, true] {
        let mut state = start.clone();
        let step = if is_index1 { index1::step } else { index3::step };
        let options = if is_index1 { Options::index1() } else { Options::index3() };
        let before = allocations::count();
        for _ in 0..20 {
            let report = step(
                &model,
                Step { dt: 1e-3, length: model.length() },
                &options,
                &mut state,
                &mut w,
            );
            assert!(report.is_ok(), "{}: {report:?}", scene.name);
        }
        assert_eq!(allocations::count() - before, 0, "{}", scene.name);
    }
}

#[test]
fn a_step_does_not_allocate_with_every_effect_and_guide() {
    check::<2>(PLANAR);
    check::<3>(SPATIAL);
}
