//! Named signals: as inline functions of time, against closed forms, and set between steps.

use crate::common;
use mbs::core::scene::{
    Interpolation, Motion, NamedSignal, Scene, Signal, SignalId, SignalKind, TableEnds,
};
use mbs::scene_file::SceneFile;
use mbs::typed::Simulation;
use mbs::{
    InputOwner, InputTable, InputTableError, Mechanism, Method, ResolvedMethod, SimulationError,
};
use mbs_testkit::scene;

/// Simulations of every formulation with the trapezoidal rule and fixed steps.
fn simulations<'a>(
    scene: &'a Scene<f64>,
) -> impl Iterator<Item = (&'static str, Simulation<f64, 2>)> + 'a {
    common::with_fixed_steps().map(move |formulation| {
        let method =
            Method { formulation: Some(formulation.into()), step: Some(1e-3), ..Method::default() };
        let settings = ResolvedMethod::new(scene, &method).expect("the settings are built");
        (formulation, Simulation::new(scene, &settings).expect("the scene starts"))
    })
}

fn push(scene: &mut Scene<f64>, name: &str, kind: SignalKind<f64>) -> SignalId {
    scene.signals.push(NamedSignal { name: name.into(), kind });
    SignalId::new(scene.signals.len() - 1)
}

#[test]
fn a_guide_by_a_signal_moves_as_the_guide_inline_to_the_last_bit() {
    let rows = vec![[0.0, 0.0], [0.2, 0.1], [0.3, 0.4], [1.0, 0.9]];
    let (amplitude, frequency, phase) = (0.3, 1.7, 0.4);
    let laws = [
        (
            Motion::Table { rows: rows.clone(), ends: TableEnds::Level },
            SignalKind::Table {
                rows,
                interpolation: Interpolation::Spline(TableEnds::Level),
                periodic: false,
            },
        ),
        (
            Motion::Sine { amplitude, frequency, phase },
            SignalKind::Sine { amplitude, frequency, phase, offset: 0.0 },
        ),
        (
            Motion::Ramp { rate: 1.5 },
            SignalKind::Ramp { rate: 1.5, start: 0.0, end: None, rounding: 0.0 },
        ),
    ];
    for (law, kind) in laws {
        let mut inline = common::scene("guided-four-bar");
        inline.outputs.clear();
        inline.initials.clear();
        let mut named = inline.clone();
        inline.guides[0].law = law;
        named.guides[0].law = Motion::Signal(push(&mut named, "target", kind));
        named.check().expect("a smooth signal");
        for ((formulation, mut a), (_, mut b)) in simulations(&inline).zip(simulations(&named)) {
            for _ in 0..50 {
                a.step(1e-3).expect("a regular step");
                b.step(1e-3).expect("a regular step");
            }
            assert_eq!(a.state().q, b.state().q, "{formulation}");
            let energies = [a.energies(), b.energies()].map(|all| all.map(f64::to_bits));
            assert_eq!(energies[0], energies[1], "{formulation}");
            assert_eq!(a.coordinate(0, 0), b.coordinate(0, 0), "{formulation}");
        }
    }
}

/// Scene of a wheel of 2 kg m^2 at rest on a fixed axle, with a torque that follows a signal.
const WHEEL: &str = r#"[scene]
dimension = 2
duration = 1.0
[[body]]
name = "wheel"
mass = 1.0
center = [0.0, 0.0]
inertia = 2.0
[[joint]]
name = "axle"
kind = "revolute"
bodies = ["ground", "wheel"]
at = [0.0, 0.0]
[[initial]]
joint = "axle"
value = 0.0
rate = 0.0
"#;

#[test]
fn a_torque_by_the_sum_of_two_signals_meets_the_closed_form() {
    let text = format!(
        "{WHEEL}[[effect]]\nkind = \"torque\"\njoint = \"axle\"\nsignal = \"both\"\n\
         [[signal]]\nname = \"both\"\nkind = \"sum\"\nof = [\"still\", \"rising\"]\nfactors = [2, -0.5]\n\
         [[signal]]\nname = \"still\"\nkind = \"constant\"\nvalue = 3\n\
         [[signal]]\nname = \"rising\"\nkind = \"ramp\"\nrate = 4\n"
    );
    let scene = scene(&text);
    for (formulation, mut simulation) in simulations(&scene) {
        for _ in 0..1000 {
            simulation.step(1e-3).expect("a regular step");
        }
        // a torque of 6 - 2 t on 2 kg m^2: rate 3 t - t^2/2, angle 3/2 t^2 - t^3/6; the work is the kinetic energy
        let motion = simulation.model().motion(&scene, 0, simulation.state());
        let (rate, angle) =
            (motion.omega[2], motion.rotation[(1, 0)].atan2(motion.rotation[(0, 0)]));
        // the rule is exact for a torque that is linear in time; rotating natural coordinates have an error of (h w)^2 = 6e-6
        let is_exact = formulation == "recursive";
        let allowed = if is_exact { 1e-9 } else { 1e-5 };
        assert!((rate - 2.5).abs() < allowed, "{formulation}: {rate} rad/s");
        // the rule has an error of h^2/12 times the third derivative
        assert!((angle - 4.0 / 3.0).abs() < allowed.max(2e-7), "{formulation}: {angle} rad");
        let [kinetic, _, work] = simulation.energies();
        let off = (kinetic - 6.25).abs().max((work - 6.25).abs());
        assert!(off < 10.0 * allowed.max(1e-6), "{formulation}: {kinetic} and {work} J");
    }
}

#[test]
fn a_force_by_two_signals_is_the_force_by_its_table() {
    let mut inline = common::scene("double-pendulum");
    inline.outputs.clear();
    let mut named = inline.clone();
    let rows = [[0.0, 1.0], [0.02, -3.0], [0.08, 5.0]];
    let signals = [1.0, -0.5].map(|factor| {
        let rows = rows.map(|[t, x]| [t, factor * x]).to_vec();
        let kind =
            SignalKind::Table { rows, interpolation: Interpolation::Linear, periodic: false };
        Some(push(&mut named, &format!("{factor}"), kind))
    });
    let vector = |[t, x]: [f64; 2]| (t, [x, -0.5 * x, 0.0]);
    let force = |course| mbs::core::scene::Effect {
        name: "push".into(),
        enabled: true,
        kind: mbs::core::scene::Force {
            body: mbs::BodyId::Body(1),
            at: [2.0, 0.0, 0.0],
            course,
            frame: mbs::core::scene::AxisFrame::Body,
        }
        .into(),
    };
    inline.effects.push(force(Signal::Table(rows.map(vector).to_vec())));
    named.effects.push(force(Signal::Named([signals[0], signals[1], None])));
    for ((formulation, mut a), (_, mut b)) in simulations(&inline).zip(simulations(&named)) {
        for _ in 0..100 {
            a.step(1e-3).expect("a regular step");
            b.step(1e-3).expect("a regular step");
        }
        assert_eq!(a.state().q, b.state().q, "{formulation}");
    }
}

#[test]
fn a_coupling_by_a_signal_moves_as_the_coupling_inline() {
    let with = |law: &str| {
        scene(&format!(
            "{WHEEL}[[coupling]]\nname = \"c\"\nkind = \"linear\"\nterms = [{{ joint = \"axle\", factor = 2 }}]\nvalue = 0.1\n{law}\n"
        ).replace("value = 0.0\nrate = 0.0", "value = 0.05"))
    };
    let inline = with("sine = { amplitude = 0.3, frequency = 2, phase = 0 }");
    let named = with(
        "signal = \"wave\"\n[[signal]]\nname = \"wave\"\nkind = \"sine\"\namplitude = 0.3\nfrequency = 2",
    );
    for formulation in ["index-1", "index-3", "classical", "state-space"] {
        let [mut a, mut b] = [&inline, &named].map(|scene| {
            let method = Method { formulation: Some(formulation.into()), ..Method::default() };
            let settings = ResolvedMethod::new(scene, &method).expect("the settings are built");
            Simulation::<f64, 2>::new(scene, &settings).expect("the scene starts")
        });
        for _ in 0..60 {
            a.step(1e-3).expect("a regular step");
            b.step(1e-3).expect("a regular step");
        }
        assert_eq!(a.state().q, b.state().q, "{formulation}");
        assert_eq!(a.state().v, b.state().v, "{formulation}");
    }
}

#[test]
fn a_signal_that_is_an_input_is_set_by_its_name() {
    let text = format!(
        "{WHEEL}[[effect]]\nkind = \"torque\"\njoint = \"axle\"\nsignal = \"torque\"\n\
         [[signal]]\nname = \"torque\"\nkind = \"product\"\nof = [\"throttle\", \"most\"]\n\
         [[signal]]\nname = \"throttle\"\nkind = \"input\"\nvalue = 0.5\nunit = \"1\"\n\
         [[signal]]\nname = \"most\"\nkind = \"constant\"\nvalue = 4\n"
    );
    let mechanism = Mechanism::parse(&text).expect("a scene");
    for formulation in ["index-1", "index-3", "classical", "state-space", "recursive"] {
        let method = Method { formulation: Some(formulation.into()), ..Method::default() };
        let mut simulation = mechanism.simulate(&method).expect("it starts");
        let [info] = simulation.inputs() else { panic!("one input") };
        assert_eq!((info.name.as_str(), info.unit.as_str(), info.start), ("throttle", "1", 0.5));
        assert_eq!(info.owner, InputOwner::Signal(SignalId::new(1)));
        simulation.advance_to(0.5).expect("a regular run");
        let axle = mechanism.find::<mbs::JointId>("axle").expect("a joint");
        // 2 N m on 2 kg m^2, then -4 N m from the next step on; (h w)^2 is 3e-7
        let is_near = |rate: f64, expected: f64| {
            assert!((rate - expected).abs() < 1e-6, "{formulation}: {rate} rad/s");
        };
        is_near(simulation.rate(axle), 0.5);
        let saved = simulation.save().expect("a snapshot");
        simulation.set_inputs(&[-1.0]).expect("an input");
        simulation.advance_to(0.75).expect("a regular run");
        is_near(simulation.rate(axle), 0.0);
        let end = simulation.save().expect("a snapshot");
        simulation.restore(&saved).expect("its own snapshot");
        simulation.set_inputs(&[-1.0]).expect("an input");
        simulation.restore(&end).expect("its own snapshot");
        simulation.advance_to(1.0).expect("a regular run");
        is_near(simulation.rate(axle), -0.5);
        simulation.set_inputs(&[f64::NAN]).expect_err("no number");
    }
}

#[test]
fn tables_for_controllers_have_signals_and_refuse_waves_by_name() {
    let with = |kind: &str| {
        let effect = "[[effect]]\nkind = \"torque\"\njoint = \"axle\"\nsignal = \"drive\"\n";
        scene(&format!("{WHEEL}{effect}[[signal]]\nname = \"drive\"\n{kind}\n"))
    };
    let export = |scene: &Scene<f64>| {
        let method = Method { formulation: Some("recursive".into()), ..Method::default() };
        let settings = ResolvedMethod::new(scene, &method).expect("the settings are built");
        mbs::export::export(scene, &settings, (&[], false))
    };
    let named = export(&with("kind = \"constant\"\nvalue = 3")).expect("tables");
    assert!(named.rust.contains("Constant([3.0, 0.0, 0.0])"), "{}", named.rust);
    let input = export(&with("kind = \"input\"\nvalue = 3")).expect("tables");
    assert!(input.rust.contains("Input([3.0, 0.0, 0.0])"), "{}", input.rust);
    let wave = "kind = \"sine\"\namplitude = 3\nfrequency = 1";
    let refused = export(&with(wave)).expect_err("a wave").to_string();
    assert!(refused.starts_with("signal `drive` cannot be written for a controller"), "{refused}");
}

/// Scene of a wheel with a torque on its axle, which follows a signal.
fn motor(course: &str) -> String {
    format!("{WHEEL}[[effect]]\nname = \"motor\"\nkind = \"torque\"\njoint = \"axle\"\n{course}\n")
}

/// Mechanism whose inputs follow a table in CSV.
fn following(document: SceneFile, csv: &[u8], file: &str) -> Result<Mechanism, SimulationError> {
    Mechanism::of_file(document).expect("a scene").following(&InputTable::csv(csv, file))
}

#[test]
fn inputs_that_follow_a_file_are_the_tables_of_it() {
    let file = |text: &str| SceneFile::parse(text, "wheel.toml").expect("TOML");
    let document = file(&motor("value = 7\ninput = true"));
    let csv = "t, motor\n0.1,0\n0.25, 1.5 # no\n".replace(" # no", "");
    let followed = following(document, csv.as_bytes(), "motor.csv").expect("a table");
    let inline = file(&motor("table = [[0.1, 0], [0.25, 1.5]]")).scene::<f64>().expect("a scene");
    assert_eq!(followed.resolve().expect("a scene"), inline);
    let of_signal = "signal = \"s\"\n[[signal]]\nname = \"s\"\nkind = \"input\"\n";
    let document = file(&motor(of_signal));
    let followed = following(document, b"t,s\n0.1,0\n0.25,1.5\n", "s.csv").expect("a table");
    let named = followed.resolve().expect("a scene");
    for ((formulation, mut a), (_, mut b)) in simulations(&inline).zip(simulations(&named)) {
        for _ in 0..300 {
            a.step(1e-3).expect("a regular step");
            b.step(1e-3).expect("a regular step");
        }
        assert_eq!(a.state().q, b.state().q, "{formulation}");
    }
    let of_guide = "[[guide]]\njoint = \"axle\"\ninput = { value = 0 }\n";
    let document = file(&format!("{}{of_guide}", WHEEL.replace("rate = 0.0\n", "")));
    let followed = following(document, b"t,axle\n0,0\n1,1\n2,4\n", "axle.csv").expect("a table");
    let law = &followed.resolve().expect("a scene").guides[0].law;
    let rows = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 4.0]];
    assert_eq!(*law, Motion::Table { rows, ends: TableEnds::Natural });
}

#[test]
fn tables_of_inputs_that_cannot_be_meant_are_refused_at_their_place() {
    let document = SceneFile::parse(&motor("value = 7\ninput = true"), "wheel.toml").expect("TOML");
    for (csv, message) in [
        ("t,moter\n0,1\n", "1:3: unknown input `moter`"),
        ("time,motor\n0,1\n", "1:1: the first column is `time`, not `t`"),
        ("motor\n0\n", "1:1: the first column is `motor`, not `t`"),
        ("t,motor\n0,1\n1,2\n1,3\n", "4:1: the time `1` is not after that before it"),
        ("t,motor\n0,1\n1,2e\n", "3:3: `2e` is not a finite number"),
        ("t,motor\n0,1\nnan,2\n", "3:1: `nan` is not a finite number"),
        ("t,motor\n0,1\n1\n", "3:1: expected 2 numbers, found 1"),
        ("t,motor\n0,1,2\n", "2:3: expected 2 numbers, found 3"),
        ("t,motor,motor\n0,1,2\n", "1:9: `motor` has two columns"),
        ("t,motor\n", "1:1: there is no row of values"),
        ("t\n0\n", "1:1: there is no input beside `t`"),
        ("", "1:1: there is no row of values"),
    ] {
        let refused = following(document.clone(), csv.as_bytes(), "m.csv").expect_err(csv);
        let refused = refused.cause::<InputTableError>().expect("a table").clone();
        assert_eq!(refused.to_string(), format!("m.csv:{message}"));
        let InputTableError::Table { hint, .. } = refused else { panic!("a table") };
        assert!(!hint.is_empty(), "{csv}");
    }
}
