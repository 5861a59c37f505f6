//! A hundred double pendulums in one scene, their steps shared by two threads: mbs-augmented with the teams of mbs-parallel.

#[path = "../../double_pendulum.rs"]
mod double_pendulum;

use double_pendulum::{TIP, TRAPEZOIDAL, check, double_pendulum};
use mbs_augmented::{Options, Workspace, index3};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyId, Scene};
use mbs_core::start::assemble;
use mbs_core::step::Step;
use mbs_core::{Alone, Team};
use mbs_parallel::ThreadTeam;
use mbs_sparse::{Multifrontal, Options as SparseOptions};

const PENDULUMS: usize = 100;

/// Copies of the double pendulum that know nothing of each other.
fn many() -> Scene<f64> {
    let one = double_pendulum();
    let mut scene = Scene { bodies: vec![], joints: vec![], ..one.clone() };
    for k in 0..PENDULUMS {
        let named = |name: &str| format!("{name} {k}").into();
        for body in &one.bodies {
            scene.bodies.push(mbs_core::scene::Body { name: named(&body.name), ..body.clone() });
        }
        for joint in &one.joints {
            let mut joint = joint.clone();
            joint.name = named(&joint.name);
            joint.bodies = joint.bodies.map(|body| match body {
                BodyId::Body(b) => BodyId::Body(2 * k + b),
                ground => ground,
            });
            scene.joints.push(joint);
        }
    }
    scene
}

/// The state after one second of steps shared by a team.
fn run<W: Team + Clone>(
    model: &NaturalModel<f64, 2>,
    start: &State<f64>,
    team: W,
) -> Result<State<f64>, Box<dyn std::error::Error>> {
    let solver = Multifrontal::on(team.clone(), model, SparseOptions::default());
    let mut workspace = Workspace::new(model, solver);
    let mut state = start.clone();
    let (options, step) = (Options::index3(), Step { dt: 1e-3, length: model.length() });
    for _ in 0..1000 {
        index3::step(&model.with_team(&team), step, &options, &mut state, &mut workspace)?;
    }
    Ok(state)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = many();
    let model = NaturalModel::<f64, 2>::new(&scene)?;
    let options = SparseOptions::default();
    let mut solver = Multifrontal::analyse(&model, options);
    let start = assemble(&scene, &model, |p| Multifrontal::analyse(p, options), &mut solver)?.state;

    let alone = run(&model, &start, Alone)?;
    let shared = run(&model, &start, ThreadTeam::new(2)?)?;

    assert!(alone == shared, "threads change no bit");
    let last = BodyId::Body(2 * PENDULUMS - 1);
    let tip = model.point(last, TIP).value(&shared.q);
    check("parallel", tip.into(), TRAPEZOIDAL);
    Ok(())
}
