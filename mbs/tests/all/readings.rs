//! Readings of a simulation between steps in every formulation, against their definitions.

use core::f64::consts::PI;
use mbs::{
    Body, BodyId, Effect, EquilibriumOptions, FormulationKind, GROUND, InitialCondition, Joint,
    Mechanism, Method, Number, Output, Search, Simulation, equilibrium,
};
use mbs_testkit::apart;

/// Makes a simulation in each formulation, with steps of this length [s].
fn simulations(m: &Mechanism, step: f64) -> impl Iterator<Item = (&'static str, Simulation)> {
    FormulationKind::listed().map(move |kind| {
        let simulation = m.simulate(&Method::new(kind).step(step));
        (kind.name(), simulation.unwrap_or_else(|e| panic!("{}: {e}", kind.name())))
    })
}

/// Mechanism of a body that rotates about its centre on an oblique axis, with a rate [rad/s].
fn rotor(axis: [f64; 3], rate: f64) -> (Mechanism, BodyId) {
    let mut m = Mechanism::spatial("rotor");
    let inertia = [0.3, 0.4, 0.5, 0.02, 0.01, -0.03];
    let body = m.add(Body::spatial([0.1, -0.2, 0.3], 1.0, inertia));
    let bearing = Joint::revolute([GROUND, body], [0.1, -0.2, 0.3]).about(axis);
    m.add(bearing.start(0.0, rate));
    (m, body)
}

/// Mechanism of two bodies that swing and turn over, in the plane or in space.
fn swinging(is_planar: bool) -> (Mechanism, [BodyId; 2]) {
    if is_planar {
        let mut m = Mechanism::planar("two bars");
        m.set_gravity([0.0, -9.81]);
        let upper = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0));
        let lower = m.add(Body::rod([1.0, 0.0], [2.0, 0.0], 1.0));
        m.add(Joint::revolute([GROUND, upper], [0.0, 0.0]).start(0.0, 1.0));
        m.add(Joint::revolute([upper, lower], [1.0, 0.0]).start(0.0, -2.0));
        return (m, [upper, lower]);
    }
    let mut m = Mechanism::spatial("two bodies");
    m.set_gravity([0.0, 0.0, -9.81]);
    let inertia = [0.3, 0.4, 0.5, 0.02, 0.01, -0.03];
    let upper = m.add(Body::spatial([0.2, 0.5, 0.1], 1.0, inertia));
    let lower = m.add(Body::spatial([0.9, 0.8, -0.2], 2.0, inertia));
    let ball = m.add(Joint::spherical([GROUND, upper], [0.0; 3]));
    let hinge = Joint::revolute([upper, lower], [0.5, 0.6, 0.0]).about([1.0, 2.0, -1.0]);
    m.add(hinge.start(0.0, 3.0));
    let three = |x: [f64; 3]| Some(x.map(Number::from).to_vec());
    m.add(InitialCondition::joint(ball, three([0.3, -0.2, 0.4]), three([1.0, -2.0, 0.5])));
    (m, [upper, lower])
}

#[test]
fn a_rotor_on_a_skew_axis_keeps_its_angular_velocity_along_it_in_every_formulation() {
    let (axis, rate) = ([1.0, -2.0, 2.0], 7.0);
    let (mut m, body) = rotor(axis, rate);
    let spin = m.add(Output::angular_velocity(body));
    for (name, mut sim) in simulations(&m, 1e-3) {
        sim.advance_to(0.3).expect("it turns");
        for (found, axis) in sim.output(spin).expect("finite").iter().zip(axis) {
            // the axis has length 3; trapezoidal steps of 7 mrad change the rate by less than its square, and controlled steps by their
            // tolerance
            assert!((found - rate * axis / 3.0).abs() < 1e-4, "{name}: {found}");
        }
    }
}

/// Rate of the rotation vector from two rotations: that of R(t + h) R(t - h)', divided by 2 h.
fn turning(before: [[f64; 3]; 3], after: [[f64; 3]; 3], h: f64) -> [f64; 3] {
    let entry = |i: usize, j: usize| (0..3).map(|k| after[i][k] * before[j][k]).sum::<f64>();
    [[2, 1], [0, 2], [1, 0]].map(|[i, j]| (entry(i, j) - entry(j, i)) / (4.0 * h))
}

#[test]
fn angular_velocity_is_the_difference_of_rotations_in_every_formulation() {
    let h = 1e-4;
    for is_planar in [true, false] {
        let (mut m, bodies) = swinging(is_planar);
        let spins = bodies.map(|body| m.add(Output::angular_velocity(body)));
        for (name, mut sim) in simulations(&m, h) {
            sim.advance_to(0.2).expect("it moves");
            let rotations = |sim: &Simulation| bodies.map(|body| sim.pose(body).rotation);
            let before = rotations(&sim);
            sim.step(h).expect("it moves");
            let found = spins.map(|spin| sim.output(spin).expect("finite"));
            sim.step(h).expect("it moves");
            for ((before, after), found) in before.into_iter().zip(rotations(&sim)).zip(found) {
                let right = turning(before, after, h);
                assert_eq!(found.len(), if is_planar { 1 } else { 3 }, "{name}");
                for (found, right) in found.iter().rev().zip(right.iter().rev()) {
                    // the error is h^2/6 times the third derivatives; the motion has about 3 rad/s and 100 rad/s^2
                    assert!((found - right).abs() < 1e-5, "{name}: {found} is not {right}");
                }
            }
        }
    }
}

#[test]
fn what_effects_exert_is_the_mass_times_the_acceleration_in_every_formulation() {
    let (mass, inertia, gravity) = (2.0, 0.5, [0.0, 0.0, -9.81]);
    let center = [0.1, -0.2, 0.3];
    let mut m = Mechanism::spatial("held by effects");
    m.set_gravity(gravity);
    let body = m.add(Body::spatial(center, mass, [inertia, inertia, inertia, 0.0, 0.0, 0.0]));
    m.add(Joint::free([GROUND, body], center));
    m.add(InitialCondition::angular_velocity(body, [0.5, -1.0, 2.0]));
    let [on_spring, on_bushing, on_force] = [[0.6, 0.0, 0.2], [-0.3, 0.4, 0.1], [0.0, 0.0, 0.9]];
    let (stiffness, damping) = ([80.0, 90.0, 70.0, 5.0, 6.0, 7.0], [2.0, 1.0, 3.0, 0.1, 0.2, 0.3]);
    let spring = [(GROUND, [0.5, 0.3, 1.4]), (body, on_spring)];
    let effects = [
        (m.add(Effect::spring_damper(spring, 120.0, 3.0, 0.7)), on_spring),
        (m.add(Effect::bushing([GROUND, body], on_bushing, stiffness, damping)), on_bushing),
        (m.add(Effect::force(body, on_force, [1.0, -2.0, 0.5])), on_force),
        (m.add(Effect::body_torque(body, [0.3, 0.2, -0.4])), center),
    ];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [[1, 2], [2, 0], [0, 1]].map(|[i, j]: [usize; 2]| a[i] * b[j] - a[j] * b[i])
    };
    for (name, mut sim) in simulations(&m, 1e-3) {
        sim.advance_to(0.2).expect("it moves");
        let (motion, now) = (sim.motion(body), sim.pose(body).position);
        let (mut force, mut moment) = (gravity.map(|g| mass * g), [0.0; 3]);
        for (effect, at) in effects {
            let exerted = sim.effect_force(effect).expect("it is there");
            let at = sim.point(body, at).position;
            let turning = cross([0, 1, 2].map(|i| at[i] - now[i]), exerted.force);
            for i in 0..3 {
                force[i] += exerted.force[i];
                moment[i] += exerted.moment[i] + turning[i];
            }
        }
        for i in 0..3 {
            let off = [
                mass * motion.acceleration[i] - force[i],
                inertia * motion.angular_acceleration[i] - moment[i],
            ];
            // Newton's method ends when the residual of forces of 20 N is below a relative 1e-4
            assert!(off.iter().all(|x| x.abs() < 2e-3), "{name}: {off:?}");
        }
    }
}

#[test]
fn an_effect_on_a_joint_exerts_its_moment_on_the_second_body() {
    let mut m = Mechanism::planar("bar");
    let bar = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0));
    let hinge = m.add(Joint::revolute([bar, GROUND], [0.0, 0.0]));
    let motor = m.add(Effect::torque(hinge, 3.0));
    let sim = m.simulate(&Method::default()).expect("it is built");
    let exerted = sim.effect_force(motor).expect("it is there");
    assert!(apart(&exerted.moment, &[0.0, 0.0, 3.0]) < 1e-12, "{exerted:?}");
    // the opposite torque acts on the bar: 3 N m over m l^2/3
    let angular = sim.motion(bar).angular_acceleration[2];
    assert!((angular + 9.0).abs() < 1e-9, "{angular}");
}

#[test]
fn contacts_are_listed_from_the_first_call_on_and_until_the_state_is_another() {
    let (mass, stiffness, fall, g) = (1.0_f64, 1e4, 0.1, 9.81);
    let mut m = Mechanism::planar("drop on a stop");
    m.set_gravity([0.0, -g]);
    let body = m.add(Body::planar([0.0, 0.0], mass, 0.1));
    let slide = m.add(Joint::prismatic([GROUND, body], [0.0, 0.0]).along([0.0, 1.0]));
    let stop = m.add(Effect::limit(slide, [-fall, 1.0], stiffness, 0.0));
    // deflection: g/w^2 (1 - cos w t) + v/w sin w t; it is zero again at tan(w t/2) = -v w/g
    let (hit, speed, w) =
        ((2.0 * fall / g).sqrt(), (2.0 * fall * g).sqrt(), (stiffness / mass).sqrt());
    let leave = hit + 2.0 * (core::f64::consts::PI - (speed * w / g).atan()) / w;
    for (name, mut sim) in simulations(&m, 1e-4) {
        sim.step(1e-3).expect("it falls");
        assert_eq!(sim.events().count(), 0, "{name}");
        sim.clear_events().expect("they are watched");
        sim.advance_to(0.2).expect("it falls");
        let found: Vec<_> =
            sim.events().map(|event| (event.effect, event.end, event.is_made)).collect();
        assert_eq!(found, [(stop, 0, true), (stop, 0, false)], "{name}");
        for (event, right) in sim.events().zip([hit, leave]) {
            // steps of 0.1 ms change the period by a relative (w h)^2/12, controlled steps by their tolerance
            assert!((event.time - right).abs() < 2e-5, "{name}: {} is not {right}", event.time);
        }
        sim.reset().expect("it starts");
        assert_eq!(sim.events().count(), 0, "{name}");
        sim.advance_to(0.15).expect("it falls");
        assert_eq!(sim.events().count(), 1, "{name}");
    }
}

#[test]
fn energies_before_the_first_step_and_after_a_return_are_those_of_the_state() {
    let mut m = Mechanism::planar("mass on a spring");
    let mass = m.add(Body::planar([0.0, -1.5], 2.0, 0.1));
    m.add(Joint::prismatic([GROUND, mass], [0.0, -1.5]).along([0.0, 1.0]));
    let ends = [(GROUND, [0.0, 0.0]), (mass, [0.0, -1.5])];
    m.add(Effect::spring_damper(ends, 40.0, 0.0, 1.0));
    for (name, mut sim) in simulations(&m, 1e-3) {
        // the spring is half a metre too long: energy 40/2 · 0.5² J
        let stored = |sim: &Simulation| sim.energies().potential;
        assert!((stored(&sim) - 5.0).abs() < 1e-12, "{name}: {}", stored(&sim));
        let start = sim.save().expect("a snapshot");
        sim.advance_to(0.2).expect("it moves");
        let later = sim.energies();
        assert!(later.kinetic > 1.0 && (later.kinetic + later.potential - 5.0).abs() < 1e-3);
        sim.restore(&start).expect("its own");
        assert!((stored(&sim) - 5.0).abs() < 1e-12, "{name}: {}", stored(&sim));
    }
}

#[test]
#[cfg(feature = "f32")]
fn single_precision_arrives_at_times_that_it_cannot_write() {
    let (m, _) = swinging(true);
    let method = Method::default().precision(mbs::Precision::F32);
    let mut sim = m.simulate(&method).expect("it starts");
    let mut steps = 0;
    for k in 1..=50_u32 {
        // single precision cannot represent tenths
        steps += sim.advance_to(f64::from(k) * 0.1).expect("it arrives").steps;
        assert_eq!(sim.advance_to(f64::from(k) * 0.1).expect("it is there").steps, 0);
    }
    assert_eq!(steps, 5000);
}

#[test]
fn a_run_starts_from_the_equilibrium_that_was_found_stable_or_not() {
    let mut m = Mechanism::planar("pendulum");
    m.set_gravity([0.0, -9.81]).set_duration(0.1);
    let bob = m.add(Body::planar([0.1, 1.0], 1.0, 0.1));
    let pivot = m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]));
    for (search, angle) in [(Search::Near, 0.1_f64.atan()), (Search::Down, 0.1_f64.atan() - PI)] {
        let rest = equilibrium(&m, &EquilibriumOptions { search }).expect("there are two");
        let mut there = m.clone();
        let sim = there.start_from(&rest).simulate(&Method::default()).expect("it starts");
        // the search ends when the residual is 1e-10 of the weight
        let off = (sim.value(pivot) - angle).rem_euclid(2.0 * PI);
        assert!(off.min(2.0 * PI - off) < 1e-8, "{search:?}: {}", sim.value(pivot));
        let again = Mechanism::parse(&there.to_toml().expect("data")).expect("a scene");
        assert_eq!(again, there);
    }
}
