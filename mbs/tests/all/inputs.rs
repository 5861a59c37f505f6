//! Inputs that are set between steps, and user-defined laws: drivers, controllers and machines, in every formulation.

use crate::common;

use mbs::core::laws::body::{BodyMotion, UnitWrench};
use mbs::core::laws::scalar::ScalarForce;
use mbs::core::laws::user::{ScalarLaw, UserBodyLaw, UserScalarLaw, WrenchLaw};
use mbs::core::scene::{
    BodyId, Effect, EffectKind, JointId, JointTorque, Motion, Own, Scene, Signal, SpringDamper,
    UserLaw,
};
use mbs::core::step::InputError;
use mbs::typed::Simulation;
use mbs::{FormulationKind, Method, ResolvedMethod};

fn simulation(scene: &Scene<f64>, formulation: &str) -> Simulation<f64, 2> {
    let formulation = Some(formulation.to_owned());
    let overrides = Method { formulation, step: Some(1e-3), ..Method::default() };
    let settings = ResolvedMethod::new(scene, &overrides).expect("the settings are built");
    Simulation::new(scene, &settings).expect("the scene starts")
}

/// Starts a scene by a formulation with an integrator, in steps of `step` [s].
fn with_integrator(
    scene: &Scene<f64>,
    (formulation, integrator): (&str, &str),
    step: f64,
) -> Simulation<f64, 2> {
    let [formulation, integrator] = [formulation, integrator].map(|name| Some(name.to_owned()));
    let overrides = Method { formulation, integrator, step: Some(step), ..Method::default() };
    let settings = ResolvedMethod::new(scene, &overrides).expect("the settings are built");
    Simulation::new(scene, &settings).expect("the scene starts")
}

/// Formulations with each of their integrators.
fn methods() -> impl Iterator<Item = (&'static str, &'static str)> {
    const RULES: [&str; 4] = ["trapezoidal", "newmark", "hht", "generalised-alpha"];
    const SLOPES: [&str; 5] = ["rk4", "rk54", "rk853", "gbs", "radau5"];
    let natural = ["index-1", "index-3", "classical", "state-space", "multi-index"];
    let with = |name, rules: &'static [&'static str]| rules.iter().map(move |&rule| (name, rule));
    let all = natural.into_iter().chain(["recursive"]);
    all.flat_map(move |name| with(name, &RULES)).chain(with("recursive", &SLOPES))
}

/// Scene of a wheel of 1 kg m^2 on a fixed axle, with a torque that is set between steps.
fn wheel() -> Scene<f64> {
    const TEXT: &str = r#"
        [scene]
        dimension = 2
        duration = 1.0
        [[body]]
        name = "wheel"
        mass = 1.0
        center = [0.0, 0.0]
        inertia = 1.0
        [[joint]]
        name = "axle"
        kind = "revolute"
        bodies = ["ground", "wheel"]
        at = [0.0, 0.0]
        [[initial]]
        joint = "axle"
        value = 0.0
        rate = 0.0
        [[output]]
        name = "axle"
        joint = "axle"
        quantity = "value"
    "#;
    let mut scene = mbs_testkit::scene(TEXT);
    let kind = EffectKind::JointTorque(JointTorque {
        joint: JointId::new(0),
        coordinate: None,
        course: Signal::Input([0.0; 3]),
    });
    scene.effects.push(Effect { name: "motor".into(), enabled: true, kind });
    scene
}

/// Angular velocity of the first body [rad/s].
fn speed(simulation: &Simulation<f64, 2>, scene: &Scene<f64>) -> f64 {
    simulation.model().motion(scene, 0, simulation.state()).omega[2]
}

#[test]
fn an_input_set_for_one_step_acts_in_that_whole_step_and_does_its_work_there() {
    let (scene, h) = (wheel(), 1e-3);
    for method in methods() {
        let mut simulation = with_integrator(&scene, method, h);
        for k in 0..6 {
            let torque = if k == 2 { 1.0 } else { 0.0 };
            simulation.set_input(0, [torque, 0.0, 0.0]).expect("an input");
            simulation.step(h).expect("a regular step");
            // 1 N m for one step h on 1 kg m^2 gives a rate of h and a work of h^2/2
            let (rate, work) = if k < 2 { (0.0, 0.0) } else { (1.0, 5e-7) };
            let (found, [_, _, done]) = (speed(&simulation, &scene) / h, simulation.energies());
            assert!((found - rate).abs() < 1e-9, "{method:?}, step {k}: {found} of the step");
            assert!((done - work).abs() < 1e-15, "{method:?}, step {k}: {done} J");
        }
    }
}

#[test]
fn steps_of_controlled_length_begin_with_the_input_that_is_set() {
    let (scene, h) = (wheel(), 1e-3);
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let overrides = Method {
            formulation: Some(formulation.into()),
            step: Some(h),
            error_tolerance: Some(1e-6),
            ..Method::default()
        };
        let settings = ResolvedMethod::new(&scene, &overrides).expect("the settings are built");
        let mut simulation =
            Simulation::<f64, 2>::new(&scene, &settings).expect("the scene starts");
        for k in 0..6 {
            let torque = if k == 2 { 1.0 } else { 0.0 };
            simulation.set_input(0, [torque, 0.0, 0.0]).expect("an input");
            let report = simulation.step(h).expect("a regular step");
            assert_eq!(report.rejected, 0, "{formulation}: what was set is no error of the step");
        }
        let (found, [_, _, done]) = (speed(&simulation, &scene) / h, simulation.energies());
        assert!((found - 1.0).abs() < 1e-9, "{formulation}: {found} of the step");
        assert!((done - 5e-7).abs() < 1e-15, "{formulation}: {done} J");
    }
}

#[test]
fn a_torque_that_is_set_every_ten_milliseconds_leaves_every_rule_its_order_in_a_closed_loop() {
    let scene = {
        let mut scene = common::scene("four-bar");
        scene.outputs.clear();
        let kind = EffectKind::JointTorque(JointTorque {
            joint: JointId::new(0),
            coordinate: None,
            course: Signal::Input([0.0; 3]),
        });
        scene.effects.push(Effect { name: "motor".into(), enabled: true, kind });
        scene
    };
    let effect = scene.effects.len() - 1;
    let torque = |sample: u32| 40.0 * f64::from(sample * 7 % 5) - 80.0;
    let run = |method, per_sample: u32| {
        let h = 1e-2 / f64::from(per_sample);
        let mut simulation = with_integrator(&scene, method, h);
        for sample in 0..20 {
            simulation.set_input(effect, [torque(sample), 0.0, 0.0]).expect("an input");
            for _ in 0..per_sample {
                simulation.step(h).unwrap_or_else(|e| panic!("{method:?}: {e}"));
            }
        }
        let [kinetic, potential, work] = simulation.energies();
        let [k0, p0, _] = simulation.initial_energies();
        let motion = simulation.model().motion(&scene, 0, simulation.state());
        // error of the energy balance: the power jumps with the input, and the work contains both values at the jump
        ([motion.rotation[(0, 0)], motion.omega[2]], kinetic + potential - work - k0 - p0)
    };
    let (right, _) = run(("recursive", "rk853"), 1);
    // the energy rule of multi-index chooses the lengths of its steps
    let has_fixed_steps =
        |(formulation, rule): &_| *formulation != "multi-index" && *rule != "rk853";
    for method in methods().filter(has_fixed_steps) {
        let error = |per_sample| {
            let (found, ledger) = run(method, per_sample);
            (f64::max((found[0] - right[0]).abs(), (found[1] - right[1]).abs()), ledger.abs())
        };
        let ((coarse, _), (fine, ledger)) = (error(5), error(10));
        let order = (coarse / fine).log2();
        // Newmark's rule damps and is of first order; the others would be of first order too if half of an input acted in the wrong step
        let least = if method.1 == "newmark" { 0.9 } else { 1.8 };
        // true for methods with error control or of higher order
        let is_exact = fine < 1e-8;
        assert!(is_exact || order > least, "{method:?}: order {order}, {coarse:e} and {fine:e}");
        // the energies are about 10 J; the limits are twice the errors of the rules at 1 ms
        let allowed = if method.1 == "newmark" { 1.2e-3 } else { 1e-6 };
        assert!(ledger < allowed, "{method:?}: {ledger:e} J");
    }
}

#[test]
fn what_is_not_finite_is_refused_and_changes_nothing() {
    let scene = wheel();
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let mut simulation = simulation(&scene, formulation);
        simulation.set_input(0, [2.0, 0.0, 0.0]).expect("an input");
        for (component, wrong) in
            [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().enumerate()
        {
            let mut value = [1.0; 3];
            value[component] = wrong;
            let refused = simulation.set_input(0, value);
            assert_eq!(refused, Err(InputError::NotFinite { number: 0, component }));
        }
        simulation.step(1e-3).expect("a regular step");
        assert!((speed(&simulation, &scene) - 2e-3).abs() < 1e-12, "{formulation}");
    }
}

#[test]
fn what_a_spring_stores_when_its_input_is_set_is_booked_as_work() {
    let (bodies, points) = ([BodyId::Ground, BodyId::Body(1)], [[2.0, 1.0, 0.0], [2.0, 0.0, 0.0]]);
    let law = UserLaw::Length { bodies, points, law: UserScalarLaw::of::<Towards>() };
    let scene = with(EffectKind::Own(Own { law, course: Signal::Input([0.7, 0.0, 0.0]) }));
    for method in methods() {
        let mut simulation = with_integrator(&scene, method, 1e-3);
        for k in 0..200_u32 {
            let length = 0.7 + 0.1 * f64::from(k / 20 % 3);
            simulation.set_input(0, [length, 0.0, 0.0]).expect("an input");
            simulation.step(1e-3).expect("a regular step");
        }
        let [kinetic, potential, work] = simulation.energies();
        let [k0, p0, _] = simulation.initial_energies();
        let off = kinetic + potential - work - k0 - p0;
        // the inputs add about 10 J; the rules have errors of 1e-4 of the energy, and Newmark's damping 1e-2
        let allowed = if method.1 == "newmark" { 1.0 } else { 1e-2 };
        assert!(work.abs() > 1.0 && off.abs() < allowed, "{method:?}: {off} of {work} J");
    }
}

fn with(effect: EffectKind<f64>) -> Scene<f64> {
    let mut scene = common::scene("double-pendulum");
    scene.outputs.clear();
    scene.effects.push(Effect { name: "own".into(), enabled: true, kind: effect });
    scene
}

/// Position of the second rod's far end.
fn tip(simulation: &Simulation<f64, 2>) -> [f64; 2] {
    let point = simulation.model().point(BodyId::Body(1), [2.0, 0.0, 0.0]);
    point.value(&simulation.state().q).into()
}

fn close(a: [f64; 2], b: [f64; 2], allowed: f64, what: &str) {
    let apart = common::distance(a, b);
    assert!(apart <= allowed, "{what}: {apart:e} m");
}

#[test]
fn an_input_that_is_set_to_a_constant_is_that_constant() {
    for formulation in common::with_fixed_steps() {
        let torque = |course| {
            EffectKind::JointTorque(JointTorque {
                joint: JointId::new(0),
                coordinate: None,
                course,
            })
        };
        let mut plain = simulation(&with(torque(Signal::Constant([3.0, 0.0, 0.0]))), formulation);
        let mut driven = simulation(&with(torque(Signal::Input([3.0, 0.0, 0.0]))), formulation);
        let effect = 0;
        let refused = plain.set_input(effect, [0.0; 3]);
        assert_eq!(
            refused,
            Err(InputError::NotAnInput { number: effect }),
            "a constant is no input"
        );
        for _ in 0..200 {
            plain.step(1e-3).expect("a regular step");
            driven.set_input(effect, [3.0, 0.0, 0.0]).expect("an input");
            driven.step(1e-3).expect("a regular step");
        }
        close(tip(&plain), tip(&driven), 1e-13, formulation);
    }
}

#[test]
fn an_input_changes_the_motion_from_the_next_step_on() {
    for formulation in common::with_fixed_steps() {
        let scene = with(EffectKind::JointTorque(JointTorque {
            joint: JointId::new(0),
            coordinate: None,
            course: Signal::Input([0.0; 3]),
        }));
        let (mut still, mut driven) =
            (simulation(&scene, formulation), simulation(&scene, formulation));
        for k in 0..100 {
            if k == 50 {
                close(tip(&still), tip(&driven), 0.0, formulation);
                driven.set_input(0, [40.0, 0.0, 0.0]).expect("an input");
            }
            still.step(1e-3).expect("a regular step");
            driven.step(1e-3).expect("a regular step");
        }
        // 40 N m act on 8/3 kg m^2 (two rods in a line) for 0.05 s, which gives about 0.02 rad, or 0.04 m at the tip
        assert!(common::distance(tip(&still), tip(&driven)) > 0.01, "{formulation}");
    }
}

/// Spring of 200 N/m whose free length is its input.
struct Towards;

impl ScalarLaw<f64> for Towards {
    fn evaluate(value: f64, rate: f64, [length, damping, _]: [f64; 3]) -> ScalarForce<f64> {
        let tension = 200.0 * (value - length) + damping * rate;
        ScalarForce { tension, stiffness: 200.0, damping, ..ScalarForce::default() }
    }
    fn energy(value: f64, [length, ..]: [f64; 3]) -> f64 {
        100.0 * (value - length) * (value - length)
    }
    fn elastic(value: f64, [length, ..]: [f64; 3]) -> f64 {
        200.0 * (value - length)
    }
}

/// Linear drag in proportion to its input.
struct Honey;

impl WrenchLaw<f64> for Honey {
    fn evaluate(motion: &BodyMotion<f64>, [c, ..]: [f64; 3]) -> UnitWrench<f64> {
        let speed = motion.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        let force = motion.velocity.map(|v| if speed > 0.0 { v / speed } else { 0.0 });
        let measure = ScalarForce { tension: c * speed, damping: c, ..ScalarForce::default() };
        UnitWrench { force, moment: [0.0; 3], measure }
    }
}

#[test]
fn a_spring_of_one_s_own_is_the_spring_of_the_library() {
    let (bodies, points) = ([BodyId::Ground, BodyId::Body(1)], [[2.0, 1.0, 0.0], [2.0, 0.0, 0.0]]);
    let (stiffness, damping, free_length) = (200.0, 3.0, 0.7);
    let kind =
        EffectKind::SpringDamper(SpringDamper { bodies, points, stiffness, damping, free_length });
    let law = UserLaw::Length { bodies, points, law: UserScalarLaw::of::<Towards>() };
    let own = EffectKind::Own(Own { law, course: Signal::Constant([0.7, 3.0, 0.0]) });
    for formulation in common::with_fixed_steps() {
        let (mut a, mut b) = (
            simulation(&with(kind.clone()), formulation),
            simulation(&with(own.clone()), formulation),
        );
        for _ in 0..300 {
            a.step(1e-3).expect("a regular step");
            b.step(1e-3).expect("a regular step");
        }
        close(tip(&a), tip(&b), 1e-12, formulation);
        // both energy balances agree, except for the rounding of the motion; energies are about 200 J
        for (x, y) in a.energies().iter().zip(b.energies()) {
            assert!((x - y).abs() < 1e-9, "{formulation}: {x} {y}");
        }
    }
}

#[test]
fn a_wrench_of_one_s_own_takes_what_the_ledger_says() {
    let law = UserLaw::Body {
        body: BodyId::Body(1),
        at: [2.0, 0.0, 0.0],
        axis: [1.0, 0.0, 0.0],
        law: UserBodyLaw::of::<Honey>(),
    };
    let scene = with(EffectKind::Own(Own { law, course: Signal::Input([0.5, 0.0, 0.0]) }));
    for formulation in common::with_fixed_steps() {
        let mut simulation = simulation(&scene, formulation);
        for _ in 0..500 {
            simulation.step(1e-3).expect("a regular step");
        }
        let [kinetic, potential, work] = simulation.energies();
        let [k0, p0, _] = simulation.initial_energies();
        assert!(work < -1.0, "{formulation}: {work} J");
        assert!((kinetic + potential - work - k0 - p0).abs() < 1e-3, "{formulation}");
    }
}

#[test]
fn a_guide_that_is_set_follows_what_it_is_told() {
    for formulation in common::with_fixed_steps() {
        let mut scene = common::scene("guided-four-bar");
        scene.outputs.clear();
        // the guide begins at rest with an acceleration of 2 rad/s^2
        scene.guides[0].law = Motion::Input([0.0, 0.0, 2.0]);
        scene.initials.clear();
        let joint = scene.guides[0].joint;
        let mut simulation = simulation(&scene, formulation);
        for k in 1..=500 {
            let t = f64::from(k) * 1e-3;
            simulation.set_guide(0, [t * t, 2.0 * t, 2.0]).expect("an input");
            simulation.step(1e-3).unwrap_or_else(|e| panic!("{formulation} at {t}: {e}"));
        }
        let joint = &scene.joints[joint];
        let BodyId::Body(body) = joint.bodies[1] else { panic!("the crank is the second body") };
        let direction = simulation.model().direction(BodyId::Body(body), [1.0, 0.0, 0.0]);
        let x: [f64; 2] = direction.value(&simulation.state().q).into();
        assert!((x[1].atan2(x[0]) - 0.25).abs() < 1e-12, "{formulation}: {x:?}");
    }
}
