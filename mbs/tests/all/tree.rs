//! Tree of the main interface: its matrices, efforts and Jacobians against closed forms, differences and natural coordinates.

use crate::common::settings;
use crate::retell::{reorder, turn_by, turn_scene, turned_in_plane};
use mbs::Error as _;
use mbs::core::scene::{BodyId, Dimension, InitialTarget, JointId, JointKind, Scene};
use mbs::typed::Simulation;
use mbs::{Matrix, Tree, TreeError, TreeRange};
use mbs_testkit::random::{self, Random};
use mbs_testkit::{allocations, close, dot, file, plus, scene};
use std::iter;

/// Relative rounding error through trees of some bodies [-].
const ROUNDING: f64 = 1e-10;
/// Step of the central differences [s], whose error is of second order.
const STEP: f64 = 1e-5;
const DIFFERENCES: f64 = 1e-6;
/// Largest violation of the joints after steps.
const FOLLOWED: f64 = 1e-8;

pub(crate) fn tree(scene: &Scene<f64>) -> Tree {
    Tree::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}

fn times(matrix: &Matrix, x: &[f64]) -> Vec<f64> {
    (0..matrix.rows).map(|i| dot(matrix.row(i), x)).collect()
}

/// Returns the scene with the bodies of every joint exchanged.
fn reversed(mut scene: Scene<f64>) -> Scene<f64> {
    scene.joints.iter_mut().for_each(|joint| joint.bodies.reverse());
    scene.name += ", reversed";
    scene
}

/// Scene of a body with a free joint off its centre, and a second body on a joint of it.
pub(crate) fn floating(dimension: Dimension) -> Scene<f64> {
    let mut scene = random::tree(3, dimension, 2);
    scene.bodies[1].center = [0.8, -0.3, 0.0];
    scene.joints[0].kind = JointKind::Free;
    scene.joints[0].axes = [None; 2];
    scene.joints[1].bodies[0] = BodyId::Body(0);
    if dimension == Dimension::Spatial {
        scene.joints[1].kind = JointKind::Spherical;
        scene.joints[1].axes = [None; 2];
    }
    scene.initials.clear();
    scene
}

const BOTH: [Dimension; 2] = [Dimension::Planar, Dimension::Spatial];

fn trees() -> impl Iterator<Item = Scene<f64>> {
    BOTH.into_iter().flat_map(|d| (1..4).map(move |seed| random::tree(seed, d, 8)))
}

/// Trees with all kinds of joints, with their bodies in both orders.
pub(crate) fn mechanisms() -> Vec<Scene<f64>> {
    let mut all: Vec<_> = trees().chain(BOTH.map(floating)).collect();
    // one body has no joint
    all[7].joints.remove(0);
    all.push(floating(Dimension::Spatial));
    all.extend(all.clone().into_iter().map(reversed));
    all
}

/// Tree in a random state; its quaternions need not have unit length.
pub(crate) fn wandering(scene: &Scene<f64>, seed: u64) -> Tree {
    let (mut tree, mut random) = (tree(scene), Random::new(seed));
    let [n_q, n] = [tree.coordinates().len(), tree.velocities().len()];
    let (q, v) = (random.vector(n_q, n_q, 1.0), random.vector(n, n, 2.0));
    tree.set(&q, &v).expect("a state");
    tree
}

/// Coordinates after a step h along the velocities v, q ⊕ h v, by the documented rates of the coordinates.
fn moved(scene: &Scene<f64>, tree: &Tree, v: &[f64], h: f64) -> Vec<f64> {
    let mut q = tree.coordinates().to_vec();
    let spatial = scene.dimension == Dimension::Spatial;
    let joints =
        (0..scene.joints.len()).map(JointId::new).filter_map(|j| tree.coordinates_of(j).ok());
    let free = (0..scene.bodies.len()).filter_map(|b| tree.free_coordinates_of(BodyId::Body(b)));
    let mut ranges: Vec<TreeRange> = joints.chain(free).collect();
    ranges.sort_by_key(|range| range.v.start);
    ranges.dedup();
    for TreeRange { q: at, v: rates, .. } in ranges {
        let linear = if spatial && at.len() != rates.len() { rates.len() - 3 } else { rates.len() };
        for k in 0..linear {
            q[at.start + k] += h * v[rates.start + k];
        }
        if linear < rates.len() {
            // the rate of a quaternion q at the angular velocity ω is q (0, ω) / 2
            let w: [f64; 3] = v[rates.end - 3..rates.end].try_into().expect("three");
            let [a, b, c, d]: [f64; 4] = q[at.end - 4..at.end].try_into().expect("four");
            let rate = [
                -b * w[0] - c * w[1] - d * w[2],
                a * w[0] + c * w[2] - d * w[1],
                a * w[1] + d * w[0] - b * w[2],
                a * w[2] + b * w[1] - c * w[0],
            ];
            q[at.end - 4..at.end].iter_mut().zip(rate).for_each(|(q, rate)| *q += 0.5 * h * rate);
        }
    }
    q
}

/// Central difference of a quantity along the velocities, which change by their rates.
fn difference(
    scene: &Scene<f64>,
    tree: &Tree,
    rates: &[f64],
    f: impl Fn(&mut Tree) -> Vec<f64>,
) -> Vec<f64> {
    let at = |h: f64| {
        let mut there = tree.clone();
        let (v, q) = (tree.velocities(), moved(scene, tree, tree.velocities(), h));
        there.set(&q, &plus(v, h, rates)).expect("a state");
        f(&mut there)
    };
    let (before, after) = (at(-STEP), at(STEP));
    after.iter().zip(before).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
}

fn motion_of(tree: &mut Tree, body: BodyId, at: [f64; 3]) -> [Vec<f64>; 3] {
    let motion = tree.point(body, at);
    [motion.position, motion.velocity, motion.acceleration].map(|x| x.to_vec())
}

#[test]
fn a_double_pendulum_has_the_matrices_of_its_closed_form() {
    let mut tree = tree(&file("double-pendulum"));
    let ([p, q], [v, w]) = ([0.4, -1.1_f64], [1.3, -0.7]);
    tree.set(&[p, q], &[v, w]).expect("a state");
    let across = 1.0 / 3.0 + 0.5 * q.cos();
    let mass = [5.0 / 3.0 + q.cos(), across, across, 1.0 / 3.0];
    close("M", &tree.mass_matrix().data, &mass, ROUNDING);
    let tip = 9.81 * 0.5 * (p + q).cos();
    let gravity = [9.81 * 1.5 * p.cos() + tip, tip];
    close("g", tree.gravity_forces(), &gravity, ROUNDING);
    let h = 0.5 * q.sin();
    let bias = [gravity[0] - h * w * (2.0 * v + w), gravity[1] + h * v * v];
    close("c + g", tree.bias_forces(), &bias, ROUNDING);
}

/// Compares positions, velocities and accelerations of the bodies, and the kinetic energy, with a simulation after some steps.
fn follows<const D: usize>(scene: &Scene<f64>, formulation: &str) {
    let name = format!("{} {formulation}", scene.name);
    let mut sim = Simulation::<f64, D>::new(scene, &settings(scene, formulation, Some(1e-3)))
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut tree = tree(scene);
    for _ in 0..20 {
        tree.follow_typed(&sim).expect("the same mechanism");
        sim.step(1e-3).expect("a step");
    }
    tree.follow_typed(&sim).expect("the same mechanism");
    let v = tree.velocities().to_vec();
    if scene.guides.is_empty() {
        let closed = times(tree.loop_jacobian(), &v);
        close(&name, &closed, &vec![0.0; closed.len()], FOLLOWED);
        let kinetic = 0.5 * dot(&times(tree.mass_matrix(), &v), &v);
        close(&name, &[kinetic], &[sim.energies()[0]], FOLLOWED * kinetic.max(1.0));
    }
    let a = tree.forward_dynamics(&vec![0.0; v.len()]).expect("accelerations").to_vec();
    close(&name, tree.inverse_dynamics(&a).expect("efforts"), &vec![0.0; v.len()], FOLLOWED);
    for b in 0..scene.bodies.len() {
        let (body, motion) = (BodyId::Body(b), sim.model().motion(scene, b, sim.state()));
        let at = motion.origin.into();
        let [position, velocity, bias] = motion_of(&mut tree, body, at);
        close(&name, &position, motion.position.as_slice(), FOLLOWED);
        close(&name, &velocity, motion.velocity.as_slice(), FOLLOWED);
        let acceleration = plus(&bias, 1.0, &times(tree.point_jacobian(body, at), &a));
        close(&name, &acceleration, motion.acceleration.as_slice(), 100.0 * FOLLOWED);
    }
    // forward dynamics with another effort must agree with inverse dynamics
    let effort = Random::new(3).vector(v.len(), v.len(), 1.0);
    let a = tree.forward_dynamics(&effort).expect("accelerations").to_vec();
    let least = tree.inverse_dynamics(&a).expect("efforts").to_vec();
    close(&name, tree.forward_dynamics(&least).expect("accelerations"), &a, 100.0 * FOLLOWED);
}

#[test]
fn a_tree_follows_every_formulation_and_has_its_accelerations() {
    for formulation in ["index-3", "classical", "recursive"] {
        for name in ["double-pendulum", "four-bar", "slider-crank", "guided-four-bar"] {
            follows::<2>(&file(name), formulation);
            follows::<2>(&reversed(file(name)), formulation);
        }
    }
    for seed in 1..4 {
        let tree = random::tree(seed, Dimension::Spatial, 6);
        follows::<3>(&reversed(tree.clone()), "index-3");
        follows::<3>(&random::guided(tree, seed, 2), "index-3");
        let mut looped = random::loops(seed, Dimension::Spatial, 6, 2);
        looped.effects.clear();
        follows::<3>(&looped, "index-3");
    }
    for scene in
        [file("rssr"), floating(Dimension::Spatial), reversed(floating(Dimension::Spatial))]
    {
        follows::<3>(&scene, "index-3");
    }
    for scene in [floating(Dimension::Planar), reversed(floating(Dimension::Planar))] {
        follows::<2>(&scene, "index-1");
    }
}

#[test]
fn points_move_as_their_jacobians_say_and_as_their_coordinates_do() {
    let at = [0.3, -0.4, 0.0];
    for (k, scene) in mechanisms().iter().enumerate() {
        let mut tree = wandering(scene, 5 + k as u64);
        let (v, none) = (tree.velocities().to_vec(), vec![0.0; tree.velocities().len()]);
        for b in (0..scene.bodies.len()).map(BodyId::Body) {
            let name = format!("{} {b:?}", scene.name);
            let [_, velocity, acceleration] = motion_of(&mut tree, b, at);
            let rate = difference(scene, &tree, &none, |t| motion_of(t, b, at)[0].clone());
            close(&name, &velocity, &rate, DIFFERENCES);
            close(&name, &times(tree.point_jacobian(b, at), &v), &velocity, ROUNDING);
            let rate = difference(scene, &tree, &none, |t| motion_of(t, b, at)[1].clone());
            close(&name, &acceleration, &rate, 10.0 * DIFFERENCES);
            // a point p of a body with centre c has the velocity v(p) = v(c) + ω × (p − c)
            let BodyId::Body(i) = b else { unreachable!() };
            let center = scene.bodies[i].center;
            let frame = times(tree.frame_jacobian(b), &v);
            let arm =
                plus(&motion_of(&mut tree, b, at)[0], -1.0, &motion_of(&mut tree, b, center)[0]);
            let carried =
                crate::common::cross([frame[3], frame[4], frame[5]], [arm[0], arm[1], arm[2]]);
            close(&name, &plus(&frame[..3], 1.0, &carried), &velocity, ROUNDING);
        }
        let center = tree.center_of_mass();
        let rate = difference(scene, &tree, &none, |t| t.center_of_mass().position.to_vec());
        close(&scene.name, &center.velocity, &rate, DIFFERENCES);
        close(&scene.name, &times(tree.center_of_mass_jacobian(), &v), &center.velocity, ROUNDING);
        let rate = difference(scene, &tree, &none, |t| t.center_of_mass().velocity.to_vec());
        close(&scene.name, &center.acceleration, &rate, 10.0 * DIFFERENCES);
    }
}

#[test]
fn inverse_dynamics_returns_what_forward_dynamics_took_and_power_is_the_change_of_energy() {
    for (k, scene) in mechanisms().iter().enumerate() {
        let mut tree = wandering(scene, 50 + k as u64);
        let (v, n) = (tree.velocities().to_vec(), tree.velocities().len());
        let effort = Random::new(7).vector(n, n, 5.0);
        let a = tree.forward_dynamics(&effort).expect("accelerations").to_vec();
        let size = ROUNDING * effort.len() as f64 * a.iter().fold(1.0, |s: f64, x| s.max(x.abs()));
        close(&scene.name, tree.inverse_dynamics(&a).expect("efforts"), &effort, size);
        let mass = tree.mass_matrix().clone();
        close(&scene.name, &plus(&times(&mass, &a), 1.0, tree.bias_forces()), &effort, size);
        // d/dt (½ vᵀ M v) = v·(τ − g), where g is the gradient of the potential energy
        let kinetic = |t: &mut Tree| {
            let v = t.velocities().to_vec();
            vec![0.5 * dot(&times(t.mass_matrix(), &v), &v)]
        };
        let power = dot(&v, &effort) - dot(&v, tree.gravity_forces());
        let rate = difference(scene, &tree, &a, kinetic);
        close(&scene.name, &rate, &[power], DIFFERENCES * power.abs().max(1e3));
        let total: f64 = scene.bodies.iter().map(|body| body.mass).sum();
        let height = |t: &mut Tree| vec![9.81 * total * t.center_of_mass().position[1]];
        let rate = difference(scene, &tree, &a, height);
        let of_gravity = dot(&v, tree.gravity_forces());
        close(&scene.name, &rate, &[of_gravity], DIFFERENCES * of_gravity.abs().max(1e2));
    }
}

#[test]
fn coordinates_have_the_sense_of_the_joints_whichever_body_comes_first() {
    for scene in trees() {
        let other = reversed(scene.clone());
        match scene.dimension {
            Dimension::Planar => [scene, other].map(starts::<2>),
            Dimension::Spatial => [scene, other].map(starts::<3>),
        };
    }
}

/// Asserts that the tree of a start has the prescribed values and rates. Rates of ball joints are in global axes.
fn starts<const D: usize>(mut scene: Scene<f64>) {
    let mut given = Vec::new();
    for initial in &mut scene.initials {
        if let InitialTarget::Joint { joint, value, rate: Some(rate) } = &mut initial.target {
            let half: Vec<f64> = rate.iter().map(|x| 0.3 * x).collect();
            given.push((*joint, half.clone(), rate.clone()));
            *value = Some(half);
        }
    }
    let sim = Simulation::<f64, D>::new(&scene, &settings(&scene, "index-3", Some(1e-3)))
        .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let mut tree = tree(&scene);
    tree.follow_typed(&sim).expect("the same mechanism");
    for (joint, mut value, mut rate) in given {
        let (data, at) = (&scene.joints[joint], tree.coordinates_of(joint).expect("in the tree"));
        if data.kind == JointKind::Spherical {
            let half = 0.5 * dot(&value, &value).sqrt();
            value.iter_mut().for_each(|x| *x *= 0.5 * half.sin() / half);
            value.insert(0, half.cos());
            if let Some(b) = data.bodies[1].index() {
                let turned = sim.model().motion(&scene, b, sim.state()).rotation.transpose();
                rate = (turned * mbs::core::algebra::Vector::<f64, 3>::from_fn(|i, _| rate[i]))
                    .as_slice()
                    .to_vec();
            }
        }
        close(&data.name, &tree.coordinates()[at.q], &value, FOLLOWED);
        close(&data.name, &tree.velocities()[at.v], &rate, FOLLOWED);
    }
}

#[test]
fn order_and_direction_of_a_mechanism_change_nothing() {
    for scene in trees() {
        let mut first = wandering(&scene, 9);
        let turned = match scene.dimension {
            Dimension::Planar => turn_by(&scene, turned_in_plane),
            Dimension::Spatial => turn_scene(&scene),
        };
        // axes of ball joints rotate with the mechanism, so their components change
        let has_balls = scene.joints.iter().any(|j| j.kind == JointKind::Spherical);
        for other in iter::once(reorder(&scene)).chain((!has_balls).then_some(turned)) {
            let mut second = tree(&other);
            second.set(first.coordinates(), first.velocities()).expect("a state");
            close(&scene.name, &first.mass_matrix().data, &second.mass_matrix().data, ROUNDING);
            close(&scene.name, first.bias_forces(), second.bias_forces(), 10.0 * ROUNDING);
        }
    }
}

#[test]
fn what_has_no_coordinates_is_refused_by_name() {
    let named = |scene: &Scene<f64>, name: &str| {
        JointId::new(scene.joints.iter().position(|joint| joint.name == name).expect("a joint"))
    };
    let bar = file("four-bar");
    let cut = tree(&bar).coordinates_of(named(&bar, "end-0")).expect_err("cut");
    assert_eq!((cut.code(), cut.joint()), ("cut-joint", Some("end-0")));
    let guided = file("guided-four-bar");
    let joint = guided.guides[0].joint;
    let error = tree(&guided).coordinates_of(joint).expect_err("guided");
    assert_eq!((error.code(), error.joint()), ("guided-joint", Some(&*guided.joints[joint].name)));
    let zoo = scene(mbs_testkit::SPATIAL);
    let error = tree(&zoo).coordinates_of(named(&zoo, "floating")).expect_err("free");
    assert_eq!(error.code(), "no-coordinates");

    let mut massless = file("double-pendulum");
    massless.bodies[1].mass = 0.0;
    let error = self::tree(&massless).accelerations().map(<[f64]>::to_vec).expect_err("no mass");
    assert_eq!((error.code(), error.body()), ("no-inertia", Some("lower")));

    let mut tree = tree(&random::aligned_tree(1, 1));
    let [n_q, n] = [tree.coordinates().len(), tree.velocities().len()];
    let code = |error: TreeError| error.code();
    assert_eq!(tree.set(&vec![0.0; n_q + 1], &vec![0.0; n]).map_err(code), Err("wrong-length"));
    assert_eq!(tree.forward_dynamics(&vec![f64::NAN; n]).map_err(code), Err("not-finite"));
    let mut ball = self::tree(&floating(Dimension::Spatial));
    let [n_q, n] = [ball.coordinates().len(), ball.velocities().len()];
    assert_eq!(ball.set(&vec![0.0; n_q], &vec![0.0; n]).map_err(code), Err("no-rotation"));
}

#[test]
fn nothing_allocates_after_the_first_calls_and_a_tree_can_be_sent_and_cloned() {
    fn sent<X: Send + Sync + Clone>(_: &X) {}
    for scene in [random::tree(2, Dimension::Spatial, 6), file("four-bar"), file("rssr")] {
        let mut tree = wandering(&scene, 1);
        sent(&tree);
        let (q, v) = (tree.coordinates().to_vec(), tree.velocities().to_vec());
        let mut all = || {
            tree.set(&q, &v).expect("a state");
            let _ = (tree.mass_matrix().rows, tree.loop_jacobian().rows);
            let _ = (tree.gravity_forces().len(), tree.bias_forces().len());
            let _ = (tree.forward_dynamics(&v).is_ok(), tree.inverse_dynamics(&v).is_ok());
            let body = BodyId::Body(0);
            let _ = (tree.point_jacobian(body, [0.1; 3]).rows, tree.frame_jacobian(body).rows);
            let _ = (tree.center_of_mass_jacobian().rows, tree.center_of_mass());
            let _ = tree.jacobian_rate_at(body, [0.1; 3]).rows;
            if tree.loop_jacobian().rows == 0 {
                let is_open = tree.inverse_dynamics_derivatives(&v).is_ok()
                    && tree.forward_dynamics_derivatives(&v).is_ok();
                assert!(is_open && tree.mobility_at(body, [0.1; 3]).is_ok(), "{}", scene.name);
            }
        };
        all();
        let before = allocations::count();
        all();
        assert_eq!(allocations::count() - before, 0, "{}", scene.name);
    }
}
