//! Mechanisms in code equal those from files, and changes keep all other parts.

mod clock;
mod values;

use mbs::{Body, Effect, Error, Guide, Joint, Mechanism, Output};
use mbs::{FormulationKind, IntegratorKind, Method};
use mbs_core::scene::{BodyId, GROUND, JointId, Motion, Number, Scene, Signal};

fn file(name: &str) -> String {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("a scene")
}

/// Scene of a mechanism, with decimal numbers.
fn scene(m: &Mechanism) -> Scene<Number> {
    m.to_file().expect("no code").numbers().expect("a scene")
}

/// Makes the mechanism of scenes/double-pendulum.toml in code.
fn double_pendulum() -> Mechanism {
    let mut m = Mechanism::planar("double pendulum");
    m.set_gravity([0.0, -9.81]).set_duration(10.0);
    let upper = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0).named("upper"));
    let lower = m.add(Body::rod([1.0, 0.0], [2.0, 0.0], 1.0).named("lower"));
    m.add(Joint::revolute([GROUND, upper], [0.0, 0.0]).start(0.0, 0.0).named("pivot"));
    m.add(Joint::revolute([upper, lower], [1.0, 0.0]).start(0.0, 0.0).named("elbow"));
    m.add(Output::position(lower, [2.0, 0.0]).named("tip"));
    m.add(Output::position(upper, [1.0, 0.0]).named("elbow"));
    m
}

#[test]
fn a_double_pendulum_in_code_is_that_of_the_file() {
    let mut m = double_pendulum();
    m.set_method(&Method { step: Some(1e-3), ..Method::default() });
    let read = Mechanism::parse(&file("double-pendulum")).expect("a scene");
    assert_eq!(m, read);
    let again = Mechanism::parse(&m.to_toml().expect("no code")).expect("a scene");
    assert_eq!(again, read);
    assert_eq!(scene(&again).resolve::<f64>(), scene(&read).resolve::<f64>());
}

#[test]
fn paths_set_numbers_in_code_and_in_files_and_files_keep_their_comments() {
    let mut m = double_pendulum();
    m.set("body.upper.mass", 2.5).expect("a path").set("joint.elbow.at.0", 1.25).expect("a path");
    let upper: BodyId = m.find("upper").expect("a name");
    assert_eq!(m.part(upper).mass, Number::from(2.5));
    assert_eq!(m.get("joint.elbow.at[0]"), Ok(1.25));
    let text = file("double-pendulum");
    let mut read = Mechanism::parse(&text).expect("a scene");
    read.set("body.upper.mass", 2.5).expect("a path");
    assert_eq!(read.to_toml(), Ok(text.replacen("mass = 1.0", "mass = 2.5", 1)));
    let error = read.set("body.uper.mass", 1.0).expect_err("no such body");
    assert_eq!(error.code(), "unknown-path");
    assert_eq!(error.hint(), Some("did you mean `upper`?".to_owned()));
}

#[test]
fn a_method_of_a_mechanism_is_written_to_its_file_and_what_it_leaves_open_stays() {
    let mut m = Mechanism::parse(&file("double-pendulum")).expect("a scene");
    let method = Method::new(FormulationKind::Recursive).integrator(IntegratorKind::Rk4);
    m.set_method(&method);
    let written = m.to_toml().expect("no code");
    assert!(written.starts_with("# Double pendulum: two uniform rods"), "{written}");
    let solver = scene(&Mechanism::parse(&written).expect("a scene")).solver;
    assert_eq!(solver.formulation.as_deref(), Some("recursive"));
    assert_eq!(solver.integrator.as_deref(), Some("rk4"));
    assert_eq!(solver.step, Some(1e-3.into()));
}

#[test]
fn changes_by_handle_keep_the_rest_of_a_file() {
    let text = file("double-pendulum");
    let mut m = Mechanism::parse(&text).expect("a scene");
    let lower: BodyId = m.find("lower").expect("a name");
    let elbow: JointId = m.find("elbow").expect("a name");
    m.part_mut(lower).mass = 3.0.into();
    m.set_gravity([0.0, -1.62]);
    let motor = m.add(Effect::torque(elbow, Signal::input(0.5)));
    assert_eq!(m.name(motor), "effect-1");
    let written = m.to_toml().expect("no code");
    assert!(written.starts_with("# Double pendulum: two uniform rods"));
    assert!(written.contains("[0.0, -1.62]") && written.contains("mass = 3.0"), "{written}");
    assert!(written.contains("[[effect]]\nname = \"effect-1\""), "{written}");
    assert_eq!(Mechanism::parse(&written).expect("a scene"), m);
    // a change by path follows a change by handle
    m.set("effect.effect-1.value", -0.5).expect("a path");
    assert_eq!((m.part(lower).mass.to_f64(), m.get("effect.effect-1.value")), (3.0, Ok(-0.5)));
}

#[test]
fn what_is_wrong_is_named() {
    let mut m = double_pendulum();
    let bodies: Vec<BodyId> = m.ids().collect();
    m.add(Joint::revolute(bodies.clone().try_into().expect("two"), [1.0, 0.0, 0.5]).named("wrist"));
    let error = m.check().expect_err("out of the plane");
    assert_eq!((error.joint(), error.code()), (Some("wrist"), "scene-refused"));
    assert!(error.to_string().contains("`wrist`"), "{error}");
    let mut m = Mechanism::spatial("arm");
    let arm = m.add(Body::rod([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 1.0));
    m.add(Joint::spherical([GROUND, arm], [0.0, 0.0]).named("shoulder"));
    let error = m.check().expect_err("two numbers in space");
    assert_eq!(error.joint(), Some("shoulder"));
    assert!(error.to_string().contains('3') && error.to_string().contains('2'), "{error}");
    let error = m.find::<JointId>("sholder").expect_err("another name");
    assert_eq!(error.hint(), Some("did you mean `shoulder`?".to_owned()));
    assert_eq!((m.name(arm), m.name(GROUND)), ("body-1", "ground"));
    let error = Mechanism::read("nowhere.toml").expect_err("no file");
    assert_eq!(Error::code(&error), "scene-refused");
}

#[test]
fn mechanisms_are_data_of_serde_with_all_digits() {
    let mut m = double_pendulum();
    let third = Number::from_decimal("0.33333333333333333333333333333333").expect("a number");
    let elbow: JointId = m.find("elbow").expect("a name");
    m.add(Guide::new(elbow, Motion::Ramp { rate: 6.0 }));
    m.part_mut(elbow).points[0][0] = third.clone();
    m.part_mut(elbow).points[1][0] = third;
    let json = serde_json::to_string(&m).expect("data");
    assert!(json.contains("\"mass\":1.0"), "{json}");
    assert_eq!(serde_json::from_str::<Mechanism>(&json).expect("data"), m);
}
