//! Starts with undetermined motions: rods whose rotation about their line is unknown, and angles whose number of turns is unknown.

use mbs_core::Cliques;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyId, Scene};
use mbs_core::start::{Assembled, AssemblyError, assemble};
use mbs_sparse::{Multifrontal, Options};
use mbs_testkit::{close, scene};

/// Largest error of rates and accelerations of order one.
const HELD: f64 = 1e-10;

fn start<const D: usize>(
    scene: &Scene<f64>,
) -> Result<(NaturalModel<f64, D>, Assembled<f64>), AssemblyError> {
    let analyse = Options::default();
    let model = NaturalModel::<f64, D>::new(scene)?;
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver)?;
    Ok((model, start))
}

#[test]
fn a_free_rod_stays_two_points_and_its_angular_velocity_swings_them() {
    let scene = scene(
        "[scene]\nname = \"rod\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -9.81]\n[[body]]\nname = \"x\"\nmass = 2.0\nrod = { from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0] }\n[[joint]]\nname = \"j\"\nkind = \"free\"\nbodies = [\"ground\", \"x\"]\nat = [0.0, 0.3, 0.0]\n[[initial]]\nbody = \"x\"\nangular_velocity = [0.5, 0.2, -0.3]\n",
    );
    let (model, Assembled { state: s, .. }) = start::<3>(&scene).unwrap();
    assert_eq!(model.n_unknowns(), 6);
    // w x r about the centre, which the least velocities leave at rest; the rotation about the line is undetermined
    let rate =
        |v: &[f64], x| -> [f64; 3] { model.point(BodyId::Body(0), [x, 0.0, 0.0]).rate(v).into() };
    close("one end", &rate(&s.v, 1.0), &[0.0, -0.15, -0.1], HELD);
    close("the other", &rate(&s.v, 0.0), &[0.0, 0.15, 0.1], HELD);
    close("the fall", &rate(&s.a, 0.5), &[0.0, 0.0, -9.81], HELD);
}

#[test]
fn an_angle_that_is_not_held_starts_within_half_a_turn() {
    let scene = scene(
        "[scene]\nname = \"flip\"\ndimension = 2\nduration = 1.0\n[[body]]\nname = \"arm\"\nmass = 43.6\ncenter = [-17.1, 0.176]\ninertia = 8100.0\n[[body]]\nname = \"x\"\nmass = 11.2\ncenter = [-17.24, -30.0]\ninertia = 126.0\n[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"arm\", \"ground\"]\nat = [0.265, 17.22]\n[[joint]]\nname = \"b\"\nkind = \"revolute\"\nbodies = [\"arm\", \"x\"]\nat = [-35.05, -9.81]\n[[initial]]\njoint = \"a\"\nvalue = -1.107\n[[effect]]\nname = \"spring\"\nkind = \"torsion-spring\"\njoint = \"b\"\nstiffness = 3.2\n",
    );
    let (model, Assembled { state: s, .. }) = start::<2>(&scene).unwrap();
    let angle = s.memory[model.memory_of_effect(0).unwrap()];
    // during the assembly the angle passes half a turn in the other sense, when the arm's end passes the place of x
    assert!((angle - 3.03).abs() < 0.02, "{angle}");
}
