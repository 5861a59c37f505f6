//! State-space form against closed forms, the tree's derivatives, differences of the motion, and modes.

mod solve;
mod states;

use crate::common;

use mbs::{
    Body, Effect, EquilibriumOptions, Error as _, GROUND, Guide, InitialCondition, Joint, JointId,
    LinearSystem, LinearizeOptions, Matrix, Mechanism, Method, Modes, Motion, Number, Output,
    Place, Search, Signal, equilibrium, linearize,
};

/// Error of matrix entries [-]: differences of fourth order are exact to rounding, 1e-11 here, and an equilibrium to 1e-10 rad.
const SAME: f64 = 1e-8;
/// Error of differences of the motion [-]: they are of second order with a step of 1e-4, so about 1e-8 of the third derivative.
const MOTION: f64 = 1e-5;

fn assert_entries(name: &str, found: &Matrix, expected: &[&[f64]]) {
    assert_eq!(
        (found.rows, found.columns),
        (expected.len(), expected.first().map_or(0, |r| r.len())),
        "{name}"
    );
    let size = expected.iter().flat_map(|row| row.iter()).fold(1.0_f64, |s, x| s.max(x.abs()));
    for (i, row) in expected.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            assert!(
                (found[(i, j)] - x).abs() <= SAME * size,
                "{name}[{i}, {j}]: {}, not {x}",
                found[(i, j)]
            );
        }
    }
}

fn at(place: Place) -> LinearizeOptions {
    LinearizeOptions { place, search: Search::Down }
}

fn about(m: &Mechanism, place: Place) -> LinearSystem {
    linearize(m, &at(place), None, None).unwrap_or_else(|e| panic!("{e}"))
}

fn read(name: &str) -> Mechanism {
    Mechanism::read(common::path(name)).unwrap_or_else(|e| panic!("{e}"))
}

/// Mass of 2 kg that slides along x on a spring of 50 N/m with a damper of 3 N s/m, and an input force.
fn sprung_mass() -> Mechanism {
    let mut m = Mechanism::planar("mass on a spring");
    let mass = m.add(Body::planar([1.0, 0.0], 2.0, 0.1).named("mass"));
    m.add(Joint::prismatic([GROUND, mass], [1.0, 0.0]).along([1.0, 0.0]).named("slide"));
    let ends = [(GROUND, [0.0, 0.0]), (mass, [1.0, 0.0])];
    let spring = m.add(Effect::spring_damper(ends, 50.0, 3.0, 1.0).named("spring"));
    m.add(
        Effect::force(mass, [1.0, 0.0], Signal::Input([0.0, 0.0, 0.0].map(Number::from)))
            .named("push"),
    );
    m.add(Output::position(mass, [1.0, 0.0]).named("place"));
    m.add(Output::velocity(mass, [1.0, 0.0]).named("speed"));
    m.add(Output::acceleration(mass, [1.0, 0.0]).named("acceleration"));
    m.add(Output::effect_force(spring).named("tension"));
    m
}

#[test]
fn a_sprung_mass_has_the_matrices_of_a_textbook() {
    let m = sprung_mass();
    let system = about(&m, Place::Equilibrium);
    assert_eq!(system.states, ["slide", "slide.rate"]);
    assert_eq!(system.inputs, ["push.x", "push.y"]);
    let columns =
        ["place.x", "place.y", "speed.x", "speed.y", "acceleration.x", "acceleration.y", "tension"];
    assert_eq!(system.outputs, columns);
    let (lower, none) = ([-25.0, -1.5], [0.0, 0.0]);
    assert_entries("A", &system.a, &[&[0.0, 1.0], &lower]);
    assert_entries("B", &system.b, &[&none, &[0.5, 0.0]]);
    let c: [&[f64]; 7] = [&[1.0, 0.0], &none, &[0.0, 1.0], &none, &lower, &none, &[50.0, 3.0]];
    assert_entries("C", &system.c, &c);
    let d: [&[f64]; 7] = [&none, &none, &none, &none, &[0.5, 0.0], &none, &none];
    assert_entries("D", &system.d, &d);
    assert_eq!(system.input_values, [0.0, 0.0]);
    assert!((system.output_values[0] - 1.0).abs() < SAME && system.state_values[0].abs() < SAME);
    let chosen = linearize(
        &m,
        &at(Place::Equilibrium),
        Some(&["push.y", "push.x"]),
        Some(&["tension", "speed"]),
    );
    let chosen = chosen.expect("known names");
    assert_eq!(chosen.outputs, ["tension", "speed.x", "speed.y"]);
    assert_entries("B", &chosen.b, &[&none, &[0.0, 0.5]]);
    assert_entries("C", &chosen.c, &[&[50.0, 3.0], &[0.0, 1.0], &none]);
}

#[test]
fn a_pendulum_falls_back_with_its_weight_and_its_pivot_carries_it() {
    let (mass, length, g) = (3.0, 0.7, 9.81);
    let mut m = Mechanism::planar("pendulum");
    m.set_gravity([0.0, -g]);
    let bob = m.add(Body::planar([0.0, -length], mass, 0.0));
    let pivot = m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
    m.add(Effect::torque(pivot, Signal::input(0.0)).named("motor"));
    m.add(Output::reaction(pivot).named("carried"));
    let system = about(&m, Place::Equilibrium);
    assert_entries("A", &system.a, &[&[0.0, 1.0], &[-g / length, 0.0]]);
    assert_entries("B", &system.b, &[&[0.0], &[1.0 / (mass * length * length)]]);
    // the force along x is m l theta'': the weight and the torque cause theta''
    assert_entries("C", &system.c, &[&[-mass * g, 0.0], &[0.0, 0.0], &[0.0, 0.0]]);
    assert_eq!(system.outputs, ["carried.Fx", "carried.Fy", "carried.Mz"]);
    assert_entries("D", &system.d, &[&[1.0 / length], &[0.0], &[0.0]]);
    assert!((system.output_values[1] - mass * g).abs() < SAME * mass * g);
}

#[test]
fn a_four_bar_in_motion_is_the_pendulum_that_its_cranks_are() {
    // parallel cranks have the equation of the scene file, (5/3) theta'' = 2 g sin(theta) + u; theta is the angle from the upright crank, and u
    // the torque
    for (place, theta) in [
        (Place::Initial, 0.0_f64),
        (Place::Initial, 0.5),
        (Place::Equilibrium, core::f64::consts::PI),
    ] {
        let mut m = read("four-bar");
        m.clear_initial_conditions();
        let pivot: JointId = m.find("pivot-0").expect("a joint");
        m.add(InitialCondition::joint(pivot, Some(vec![theta.into()]), Some(vec![(-1.0).into()])));
        m.add(Effect::torque(pivot, Signal::input(0.0)).named("motor"));
        let system = about(&m, place);
        assert_eq!(system.states, ["pivot-0", "pivot-0.rate"]);
        assert_entries("A", &system.a, &[&[0.0, 1.0], &[1.2 * 9.81 * theta.cos(), 0.0]]);
        assert_entries("B", &system.b, &[&[0.0], &[0.6]]);
        let tip: [&[f64]; 2] = [&[-theta.cos(), 0.0], &[-theta.sin(), 0.0]];
        assert_entries("C", &system.c, &[tip[0], tip[1], tip[0], tip[1]]);
        assert_entries("D", &system.d, &[&[0.0]; 4].map(|row: &[f64; 1]| &row[..]));
    }
}

#[test]
fn a_long_chain_keeps_its_digits_in_relative_angles() {
    let (n, g) = (40, 9.81);
    let mut m = Mechanism::planar("chain");
    m.set_gravity([0.0, -g]);
    let mut before = GROUND;
    for i in 0..n {
        let top = -(i as f64);
        let link = m.add(Body::rod([0.0, top], [0.0, top - 1.0], 1.0));
        m.add(Joint::revolute([before, link], [0.0, top]));
        before = link;
    }
    let system = about(&m, Place::Initial);
    assert!(
        system.states[..n].iter().enumerate().all(|(i, name)| *name == format!("joint-{}", i + 1))
    );
    // moments about the upper end of rod i: the weight of all rods below it acts there, and the relative angles up to it rotate it
    let below = |i: usize| (n - 1 - i) as f64;
    let mass = |i: usize, k: usize| below(i.max(k)) + if i == k { 1.0 / 3.0 } else { 0.5 };
    for j in 0..n {
        let turns = (0..n).scan(0.0, |turn, i| {
            *turn += system.a[(n + i, j)];
            Some(*turn)
        });
        let turns: Vec<f64> = turns.collect();
        for i in 0..n {
            let weight = if j <= i { g * (below(i) + 0.5) } else { 0.0 };
            let moments = turns.iter().enumerate().map(|(k, turn)| mass(i, k) * turn);
            let left = (weight + moments.sum::<f64>()).abs();
            // the limit is relative to the weight of the whole chain, for an angle of one radian
            assert!(left < SAME * g * n as f64, "{i}, {j}: {left} N m");
        }
    }
}

#[test]
fn a_scene_that_starts_settled_is_linearised_there_as_its_start() {
    let mut m = Mechanism::planar("pendulum");
    m.set_gravity([0.0, -9.81]);
    let bob = m.add(Body::planar([1.0, 0.0], 2.0, 0.0));
    let pivot = m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
    let level = about(&m, Place::Initial);
    assert_entries("A", &level.a, &[&[0.0, 1.0], &[0.0, 0.0]]);
    m.add(InitialCondition::joint(pivot, Some(vec![(-1.0).into()]), None));
    let rest = equilibrium(&m, &EquilibriumOptions::default()).expect("it hangs");
    m.start_from(&rest);
    let settled = about(&m, Place::Initial);
    assert_entries("A", &settled.a, &[&[0.0, 1.0], &[-9.81, 0.0]]);
    assert!((settled.state_values[0] + core::f64::consts::FRAC_PI_2).abs() < SAME);
}

#[test]
fn a_slider_crank_in_motion_answers_as_its_motion_does() {
    let mechanism = |[value, rate, torque]: [f64; 3]| {
        let mut m = read("slider-crank");
        let pivot: JointId = m.find("pivot").expect("a joint");
        m.clear_initial_conditions();
        let start = [value, rate].map(|x| Some(vec![x.into()]));
        let [value, rate] = start;
        m.add(InitialCondition::joint(pivot, value, rate));
        m.add(Effect::torque(pivot, Signal::input(torque)).named("motor"));
        let turning = m.add(Output::joint_acceleration(pivot).named("turning"));
        (m, turning)
    };
    let (start, h) = ([0.3, -20.0, 0.4], 1e-4);
    let system = about(&mechanism(start).0, Place::Initial);
    assert_eq!(system.states, ["pivot", "pivot.rate"]);
    let row = system.outputs.iter().position(|name| name == "turning").expect("an output");
    for k in 0..3 {
        let [after, before] = [1.0, -1.0].map(|sign| {
            let mut there = start;
            there[k] += sign * h;
            let (m, turning) = mechanism(there);
            let sim = m.simulate(&Method::default()).expect("it starts");
            sim.output(turning).expect("finite")[0]
        });
        let slope = (after - before) / (2.0 * h);
        let found = if k < 2 { system.c[(row, k)] } else { system.d[(row, 0)] };
        let of_state = if k < 2 { system.a[(1, k)] } else { system.b[(1, 0)] };
        let size = slope.abs().max(1.0);
        assert!((found - slope).abs() < MOTION * size, "{k}: {found}, not {slope}");
        assert!((of_state - found).abs() < SAME * size, "{k}: {of_state}, not {found}");
    }
}

/// Solution x of M x = b by elimination with pivots, for each column.
fn solved(matrix: &Matrix, b: &Matrix) -> Matrix {
    let (n, mut m, mut x) = (matrix.rows, matrix.clone(), b.clone());
    for k in 0..n {
        let pivot = (k..n).fold(k, |p, i| if m[(i, k)].abs() > m[(p, k)].abs() { i } else { p });
        for j in 0..n {
            m.data.swap(k * n + j, pivot * n + j);
        }
        for j in 0..x.columns {
            x.data.swap(k * b.columns + j, pivot * b.columns + j);
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = m[(i, k)] / m[(k, k)];
            (0..n).for_each(|j| m[(i, j)] -= factor * m[(k, j)]);
            (0..b.columns).for_each(|j| x[(i, j)] -= factor * x[(k, j)]);
        }
    }
    for i in 0..n {
        (0..b.columns).for_each(|j| x[(i, j)] /= m[(i, i)]);
    }
    x
}

#[test]
fn servos_take_each_joint_to_its_target_and_no_other() {
    let system = about(&read("servo-arm"), Place::Equilibrium);
    assert_eq!(system.states.len(), 18);
    assert_eq!(system.states[12], "servo-turn.integral");
    assert!(
        system.inputs.iter().all(|name| name.starts_with("target-")) && system.inputs.len() == 6
    );
    let x = solved(&system.a, &system.b);
    for i in 0..6 {
        for j in 0..6 {
            let through: f64 = (0..18).map(|k| system.c[(i, k)] * x[(k, j)]).sum();
            let gain = system.d[(i, j)] - through;
            let expected = if i == j { 1.0 } else { 0.0 };
            // the equations are ill-conditioned: coefficients of the weakest joint are a thousandth of those of the strongest
            assert!((gain - expected).abs() < 1e-7, "{i} {j}: {gain}");
        }
    }
}

#[test]
fn an_arm_in_motion_has_the_derivatives_of_its_tree() {
    let mut m = read("six-joint-arm");
    for effect in m.ids::<mbs::EffectId>() {
        m.part_mut(effect).enabled = false;
    }
    m.clear_initial_conditions();
    let joints: Vec<JointId> = m.ids().collect();
    let (q, v) = ([0.3, -0.4, 0.8, 0.2, -0.7, 0.5], [1.0, -0.5, 0.7, 2.0, -1.5, 0.4]);
    for (i, &joint) in joints.iter().enumerate() {
        m.add(Effect::torque(joint, Signal::input(0.0)).named(&format!("motor-{i}")));
        m.add(InitialCondition::joint(joint, Some(vec![q[i].into()]), Some(vec![v[i].into()])));
    }
    let mut tree = m.tree().expect("a tree");
    let system = about(&m, Place::Initial);
    tree.set(&q, &v).expect("a state");
    let slopes = tree.forward_dynamics_derivatives(&[0.0; 6]).expect("no loops");
    for (k, expected) in [&slopes.q, &slopes.v].into_iter().enumerate() {
        let size = expected.data.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
        for i in 0..6 {
            for j in 0..6 {
                let (found, x) = (system.a[(6 + i, 6 * k + j)], expected[(i, j)]);
                assert!((found - x).abs() < SAME * size, "A {k} {i} {j}: {found}, not {x}");
                let unit = if k == 1 && i == j { 1.0 } else { 0.0 };
                assert!((system.a[(i, 6 * k + j)] - unit).abs() < SAME, "upper {k} {i} {j}");
            }
        }
    }
    let size = slopes.effort.data.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
    for i in 0..6 {
        for j in 0..6 {
            let (found, x) = (system.b[(6 + i, j)], slopes.effort[(i, j)]);
            assert!((found - x).abs() < SAME * size, "B {i} {j}: {found}, not {x}");
        }
    }
}

#[test]
fn two_damped_masses_move_in_the_golden_ratio() {
    let (k, beta) = (100.0, 0.01);
    let mut m = Mechanism::planar("two masses");
    let mut before = GROUND;
    for (name, x) in [("first", 1.0), ("second", 2.0)] {
        let mass = m.add(Body::planar([x, 0.0], 1.0, 0.1));
        m.add(Joint::prismatic([GROUND, mass], [x, 0.0]).along([1.0, 0.0]).named(name));
        let ends = [(before, [x - 1.0, 0.0]), (mass, [x, 0.0])];
        m.add(Effect::spring_damper(ends, k, beta * k, 1.0));
        before = mass;
    }
    let system = about(&m, Place::Equilibrium);
    let shapes = system.shapes().expect("they converge");
    let root = 5.0_f64.sqrt();
    // the mode shape is x2 = (2 - omega^2 m / k) x1; the eigenvalue lambda is a root of lambda^2 + beta omega^2 lambda + omega^2 = 0
    for (shape, sign) in shapes.iter().zip([-1.0, 1.0]) {
        let square = 0.5 * k * (3.0 + sign * root);
        let real = -0.5 * beta * square;
        let imaginary = (square - real * real).sqrt();
        let mode = shape.mode;
        assert!(
            (mode.real - real).abs() + (mode.imaginary - imaginary).abs() < SAME * imaginary,
            "{mode:?}"
        );
        let [x1, x2, v1, v2] = [0, 1, 2, 3].map(|i| shape.states[i]);
        let ratio = 2.0 - square / k;
        for part in 0..2 {
            assert!((x2[part] - ratio * x1[part]).abs() < SAME, "{shape:?}");
        }
        for (x, v) in [(x1, v1), (x2, v2)] {
            let rate = [real * x[0] - imaginary * x[1], real * x[1] + imaginary * x[0]];
            assert!((rate[0] - v[0]).abs() + (rate[1] - v[1]).abs() < SAME, "{shape:?}");
        }
        let largest = shape.states.iter().map(|x| x[0].hypot(x[1])).fold(0.0, f64::max);
        assert!((largest - 1.0).abs() < SAME && shape.states.contains(&[1.0, 0.0]), "{shape:?}");
    }
}

#[test]
fn eigenvalues_are_those_of_modes_whatever_the_states() {
    for name in [
        "double-pendulum",
        "spatial-four-bar",
        "quarter-car",
        "tree-30",
        "iltis-equilibrium",
        "servo-arm",
        "rssr",
    ] {
        let scene = common::scene(name);
        let modes = Modes::new(&scene, Place::Equilibrium, Search::Down)
            .unwrap_or_else(|e| panic!("{name}: {e:?}"));
        let system = LinearSystem::new(&scene, &at(Place::Equilibrium), None, Some(&[]));
        let system = system.unwrap_or_else(|e| panic!("{name}: {e}"));
        println!("{name}: {:?}", &system.states[..modes.dof]);
        let shapes = system.shapes().expect("they converge");
        // rounding makes a neutral pair of eigenvalues two real ones or a complex pair
        let shapes: Vec<_> = shapes.iter().filter(|shape| !shape.mode.is_neutral).collect();
        let lively: Vec<_> = modes.modes.iter().filter(|mode| !mode.is_neutral).collect();
        assert_eq!(shapes.len(), lively.len(), "{name}: {shapes:?}, not {lively:?}");
        let largest = modes.modes.iter().map(mbs::Mode::undamped_frequency).fold(0.0, f64::max);
        for (shape, mode) in shapes.iter().zip(lively) {
            let found = shape.mode;
            let apart = (found.real - mode.real).hypot(found.imaginary - mode.imaginary);
            // double eigenvalues have an error of the square root of rounding
            assert!(apart < 1e-6 * largest, "{name}: {found:?}, not {mode:?}");
            for i in 0..system.a.rows {
                let sum = |part: usize| -> f64 {
                    (0..system.a.columns).map(|j| system.a[(i, j)] * shape.states[j][part]).sum()
                };
                let [re, im] = shape.states[i];
                let left = [
                    sum(0) - found.real * re + found.imaginary * im,
                    sum(1) - found.real * im - found.imaginary * re,
                ];
                let size = system.a.row(i).iter().fold(largest, |s, x| s.max(x.abs()));
                assert!(left[0].hypot(left[1]) < 1e-7 * size, "{name}: {found:?}: {left:?}");
            }
        }
    }
}

#[test]
fn a_tumbling_body_turns_as_eulers_equations_say() {
    let (inertia, w) = ([0.5, 0.6, 0.9], [0.4, -1.1, 0.7]);
    let mut m = Mechanism::spatial("tumbling");
    let body = m.add(
        Body::spatial([0.3, 0.1, -0.2], 2.0, [inertia[0], inertia[1], inertia[2], 0.0, 0.0, 0.0])
            .named("stone"),
    );
    m.add(InitialCondition::angular_velocity(body, w));
    m.add(Output::angular_velocity(body).named("turning"));
    let system = about(&m, Place::Initial);
    let names = ["stone.x", "stone.y", "stone.z", "stone.rx", "stone.ry", "stone.rz"];
    assert_eq!(system.states[..6], names);
    assert_eq!(system.states[9], "stone.rx.rate");
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let unit = |j: usize| core::array::from_fn::<f64, 3, _>(|i| if i == j { 1.0 } else { 0.0 });
    // in global axes omega' = R a(R^T omega), with a(w) = -J^-1 (w x J w) and the small rotation R = 1 + theta x; relative to the motion with
    // the angular velocity w, theta' = omega - w + w x theta
    let gyration = |a: [f64; 3], b: [f64; 3]| {
        let both = cross(a, core::array::from_fn(|i| inertia[i] * b[i]));
        core::array::from_fn::<f64, 3, _>(|i| -both[i] / inertia[i])
    };
    let by_rate = |d: [f64; 3]| {
        let (a, b) = (gyration(d, w), gyration(w, d));
        core::array::from_fn::<f64, 3, _>(|i| a[i] + b[i])
    };
    for j in 0..3 {
        let turned = cross(unit(j), gyration(w, w));
        let back = by_rate(cross(unit(j), w));
        let carried = cross(w, unit(j));
        for i in 0..3 {
            let near =
                |found: f64, x: f64| assert!((found - x).abs() < SAME, "{i} {j}: {found}, not {x}");
            near(system.a[(3 + i, 3 + j)], carried[i]);
            near(system.a[(3 + i, 9 + j)], unit(j)[i]);
            near(system.a[(9 + i, 3 + j)], turned[i] - back[i]);
            near(system.a[(9 + i, 9 + j)], by_rate(unit(j))[i]);
            near(system.a[(i, 6 + j)], unit(j)[i]);
        }
    }
}

#[test]
fn a_guided_cart_swings_its_bob_by_its_acceleration_alone() {
    let (length, g) = (0.7, 9.81);
    let mut m = Mechanism::planar("guided cart");
    m.set_gravity([0.0, -g]);
    let cart = m.add(Body::planar([0.0, 0.0], 2.0, 0.1));
    let bob = m.add(Body::planar([0.0, -length], 3.0, 0.0));
    let slide =
        m.add(Joint::prismatic([GROUND, cart], [0.0, 0.0]).along([1.0, 0.0]).named("slide"));
    m.add(Joint::revolute([cart, bob], [0.0, 0.0]).named("pivot"));
    m.add(Guide::new(slide, Motion::Input([0.0, 0.3, 0.0])));
    m.add(Output::position(bob, [0.0, -length]).named("bob"));
    m.add(Output::velocity(bob, [0.0, -length]).named("speed"));
    for place in [Place::Equilibrium, Place::Initial] {
        let system = about(&m, place);
        assert_eq!(system.states, ["pivot", "pivot.rate"]);
        assert_eq!(system.inputs, ["slide", "slide.rate", "slide.acceleration"]);
        let none = [0.0; 3];
        assert_entries("A", &system.a, &[&[0.0, 1.0], &[-g / length, 0.0]]);
        assert_entries("B", &system.b, &[&none, &[0.0, 0.0, -1.0 / length]]);
        // the bob's height is proportional to (1 - cos) of its angle, so its speed depends on the angle by the rate of this state
        let rise = length * system.state_values[1];
        let c: [&[f64]; 4] = [&[length, 0.0], &[0.0, 0.0], &[0.0, length], &[rise, 0.0]];
        assert_entries("C", &system.c, &c);
        assert_entries("D", &system.d, &[&[1.0, 0.0, 0.0], &none, &[0.0, 1.0, 0.0], &none]);
    }
}

#[test]
fn unknown_names_and_inputs_without_a_derivative_are_refused() {
    let m = sprung_mass();
    let refused = |inputs: Option<&[&str]>, outputs: Option<&[&str]>, m: &Mechanism| {
        let error = linearize(m, &at(Place::Initial), inputs, outputs).expect_err("refused");
        (error.code(), error.to_string())
    };
    let (code, message) = refused(Some(&["push"]), None, &m);
    assert!(code == "unknown-name" && message.contains("no input `push`"), "{code}: {message}");
    let (code, message) = refused(None, Some(&["tensions"]), &m);
    assert!(code == "unknown-name" && message.contains("no output `tensions`"), "{message}");
    // no joint is free, and no input or output is requested
    let mut m = Mechanism::planar("held");
    let cart = m.add(Body::planar([0.0, 0.0], 2.0, 0.1));
    let slide = m.add(Joint::prismatic([GROUND, cart], [0.0, 0.0]).along([1.0, 0.0]));
    m.add(Guide::new(slide, Motion::Input([0.0; 3])));
    let none = linearize(&m, &at(Place::Initial), Some(&[]), None).expect("no inputs");
    assert!(none.states.is_empty() && none.inputs.is_empty() && none.outputs.len() == 1);
    assert_eq!(none.shapes().expect("no states"), []);
}
