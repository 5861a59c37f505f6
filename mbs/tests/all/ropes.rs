//! Ropes with a part whose length becomes zero: every formulation stops there and names the rope.

use crate::common::run_in;
use mbs::{Body, Coupling, Error, FormulationKind, GROUND, Joint, Mechanism, Method, Run};

/// Mechanism of 3 kg and 2 kg on a rope over two points of the ground. The lighter mass hangs half a metre below its point.
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
    // a = g (3 - 2)/(3 + 2), and the lighter mass reaches its point, half a metre away, at t = sqrt(1/a)
    let meeting = (1.0_f64 / 1.962).sqrt();
    for kind in FormulationKind::listed() {
        let method = Method { step: Some(1e-3), ..Method::new(kind) };
        let result = mbs::run(&atwood(), &Run::new().method(method)).expect("it starts");
        let stop = result.stop().unwrap_or_else(|| panic!("{} does not stop", kind.name()));
        assert_eq!(stop.code(), "rope-collapsed", "{}: {stop}", kind.name());
        let message = stop.to_string();
        for part in ["`hoist`", "from `ground` to `body-2`", "part 3", "no length left"] {
            assert!(message.contains(part), "{}: {message}", kind.name());
        }
        let time = *result.table().time().last().expect("a row");
        assert!((0.0..2e-3).contains(&(meeting - time)), "{}: {time}, {meeting}", kind.name());
    }
}

#[test]
fn a_part_that_only_turns_keeps_its_rope() {
    // a mass on one rope swings through more than half a revolution
    let mut m = Mechanism::planar("swing");
    m.set_gravity([0.0, -9.81]).set_duration(1.5);
    let bob = m.add(Body::planar([0.3, 0.0], 1.0, 1e-3));
    m.add(Joint::free([GROUND, bob], [0.3, 0.0]).named("way"));
    m.add(Coupling::rope([(GROUND, [0.0, 0.0]), (bob, [0.3, 0.0])]).named("rope"));
    for kind in FormulationKind::listed() {
        let method = Method { step: Some(5e-3), ..Method::new(kind) };
        let result = mbs::run(&m, &Run::new().method(method)).expect("it starts");
        assert!(result.stop().is_none(), "{}: {:?}", kind.name(), result.stop());
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
        let stop = result.stop().unwrap_or_else(|| panic!("{integrator} does not stop"));
        assert_eq!(stop.code(), "rope-collapsed", "{integrator}: {stop}");
        let time = *result.table().time().last().expect("a row");
        assert!((0.0..2e-3).contains(&(meeting - time)), "{integrator}: {time}, {meeting}");
    }
}

/// A mass hangs below a carriage that oscillates by 0.1 m, both on vertical slides.
#[test]
fn a_rope_that_would_have_to_push_is_noted_with_its_time_and_force() {
    let text = |frequency: f64, kind: &str| {
        let body = |name: &str, y: f64| {
            format!(
                "[[body]]\nname = \"{name}\"\nmass = 5.0\ncenter = [0.0, {y:?}]\ninertia = 1.0\n\
                 [[joint]]\nname = \"{name}\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"{name}\"]\nat = [0.0, {y:?}]\naxis = [0.0, 1.0]\n"
            )
        };
        format!(
            "[scene]\nname = \"hoist\"\ndimension = 2\nduration = 0.5\ngravity = [0.0, -9.81]\n{}{}\
             [[guide]]\njoint = \"carriage\"\nsine = {{ amplitude = 0.1, frequency = {frequency:?}, phase = 0.0 }}\n\
             [[coupling]]\nname = \"line\"\n{kind}\n",
            body("carriage", 1.0),
            body("load", 0.0)
        )
    };
    let rope = "kind = \"rope\"\npoints = [{ body = \"carriage\", at = [0.0, 1.0] }, { body = \"load\", at = [0.0, 0.0] }]";
    let rod = "kind = \"linear\"\nterms = [{ points = [{ body = \"carriage\", at = [0.0, 1.0] }, { body = \"load\", at = [0.0, 0.0] }] }]";
    for kind in FormulationKind::listed() {
        let notes = |frequency: f64, coupling: &str| {
            let m = Mechanism::parse(&text(frequency, coupling)).expect("a scene");
            let method = Method { step: Some(1e-3), ..Method::new(kind) };
            mbs::run(&m, &Run::new().method(method)).expect("it runs").notes().to_vec()
        };
        // the acceleration 0.1 (2 pi f)^2 reaches 9.81 m/s^2 at f = 1.576 Hz
        assert_eq!(notes(1.5, rope), [""; 0], "{}", kind.name());
        assert_eq!(notes(3.0, rod), [""; 0], "{}", kind.name());
        let noted = notes(3.0, rope);
        let omega = core::f64::consts::TAU * 3.0;
        // the note has the end of the first step after sin(w t) = g / (A w^2), with amplitude A and angular frequency w
        let first = ((9.81 / (0.1 * omega * omega)).asin() / omega * 1e3).ceil() / 1e3;
        let begin = format!("the rope `line` pushes at t = {first} s, by up to ");
        assert_eq!(noted.len(), 1, "{}: {noted:?}", kind.name());
        let rest = noted[0].strip_prefix(&begin);
        let most: f64 = rest
            .and_then(|rest| rest.split(' ').next())
            .and_then(|number| number.parse().ok())
            .unwrap_or_else(|| panic!("{}: {noted:?}", kind.name()));
        let right = 5.0 * (0.1 * omega * omega - 9.81);
        assert!((most - right).abs() < 1e-2 * right, "{}: {most} {right}", kind.name());
    }
}

/// Scene of a thin rod on a rope 0.1 m beside its axis; a force of 3 N acts 0.2 m beside the axis. The balance about the axis is T 0.1 = 3
/// 0.2, and 1 kg rises with T - 3 N.
const ROD: &str = "[scene]\ndimension = 3\nduration = 0.005\n\
    [[body]]\nname = \"rod\"\nmass = 1.0\nrod = { from = [-0.5, 0.0, 0.0], to = [0.5, 0.0, 0.0] }\n\
    [[joint]]\nname = \"place\"\nkind = \"free\"\nbodies = [\"ground\", \"rod\"]\n\
    [[coupling]]\nname = \"rope\"\nkind = \"rope\"\n\
    points = [{ body = \"rod\", at = [0.0, 0.1, 0.0] }, { body = \"ground\", at = [0.0, 0.1, 1.0] }]\n\
    [[effect]]\nkind = \"force\"\nbody = \"rod\"\nat = [0.0, 0.2, 0.0]\nvalue = [0.0, 0.0, -3.0]\n\
    [[output]]\nname = \"tension\"\ncoupling = \"rope\"\nquantity = \"effort\"\n\
    [[output]]\nname = \"rise\"\nbody = \"rod\"\nquantity = \"acceleration\"\n";

#[test]
fn a_thin_rod_that_a_rope_beside_its_line_turns_moves_rightly_or_has_no_tree() {
    let scene = mbs_testkit::scene(ROD);
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let outcome = run_in(&scene, formulation, Some(1e-3));
        if formulation == "recursive" {
            assert_eq!(outcome.error.map(|error| error.code()), Some("no-tree"));
            continue;
        }
        assert_eq!(outcome.error, None, "{formulation}");
        let (_, row) = &outcome.rows()[0];
        let off = (row[0] - 6.0).abs().max((row[3] - 3.0).abs());
        assert!(off < 1e-9, "{formulation}: {row:?}");
    }
}
