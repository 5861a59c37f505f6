//! After [`Workspace::new`] nothing allocates: a counting allocator sees zero calls in a step, with effects and guides.

use mbs_augmented::{Options, Workspace, index1, index3};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::start::assemble;
use mbs_scene::Document;
use mbs_sparse::Multifrontal;

#[path = "../../mbs-core/tests/common/allocations.rs"]
mod allocations;
#[path = "../../mbs-core/tests/common/mod.rs"]
mod common;

fn check<const D: usize>(text: &str) {
    let document = Document::parse(text, "test.toml").expect("the text is a document");
    let scene: Scene<f64> = document.scene().expect("the document is a scene");
    let model = NaturalModel::<f64, D>::new(&scene).expect("the scene has a model");
    let mut solver = Multifrontal::analyse(&model, mbs_sparse::Options::default());
    let start = assemble(
        &scene,
        &model,
        |p| Multifrontal::analyse(p, mbs_sparse::Options::default()),
        &mut solver,
    )
    .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let mut w = Workspace::new(&model, solver);
    for is_index1 in [false, true] {
        let mut state = start.state.clone();
        let step = if is_index1 { index1::step } else { index3::step };
        let options = if is_index1 { Options::index1() } else { Options::index3() };
        let before = allocations::count();
        for _ in 0..20 {
            let report = step(&model, (1e-3, model.length()), &options, &mut state, &mut w);
            assert!(report.is_ok(), "{}: {report:?}", scene.name);
        }
        assert_eq!(allocations::count() - before, 0, "{}", scene.name);
    }
}

#[test]
fn a_step_does_not_allocate_with_every_effect_and_guide() {
    check::<2>(common::PLANAR);
    check::<3>(common::SPATIAL);
}
