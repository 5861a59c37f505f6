//! Ropes whose parts lose their length: every formulation stops there by name.

use mbs::{Body, Coupling, Error, FormulationKind, GROUND, Joint, Mechanism, Method, Run};

/// 3 kg and 2 kg on a rope over two points of the ground; the lighter one hangs half a metre below its point.
fn atwood() -> Mechanism {
    let mut m = Mechanism::planar("atwood");
    m.set_gravity([0.0, -9.81]).set_duration(2.0);
    let [heavy, light] = [([0.0, -1.0], 3.0), ([1.0, 0.5], 2.0)]
        .map(|(at, mass)| m.add(Body::planar(at, mass, 0.1)));
    for (body, at, name) in [(heavy, [0.0, -1.0], "down"), (light, [1.0, 0.5], "up")] {
        m.add(Joint::prismatic([GROUND, body], at).along([0.0, 1.0]).named(name));
    }
    let points =
        [(heavy, [0.0, -1.0]), (GROUND, [0.0, 1.0]), (GROUND, [1.0, 1.0]), (light, [1.0, 0.5])];
    m.add(Coupling::rope(points).named("hoist"));
    m
}

#[test]
fn a_part_that_has_no_length_left_stops_the_run_in_every_formulation() {
    // a = g (3 - 2)/(3 + 2), and half a metre is passed at t = sqrt(1/a)
    let meeting = (1.0_f64 / 1.962).sqrt();
    for kind in FormulationKind::listed() {
        let method = Method { step: Some(1e-3), ..Method::new(kind) };
        let result = mbs::run(&atwood(), &Run::new().method(method)).expect("it starts");
        let stop = result.stop.unwrap_or_else(|| panic!("{} does not stop", kind.name()));
        assert_eq!(stop.code(), "rope-collapsed", "{}: {stop}", kind.name());
        let message = stop.to_string();
        for part in ["`hoist`", "from `ground` to `body-2`", "part 3", "no length left"] {
            assert!(message.contains(part), "{}: {message}", kind.name());
        }
        let time = *result.table.time().last().expect("a row");
        assert!((0.0..2e-3).contains(&(meeting - time)), "{}: {time}, {meeting}", kind.name());
    }
}

#[test]
fn a_part_that_only_turns_keeps_its_rope() {
    // a mass on one rope swings through more than half a turn
    let mut m = Mechanism::planar("swing");
    m.set_gravity([0.0, -9.81]).set_duration(1.5);
    let bob = m.add(Body::planar([0.3, 0.0], 1.0, 1e-3));
    m.add(Joint::free([GROUND, bob], [0.3, 0.0]).named("way"));
    m.add(Coupling::rope([(GROUND, [0.0, 0.0]), (bob, [0.3, 0.0])]).named("rope"));
    for kind in FormulationKind::listed() {
        let method = Method { step: Some(5e-3), ..Method::new(kind) };
        let result = mbs::run(&m, &Run::new().method(method)).expect("it starts");
        assert!(result.stop.is_none(), "{}: {:?}", kind.name(), result.stop);
    }
}

#[test]
fn explicit_steps_and_methods_with_error_control_stop_there_too() {
    let meeting = (1.0_f64 / 1.962).sqrt();
    let recursive = FormulationKind::listed().find(|kind| kind.name() == "recursive");
    let by = |integrator: &str| Method {
        integrator: Some(integrator.to_owned()),
        step: Some(1e-3),
        ..Method::new(recursive.expect("it is listed"))
    };
    for integrator in ["rk4", "rk54", "rk853", "gbs", "radau5"] {
        let result = mbs::run(&atwood(), &Run::new().method(by(integrator))).expect("it starts");
        let stop = result.stop.unwrap_or_else(|| panic!("{integrator} does not stop"));
        assert_eq!(stop.code(), "rope-collapsed", "{integrator}: {stop}");
        let time = *result.table.time().last().expect("a row");
        assert!((0.0..2e-3).contains(&(meeting - time)), "{integrator}: {time}, {meeting}");
    }
}
