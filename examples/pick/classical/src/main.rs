//! A double pendulum with mbs-core and mbs-classical alone: index-3 classical Lagrangian on a dense solver.

#[path = "../../double_pendulum.rs"]
mod double_pendulum;

use double_pendulum::{TIP, TRAPEZOIDAL, check, double_pendulum};
use mbs_classical::{Options, Saddle, Workspace, index3};
use mbs_core::dense::Dense;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::BodyId;
use mbs_core::start::assemble;
use mbs_core::step::Step;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = double_pendulum();
    let model = NaturalModel::<f64, 2>::new(&scene)?;
    let mut solver = Dense::new(&model);
    let mut state = assemble(&scene, &model, |p| Dense::new(p), &mut solver)?.state;
    let mut workspace = Workspace::new(&model, Dense::new(&Saddle::new(&model)));

    let (options, step) = (Options::index3(), Step { dt: 1e-3, length: model.length() });
    for _ in 0..1000 {
        index3::step(&model, step, &options, &mut state, &mut workspace)?;
    }

    let tip = model.point(BodyId::Body(1), TIP).value(&state.q);
    check("classical", tip.into(), TRAPEZOIDAL);
    Ok(())
}
