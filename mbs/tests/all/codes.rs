//! User-defined laws with data, through the main interface. They give the same motion as the library's laws in every formulation and
//! integrator. Wrong laws are refused.

use mbs::core::scene::{EffectKind, LawOnLine, Scene};
use mbs::{
    Body, BodyId, BodyLaw, Effect, EffectId, EquilibriumOptions, Error, Force, ForceLaw,
    FormulationKind, GROUND, IntegratorKind, Joint, JointId, Measured, MeasuredBody, Mechanism,
    Method, Precision, Run, Signal, Simulation, StepRule, Wrench, equilibrium, modes, run,
};

/// Force k (x - x0) + c x' of a spring and a damper.
#[derive(Debug)]
struct Spring {
    stiffness: f64,
    damping: f64,
    free: f64,
}

impl ForceLaw for Spring {
    fn evaluate(&self, at: &Measured) -> Force {
        let stretch = at.value - self.free - at.input[0];
        Force {
            force: self.stiffness * stretch + self.damping * at.rate,
            stiffness: self.stiffness,
            damping: self.damping,
            energy: 0.5 * self.stiffness * stretch * stretch,
        }
    }
}

const SPRING: Spring = Spring { stiffness: 200.0, damping: 3.0, free: 0.7 };

/// Drag force -c v and drag moment -d w, plus the input along x and about z.
#[derive(Debug)]
struct Honey {
    drag: f64,
    turning: f64,
}

impl BodyLaw for Honey {
    fn evaluate(&self, at: &MeasuredBody) -> Wrench {
        let (mut force, mut moment) =
            (at.velocity.map(|v| -self.drag * v), at.angular_velocity.map(|w| -self.turning * w));
        force[0] += at.input[0];
        moment[2] += at.input[1];
        Wrench { force, moment }
    }
}

/// Spring that returns a wrong force below a length.
#[derive(Debug)]
struct Breaking(Force, f64);

impl ForceLaw for Breaking {
    fn evaluate(&self, at: &Measured) -> Force {
        if at.value < self.1 { self.0 } else { SPRING.evaluate(at) }
    }
}

/// Formulations with each of their integrators.
fn methods() -> impl Iterator<Item = Method> {
    use IntegratorKind::{
        Extrapolation, GeneralisedAlpha, Hht, Newmark, Radau5, Rk4, Rk54, Rk853, Trapezoidal,
    };
    let slopes = [Trapezoidal, Newmark, Rk4, Rk54, Rk853, Extrapolation, Radau5].into_iter();
    let rules = [Trapezoidal, Newmark, Hht, GeneralisedAlpha];
    let natural = FormulationKind::ALL.into_iter().filter(|f| *f != FormulationKind::Recursive);
    let natural = natural.flat_map(move |f| rules.map(|rule| Method::new(f).integrator(rule)));
    natural.chain(slopes.map(|s| Method::new(FormulationKind::Recursive).integrator(s)))
}

/// A double pendulum with its elbow, without effects.
fn pendulum() -> (Mechanism, [BodyId; 2], [JointId; 2]) {
    let mut m = Mechanism::planar("double pendulum");
    m.set_gravity([0.0, -9.81]).set_duration(0.3);
    let upper = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0));
    let lower = m.add(Body::rod([1.0, 0.0], [2.0, 0.0], 1.0));
    let pivot = m.add(Joint::revolute([GROUND, upper], [0.0, 0.0]));
    let elbow = m.add(Joint::revolute([upper, lower], [1.0, 0.0]));
    (m, [upper, lower], [pivot, elbow])
}

/// The double pendulum with a spring from the ground to its end, by the library or by code.
fn on_line(law: Option<impl ForceLaw + 'static>) -> Mechanism {
    let (mut m, [_, lower], _) = pendulum();
    let ends = [(GROUND, [2.0, 1.0]), (lower, [2.0, 0.0])];
    let Spring { stiffness, damping, free } = SPRING;
    m.add(match law {
        Some(law) => Effect::law_on_line(ends, law),
        None => Effect::spring_damper(ends, stiffness, damping, free),
    });
    m
}

fn simulate(m: &Mechanism, method: &Method) -> Simulation {
    m.simulate(method).unwrap_or_else(|e| panic!("{method:?}: {e}"))
}

/// True if the energy invariant controls the lengths of the steps.
fn follows_energy(method: &Method) -> bool {
    method.formulation.as_deref() == Some(FormulationKind::MultiIndex.name())
}

/// Coordinates of all joints of a mechanism.
fn coordinates(sim: &Simulation, m: &Mechanism) -> Vec<f64> {
    m.ids::<JointId>().map(|joint| sim.value(joint)).collect()
}

/// Asserts that both mechanisms have the same motion and energies in every formulation and integrator.
fn are_the_same(library: &Mechanism, code: &Mechanism) {
    for method in methods() {
        let (mut a, mut b) = (simulate(library, &method), simulate(code, &method));
        for sim in [&mut a, &mut b] {
            sim.advance_to(0.3).unwrap_or_else(|e| panic!("{method:?}: {e}"));
        }
        // the laws differ by rounding, which grows over 300 steps with the tolerance of the iterations; the numerical derivative of V differs
        // by 1e-10 of 100 J, and multi-index chooses its steps by it
        let allowed = if follows_energy(&method) { 1e-6 } else { 1e-11 };
        for (x, y) in coordinates(&a, library).into_iter().zip(coordinates(&b, code)) {
            assert!((x - y).abs() < allowed, "{method:?}: {x} {y}");
        }
        let allowed = if follows_energy(&method) { 1e-4 } else { 1e-7 };
        let [e, f] = [a, b].map(|sim| sim.energies());
        for (x, y) in [(e.kinetic, f.kinetic), (e.potential, f.potential), (e.work, f.work)] {
            assert!((x - y).abs() < allowed, "{method:?}: {x} {y} J");
        }
    }
}

#[test]
fn a_spring_in_code_on_a_line_is_the_library_s_in_every_formulation_and_integrator() {
    are_the_same(&on_line(None::<Spring>), &on_line(Some(SPRING)));
}

#[test]
fn a_spring_in_code_on_a_joint_is_the_library_s_in_every_formulation_and_integrator() {
    let with = |effect: fn(JointId) -> Effect| {
        let (mut m, _, [_, elbow]) = pendulum();
        m.add(effect(elbow));
        m
    };
    let law = |joint| Effect::law_on_joint(joint, Spring { free: 0.2, ..SPRING });
    are_the_same(&with(|joint| Effect::torsion_spring(joint, 200.0, 3.0, 0.2)), &with(law));
}

#[test]
fn a_slider_on_a_spring_in_code_swings_as_the_closed_form_says() {
    let mut m = Mechanism::spatial("slider");
    let body = m.add(Body::spatial([0.5, 0.0, 0.0], 2.0, [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]));
    let slide = m.add(Joint::prismatic([GROUND, body], [0.0, 0.0, 0.0]).along([1.0, 0.0, 0.0]));
    m.add(Effect::law_on_joint(slide, Spring { stiffness: 50.0, damping: 0.0, free: 0.1 }));
    for method in methods() {
        let mut sim = simulate(&m, &method.step(1e-4));
        sim.advance_to(0.4).expect("regular steps");
        // x = x0 (1 - cos w t), w = 5 rad/s; steps of h have a phase error of (w h)^2 w t / 12 = 4e-8, and Newmark's damping is w h w t / 2
        let x = 0.1 * (1.0 - f64::cos(5.0 * 0.4));
        assert!((sim.value(slide) - x).abs() < 1e-4, "{}", sim.value(slide));
    }
}

#[test]
fn a_body_in_honey_slows_down_as_the_closed_form_says() {
    let mut m = Mechanism::planar("honey");
    m.set_gravity([0.0, 0.0]);
    let body = m.add(Body::planar([0.3, 0.4], 2.0, 0.5));
    let free = m.add(Joint::free([GROUND, body], [0.3, 0.4]));
    let honey = m.add(Effect::law_on_body(body, [0.3, 0.4], Honey { drag: 4.0, turning: 1.5 }));
    for method in methods() {
        let mut sim = simulate(&m, &method);
        sim.set_state(&[(free, [0.0, 0.0, 0.0].into(), [3.0, -1.0, 2.0].into())]).expect("free");
        sim.advance_to(0.5).unwrap_or_else(|e| panic!("{method:?}: {e}"));
        let rates = sim.rates(free);
        let (slower, turns) = (f64::exp(-4.0 / 2.0 * 0.5), f64::exp(-1.5 / 0.5 * 0.5));
        // errors of second order, (3/s h)^2 / 12 of 1.5, are 1e-6; Newmark's damping of first order is 3/s h / 4
        for (x, y) in rates.iter().zip([3.0 * slower, -slower, 2.0 * turns]) {
            assert!((x - y).abs() < 1e-3 * y.abs(), "{method:?}: {x} {y}");
        }
        let e = sim.energies();
        let before = 0.5 * (2.0 * 10.0 + 0.5 * 4.0);
        assert!((e.kinetic - e.work - before).abs() < 1e-2, "{method:?}: {e:?}");
        // its input acts from the next step on
        let push = sim.input_of(honey).expect("every law has one");
        sim.set_input(push, 4000.0).expect("finite");
        let v = sim.rates(free)[0];
        sim.step(1e-3).unwrap_or_else(|e| panic!("{method:?}: {e}"));
        assert!((sim.rates(free)[0] - v - 2.0).abs() < 0.02, "{method:?}");
    }
}

#[test]
fn equilibrium_modes_and_runs_see_laws_in_code() {
    let [library, code] = [on_line(None::<Spring>), on_line(Some(SPRING))];
    let rests = [&library, &code].map(|m| equilibrium(m, &EquilibriumOptions::default()));
    let [a, b] = rests.map(|rest| rest.expect("a spring holds it"));
    // the searches differ by rounding
    assert!((a.potential - b.potential).abs() < 1e-9, "{} {}", a.potential, b.potential);
    let [x, y] = [(&library, &a), (&code, &b)].map(|(m, rest)| modes(m, rest).expect("smooth"));
    assert_eq!(x.modes.len(), y.modes.len());
    for (x, y) in x.modes.iter().zip(&y.modes) {
        // numerical derivatives of forces have ten digits
        assert!((x.frequency() - y.frequency()).abs() < 1e-7, "{x:?} {y:?}");
    }
    let [a, b] = [&library, &code].map(|m| run(m, &Run::new()).expect("a run"));
    assert!(a.stop().is_none() && b.stop().is_none());
    let ends = [&a, &b].map(|r| r.table().column("joint-2").expect("an angle").last().copied());
    assert!((ends[0].unwrap_or(0.0) - ends[1].unwrap_or(1.0)).abs() < 1e-11, "{ends:?}");
    // the tree has the joints only, without the forces of effects
    assert_eq!(code.tree().expect("a tree").coordinates().len(), 2);
}

#[test]
fn every_precision_that_is_built_moves_as_doubles_do() {
    let m = on_line(Some(SPRING));
    let recursive = Method::new(FormulationKind::Recursive).integrator(IntegratorKind::Rk4);
    for method in [Method::default(), recursive] {
        let end = |precision| {
            let mut sim = m.simulate(&method.clone().precision(precision)).ok()?;
            for _ in 0..300 {
                sim.step(1e-3).unwrap_or_else(|e| panic!("{precision:?}: {e}"));
            }
            Some(coordinates(&sim, &m))
        };
        let doubles = end(Precision::F64).expect("always built");
        // the runs differ by the rounding of 300 steps; in double-double the difference is the rounding of the run in doubles
        for (precision, allowed) in [(Precision::F32, 1e-2), (Precision::DoubleDouble, 1e-9)] {
            for (x, y) in end(precision).into_iter().flatten().zip(&doubles) {
                assert!((x - y).abs() < allowed, "{precision:?}: {x} {y}");
            }
        }
    }
}

#[test]
fn the_invariant_stays_with_an_energy_and_without() {
    /// Spring whose stated energy is zero, or a tenth too large.
    #[derive(Debug)]
    struct StatedEnergy(f64);
    impl ForceLaw for StatedEnergy {
        fn evaluate(&self, at: &Measured) -> Force {
            let force = Spring { damping: 0.0, ..SPRING }.evaluate(at);
            Force { energy: self.0 * force.energy, ..force }
        }
    }
    for method in methods() {
        for share in [0.0, 1.0, 1.1] {
            let mut sim = simulate(&on_line(Some(StatedEnergy(share))), &method);
            let off = |sim: &Simulation| {
                let e = sim.energies();
                e.kinetic + e.potential - e.work
            };
            sim.step(1e-3).unwrap_or_else(|e| panic!("{method:?}: {e}"));
            let before = off(&sim);
            sim.advance_to(0.3).unwrap_or_else(|e| panic!("{method:?}: {e}"));
            // the integrators have errors of 1e-5 of 100 J, Newmark's damping 1e-2; energy that is not stored counts as work, so a wrong
            // stated energy of a spring leaves the invariant constant
            assert!((off(&sim) - before).abs() < 0.5, "{method:?}: {} J", off(&sim) - before);
        }
    }
}

#[test]
fn an_input_is_the_law_s_own_from_the_next_step_on() {
    for method in methods() {
        let (m, still) = (on_line(Some(SPRING)), on_line(Some(Spring { free: 0.9, ..SPRING })));
        let (mut sim, mut still) = (simulate(&m, &method), simulate(&still, &method));
        let effect = m.find("effect-1").expect("a name");
        let input = sim.input_of(effect).expect("every law has one");
        assert_eq!(sim.inputs().len(), 3);
        sim.set_input(input, 0.2).expect("finite");
        for sim in [&mut sim, &mut still] {
            sim.advance_to(0.05).unwrap_or_else(|e| panic!("{method:?}: {e}"));
        }
        // the steps are the same, except for their lengths in multi-index
        let elbow = m.find("joint-2").expect("a name");
        let apart = (sim.value(elbow) - still.value(elbow)).abs();
        let allowed = if follows_energy(&method) { 1e-4 } else { 1e-9 };
        assert!(apart < allowed, "{method:?}: {apart}");
        let bad = sim.set_input(input, f64::NAN).expect_err("not finite");
        assert_eq!(bad.code(), "input-refused");
    }
}

#[test]
fn a_law_that_is_not_finite_ends_the_step_with_the_name_of_its_effect() {
    let wrong = [
        Force { force: f64::NAN, ..Force::default() },
        Force { force: f64::INFINITY, ..Force::default() },
        Force { stiffness: f64::NEG_INFINITY, ..Force::default() },
        Force { energy: f64::NAN, ..Force::default() },
    ];
    let controls = [StepRule::Error, StepRule::Energy];
    let controlled = FormulationKind::ALL
        .into_iter()
        .flat_map(|f| controls.map(|rule| Method::new(f).control(rule)));
    for method in methods().chain(controlled) {
        for force in wrong {
            // the end of the pendulum starts at 1 m, and the spring lifts it
            let m = on_line(Some(Breaking(force, 0.95)));
            // not every formulation has every integrator
            let Ok(mut sim) = m.simulate(&method) else { continue };
            let error = sim.advance_to(1.0).expect_err("the law ends");
            assert_eq!(error.code(), "law-not-finite", "{method:?}: {error}");
            assert!(error.to_string().starts_with("`effect-1`: its law"), "{error}");
            let (joint, body) = (error.joint(), error.body());
            assert_eq!((joint, body), (None, None));
            let values = coordinates(&sim, &m);
            assert!(values.iter().all(|x| x.is_finite()) && sim.time() > 0.01, "{method:?}");
        }
    }
}

#[test]
fn a_law_on_a_body_that_is_not_finite_ends_the_step_too() {
    #[derive(Debug)]
    struct Late;
    impl BodyLaw for Late {
        fn evaluate(&self, at: &MeasuredBody) -> Wrench {
            let moment = [0.0, 0.0, if at.time > 0.0105 { f64::NAN } else { 1.0 }];
            Wrench { moment, ..Wrench::default() }
        }
    }
    for method in methods() {
        let (mut m, [_, lower], _) = pendulum();
        m.add(Effect::law_on_body(lower, [2.0, 0.0], Late).named("late"));
        let mut sim = simulate(&m, &method);
        let error = sim.advance_to(0.1).expect_err("the law ends");
        assert_eq!(error.code(), "law-not-finite", "{method:?}: {error}");
        assert!(error.to_string().contains("`late`"), "{error}");
        assert!((sim.time() - 0.01).abs() < 1e-3, "{method:?}: {}", sim.time());
    }
}

#[test]
fn a_law_that_is_not_finite_at_the_start_is_refused_with_the_name_of_its_effect() {
    let m = on_line(Some(Breaking(Force { force: f64::NAN, ..Force::default() }, 2.0)));
    for method in methods() {
        let error = m.simulate(&method).expect_err("no accelerations");
        assert_eq!(error.code(), "law-not-finite", "{method:?}: {error}");
        assert!(error.to_string().contains("`effect-1`"), "{error}");
    }
    let error = equilibrium(&m, &EquilibriumOptions::default()).expect_err("no forces");
    assert_eq!(error.code(), "law-not-finite");
}

#[test]
fn a_clone_shares_its_laws_and_another_law_is_another_mechanism() {
    let (m, other) = (on_line(Some(SPRING)), on_line(Some(SPRING)));
    let mut clone = m.clone();
    assert!(clone == m && other != m);
    assert!(format!("{m:?}").contains("Spring { stiffness: 200.0, damping: 3.0"), "{m:?}");
    let effect: EffectId = clone.find("effect-1").expect("a name");
    let part = clone.part_mut(effect);
    let EffectKind::LawOnLine(LawOnLine { input, .. }) = &mut part.kind else { panic!("a law") };
    *input = Signal::input(0.1);
    assert_ne!(clone, m);
    let mut sim = simulate(&clone, &Method::default());
    assert!((sim.inputs()[0].start - 0.1).abs() < 1e-15);
    assert_eq!(sim.inputs()[0].name, "effect-1.x");
    let mut copy = sim.clone();
    for sim in [&mut sim, &mut copy] {
        sim.advance_to(0.1).expect("regular steps");
    }
    assert_eq!(coordinates(&sim, &clone), coordinates(&copy, &clone));
}

#[test]
fn what_is_written_refuses_laws_in_code_by_name() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    let mut read = Mechanism::read(path).expect("a scene");
    let elbow = read.find("elbow").expect("a name");
    read.add(Effect::law_on_joint(elbow, SPRING).named("effect-1"));
    for mut m in [on_line(Some(SPRING)), read] {
        let error = m.to_toml().expect_err("code has no text");
        assert_eq!(error.code(), "not-written");
        assert!(error.to_string().contains("`effect-1`"), "{error}");
        let file = std::env::temp_dir().join("mbs-law-in-code.toml");
        assert!(m.write(&file).is_err() && !file.exists());
        let error = serde_json::to_string(&m).expect_err("code has no text").to_string();
        assert!(error.contains("`effect-1`"), "{error}");
        let error = m.set("scene.duration", 1.0).expect_err("no text to set it in");
        assert!(error.to_string().contains("`effect-1`"), "{error}");
    }
}

#[test]
fn an_export_refuses_laws_in_code_by_name() {
    let scene: Scene<f64> = {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
        let text = std::fs::read_to_string(path).expect("a scene");
        let mut scene = mbs::scene_file::SceneFile::parse(&text, "scene")
            .expect("a scene")
            .numbers()
            .expect("numbers");
        let pivot = JointId::new(0);
        scene.effects.push(Effect::law_on_joint(pivot, SPRING).named("brake"));
        scene.resolve().expect("a scene")
    };
    let method = Method::new(FormulationKind::Recursive);
    let settings = mbs::ResolvedMethod::new(&scene, &method).expect("settings");
    let error = mbs::export::export(&scene, &settings, (&[], false)).expect_err("code");
    assert!(error.to_string().contains("`brake`"), "{error}");
}
