//! Debugging.
mod support;
use mbs_recursive::{Planar, rk54_step, TreeModel, TreeState, Workspace, Options};
use support::{Run, file};
#[test]
fn dbg() {
    let mut run = Run::<Planar>::new::<2>(&file("four-bar"));
    run.options.error = 1e-10;
    for i in 0..10 {
        if let Err(e) = rk54_step(&run.model, 1.0, &run.options, &mut run.state, &mut run.workspace) { println!("{i} {e:?}"); break; }
    }
    let scene = file("andrews");
    let model = TreeModel::<f64, Planar>::new(&scene).unwrap();
    let (nat, st) = support::natural::<2>(&scene);
    println!("{:?}", model.cut_joints().map(|j| scene.joints[j].name.clone()).collect::<Vec<_>>());
    let mut w = Workspace::new(&model);
    let mut s = TreeState::at_rest(&model);
    s.t = 0.0;
    println!("{:?} {:?}", st.v, st.a);
    println!("{:?}", model.accelerate(&Options::default(), &mut s, &mut w));
    println!("{:?}", s);
    let mut store = w.store();
    println!("{:?}", store.a);
    println!("{:?}", store.loops.pivots);
    println!("{:?}", store.rows);
    println!("{:?}", model.start(&scene, &nat, &st));
}
