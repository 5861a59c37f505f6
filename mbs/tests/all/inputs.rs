//! What is set between steps, and laws of a user's own: drivers, controllers and machines, in every formulation.

use crate::common;

use mbs::core::laws::body::{Action, BodyMotion};
use mbs::core::laws::own::{OwnScalar, OwnWrench, ScalarLaw, WrenchLaw};
use mbs::core::laws::scalar::Measure;
use mbs::core::scene::{BodyRef, Course, Effect, EffectKind, GuideLaw, OwnLaw, Scene};
use mbs::{Formulation, Overrides, Settings, Simulation};

fn simulation(scene: &Scene<f64>, formulation: &str) -> Simulation<f64, 2> {
    let formulation = Some(formulation.to_owned());
    let overrides = Overrides { formulation, step: Some(1e-3), ..Overrides::default() };
    let settings = Settings::new(scene, &overrides).expect("the settings are built");
    Simulation::new(scene, &settings).expect("the scene starts")
}

fn with(effect: EffectKind<f64>) -> Scene<f64> {
    let mut scene = common::scene("double-pendulum");
    scene.outputs.clear();
    scene.effects.push(Effect { name: "own".into(), enabled: true, kind: effect });
    scene
}

/// Where the second rod's far end is.
fn tip(simulation: &Simulation<f64, 2>) -> [f64; 2] {
    let point = simulation.model().point(BodyRef::Body(1), [2.0, 0.0, 0.0]);
    point.value(&simulation.state().q).into()
}

fn close(a: [f64; 2], b: [f64; 2], allowed: f64, what: &str) {
    let apart = common::distance(a, b);
    assert!(apart <= allowed, "{what}: {apart:e} m");
}

#[test]
fn an_input_that_is_set_to_a_constant_is_that_constant() {
    for formulation in
        Formulation::ALL.map(Formulation::name).into_iter().filter(|f| *f != "multi-index")
    {
        let torque = |course| EffectKind::JointTorque { joint: 0, course };
        let mut plain = simulation(&with(torque(Course::Constant([3.0, 0.0, 0.0]))), formulation);
        let mut driven = simulation(&with(torque(Course::Input([3.0, 0.0, 0.0]))), formulation);
        let effect = 0;
        assert!(!plain.set_input(effect, [0.0; 3]), "a constant is no input");
        for _ in 0..200 {
            plain.step(1e-3).expect("a regular step");
            assert!(driven.set_input(effect, [3.0, 0.0, 0.0]));
            driven.step(1e-3).expect("a regular step");
        }
        close(tip(&plain), tip(&driven), 1e-13, formulation);
    }
}

#[test]
fn an_input_changes_the_motion_from_the_next_step_on() {
    for formulation in
        Formulation::ALL.map(Formulation::name).into_iter().filter(|f| *f != "multi-index")
    {
        let scene = with(EffectKind::JointTorque { joint: 0, course: Course::Input([0.0; 3]) });
        let (mut still, mut driven) =
            (simulation(&scene, formulation), simulation(&scene, formulation));
        for k in 0..100 {
            if k == 50 {
                close(tip(&still), tip(&driven), 0.0, formulation);
                assert!(driven.set_input(0, [40.0, 0.0, 0.0]));
            }
            still.step(1e-3).expect("a regular step");
            driven.step(1e-3).expect("a regular step");
        }
        // 40 N m on 8/3 kg m^2 (two rods in line) for 0.05 s: about 0.02 rad, 0.04 m at the tip.
        assert!(common::distance(tip(&still), tip(&driven)) > 0.01, "{formulation}");
    }
}

/// A spring of 200 N/m towards the length that is its input.
struct Towards;

impl ScalarLaw<f64> for Towards {
    fn evaluate(value: f64, rate: f64, [length, damping, _]: [f64; 3]) -> Measure<f64> {
        let tension = 200.0 * (value - length) + damping * rate;
        Measure { tension, stiffness: 200.0, damping, ..Measure::default() }
    }
    fn energy(value: f64, [length, ..]: [f64; 3]) -> f64 {
        100.0 * (value - length) * (value - length)
    }
    fn elastic(value: f64, [length, ..]: [f64; 3]) -> f64 {
        200.0 * (value - length)
    }
}

/// Linear drag, in proportion to the input.
struct Honey;

impl WrenchLaw<f64> for Honey {
    fn evaluate(motion: &BodyMotion<f64>, [c, ..]: [f64; 3]) -> Action<f64> {
        let speed = motion.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        let force = motion.velocity.map(|v| if speed > 0.0 { v / speed } else { 0.0 });
        let measure = Measure { tension: c * speed, damping: c, ..Measure::default() };
        Action { force, moment: [0.0; 3], measure }
    }
}

#[test]
fn a_spring_of_one_s_own_is_the_spring_of_the_library() {
    let (bodies, points) =
        ([BodyRef::Ground, BodyRef::Body(1)], [[2.0, 1.0, 0.0], [2.0, 0.0, 0.0]]);
    let (stiffness, damping, free_length) = (200.0, 3.0, 0.7);
    let kind = EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length };
    let law = OwnLaw::Length { bodies, points, law: OwnScalar::of::<Towards>() };
    let own = EffectKind::Own { law, course: Course::Constant([0.7, 3.0, 0.0]) };
    for formulation in
        Formulation::ALL.map(Formulation::name).into_iter().filter(|f| *f != "multi-index")
    {
        let (mut a, mut b) = (
            simulation(&with(kind.clone()), formulation),
            simulation(&with(own.clone()), formulation),
        );
        for _ in 0..300 {
            a.step(1e-3).expect("a regular step");
            b.step(1e-3).expect("a regular step");
        }
        close(tip(&a), tip(&b), 1e-12, formulation);
        // The ledgers tell of the same energies; of some 200 J, rounding of the motion.
        for (x, y) in a.energies().iter().zip(b.energies()) {
            assert!((x - y).abs() < 1e-9, "{formulation}: {x} {y}");
        }
    }
}

#[test]
fn a_wrench_of_one_s_own_takes_what_the_ledger_says() {
    let law = OwnLaw::Body {
        body: 1,
        at: [2.0, 0.0, 0.0],
        axis: [1.0, 0.0, 0.0],
        law: OwnWrench::of::<Honey>(),
    };
    let scene = with(EffectKind::Own { law, course: Course::Input([0.5, 0.0, 0.0]) });
    for formulation in
        Formulation::ALL.map(Formulation::name).into_iter().filter(|f| *f != "multi-index")
    {
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
    for formulation in
        Formulation::ALL.map(Formulation::name).into_iter().filter(|f| *f != "multi-index")
    {
        let mut scene = common::scene("guided-four-bar");
        scene.outputs.clear();
        // At rest, then at 2 rad/s^2.
        scene.guides[0].law = GuideLaw::Input([0.0, 0.0, 2.0]);
        scene.initials.clear();
        let joint = scene.guides[0].joint;
        let mut simulation = simulation(&scene, formulation);
        for k in 1..=500 {
            let t = f64::from(k) * 1e-3;
            assert!(simulation.set_guide(0, [t * t, 2.0 * t, 2.0]), "{formulation}");
            simulation.step(1e-3).unwrap_or_else(|e| panic!("{formulation} at {t}: {e}"));
        }
        let joint = &scene.joints[joint];
        let BodyRef::Body(body) = joint.bodies[1] else { panic!("the crank is the second body") };
        let direction = simulation.model().direction(BodyRef::Body(body), [1.0, 0.0, 0.0]);
        let x: [f64; 2] = direction.value(&simulation.state().q).into();
        assert!((x[1].atan2(x[0]) - 0.25).abs() < 1e-12, "{formulation}: {x:?}");
    }
}
