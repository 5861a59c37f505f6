//! Units of numbers in lists, places and values: a number with a unit must have the dimensions of its key.

use super::*;

const SCENE: &str = r#"
[scene]
dimension = 2
duration = 1.0
gravity = [0.0, "-9.81 m/s^2"]

[[point]]
name = "p"
at = ["300 mm", 0.0]

[[body]]
name = "a"
mass = 1.0
center = ["500 mm", 0.0]
inertia = "0.1 kg*m^2"

[[joint]]
kind = "revolute"
name = "j"
bodies = ["ground", "a"]
at = ["400 mm", 0.0]
range = ["-90 deg", "90 deg"]

[[initial]]
joint = "j"
value = ["10 deg"]
rate = "6 rpm"

[[guide]]
joint = "j"
ramp = { rate = "60 rpm" }

[[effect]]
kind = "torque"
joint = "j"
value = "3 N*m"

[[effect]]
kind = "force"
body = "a"
at = { of = "p", plus = ["1 cm", 0.0] }
table = [["0 ms", ["1 kN", 0.0]], ["1 s", "2 N", 0.0]]

[[effect]]
kind = "bushing"
bodies = ["ground", "a"]
at = [0.0, 0.0]
stiffness = ["1 kN/m", 1.0, "2 N*m/rad"]
damping = [0.0, 0.0, 0.0]
"#;

#[test]
fn units_of_lists_places_and_values_are_those_of_their_keys() {
    let read = |text: &str| SceneFile::parse(text, "m.toml").and_then(|file| file.numbers());
    read(SCENE).unwrap_or_else(|e| panic!("{}", e.render()));
    for (right, wrong, unit) in [
        ("-9.81 m/s^2", "-9.81 kg", "m/s^2"),
        ("300 mm", "300 s", "m"),
        ("500 mm", "500 g", "m"),
        ("400 mm", "400 kg", "m"),
        ("-90 deg", "-90 mm", "rad"),
        ("10 deg", "10 mm", "rad"),
        ("6 rpm", "6 m/s", "rad/s"),
        ("60 rpm", "90 m/s", "rad/s"),
        ("3 N*m", "3 N", "N m"),
        ("1 cm", "1 N", "m"),
        ("0 ms", "0 mm", "s"),
        ("1 kN\"", "1 kg\"", "N"),
        ("2 N\"", "2 W\"", "N"),
        ("1 kN/m", "1 N*m/rad", "N/m"),
        ("2 N*m/rad", "2 N/m", "N m/rad"),
    ] {
        let error = read(&SCENE.replacen(right, wrong, 1)).expect_err(wrong);
        let end = format!("is in {unit}");
        assert!(error.fault().to_string().ends_with(&end), "{wrong}: {}", error.render());
    }
}
