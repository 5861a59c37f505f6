//! Scenes of the format: each error has its exact place, and no input causes a panic.
#![allow(clippy::float_cmp, reason = "numbers are read exactly")]

use mbs_core::scene::*;
use mbs_scene::{ReadError, ReadFault, SceneFile, to_toml};

mod balls;
mod columns;
mod couplings;
mod edit;
mod effects;
mod expression;
mod expressions;
mod frames;
mod guides;
mod hints;
mod includes;
mod limits;
mod measured;
mod nearest;
mod outputs;
mod path;
mod points;
mod points_by_name;
mod random;
mod road;
mod rotors;
mod same;
mod set;
mod shapes;
mod signals;
mod slips;
mod sums;
mod sweep;
mod tables;
mod units;
mod values;

const PLANAR: &str = r#"[scene]
name = "double pendulum"
dimension = 2
gravity = [0.0, -9.81]
duration = 10.0

[[body]]
name = "upper"
rod = { from = [0.0, 0.0], to = [1.0, 0.0] }
mass = 1.0

[[body]]
name = "lower"
mass = 1.0
center = [1.5, 0.0]
inertia = 0.08333333333333333

[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "upper"]
at = [0.0, 0.0]

[[joint]]
name = "elbow"
kind = "revolute"
bodies = ["upper", "lower"]
at = [1.0, 0.0]

[[initial]]
joint = "pivot"
value = 0.1
rate = 0.0

[[initial]]
body = "lower"
at = [2.0, 0.0]
velocity = [0.0, 0.0]

[[guide]]
joint = "elbow"
sine = { amplitude = 0.05, frequency = 0.5, phase = 0.0 }

[[effect]]
name = "strut"
kind = "spring-damper"
bodies = ["ground", "lower"]
points = [[2.0, 1.0], [2.0, 0.0]]
stiffness = 35900.0
damping = 1000.0
free_length = 0.5

[[effect]]
kind = "torque"
joint = "pivot"
table = [[0.0, 1.0], [1.0, 2.0]]
enabled = false

[solver]
formulation = "auto"
step = 1.0e-3
tolerance = 1.0e-10
penalty = 1.0e7

[[output]]
name = "tip"
body = "lower"
at = [2.0, 0.0]
quantity = "position"
"#;

const SPATIAL: &str = r#"[scene]
dimension = 3
duration = 1
[[body]]
name = "a"
mass = 2
center = [0, 0, 1]
inertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]
[[body]]
name = "b"
mass = 0
[[joint]]
name = "cross"
kind = "universal"
bodies = ["ground", "a"]
at = [0, 0, 0]
axes = [[1, 0, 0], [0, 1, 0]]
[[joint]]
name = "table"
kind = "planar"
bodies = ["a", "b"]
at = [0, 0, 0]
axis = [0, 0, 1]
direction = [1, 0, 0]
[[joint]]
name = "drift"
kind = "free"
bodies = ["ground", "a"]
[[joint]]
name = "link"
kind = "distance"
bodies = ["ground", "b"]
points = [[0, 0, 0], [1, 0, 0]]
axis = [0, 1, 0]
[[effect]]
kind = "force"
body = "a"
at = [0, 0, 1]
table = [[0, 1, 2, 3], [1, [4, 5, 6]]]
frame = "body"
"#;

fn read(text: &str) -> Result<Scene<f64>, ReadError> {
    SceneFile::parse(text, "test.toml")?.scene()
}

/// The error of the planar scene with one passage replaced.
fn spoiled(from: &str, to: &str) -> ReadError {
    spoil(PLANAR, from, to)
}

fn spoil(scene: &str, from: &str, to: &str) -> ReadError {
    assert_eq!(scene.matches(from).count(), 1, "{from} stands once in the scene");
    read(&scene.replacen(from, to, 1)).expect_err(to)
}

/// The beginning of a spatial scene, with three bodies.
const THREE_BODIES: &str = r#"[scene]
dimension = 3
duration = 1.0
[[body]]
name = "w"
mass = 1.0
center = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[body]]
name = "v"
mass = 1.0
center = [1.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[body]]
name = "u"
mass = 1.0
center = [2.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
"#;

/// Asserts that an error has this place, message and hint.
fn refused(error: &ReadError, place: &str, message: &str, hint: &str) {
    let expected = format!("test.toml:{place}: {message}");
    assert_eq!(error.to_string(), expected);
    assert!(error.hint().contains(hint), "{} <> {hint}", error.hint());
}

#[test]
fn the_planar_scene_of_the_format_is_read() {
    let scene = read(PLANAR).unwrap();
    assert_eq!(scene.name, "double pendulum");
    assert_eq!(scene.gravity, Some([0.0, -9.81, 0.0]));
    assert_eq!(scene.bodies[0].center, [0.5, 0.0, 0.0]);
    assert_eq!(scene.joints[1].bodies, [BodyId::Body(0), BodyId::Body(1)]);
    assert_eq!(scene.effects[1].name, "effect-2");
    assert!(!scene.effects[1].enabled);
    assert_eq!(scene.solver.formulation.as_deref(), Some("auto"));
    assert_eq!(
        scene.outputs[0].quantity,
        Quantity::Position { body: BodyId::Body(1), at: [2.0, 0.0, 0.0] }
    );
    let velocity = Some(([2.0, 0.0, 0.0], [0.0; 3]));
    let expected = InitialTarget::Body { body: BodyId::Body(1), velocity, angular_velocity: None };
    assert_eq!(scene.initials[1].target, expected);
}

#[test]
fn the_spatial_kinds_are_read() {
    let scene = read(SPATIAL).unwrap();
    assert_eq!(scene.name, "test");
    assert_eq!(scene.gravity, None);
    assert_eq!(scene.joints[0].axes, [Some([1.0, 0.0, 0.0]), Some([0.0, 1.0, 0.0])]);
    assert_eq!(scene.joints[1].axes, [Some([0.0, 0.0, 1.0]), Some([1.0, 0.0, 0.0])]);
    assert_eq!(scene.joints[2].points, [[0.0, 0.0, 1.0]; 2]);
    assert_eq!(scene.joints[3].points, [[0.0; 3], [1.0, 0.0, 0.0]]);
    let EffectKind::Force(Force { course, frame, .. }) = &scene.effects[0].kind else { panic!() };
    let rows = vec![(0.0, [1.0, 2.0, 3.0]), (1.0, [4.0, 5.0, 6.0])];
    assert_eq!((course, *frame), (&Signal::Table(rows), AxisFrame::Body));
}

#[test]
fn numbers_keep_their_decimal_text_until_the_precision_is_known() {
    let document = SceneFile::parse(PLANAR, "x").unwrap();
    assert_eq!(
        document.scene::<f32>().unwrap().gravity.unwrap()[1].to_bits(),
        (-9.81_f32).to_bits()
    );
    assert_eq!(
        document.scene::<f64>().unwrap().gravity.unwrap()[1].to_bits(),
        (-9.81_f64).to_bits()
    );
    // A halfway case: by way of f64 this text would be rounded to 1.0 in f32.
    let text = PLANAR.replace("duration = 10.0", "duration = 1.00000005960464477540");
    let document = SceneFile::parse(&text, "x").unwrap();
    assert_eq!(document.scene::<f32>().unwrap().duration.to_bits(), 1.000_000_1_f32.to_bits());
    let text = PLANAR.replace("duration = 10.0", "duration = 1_0.2_5e+0_1");
    assert_eq!(read(&text).unwrap().duration.to_bits(), 102.5_f64.to_bits());
    let text = PLANAR.replace("duration = 10.0", "duration = 0xF_F");
    assert_eq!(read(&text).unwrap().duration.to_bits(), 255.0_f64.to_bits());
}

#[test]
fn unknown_words_are_refused_with_the_nearest_name() {
    let e = spoiled("rate = 0.0\n", "rat = 0.0\n");
    refused(&e, "33:1", "unknown key `rat`", "did you mean `rate`?");
    let e = spoiled("[solver]", "[solvr]");
    refused(&e, "59:2", "unknown key `solvr`", "did you mean `solver`?");
    let e = spoiled("[\"upper\", \"lower\"]", "[\"uper\", \"lower\"]");
    refused(&e, "27:11", "unknown body `uper`", "did you mean `upper`?");
    let e = spoiled("joint = \"elbow\"", "joint = \"ellbow\"");
    refused(&e, "41:9", "unknown joint `ellbow`", "did you mean `elbow`?");
    let e = spoiled("name = \"pivot\"\nkind = \"revolute\"", "name = \"pivot\"\nkind = \"hinge\"");
    refused(&e, "20:8", "unknown kind `hinge`", "did you mean `revolute`?");
    let e = spoiled("name = \"pivot\"\nkind = \"revolute\"", "name = \"pivot\"\nkind = \"cone\"");
    refused(&e, "20:8", "unknown kind `cone`", "choices: revolute, spherical");
    let e = spoiled("quantity = \"position\"", "quantity = \"positon\"");
    refused(&e, "69:12", "unknown quantity `positon`", "did you mean `position`?");
    let e = spoiled("dimension = 2", "dimension = 4");
    refused(&e, "3:13", "unknown dimension `4`", "choices: 2, 3");
    let e = spoiled("phase = 0.0", "fase = 0.0");
    refused(&e, "42:45", "unknown key `fase`", "did you mean `phase`?");
}

#[test]
fn tables_of_guides_end_as_is_written_beside_them() {
    let guide = |more: &str| {
        let text =
            PLANAR.replace("sine = { amplitude = 0.05, frequency = 0.5, phase = 0.0 }", more);
        assert_ne!(text, PLANAR);
        read(&text)
    };
    let table = "table = [[0.0, 0.0], [1.0, 0.1]]";
    for (ends, expected) in [
        ("", TableEnds::Natural),
        ("ends = \"natural\"", TableEnds::Natural),
        ("ends = \"level\"", TableEnds::Level),
    ] {
        let scene = guide(&format!("{table}\n{ends}")).expect("both words are known");
        let rows = vec![[0.0, 0.0], [1.0, 0.1]];
        assert_eq!(scene.guides[0].law, Motion::Table { rows, ends: expected });
    }
    let e = guide(&format!("{table}\nends = \"levl\"")).unwrap_err();
    refused(&e, "43:8", "unknown ends `levl`", "did you mean `level`?");
    let e = guide("ramp = { rate = 1.0 }\nends = \"level\"").unwrap_err();
    refused(&e, "43:1", "`ends` has no meaning here", "remove it");
}

#[test]
fn types_counts_and_missing_keys_have_places() {
    let e = spoiled("duration = 10.0\n", "");
    refused(&e, "1:1", "`duration` is missing", "add `duration`");
    let e = spoiled("duration = 10.0", "duration = \"ten\"");
    refused(&e, "5:13", "`ten` is no parameter", "write a number");
    let e = spoiled("duration = 10.0", "duration = \"10 m\"");
    refused(&e, "5:12", "`10 m` is a length, `duration` is in s", "write a number in s");
    let e = spoiled("duration = 10.0", "duration = 10.0 s");
    assert!(e.hint().starts_with("write 10.0,"), "{e} {}", e.hint());
    let e = spoiled("center = [1.5, 0.0]", "center = [\"1500 furlongs\", 0.0]");
    refused(&e, "15:17", "`furlongs` is no unit", "`1500*furlongs`");
    let e = spoiled("-9.81]", "-9.81, 0.0, 0.0]");
    refused(&e, "4:11", "expected 2 entries, found 4", "write 2");
    let e = spoiled("-9.81]", "-9.81, 0.5]");
    refused(&e, "4:11", "`gravity` leaves the plane of a planar scene by 0.5", "x-y plane");
    let e = spoiled("duration = 10.0", "duration = inf");
    refused(&e, "5:12", "`inf` is not a finite number", "finite");
    let e = spoiled("damping = 1000.0", "damping = 1e999");
    refused(&e, "50:11", "`1e999` is not a finite number", "finite");
    let e = spoiled("center = [1.5, 0.0]", "center = [nan, 0.0]");
    refused(&e, "15:11", "`nan` is not a finite number", "finite");
    let e = spoiled("mass = 1.0\n\n[[body]]", "mass = 1.0\ncenter = [0.0, 0.0]\n\n[[body]]");
    refused(&e, "11:10", "both `rod` and `center` are given", "keep one");
    let e = spoiled("at = [1.0, 0.0]", "at = [1.0, 0.0]\naxis = [0.0, 1.0]");
    refused(&e, "29:1", "`axis` has no meaning here", "remove it; keys: name, kind, bodies, at");
    let e = spoiled(
        "body = \"lower\"\nat = [2.0, 0.0]\nvelocity",
        "body = \"ground\"\nat = [2.0, 0.0]\nvelocity",
    );
    refused(&e, "36:8", "the ground does not move", "name a body");
    // The error is about the word, not about a key that the quantity nearest to it does not use.
    let e = spoiled("at = [2.0, 0.0]\nquantity = \"position\"", "quantity = \"angular-velocty\"");
    refused(&e, "68:12", "unknown quantity `angular-velocty`", "`angular-velocity`");
    let e = spoiled("duration = 10.0", "duration = = 10.0");
    assert_eq!((e.place().line, e.place().column), (5, 12), "{e}");
    assert!(matches!(e.fault(), ReadFault::Syntax { .. }));
    refused(&read("").unwrap_err(), "1:1", "`[scene]` is missing", "add");
}

#[test]
fn malformed_scenes_are_refused_at_the_value() {
    let e = spoiled("mass = 1.0\ncenter", "mass = -1.0\ncenter");
    refused(&e, "14:8", "`mass` must not be negative, but is -1", "zero or more");
    let e = spoiled("name = \"lower\"", "name = \"upper\"");
    refused(&e, "13:8", "this name is already that of body 1", "own name");
    let e = spoiled("[\"ground\", \"upper\"]", "[\"upper\", \"upper\"]");
    refused(&e, "21:10", "`bodies` has the same body twice", "two different bodies");
    let e = spoiled("to = [1.0, 0.0] }", "to = [0.0, 0.0] }");
    refused(&e, "9:7", "`rod` has both points in the same place", "move");
    let e = spoiled("step = 1.0e-3", "step = 0");
    refused(&e, "61:8", "`step` must be larger than zero, but is 0", "larger than zero");
    let e = spoiled("joint = \"pivot\"\nvalue = 0.1", "joint = \"elbow\"\nvalue = 0.1");
    refused(&e, "32:9", "`value` is 0.1, but the guide of the joint starts with 0", "guide gives");
    let e = spoiled("value = 0.1", "value = [0.1, 0.2]");
    refused(&e, "32:9", "`value` needs 1 number, but has 2", "as many");
    let e = spoil(SPATIAL, "[0.1, 0.1, 0.1, 0.0, 0.0, 0.0]", "[0.1, 0.1, 0.3, 0.0, 0.0, 0.0]");
    let message = "`inertia` breaks the triangle inequality: the largest principal moment 3.000e-1 is \
                   more than the sum 2.000e-1 of the other two";
    refused(&e, "8:11", message, "digits");
    let e = spoil(SPATIAL, "axis = [0, 1, 0]", "axis = [0, 0.0, 0]");
    refused(&e, "34:8", "`axis` has no direction: all components are zero", "not zero");
    let e =
        spoiled("name = \"elbow\"\nkind = \"revolute\"", "name = \"elbow\"\nkind = \"spherical\"");
    refused(&e, "26:8", "`kind` needs a spatial scene", "dimension = 3");
}

#[test]
fn rendering_shows_the_line_with_carets_under_the_text() {
    let text = "[scene]\n\tname = \"Zwölf\"; # ö\n";
    let error = SceneFile::parse(text, "a b.toml").unwrap_err();
    assert_eq!(error.place().line, 2);
    let e = spoiled("[\"upper\", \"lower\"]", "[\"üpper\", \"löwer\"]");
    let expected = "test.toml:27:11: unknown body `üpper`\n\
                    27 | bodies = [\"üpper\", \"löwer\"]\n   |           ^^^^^^^\n\
                    hint: did you mean `upper`?\n";
    assert_eq!(e.render(), expected);
    let document = SceneFile::parse(PLANAR, "x").unwrap();
    let (_, place) = document.place(Entry::Solver, "formulation");
    assert_eq!((place.line, place.column, place.width), (60, 15, 6));
    assert_eq!(document.place(Entry::Body(1), "rod").1.line, 12);
    assert_eq!(document.place(Entry::Body(9), "rod").1.line, 1);
    let error = SceneFile::from_bytes(b"[scene]\nname = \"\xff\"", "x").unwrap_err();
    assert_eq!((error.place().line, error.place().column), (2, 9));
}

/// The scene of a text. Its effects must be equal after it is written and read again.
fn read_back(text: &str) -> Scene<f64> {
    let scene = read(text).unwrap_or_else(|e| panic!("{}", e.render()));
    let file = SceneFile::parse(text, "s.toml").expect("it reads");
    let written = to_toml(&file.numbers().expect("numbers")).expect("it is written");
    let again = read(&written).unwrap_or_else(|e| panic!("{}\n{written}", e.render()));
    assert_eq!(again.effects, scene.effects, "{written}");
    scene
}
