//! Tests of couplings: gears, cams and ropes are compared with closed-form solutions, dense saddle-point systems and natural coordinates.

use crate::support::{Run, imbalance, random};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{
    Coupling, CouplingMeasure, CouplingTerm, Dimension, Freedom, JointId, Scene,
};
use mbs_recursive::own::OwnFreedoms;
use mbs_recursive::space::Space;
use mbs_recursive::{EffortTerms, Planar, Spatial, TreeError, TreeModel};
use mbs_testkit::Random;

/// Two wheels in a housing that can turn freely, with a motor between the housing and the first wheel.
const HOUSING: &str = r#"
[scene]
dimension = 2
duration = 1.0
[[body]]
name = "housing"
mass = 1.0
center = [0.0, 0.0]
inertia = 0.196
[[body]]
name = "first"
mass = 1.0
center = [0.2, 0.0]
inertia = 0.02
[[body]]
name = "second"
mass = 1.0
center = [-0.2, 0.0]
inertia = 0.004
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "housing"]
at = [0.0, 0.0]
[[joint]]
name = "a"
kind = "revolute"
bodies = ["housing", "first"]
at = [0.2, 0.0]
[[joint]]
name = "b"
kind = "revolute"
bodies = ["second", "housing"]
at = [-0.2, 0.0]
[[effect]]
name = "motor"
kind = "torque"
joint = "a"
value = 0.8
"#;

/// A coupling of the wheels as meshing gears. The second joint is reversed, so that its coordinate has the opposite sign.
const MESH: &str = r#"
[[coupling]]
name = "mesh"
kind = "linear"
terms = [{ joint = "a", factor = 40.0 }, { joint = "b", factor = -17.0 }]
"#;

fn coordinate<S: Space<f64>>(run: &Run<S>, scene: &Scene<f64>, joint: usize) -> usize {
    let link = run.model.coordinate_links(scene)[joint][0].expect("a coordinate");
    run.model.mechanism().links[link as usize].v as usize
}

#[test]
fn wheels_in_a_free_housing_accelerate_as_the_closed_form_says() {
    // [[0.3, I1 - k I2], [I1 - k I2, I1 + k^2 I2]] (x, y) = (0, 0.8): accelerations of housing and first wheel, k = 40/17
    let scene = mbs_testkit::scene(&format!("{HOUSING}{MESH}"));
    let run = Run::<Planar>::new::<2>(&scene);
    let [housing, first, second] =
        [0, 1, 2].map(|joint| run.state.a[coordinate(&run, &scene, joint)]);
    assert!((housing + 0.675_944_334).abs() < 1e-9, "{housing}");
    assert!((first - 19.151_756_130).abs() < 1e-9, "{first}");
    assert!((17.0 * second - 40.0 * first).abs() < 1e-11, "{second}");
    // The torque on the first wheel is the wheel's factor times the effort.
    let effort = run.model.coupling_effort(&run.state, 0).expect("a row");
    assert!((40.0 * effort + 0.430_483_764).abs() < 1e-9, "{effort}");
}

/// Adds a coupling over the coordinates of two or three random joints that have one freedom.
fn couple(scene: &mut Scene<f64>, random: &mut Random) {
    let mut known = Vec::new();
    for (j, joint) in scene.joints.iter().enumerate() {
        let numbered = joint.kind.numbered(scene.dimension);
        let single = numbered.filter(|(_, freedom)| *freedom != Freedom::Ball);
        known.extend(single.map(|(number, _)| (JointId::new(j), number)));
    }
    let n = 2 + random.below(2);
    let mut terms = Vec::new();
    for _ in 0..n.min(known.len()) {
        let (joint, number) = known.swap_remove(random.below(known.len()));
        let of = CouplingMeasure::Coordinate { joint, number };
        terms.push(CouplingTerm { factor: 1.0 + 2.0 * random.next(), of, curve: None });
    }
    scene.couplings.push(Coupling::sum(terms, 0.0));
}

/// Solves [M -Cᵀ; C 0] (a, e) = (-bias, 0) for accelerations a and efforts e. Returns the relative difference from the results of the tree.
fn apart_from_saddle<S: Space<f64>>(scene: &Scene<f64>, seed: u64) -> f64 {
    let mut run = Run::<S>::wandering(scene, seed);
    run.accelerate();
    let (n, rows) = (run.model.n_freedoms(), scene.couplings.len());
    let links = run.model.coordinate_links(scene);
    let size = n + rows;
    let mut saddle = vec![vec![0.0; size + 1]; size];
    for (row, coupling) in scene.couplings.iter().enumerate() {
        for term in &coupling.terms {
            let (joint, number) = term.of.coordinate().expect("a coordinate");
            let link = links[joint.index()][number].expect("a link") as usize;
            let v = run.model.mechanism().links[link].v as usize;
            saddle[n + row][v] += term.factor;
            saddle[v][n + row] -= term.factor;
        }
    }
    let (a, state) = (run.state.a.clone(), &mut run.state);
    let (mut mass, workspace) = (vec![0.0; n * n], &mut run.workspace);
    OwnFreedoms::of_tree(&run.model).write_mass_matrix(&run.model, state, workspace, &mut mass);
    state.a.fill(0.0);
    let mut bias = vec![0.0; n];
    let terms = EffortTerms::WithoutEffects;
    run.model.write_efforts((state, terms), &mut run.workspace, &mut bias);
    for (i, row) in saddle.iter_mut().take(n).enumerate() {
        row[..n].copy_from_slice(&mass[i * n..(i + 1) * n]);
        row[size] = -bias[i];
    }
    let x = solved(saddle);
    let efforts = (0..rows).map(|i| run.model.coupling_effort(state, i).expect("a row"));
    let found: Vec<f64> = a.into_iter().chain(efforts).collect();
    let largest = x.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    found.iter().zip(&x).fold(0.0_f64, |worst, (x, y)| worst.max((x - y).abs() / largest))
}

/// Returns the solution of a linear system by elimination with the largest pivots. The last column of `rows` is the right-hand side.
fn solved(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs()));
        rows.swap(k, pivot.expect("a row"));
        let of = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != k {
                let m = row[k] / of[k];
                row.iter_mut().zip(&of).skip(k).for_each(|(x, y)| *x -= m * y);
            }
        }
    }
    rows.iter().enumerate().map(|(i, row)| row[n] / row[i]).collect()
}

#[test]
fn accelerations_and_efforts_of_random_trees_with_couplings_meet_the_dense_saddle_system() {
    for seed in 1..=50 {
        for dimension in [Dimension::Planar, Dimension::Spatial] {
            let mut scene = random::tree(seed, 12, dimension);
            let random = &mut Random(seed ^ 0xa5);
            for _ in 0..=seed % 2 {
                couple(&mut scene, random);
            }
            let apart = match dimension {
                Dimension::Planar => apart_from_saddle::<Planar>(&scene, seed),
                Dimension::Spatial => apart_from_saddle::<Spatial>(&scene, seed),
            };
            assert!(apart < 1e-9, "{dimension:?} {seed}: {apart:e}");
        }
    }
}

/// A planetary gear: a sun that a motor turns, a planet, a carrier, and a fixed ring.
const PLANETARY: &str = r#"
[scene]
dimension = 2
duration = 1.0
[[body]]
name = "sun"
mass = 1.0
center = [0.0, 0.0]
inertia = 0.01
[[body]]
name = "carrier"
mass = 1.0
center = [0.0, 0.0]
inertia = 0.05
[[body]]
name = "planet"
mass = 0.4
center = [0.08, 0.0]
inertia = 0.002
[[joint]]
name = "s"
kind = "revolute"
bodies = ["ground", "sun"]
at = [0.0, 0.0]
[[joint]]
name = "c"
kind = "revolute"
bodies = ["ground", "carrier"]
at = [0.0, 0.0]
[[joint]]
name = "p"
kind = "revolute"
bodies = ["carrier", "planet"]
at = [0.08, 0.0]
[[effect]]
name = "motor"
kind = "torque"
joint = "s"
value = 1.0
[[coupling]]
name = "inner"
kind = "linear"
terms = [{ joint = "s", factor = 20.0 }, { joint = "c", factor = -20.0 }, { joint = "p", factor = 20.0 }]
[[coupling]]
name = "outer"
kind = "linear"
terms = [{ joint = "c", factor = 60.0 }, { joint = "p", factor = 20.0 }]
"#;

#[test]
fn a_planetary_set_with_its_ring_held_accelerates_as_the_closed_form_says() {
    // acceleration of the carrier: 4 N m / (16 I_sun + I_carrier + m r^2 + 4 I_planet)
    let scene = mbs_testkit::scene(PLANETARY);
    let run = Run::<Planar>::new::<2>(&scene);
    let [sun, carrier, planet] =
        [0, 1, 2].map(|joint| run.state.a[coordinate(&run, &scene, joint)]);
    assert!((carrier - 18.135_654_697).abs() < 1e-9, "{carrier}");
    assert!((sun - 4.0 * carrier).abs() < 1e-11 && (planet + 3.0 * carrier).abs() < 1e-11);
}

/// Returns the scene of the wheels in a housing, with the housing as a pendulum and with eccentric wheels.
fn swinging() -> Scene<f64> {
    let text = format!("{HOUSING}{MESH}")
        .replace("dimension = 2", "dimension = 2\ngravity = [0.0, -9.81]");
    let mut scene = mbs_testkit::scene(&text);
    scene.effects.clear();
    for (body, center) in scene.bodies.iter_mut().zip([[0.3, 0.1], [0.25, 0.02], [-0.2, 0.03]]) {
        body.center = [center[0], center[1], 0.0];
    }
    scene
}

#[test]
fn a_gear_on_a_swinging_housing_keeps_its_ratio_over_ten_thousand_steps() {
    let scene = swinging();
    for is_explicit in [false, true] {
        let mut run = Run::<Planar>::new::<2>(&scene);
        let [a, b] = [1, 2].map(|joint| coordinate(&run, &scene, joint));
        let mut worst = 0.0_f64;
        for _ in 0..10_000 {
            if is_explicit { run.rk4(1e-3) } else { run.step(1e-3) }.expect("a step");
            worst = worst.max((run.state.z[a] - run.state.z[b] * 17.0 / 40.0).abs());
        }
        assert!(worst < 1e-12, "{is_explicit}: {worst:e}");
    }
}

/// Returns the error of the coordinates after half a second with steps of length `dt`, divided by the error with steps of half this length.
fn ratio(scene: &Scene<f64>, (dt, n): (f64, u32), is_explicit: bool) -> f64 {
    let mut exact = Run::<Planar>::new::<2>(scene);
    exact.options.error = 1e-13;
    exact.rk853(dt * f64::from(n)).expect("a step");
    let error = |dt: f64, n: u32| {
        let mut run = Run::<Planar>::new::<2>(scene);
        for _ in 0..n {
            if is_explicit { run.rk4(dt) } else { run.step(dt) }.expect("a step");
        }
        let apart = run.state.z.iter().zip(&exact.state.z).map(|(x, y)| (x - y).abs());
        apart.fold(0.0, f64::max)
    };
    error(dt, n) / error(dt * 0.5, 2 * n)
}

#[test]
fn a_gear_on_a_swinging_housing_has_the_orders_of_the_methods() {
    let (fourth, second) =
        (ratio(&swinging(), (4e-3, 125), true), ratio(&swinging(), (4e-3, 125), false));
    assert!((14.0..20.0).contains(&fourth) && (3.8..4.2).contains(&second), "{fourth} {second}");
}

/// A cam that lifts a follower against gravity, and a follower without a spring that moves by a polynomial.
const CAM: &str = r#"
[scene]
dimension = 2
duration = 1.0
gravity = [0.0, -9.81]
[[body]]
name = "shaft"
mass = 2.0
center = [0.05, 0.0]
inertia = 0.03
[[body]]
name = "follower"
mass = 0.5
center = [0.0, 0.3]
inertia = 0.01
[[joint]]
name = "camshaft"
kind = "revolute"
bodies = ["ground", "shaft"]
at = [0.0, 0.0]
[[joint]]
name = "lift"
kind = "prismatic"
bodies = ["ground", "follower"]
at = [0.0, 0.3]
axis = [0.0, 1.0]
[[coupling]]
name = "cam"
kind = "cam"
joints = ["camshaft", "lift"]
coefficients = [0.0, 0.02, 0.05, -0.01]
[[initial]]
joint = "camshaft"
rate = 3.0
"#;

#[test]
fn a_cam_is_followed_with_the_order_of_the_rule_and_without_drift() {
    let scene = mbs_testkit::scene(CAM);
    let of = ratio(&scene, (4e-3, 125), false);
    assert!((3.8..4.2).contains(&of), "{of}");
    let mut run = Run::<Planar>::new::<2>(&scene);
    let energy = run.drift(1e-3, 1000);
    let [shaft, lift] = [0, 1].map(|joint| run.state.z[coordinate(&run, &scene, joint)]);
    let curve = shaft * (0.02 + shaft * (0.05 - 0.01 * shaft));
    assert!((lift - curve).abs() < 1e-13 && energy < 1e-4, "{lift} {curve} {energy}");
}

/// A screw, a rack, a universal joint, a rope over three bodies with a drum, and a driven wheel, all on a moving base.
const MACHINE: &str = r#"
[scene]
dimension = 3
duration = 1.0
gravity = [0.0, 0.0, -9.81]
[[body]]
name = "base"
mass = 4.0
center = [0.2, 0.1, 0.0]
inertia = [0.3, 0.4, 0.5, 0.02, -0.01, 0.03]
[[body]]
name = "nut"
mass = 1.0
center = [0.5, 0.1, 0.2]
inertia = [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]
[[body]]
name = "rack"
mass = 0.7
center = [0.1, 0.6, 0.1]
inertia = [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]
[[body]]
name = "shaft"
mass = 0.8
center = [0.4, -0.3, 0.1]
inertia = [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]
[[body]]
name = "hook"
mass = 1.3
center = [0.1, 0.2, -0.9]
inertia = [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]
[[body]]
name = "drum"
mass = 0.9
center = [-0.4, 0.2, 0.1]
inertia = [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "base"]
at = [0.0, 0.0, 0.1]
axis = [0.3, 1.0, 0.2]
[[joint]]
name = "spindle"
kind = "cylindrical"
bodies = ["base", "nut"]
at = [0.4, 0.1, 0.2]
axis = [1.0, 0.2, 0.1]
[[joint]]
name = "guide"
kind = "prismatic"
bodies = ["rack", "base"]
at = [0.1, 0.4, 0.1]
axis = [0.1, 1.0, 0.3]
[[joint]]
name = "cross"
kind = "universal"
bodies = ["base", "shaft"]
at = [0.3, -0.2, 0.1]
axes = [[1.0, 0.0, 0.2], [0.0, 1.0, 0.1]]
[[joint]]
name = "fall"
kind = "spherical"
bodies = ["nut", "hook"]
at = [0.6, 0.1, -0.3]
[[joint]]
name = "winch"
kind = "revolute"
bodies = ["base", "drum"]
at = [-0.3, 0.2, 0.1]
axis = [0.0, 1.0, 0.2]
[[coupling]]
name = "screw"
kind = "screw"
joint = "spindle"
lead = 0.3
[[coupling]]
name = "mixed"
kind = "linear"
terms = [{ joint = "cross", coordinate = 1, factor = 0.4 }, { joint = "guide", factor = 2.0 }, { joint = "hinge", factor = -0.3 }]
[[coupling]]
name = "rope"
kind = "rope"
points = [{ body = "ground", at = [0.0, -0.3, 0.9] }, { body = "base", at = [0.3, 0.1, 0.4] }, { body = "hook", at = [0.1, 0.2, -0.7] }, { body = "base", at = [-0.1, 0.2, 0.3] }]
drum = { joint = "winch", radius = 0.3 }
[[coupling]]
name = "driven"
kind = "linear"
terms = [{ joint = "cross", coordinate = 0, factor = 1.0 }, { joint = "guide", factor = 0.5, coefficients = [0.0, 1.0, 0.7] }]
sine = { amplitude = 0.2, frequency = 0.7 }
"#;

#[test]
fn screws_ropes_cams_and_driven_sums_have_the_accelerations_of_natural_coordinates() {
    let scene = mbs_testkit::scene(MACHINE);
    let mut run = Run::<Spatial>::wandering(&scene, 7);
    let motions = run.motions(scene.bodies.len());
    let model = NaturalModel::<f64, 3>::new(&scene).expect("the scene has a model");
    let mut state = State::at_rest(&model);
    state.t = run.state.t;
    let links = run.model.coordinate_links(&scene);
    for ((joint, number), sign, place) in model.coupled_angles() {
        let link = links[joint][number].expect("a link");
        state.memory[place] = sign * run.model.coordinate(&run.state, link);
    }
    model.write_motions(&motions, &mut state);
    let left = imbalance(&model, &state);
    assert!(left.iter().all(|&x| x < 1e-12), "{left:?}");
}

#[test]
fn a_driven_sum_books_its_work() {
    let scene = mbs_testkit::scene(MACHINE);
    let energy = |dt: f64, n: u32| Run::<Spatial>::new::<3>(&scene).drift(dt, n);
    let errors = [energy(4e-3, 100), energy(2e-3, 200)];
    assert!((3.5..4.5).contains(&(errors[0] / errors[1])), "{errors:?}");
}

#[test]
fn rows_of_couplings_stand_in_the_jacobian() {
    // J v is the rate of the sum, and J a + bias its acceleration. Both are zero, except for the driven sum.
    let scene = mbs_testkit::scene(MACHINE);
    let mut run = Run::<Spatial>::wandering(&scene, 3);
    let (model, workspace) = (&run.model, &mut run.workspace);
    let (n, mut rows) = (model.n_freedoms(), vec![f64::NAN; 4 * model.n_freedoms()]);
    OwnFreedoms::of_tree(model).write_loop_rows(model, &run.state, workspace, &mut rows);
    for (k, row) in rows.chunks_exact(n).enumerate() {
        let rate = mbs_testkit::dot(row, &run.state.v);
        let turning = 2.0 * core::f64::consts::PI * 0.7;
        let driven = 0.2 * turning * (turning * run.state.t).cos();
        let expected = if k == 3 { driven } else { 0.0 };
        assert!((rate - expected).abs() < 1e-12, "{k}: {rate} {expected}");
    }
}

#[test]
fn a_coupling_of_guided_joints_is_dropped_if_they_hold_it_and_else_refused() {
    let guides = "[[guide]]\njoint = \"a\"\nramp = { rate = 17.0 }\n[[guide]]\njoint = \"b\"\nramp = { rate = 40.0 }\n";
    let of = |guides: &str| {
        let without = HOUSING.split("[[effect]]").next().expect("a text");
        TreeModel::<f64, Planar>::new(&mbs_testkit::scene(&format!("{without}{MESH}{guides}")))
    };
    assert_eq!(of(guides).expect("a tree").n_rows(), 0);
    let other = of(&guides.replace("40.0", "41.0")).map(|tree| tree.n_rows());
    assert_eq!(other, Err(TreeError::CouplingGuided { coupling: 0 }));
}

#[test]
fn a_guided_wheel_turns_the_other_one() {
    let guide = "[[guide]]\njoint = \"a\"\nsine = { amplitude = 0.3, frequency = 2.0 }\n";
    let without = HOUSING.split("[[effect]]").next().expect("a text");
    let scene = mbs_testkit::scene(&format!("{without}{MESH}{guide}"));
    let mut run = Run::<Planar>::new::<2>(&scene);
    let energy = run.drift(1e-3, 200);
    let turn = 0.3 * (4.0 * core::f64::consts::PI * run.state.t).sin();
    let [hinge, second] = [0, 2].map(|joint| run.state.z[coordinate(&run, &scene, joint)]);
    assert!((second - turn * 40.0 / 17.0).abs() < 1e-13, "{second} {turn}");
    // The angular momentum 0.3 φ' + I1 a' - I2 b' is zero at a start with the rates of the guide, and remains zero.
    let rates = |x: [f64; 3]| 0.3 * x[0] + 0.02 * x[1] - 0.004 * x[2];
    let start = Run::<Planar>::new::<2>(&scene);
    let before = rates([
        start.state.v[coordinate(&start, &scene, 0)],
        0.0,
        start.state.v[coordinate(&start, &scene, 2)],
    ]);
    let guided = 0.3 * 4.0 * core::f64::consts::PI;
    let moved = rates([hinge, turn, second]) - (before + 0.02 * guided) * run.state.t;
    assert!(moved.abs() < 1e-5 && energy < 1e-2, "{moved} {energy}");
}
