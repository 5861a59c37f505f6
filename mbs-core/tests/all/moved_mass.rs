//! Mass that a joint coordinate moves alone, compared with closed forms, and stops whose stiffness follows from it.

use crate::small::{GROUND, add_body, add_joint, scene};
use mbs_core::effects::Rotor;
use mbs_core::scene::{
    Coupling, CouplingMeasure, CouplingTerm, Dimension, Effect, EffectKind, Guide, Inertia,
    JointId, JointKind, Motion, Number, Scene, SceneFault,
};
use mbs_core::start::moved_mass;
use mbs_scene::SceneFile;

/// Allowed relative error of the mass. It follows from an energy, which has twice the error of the velocities. The iterations for
/// the velocities end at rounding errors.
const EXACT: f64 = 1e-9;

fn is_near(found: Option<f64>, expected: f64) {
    let found = found.expect("a mass");
    assert!((found - expected).abs() <= EXACT * expected, "{found:.15}, not {expected:.15}");
}

const TURN: [Option<[f64; 3]>; 2] = [Some([0.0, 0.0, 1.0]), None];

#[test]
fn a_hinge_moves_the_inertia_about_it_and_what_follows() {
    let mut s = scene(Dimension::Spatial, [0.0; 3]);
    let inertia = Inertia::Spatial([0.7, 0.8, 0.4, 0.0, 0.0, 0.0]);
    let body = add_body(&mut s, 2.0, [0.5, 0.0, 0.0], inertia);
    add_joint(&mut s, JointKind::Revolute, [GROUND, body], [0.0; 3], TURN);
    is_near(moved_mass(&s, (JointId::new(0), 0)), 0.9);
    // another body on a hinge at its centre of mass is moved without rotation
    let next = add_body(&mut s, 3.0, [1.0, 0.0, 0.0], inertia);
    add_joint(&mut s, JointKind::Revolute, [body, next], [1.0, 0.0, 0.0], TURN);
    is_near(moved_mass(&s, (JointId::new(0), 0)), 0.9 + 3.0);
    // fixed by a guide relative to the first body, it rotates with it
    let held = Guide { joint: JointId::new(1), number: 0, law: Motion::Ramp { rate: 5.0 } };
    s.guides.push(held);
    is_near(moved_mass(&s, (JointId::new(0), 0)), 0.9 + 3.0 + 0.4);
    assert_eq!(moved_mass(&s, (JointId::new(1), 0)), None, "a guided coordinate moves nothing");
}

#[test]
fn a_rotor_behind_a_ratio_is_moved_too() {
    let mut s = scene(Dimension::Planar, [0.0; 3]);
    let wheel = add_body(&mut s, 1.0, [0.0; 3], Inertia::Planar(0.3));
    add_joint(&mut s, JointKind::Revolute, [GROUND, wheel], [0.0; 3], [None; 2]);
    let rotor = Rotor { joint: JointId::new(0), coordinate: None, inertia: 1e-3, ratio: -20.0 };
    let effect = |enabled| Effect { name: "motor".into(), enabled, kind: rotor.clone().into() };
    s.effects.push(effect(false));
    is_near(moved_mass(&s, (JointId::new(0), 0)), 0.3);
    s.effects.push(effect(true));
    is_near(moved_mass(&s, (JointId::new(0), 0)), 0.3 + 0.4);
}

#[test]
fn free_bodies_share_and_gears_reflect() {
    let mut s = scene(Dimension::Planar, [0.0; 3]);
    let [i1, i2] = [0.3, 0.5];
    let a = add_body(&mut s, 1.0, [0.0; 3], Inertia::Planar(i1));
    let b = add_body(&mut s, 2.0, [0.0; 3], Inertia::Planar(i2));
    // two bodies on one hinge at their centres have the reduced inertia
    add_joint(&mut s, JointKind::Revolute, [a, b], [0.0; 3], [None; 2]);
    is_near(moved_mass(&s, (JointId::new(0), 0)), i1 * i2 / (i1 + i2));
    let mut geared = scene(Dimension::Planar, [0.0; 3]);
    for (x, inertia) in [(0.0, i1), (1.0, i2)] {
        let wheel = add_body(&mut geared, 1.0, [x, 0.0, 0.0], Inertia::Planar(inertia));
        add_joint(&mut geared, JointKind::Revolute, [GROUND, wheel], [x, 0.0, 0.0], [None; 2]);
    }
    let term = |joint, factor| CouplingTerm {
        factor,
        of: CouplingMeasure::Coordinate { joint: JointId::new(joint), number: 0 },
        curve: None,
    };
    let terms = vec![term(0, 20.0), term(1, 40.0)];
    geared.couplings.push(Coupling { name: "k".into(), ..Coupling::sum(terms, 0.7) });
    is_near(moved_mass(&geared, (JointId::new(0), 0)), i1 + 0.25 * i2);
    is_near(moved_mass(&geared, (JointId::new(1), 0)), i2 + 4.0 * i1);
}

/// Scene of two crossed slides: the upper one carries 1 kg, the lower one both bodies.
const SLIDES: &str = r#"
[scene]
dimension = 2
duration = 1.0
[[body]]
name = "lower"
mass = 3.0
center = [0.0, 0.0]
inertia = 0.1
[[body]]
name = "upper"
mass = 1.0
center = [0.0, 0.0]
inertia = 0.1
[[joint]]
name = "x"
kind = "prismatic"
bodies = ["ground", "lower"]
at = [0.0, 0.0]
axis = [1.0, 0.0]
range = [-0.5, 0.25]
[[joint]]
name = "y"
kind = "prismatic"
bodies = ["lower", "upper"]
at = [0.0, 0.0]
axis = [0.0, 1.0]
[[effect]]
kind = "limit"
"#;

fn numbers(limit: &str) -> Result<Scene<Number>, mbs_scene::ReadError> {
    SceneFile::parse(&format!("{SLIDES}{limit}\n"), "test.toml")?.numbers()
}

#[test]
fn what_a_limit_leaves_out_follows_from_its_joint() {
    for (limit, ends, expected) in [
        ("joint = \"x\"\nrange = true", [-0.5, 0.25], [4.0 / 4e-4, 8.0 / 0.02]),
        ("joint = \"y\"\nlower = -1\nupper = 2", [-1.0, 2.0], [1.0 / 4e-4, 2.0 / 0.02]),
        ("joint = \"y\"\nlower = -1\nupper = 2\nstiffness = 5", [-1.0, 2.0], [5.0, 0.0]),
        ("joint = \"x\"\nrange = true\ndamping = 7", [-0.5, 0.25], [4.0 / 4e-4, 7.0]),
    ] {
        let source = numbers(limit).unwrap_or_else(|e| panic!("{}", e.render()));
        let scene = source.resolve::<f64>().expect("a scene");
        let EffectKind::Limit(found) = &scene.effects[0].kind else { panic!("a limit") };
        assert_eq!(found.ends(&scene.joints), Some(ends), "{limit}");
        for (found, expected) in [found.stiffness, found.damping].into_iter().zip(expected) {
            assert!((found - expected).abs() <= EXACT * expected, "{limit}: {found}");
        }
        // a key that is left out is not written
        let text = mbs_scene::to_toml(&source).expect("a text");
        let again = SceneFile::parse(&text, "x").and_then(|file| file.numbers()).expect("a scene");
        assert_eq!(again.resolve::<f64>().expect("a scene"), scene, "{text}");
        assert_eq!(text.contains("\nstiffness"), limit.contains("stiffness"), "{text}");
    }
}

#[test]
fn limits_without_a_range_or_a_mass_are_refused_by_name() {
    let fault = |limit: &str| numbers(limit).expect("it reads").resolve::<f64>().expect_err(limit);
    let e = fault("joint = \"y\"\nrange = true");
    assert_eq!((e.field, e.fault), ("range", SceneFault::NoRange));
    let guide = "joint = \"x\"\nrange = true\n[[guide]]\njoint = \"x\"\nramp = { rate = 1 }";
    let e = fault(guide);
    assert_eq!((e.field, e.fault), ("stiffness", SceneFault::NoMovedMass));
    let e = numbers("joint = \"x\"\nrange = true\nlower = 1").expect_err("both");
    assert_eq!(e.to_string(), "test.toml:32:9: both `range` and `lower` are given");
    let e = numbers("joint = \"x\"\nlower = 1").expect_err("one end");
    assert!(e.to_string().contains("`upper` is missing"), "{e}");
}
