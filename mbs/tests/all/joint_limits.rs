//! Ranges and limits of joints: exceeding them is noted with joint and time, without an effect on the motion.

use mbs::{
    Body, Effect, FormulationKind, GROUND, Guide, Joint, JointId, JointLimits, Mechanism, Method,
    Motion, Number, Run,
};

/// Mechanism of a wheel on a hinge without forces that rotates at 2 rad/s, so that its angle is 2 t.
fn wheel(limits: JointLimits<Number>) -> Mechanism {
    let mut m = Mechanism::planar("wheel");
    m.set_duration(1.0);
    let wheel = m.add(Body::planar([0.0, 0.0], 1.0, 0.5));
    let hinge = Joint { limits, ..Joint::revolute([GROUND, wheel], [0.0, 0.0]) };
    m.add(hinge.named("hinge").start(0.0, 2.0));
    m
}

/// Options with steps of 10 ms. The angle leaves the range at 0.99 rad in the step that ends at 0.5 s.
fn by(kind: FormulationKind) -> Run {
    Run::new().method(Method { step: Some(0.01), ..Method::new(kind) })
}

fn limits(range: [f64; 2], velocity: f64) -> JointLimits<Number> {
    let velocity = Some(velocity.into());
    JointLimits { range: Some(range.map(Into::into)), effort: Some(7.0.into()), velocity }
}

#[test]
fn a_run_notes_each_limit_once_with_joint_and_time_in_every_formulation() {
    for kind in FormulationKind::listed() {
        let run = |limits| mbs::run(&wheel(limits), &by(kind)).expect("it runs");
        let noted = run(limits([-1.0, 0.99], 1.5)).notes().to_vec();
        let expected = [
            "joint `hinge` leaves its range above 0.99 rad at t = 0.5 s, by up to 1.01 rad",
            "the rate of joint `hinge` passes its limit of 1.5 rad/s at t = 0 s, by up to 0.5 rad/s",
        ];
        assert_eq!(noted, expected, "{}", kind.name());
        let below = run(limits([0.5, 3.0], 2.5)).notes().to_vec();
        let expected =
            ["joint `hinge` leaves its range below 0.5 rad at t = 0 s, by up to 0.5 rad"];
        assert_eq!(below, expected, "{}", kind.name());
        // a range that the angle does not leave is not noted, and the motion is the same
        let plain = run(JointLimits::NONE);
        assert_eq!(plain.notes(), [""; 0], "{}", kind.name());
        for other in [run(limits([-1.0, 2.5], 2.5)), run(limits([-1.0, 0.5], 1.0))] {
            assert_eq!(other.table(), plain.table(), "{}", kind.name());
        }
    }
}

#[test]
fn turns_count_and_a_guide_that_reaches_the_end_of_its_range_does_not_leave_it() {
    let mut m = Mechanism::planar("guided");
    m.set_duration(3.0);
    let wheel = m.add(Body::planar([0.0, 0.0], 1.0, 0.5));
    let amplitude = 7.0;
    let hinge = Joint::revolute([GROUND, wheel], [0.0, 0.0]).range(-amplitude, amplitude);
    let hinge = m.add(hinge.named("hinge"));
    let [most, frequency, phase] = [amplitude, 0.25, 0.0].map(Number::from);
    let sine = Motion::Sine { amplitude: most, frequency, phase };
    m.add(Guide::new(hinge, sine));
    for kind in FormulationKind::listed() {
        let notes = |m: &Mechanism| mbs::run(m, &by(kind)).expect("it runs").notes().to_vec();
        assert!(notes(&m).iter().all(|note| !note.contains("range")), "{:?}", notes(&m));
        let mut narrow = m.clone();
        narrow.part_mut(hinge).limits.range = Some([(-6.5).into(), 7.0.into()]);
        // the sine falls below -6.5 at 2.7579 s; a controlled step ends later than this
        let found = notes(&narrow);
        let [begin, end] =
            ["joint `hinge` leaves its range below -6.5 rad at t = 2.76", ", by up to 0.5 rad"];
        let is_expected = |note: &String| note.starts_with(begin) && note.ends_with(end);
        assert!(found.iter().any(is_expected), "{}: {found:?}", kind.name());
    }
}

/// Mechanism of a pendulum of 2 kg, 0.4 kg m^2 about its centre and 0.5 m to its hinge, which falls on a stop.
fn pendulum(stops: Effect) -> Mechanism {
    let mut m = Mechanism::planar("stopped");
    m.set_gravity([0.0, -9.81]).set_duration(1.0);
    let bob = m.add(Body::planar([0.5, 0.0], 2.0, 0.4));
    let hinge = m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).range(-0.6, 0.4).named("hinge"));
    assert_eq!(hinge, JointId::new(0));
    m.add(stops);
    m
}

#[test]
fn stops_without_numbers_are_those_of_the_moved_inertia() {
    // inertia about the hinge, 0.4 + 2 0.5^2 kg m^2; the time tau of the stop is 20 ms
    let (inertia, tau) = (0.9, 0.02);
    let hinge = JointId::new(0);
    let explicit = Effect::limit(hinge, [-0.6, 0.4], inertia / (tau * tau), 2.0 * inertia / tau);
    for kind in FormulationKind::listed() {
        let run = |stops| {
            let method = Method { step: Some(1e-3), ..Method::new(kind) };
            mbs::run(&pendulum(stops), &Run::new().method(method)).expect("it runs").table().clone()
        };
        let (found, expected) = (run(Effect::stops(hinge)), run(explicit.clone()));
        let [found, expected] = [&found, &expected].map(|t| t.column("hinge").expect("a column"));
        let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{}: {off:e}", kind.name());
        let lowest = expected.iter().copied().fold(0.0, f64::min);
        assert!(lowest < -0.6, "{}: it does not reach its stop: {lowest}", kind.name());
    }
}
