//! Setting the state of a simulation: the state is set exactly, or refused without a change.

use mbs::{
    Body, Coordinates, Effect, Error, FormulationKind, GROUND, Guide, Joint, JointId, Mechanism,
    Method, Motion, Number, Signal, Simulation,
};

fn two_pendulums() -> (Mechanism, [JointId; 2]) {
    let mut m = Mechanism::planar("two pendulums");
    m.set_gravity([0.0, -9.81]);
    let upper = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0));
    let lower = m.add(Body::rod([1.0, 0.0], [2.0, 0.0], 1.0));
    let pivot = m.add(Joint::revolute([GROUND, upper], [0.0, 0.0]).named("pivot"));
    let elbow = m.add(Joint::revolute([upper, lower], [1.0, 0.0]).named("elbow"));
    (m, [pivot, elbow])
}

#[test]
fn a_state_is_held_or_refused_with_its_joint_in_every_formulation() {
    let (m, [pivot, elbow]) = two_pendulums();
    let none = Coordinates::default();
    for kind in FormulationKind::listed() {
        let mut sim = m.simulate(&Method::new(kind)).expect("it starts");
        let state = [(pivot, 0.3.into(), 1.0.into()), (elbow, none, (-2.0).into())];
        sim.set_state(&state).expect("an open chain allows all");
        // the limit is the rounding error of the assembly
        let off = [sim.value(pivot) - 0.3, sim.rate(pivot) - 1.0, sim.rate(elbow) + 2.0];
        assert!(off.iter().all(|x| x.abs() < 1e-12), "{}: {off:?}", kind.name());
        let before = sim.save().expect("a state");
        for bad in [
            vec![(elbow, f64::NAN.into(), none)],
            vec![(elbow, none, f64::INFINITY.into())],
            vec![(elbow, [0.1, 0.2].into(), none)],
            vec![(elbow, 0.1.into(), none), (elbow, none, 1.0.into())],
        ] {
            let error = sim.set_state(&bad).expect_err("no state");
            assert_eq!((error.code(), error.joint()), ("state-refused", Some("elbow")), "{error}");
            assert_eq!(sim.save().expect("a state"), before, "{error}");
        }
    }
}

#[test]
fn a_state_that_is_set_on_the_way_is_that_of_now() {
    // a torque that grows with time, on a joint that rotates fast: angles and accelerations are those of the present time
    let (mut m, [pivot, elbow]) = two_pendulums();
    m.add(Effect::torque(pivot, Signal::Table(vec![row(0.0, 0.0), row(20.0, 40.0)])));
    for kind in [FormulationKind::Index3, FormulationKind::Index1, FormulationKind::Recursive] {
        let mut sim = m.simulate(&Method::new(kind)).expect("it starts");
        sim.advance_to(10.0).expect("it moves");
        let state = [(pivot, 0.3.into(), 1.0.into()), (elbow, 0.1.into(), (-2.0).into())];
        sim.set_state(&state).expect("an open chain allows all");
        let name = kind.name();
        assert!((sim.value(pivot) - 0.3).abs() < 1e-12, "{name}: {}", sim.value(pivot));
        assert!((sim.time() - 10.0).abs() < 1e-12);
        let work = |sim: &Simulation| sim.energies().work;
        let before = work(&sim);
        sim.step(1e-3).expect("a regular step");
        // 20 N m act over a rotation of about a thousandth of a radian
        let turned = sim.value(pivot) - 0.3;
        assert!(turned.abs() > 5e-4 && (work(&sim) - before - 20.0 * turned).abs() < 1e-2 * turned);
    }
}

fn row(t: f64, value: f64) -> (Number, [Number; 3]) {
    (t.into(), [value.into(), 0.0.into(), 0.0.into()])
}

#[test]
fn guided_mechanisms_are_set_at_time_zero_alone() {
    let (mut m, [pivot, elbow]) = two_pendulums();
    m.add(Guide::new(pivot, Motion::Ramp { rate: 1.0 }));
    let mut sim = m.simulate(&Method::default()).expect("it starts");
    let state = [(elbow, 0.2.into(), 0.0.into())];
    sim.set_state(&state).expect("where the guide begins");
    sim.step(1e-3).expect("a regular step");
    let before = sim.save().expect("a state");
    let error = sim.set_state(&state).expect_err("the guide has moved");
    assert_eq!(error.code(), "state-refused");
    assert!(error.hint().is_some_and(|hint| hint.contains("reset")));
    assert_eq!(sim.save().expect("a state"), before);
}

#[test]
fn times_that_cannot_be_reached_are_refused_and_late_ones_of_short_numbers_are_stepped_to() {
    let (m, _) = two_pendulums();
    let mut sim = m.simulate(&Method::default()).expect("it starts");
    for time in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, -1.0] {
        assert_eq!(sim.advance_to(time).expect_err("no time").code(), "bad-step", "{time}");
    }
    assert_eq!(sim.advance_to(0.0).expect("it is there").steps, 0);
    assert_eq!(sim.advance_to(0.0105).expect("it arrives").steps, 11);
}
