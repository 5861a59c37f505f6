//! States that a simulation is put into: held exactly, or refused with nothing changed.

use mbs::{Body, Coordinates, Error, FormulationKind, GROUND, Joint, JointId, Mechanism, Method};

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
        // rounding of the assembly
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
