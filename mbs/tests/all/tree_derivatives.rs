//! Derivatives of a tree's dynamics and Jacobians against differences, steps on its positions, and the inertia of a frame.

use crate::gravity_scale::lightened;
use crate::tree::{floating, mechanisms, tree, wandering};
use mbs::core::scene::{BodyId, Dimension};
use mbs::{Error as _, FrameTarget, InverseKinematicsEnd, Matrix, Tree};
use mbs_testkit::random::{self, Random};
use mbs_testkit::{close, dot, file};

/// Step of the differences of order eight. Relative to the step, truncation and the rounding of the quantities are both below 1e-13.
const STEP: f64 = 1e-2;
/// Largest difference, relative to the largest derivative [-]. Accelerations of a light body at the end of a chain lose three digits.
const DIFFERENCES: f64 = 1e-9;
/// Relative rounding error through trees of some bodies [-].
const ROUNDING: f64 = 1e-11;

/// Quantity that is read from a tree.
type Quantity<'a> = &'a dyn Fn(&mut Tree) -> Vec<f64>;

/// Derivative of a quantity of a copied tree. `change` moves the copy by a distance.
fn derivative(tree: &Tree, change: &dyn Fn(&mut Tree, f64), quantity: Quantity<'_>) -> Vec<f64> {
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let (mut there, q, v) = (tree.clone(), tree.coordinates(), tree.velocities());
    let mut at = |h: f64| {
        there.set(q, v).expect("its own state");
        change(&mut there, h);
        quantity(&mut there)
    };
    let mut sum = Vec::new();
    for (i, weight) in (1_u8..).zip(weights) {
        let h = f64::from(i) * STEP;
        let (after, before) = (at(h), at(-h));
        sum.resize(after.len(), 0.0);
        for ((sum, after), before) in sum.iter_mut().zip(after).zip(before) {
            *sum += weight * (after - before) / STEP;
        }
    }
    sum
}

/// Moves the tree's position along one of its velocities, without a change of the velocities.
fn along(tree: &mut Tree, k: usize, h: f64) {
    let mut step = vec![0.0; tree.velocities().len()];
    step[k] = h;
    let (q, v) = (tree.coordinates().to_vec(), tree.velocities().to_vec());
    let mut there = q.clone();
    tree.integrate(&q, &step, &mut there).expect("a step");
    tree.set(&there, &v).expect("a state");
}

fn faster(tree: &mut Tree, k: usize, h: f64) {
    let (q, mut v) = (tree.coordinates().to_vec(), tree.velocities().to_vec());
    v[k] += h;
    tree.set(&q, &v).expect("a state");
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(f64::MIN_POSITIVE, |s, x| s.max(x.abs()))
}

fn column(matrix: &Matrix, k: usize) -> Vec<f64> {
    (0..matrix.rows).map(|i| matrix[(i, k)]).collect()
}

#[test]
fn derivatives_of_both_dynamics_are_those_of_differences_whichever_body_comes_first() {
    for scene in mechanisms().into_iter().flat_map(|scene| [lightened(&scene), scene]) {
        let mut tree = wandering(&scene, 5);
        let (n, mut random) = (tree.velocities().len(), Random::new(7));
        let given = random.vector(n, n, 3.0);
        let inverse = tree.inverse_dynamics_derivatives(&given).expect("no loops").clone();
        let forward = tree.forward_dynamics_derivatives(&given).expect("no loops").clone();
        let efforts = |t: &mut Tree| t.inverse_dynamics(&given).expect("efforts").to_vec();
        let motion = |t: &mut Tree| t.forward_dynamics(&given).expect("accelerations").to_vec();
        let mass = tree.mass_matrix().clone();
        close(&scene.name, &inverse.acceleration.data, &mass.data, ROUNDING * largest(&mass.data));
        for k in 0..n {
            let both = [(&inverse.q, &inverse.v), (&forward.q, &forward.v)];
            let of: [Quantity<'_>; 2] = [&efforts, &motion];
            for ((q, v), quantity) in both.into_iter().zip(of) {
                let size = DIFFERENCES * largest(&q.data).max(largest(&v.data));
                let name = format!("{} {k}", scene.name);
                let by_q = derivative(&tree, &|t, h| along(t, k, h), quantity);
                close(&name, &column(q, k), &by_q, size);
                let by_v = derivative(&tree, &|t, h| faster(t, k, h), quantity);
                close(&name, &column(v, k), &by_v, size);
            }
            // the product of M and a column of its inverse is a unit vector
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
            let inverse = column(&forward.effort, k);
            let product: Vec<f64> = (0..n).map(|i| dot(mass.row(i), &inverse)).collect();
            close(&scene.name, &product, &unit, ROUNDING);
        }
    }
}

#[test]
fn the_rate_of_a_jacobian_is_its_change_in_time_and_gives_the_acceleration_at_constant_velocities()
{
    for scene in mechanisms() {
        let mut tree = wandering(&scene, 6);
        let body = BodyId::Body(scene.bodies.len() - 1);
        let at = [0.3, 0.2, if scene.dimension == Dimension::Spatial { -0.4 } else { 0.0 }];
        let rate = tree.jacobian_rate_at(body, at).clone();
        let v = tree.velocities().to_vec();
        let acceleration: Vec<f64> = (0..3).map(|i| dot(rate.row(i), &v)).collect();
        let own = tree.point(body, at).acceleration;
        close(&scene.name, &acceleration, &own, ROUNDING * (1.0 + largest(&own)));
        let slower = 0.1;
        let drift = |t: &mut Tree, h: f64| {
            let step: Vec<f64> = v.iter().map(|v| v * h * slower).collect();
            let mut q = vec![0.0; t.coordinates().len()];
            t.integrate(t.coordinates(), &step, &mut q).expect("a step");
            t.set(&q, &v).expect("a state");
        };
        let change = derivative(&tree, &drift, &|t| t.jacobian_at(body, at).data.clone());
        let change: Vec<f64> = change.iter().map(|x| x / slower).collect();
        close(&scene.name, &rate.data, &change, DIFFERENCES);
    }
}

#[test]
fn a_difference_of_positions_is_the_step_between_them() {
    for scene in mechanisms() {
        let tree = wandering(&scene, 8);
        let n = tree.velocities().len();
        let step = Random::new(9).vector(n, n, 1.0);
        let mut there = vec![0.0; tree.coordinates().len()];
        tree.integrate(tree.coordinates(), &step, &mut there).expect("a step");
        let mut found = vec![0.0; n];
        tree.difference(tree.coordinates(), &there, &mut found).expect("positions");
        close(&scene.name, &found, &step, ROUNDING);
    }
}

#[test]
fn operational_space_inertia_makes_the_accelerations_of_a_force_on_the_frame() {
    for scene in mechanisms().into_iter().chain([file("six-joint-arm")]) {
        let mut tree = wandering(&scene, 3);
        let body = BodyId::Body(scene.bodies.len() - 1);
        let at = [0.3, 0.2, 0.0];
        let n = tree.velocities().len();
        // a force and a moment are converted to efforts; the test uses the accelerations of the frame that these efforts alone cause
        let mut force = Random::new(4).vector(6, 6, 2.0);
        if scene.dimension == Dimension::Planar {
            force[2..5].fill(0.0);
        }
        let jacobian = tree.jacobian_at(body, at).clone();
        let efforts: Vec<f64> = (0..n).map(|k| dot(&column(&jacobian, k), &force)).collect();
        let free = tree.forward_dynamics(&vec![0.0; n]).expect("accelerations").to_vec();
        let pushed = tree.forward_dynamics(&efforts).expect("accelerations").to_vec();
        let change: Vec<f64> = pushed.iter().zip(&free).map(|(x, y)| x - y).collect();
        let motion: Vec<f64> = (0..6).map(|i| dot(jacobian.row(i), &change)).collect();
        let mobility = tree.mobility_at(body, at).expect("no loops").clone();
        let answer: Vec<f64> = (0..6).map(|i| dot(mobility.row(i), &force)).collect();
        close(&scene.name, &answer, &motion, ROUNDING * (1.0 + largest(&motion)));
        match tree.operational_space_inertia_at(body, at) {
            Ok(inertia) => {
                let back: Vec<f64> = (0..6).map(|i| dot(inertia.row(i), &motion)).collect();
                // near a singular position the inertia is ill-conditioned
                close(&scene.name, &back, &force, 1e-6);
            }
            Err(error) => assert_eq!(error.code(), "held-frame", "{}", scene.name),
        }
    }
    // two joints cannot move a rod in three directions
    let mut rods = tree(&file("double-pendulum"));
    let error = rods.operational_space_inertia_at(BodyId::Body(1), [2.0, 0.0, 0.0]);
    assert_eq!(error.expect_err("two joints").code(), "held-frame");
    // six joints move the last link in all directions, unless they are in a line
    let mut arm = tree(&file("six-joint-arm"));
    let (last, at) = (BodyId::Body(5), file("six-joint-arm").bodies[5].center);
    arm.set(&[0.3, 0.4, 0.5, 0.6, 0.7, 0.8], &[0.0; 6]).expect("a state");
    assert!(arm.operational_space_inertia_at(last, at).is_ok());
}

#[test]
fn what_is_of_open_trees_alone_is_refused_by_the_name_of_the_joint_that_closes_the_loop() {
    let mut loops = tree(&file("four-bar"));
    let n = loops.velocities().len();
    let error = loops.forward_dynamics_derivatives(&vec![0.0; n]).expect_err("a loop");
    assert_eq!((error.code(), error.joint()), ("closed-loops", Some("end-0")));
    let error = loops.mobility_at(BodyId::Body(0), [0.0; 3]).expect_err("a loop");
    assert_eq!((error.code(), error.joint()), ("closed-loops", Some("end-0")));
    let mut ball = tree(&floating(Dimension::Spatial));
    let error = ball.inverse_dynamics_derivatives(&[0.0]).expect_err("too few");
    assert_eq!(error.code(), "wrong-length");
}

#[test]
fn a_mechanism_without_freedoms_and_the_ground_have_empty_answers() {
    for dimension in [Dimension::Planar, Dimension::Spatial] {
        let scene = random::guided_whole(random::guided(random::tree(1, dimension, 3), 1, 4), 1, 4);
        let mut tree = tree(&scene);
        let n = tree.velocities().len();
        let none = vec![0.0; n];
        for body in [BodyId::Ground, BodyId::Body(0)] {
            let at = [0.1, 0.0, 0.0];
            assert_eq!(tree.jacobian_at(body, at).columns, n);
            assert_eq!(tree.jacobian_rate_at(body, at).columns, n);
            let mobility = tree.mobility_at(body, at).expect("no loops");
            assert!(n > 0 || mobility.data.iter().all(|x| *x == 0.0));
            let place = FrameTarget { position: Some([9.0, 0.0, 0.0]), rotation: None };
            let found = tree.inverse_kinematics(body, at, &place).expect("no loops");
            assert_eq!(found.end, InverseKinematicsEnd::Nearest);
        }
        assert_eq!(tree.inverse_dynamics_derivatives(&none).expect("no loops").q.rows, n);
        assert_eq!(tree.forward_dynamics_derivatives(&none).expect("no loops").q.rows, n);
        assert_eq!(tree.center_of_mass_jacobian().columns, n);
    }
}
