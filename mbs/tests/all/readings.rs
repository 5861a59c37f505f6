//! What is read of a simulation between steps, in every formulation, against what it must be by definition.

use mbs::{
    Body, BodyId, FormulationKind, GROUND, InitialCondition, Joint, Mechanism, Method, Number,
    Output, Simulation,
};

/// A simulation in each formulation, by steps of this length [s].
fn simulations(m: &Mechanism, step: f64) -> impl Iterator<Item = (&'static str, Simulation)> {
    FormulationKind::listed().map(move |kind| {
        let simulation = m.simulate(&Method::new(kind).step(step));
        (kind.name(), simulation.unwrap_or_else(|e| panic!("{}: {e}", kind.name())))
    })
}

/// A body that turns about its centre on an axis along no other one, with a rate [rad/s].
fn rotor(axis: [f64; 3], rate: f64) -> (Mechanism, BodyId) {
    let mut m = Mechanism::spatial("rotor");
    let inertia = [0.3, 0.4, 0.5, 0.02, 0.01, -0.03];
    let body = m.add(Body::spatial([0.1, -0.2, 0.3], 1.0, inertia));
    let bearing = Joint::revolute([GROUND, body], [0.1, -0.2, 0.3]).about(axis);
    m.add(bearing.start(0.0, rate));
    (m, body)
}

/// Two bodies that swing and turn over, in the plane or in space.
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
            // the axis has length 3; trapezoidal steps of 7 mrad change the rate by less than its square, and steps that are controlled
            // by their tolerance
            assert!((found - rate * axis / 3.0).abs() < 1e-4, "{name}: {found}");
        }
    }
}

/// The rotation vector's rate from three rotations: of R(t + h) R(t - h)', divided by 2 h.
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
                    // h^2/6 times third derivatives of a motion at 3 rad/s and 100 rad/s^2
                    assert!((found - right).abs() < 1e-5, "{name}: {found} is not {right}");
                }
            }
        }
    }
}
