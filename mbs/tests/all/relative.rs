//! Simulations and trees of the same mechanism: exchange of states, accelerations with all effects, rollouts.

use mbs::{
    BodyId, Error as _, FormulationKind, IntegratorKind, Mechanism, Method, Rollout, Simulation,
    Tree,
};
use mbs_testkit::random::Random;

/// Scenes of every kind: open trees, loops, ball joints, free bodies, guides, tires, gears, rolling, controllers, ropes.
const SCENES: [&str; 16] = [
    "andrews",
    "crane",
    "double-pendulum",
    "excavator",
    "four-bar",
    "free-body",
    "geared-arm",
    "guided-four-bar",
    "hexapod",
    "iltis-links",
    "planetary-gear",
    "quarter-car",
    "rssr",
    "servo-arm",
    "six-joint-arm",
    "spinning-top",
];
/// Largest difference of accelerations, relative to the largest acceleration [-]. Natural and relative coordinates are rounded differently,
/// and stiff controllers and tires amplify this.
const ROUNDED: f64 = 1e-7;
/// Relative error of a state after conversion to natural coordinates and back [-]. Angles are recovered by arc tangents.
const RETURNED: f64 = 1e-9;

fn read(name: &str) -> Mechanism {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Mechanism::read(path).unwrap_or_else(|error| panic!("{}", error.render()))
}

/// Simulation some steps after its start.
fn moving(m: &Mechanism, kind: FormulationKind) -> Simulation {
    let method = Method::new(kind).integrator(IntegratorKind::Trapezoidal).step(1e-3);
    let mut simulation = m.simulate(&method).expect("a start");
    for _ in 0..20 {
        simulation.step(1e-3).expect("a step");
    }
    simulation
}

#[test]
fn accelerations_of_a_tree_move_the_bodies_as_those_of_the_simulation_do() {
    for name in SCENES {
        let m = read(name);
        let mut simulation = moving(&m, FormulationKind::Index3);
        let mut tree = m.tree().expect("a tree");
        tree.follow(&simulation).expect("the same mechanism");
        let [q, v] = elsewhere(&mut tree, 5);
        // the new start evaluates the equations in natural coordinates at exactly this state; a step would leave projection errors
        simulation.set_coordinates(&mut tree, &q, &v).expect("a state");
        let a = tree.accelerations().expect("accelerations").to_vec();
        for body in m.ids::<BodyId>() {
            let center = tree.frame_place(m.name(body)).expect("a body").1;
            let right = simulation.point(body, center).acceleration;
            let drift = tree.point(body, center).acceleration;
            let rows = tree.point_jacobian(body, center);
            for (i, right) in right.into_iter().enumerate() {
                let by_joints: f64 = rows.row(i).iter().zip(&a).map(|(j, a)| j * a).sum();
                let size = 1.0 + right.abs() + a.iter().fold(0.0, |s: f64, a| s.max(a.abs()));
                let off = (by_joints + drift[i] - right).abs();
                assert!(off < ROUNDED * size, "{name}, {}: {off:e} of {size}", m.name(body));
            }
        }
    }
}

/// Slightly changed positions, and velocities, that both satisfy the closed loops.
fn elsewhere(tree: &mut Tree, seed: u64) -> [Vec<f64>; 2] {
    let n = tree.velocities().len();
    let mut random = Random::new(seed);
    let (q, mut moved) = (tree.coordinates().to_vec(), tree.coordinates().to_vec());
    tree.integrate(&q, &random.vector(n, n, 0.05), &mut moved).expect("a step");
    tree.set(&moved, &random.vector(n, n, 0.1)).expect("a state");
    tree.make_consistent().expect("loops that close nearby");
    [tree.coordinates().to_vec(), tree.velocities().to_vec()]
}

#[test]
fn a_simulation_takes_a_state_of_its_tree_and_steps_on_from_there() {
    for name in SCENES {
        let m = read(name);
        for kind in [FormulationKind::Index3, FormulationKind::Recursive] {
            let mut simulation = moving(&m, kind);
            let (mut tree, mut other) = (m.tree().expect("a tree"), m.tree().expect("a tree"));
            tree.follow(&simulation).expect("the same mechanism");
            let [q, v] = elsewhere(&mut tree, 3);
            let moved = simulation.set_coordinates(&mut tree, &q, &v);
            let moved = moved.unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(moved < RETURNED, "{name}: moved by {moved:e}");
            other.follow(&simulation).expect("the same mechanism");
            let mut step = vec![0.0; v.len()];
            other.difference(&q, other.coordinates(), &mut step).expect("numbers");
            let rates = v.iter().zip(other.velocities()).map(|(a, b)| a - b);
            for off in step.iter().copied().chain(rates) {
                assert!(off.abs() < RETURNED, "{name}, {}: {off:e}", kind.name());
            }
            let time = simulation.time();
            let [kinetic, _] = other.energies();
            let found = simulation.energies().kinetic;
            let is_guided = m.ids::<mbs::GuideId>().len() > 0;
            assert!(is_guided || (kinetic - found).abs() < RETURNED * (1.0 + kinetic), "{name}");
            simulation.step(1e-4).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!((simulation.time() - time - 1e-4).abs() < 1e-12, "{name}");
        }
    }
}

#[test]
fn turns_of_joints_go_with_a_state() {
    let m = read("double-pendulum");
    for kind in [FormulationKind::Index3, FormulationKind::Recursive] {
        let mut simulation = m.simulate(&Method::new(kind)).expect("a start");
        let mut tree = m.tree().expect("a tree");
        simulation.set_coordinates(&mut tree, &[-12.0, 31.0], &[0.0; 2]).expect("a state");
        let mut other = m.tree().expect("a tree");
        other.follow(&simulation).expect("the same mechanism");
        for (q, right) in other.coordinates().iter().zip([-12.0, 31.0]) {
            assert!((q - right).abs() < RETURNED, "{}: {q}", kind.name());
        }
    }
}

/// Rows of the coordinates q of the same motion by a simulation, step by step.
fn stepped(m: &Mechanism, inputs: &[f64], task: &Rollout<'_>) -> Vec<f64> {
    let method =
        Method::new(FormulationKind::Recursive).integrator(task.integrator).step(task.step);
    let mut simulation = m.simulate(&method).expect("a start");
    let mut tree = m.tree().expect("a tree");
    simulation.set_coordinates(&mut tree, task.q, task.v).expect("a state");
    let mut rows = tree.coordinates().to_vec();
    let n = simulation.inputs().len();
    for k in 0..task.n_steps {
        if n > 0 {
            simulation.set_inputs(&inputs[n * k..][..n]).expect("inputs");
        }
        simulation.step(task.step).expect("a step");
        tree.follow(&simulation).expect("the same mechanism");
        rows.extend_from_slice(tree.coordinates());
    }
    rows
}

#[test]
fn a_rollout_is_the_simulation_in_relative_coordinates() {
    for name in ["double-pendulum", "six-joint-arm", "free-body", "four-bar", "servo-arm"] {
        let m = read(name);
        let mut tree = m.tree().expect("a tree");
        let [q, v] = elsewhere(&mut tree, 7);
        let (n_steps, n_inputs) = (50, tree.inputs().len());
        let mut random = Random::new(1);
        let inputs: Vec<f64> =
            (0..n_inputs * n_steps).map(|_| random.vector(1, 1, 1.0)[0]).collect();
        for integrator in [IntegratorKind::Rk4, IntegratorKind::Trapezoidal] {
            let task = Rollout {
                q: &q,
                v: &v,
                inputs: &inputs,
                step: 1e-3,
                n_steps,
                integrator,
                interrupt: None,
            };
            let mut rows = [vec![0.0; q.len() * 51], vec![0.0; v.len() * 51]];
            let [to_q, to_v] = &mut rows;
            tree.rollout(&task, to_q, to_v).unwrap_or_else(|end| panic!("{name}: {}", end.error));
            for (a, b) in rows[0].iter().zip(stepped(&m, &inputs, &task)) {
                assert!((a - b).abs() < RETURNED * (1.0 + b.abs()), "{name}: {a} and {b}");
            }
        }
    }
}

#[test]
fn a_rollout_that_fails_says_when_and_leaves_no_numbers_behind() {
    let m = read("double-pendulum");
    let mut tree = m.tree().expect("a tree");
    let integrator = IntegratorKind::Rk4;
    let (mut q, mut v) = ([0.0; 2 * 11], [0.0; 2 * 11]);
    // the squares of these rates overflow
    let task = Rollout {
        q: &[0.0; 2],
        v: &[1e200, 0.0],
        inputs: &[],
        step: 1e-3,
        n_steps: 10,
        integrator,
        interrupt: None,
    };
    let end = tree.rollout(&task, &mut q, &mut v).expect_err("no motion");
    assert!(end.error.hint().is_some(), "{}", end.error);
    assert!(q[2 * (end.steps.expect("it began") + 1)..].iter().all(|x| x.is_nan()));
    for (bad, code) in [
        (Rollout { step: 0.0, v: &[0.0; 2], ..task }, "bad-step"),
        (Rollout { q: &[0.0], v: &[0.0; 2], ..task }, "wrong-length"),
        (Rollout { inputs: &[1.0], v: &[0.0; 2], ..task }, "wrong-length"),
        (Rollout { v: &[f64::NAN, 0.0], ..task }, "not-finite"),
    ] {
        let end = tree.rollout(&bad, &mut q, &mut v).expect_err("refused");
        assert_eq!((end.error.code(), end.steps), (code, None));
    }
}
