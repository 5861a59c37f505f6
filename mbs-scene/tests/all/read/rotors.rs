//! Rotors: they are read and written. Invalid rotors are refused at their place.

use super::{read, refused, spoil};
use mbs_core::scene::*;
use mbs_scene::{SceneFile, to_toml};

const MOTOR: &str = r#"[scene]
dimension = 3
duration = 1
[[body]]
name = "a"
mass = 1
center = [0, 0, 0]
inertia = [1, 1, 1, 0, 0, 0]
[[joint]]
name = "elbow"
kind = "cylindrical"
bodies = ["ground", "a"]
at = [0, 0, 0]
axis = [0, 0, 1]
[[effect]]
name = "motor"
kind = "rotor"
joint = "elbow"
coordinate = "turn"
inertia = 1.0e-4
ratio = -50.0
"#;

#[test]
fn a_rotor_is_read_and_written() {
    let joint = JointId::new(0);
    let kind = Rotor { joint, coordinate: Some(1), inertia: 1e-4, ratio: -50.0 };
    assert_eq!(read(MOTOR).unwrap().effects[0].kind, EffectKind::Rotor(kind));
    let scene = SceneFile::parse(MOTOR, "m.toml").unwrap().numbers().unwrap();
    let again = SceneFile::parse(&to_toml(&scene).unwrap(), "m.toml").unwrap().numbers().unwrap();
    assert_eq!(again.effects, scene.effects);
}

#[test]
fn a_rotor_that_adds_no_inertia_is_refused_with_its_place() {
    let of = |key: &str, to: &str| spoil(MOTOR, key, to);
    for (inertia, place) in [("0", "0"), ("-1e-4", "-0.0001")] {
        let e = of("inertia = 1.0e-4", &format!("inertia = {inertia}"));
        let message = format!("`inertia` must be larger than zero, but is {place}");
        refused(&e, "20:11", &message, "larger than zero");
    }
    let e = of("ratio = -50.0", "ratio = 0.0");
    let message = "`ratio` makes an inertia of 0 at the joint: inertia times its square";
    refused(&e, "21:9", message, "how far the rotor turns for each unit");
    let e = of("ratio = -50.0", "ratio = 1e200");
    let message = "`ratio` makes an inertia of inf at the joint: inertia times its square";
    refused(&e, "21:9", message, "how far the rotor turns for each unit");
    let e = of("ratio = -50.0", "ratio = nan");
    assert!(e.to_string().starts_with("test.toml:21:9: "), "{e}");
    let e = of("ratio = -50.0\n", "");
    assert!(e.to_string().contains("`ratio`"), "{e}");
}

#[test]
fn a_rotor_names_a_coordinate_that_is_there() {
    let of = |key: &str, to: &str| spoil(MOTOR, key, to);
    let e = of("joint = \"elbow\"", "joint = \"elbo\"");
    refused(&e, "18:9", "unknown joint `elbo`", "did you mean `elbow`?");
    let e = of("coordinate = \"turn\"\n", "");
    let several = "`coordinate` is missing: the joint has `slide`, `turn`";
    refused(&e, "15:1", several, "write one of these names");
    let without = MOTOR.replace("coordinate = \"turn\"\n", "");
    let on = |kind: &str| {
        let axis = if kind == "universal" { "axes = [[1, 0, 0], [0, 1, 0]]" } else { "" };
        let text = without.replace("\"cylindrical\"", &format!("\"{kind}\""));
        read(&text.replace("axis = [0, 0, 1]", axis)).expect_err(kind)
    };
    let message = "`joint` is a joint with 3 coordinates; exactly one is needed";
    refused(&on("spherical"), "18:9", message, "revolute or prismatic");
    let message = "`joint` is a joint with 0 coordinates; exactly one is needed";
    refused(&on("weld"), "18:9", message, "revolute or prismatic");
    let message = "`coordinate` is missing: the joint has `first`, `second`";
    refused(&on("universal"), "15:1", message, "one of these names");
    let e = read(&MOTOR.replace("\"cylindrical\"", "\"free\"").replace("axis = [0, 0, 1]\n", ""));
    assert!(e.is_err_and(|e| e.to_string().contains("coordinate")), "`turn` is none of its names");
    let free = MOTOR.replace("\"cylindrical\"", "\"free\"").replace("axis = [0, 0, 1]\n", "");
    let e = read(&free.replace("\"turn\"", "\"x\"")).expect_err("nothing holds the rotor");
    refused(&e, "17:9", "`joint` is a free joint, which holds no rotor", "has an axis");
    let distance = without
        .replace("\"cylindrical\"", "\"distance\"")
        .replace("at = [0, 0, 0]\naxis = [0, 0, 1]", "points = [[0, 0, 1], [0, 0, 0]]");
    let e = read(&distance).expect_err("no coordinate");
    assert!(e.to_string().contains("0 coordinates"), "{e}");
}
