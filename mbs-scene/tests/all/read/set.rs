//! Values that a command line sets, scenes in JSON, and paths to expressions.

use super::*;
use mbs_scene::SceneSweep;

const SCENE: &str = "\
[scene]
dimension = 2
duration = 1.0

[parameters]
k = \"35.9 kN/m\"

[[point]]
name = \"top\"
at = [0.0, 1.0]

[[body]]
name = \"b\"
mass = \"2 kg\"
center = [0.5, 0.0]
inertia = 1.0

[[effect]]
name = \"spring\"
kind = \"spring-damper\"
bodies = [\"ground\", \"b\"]
points = [\"top\", [0.5, 0.0]]
stiffness = \"k\"
free_length = 1.0
damping = 0.5
";

fn file() -> SceneFile {
    SceneFile::parse(SCENE, "test.toml").expect("TOML")
}

fn set(assignment: &str) -> Result<Scene<f64>, ReadError> {
    file().with_set(assignment)?.scene()
}

#[test]
fn values_of_all_forms_are_set_by_the_paths_of_sweeps() {
    let of = |text: &str| set(text).unwrap_or_else(|e| panic!("{}", e.render()));
    assert_eq!(of("body.b.mass=3").bodies[0].mass, 3.0);
    assert_eq!(of("body.b.mass = 3 t").bodies[0].mass, 3000.0);
    assert_eq!(of("body[0].center[1]=\"1/4\"").bodies[0].center[1], 0.25);
    assert_eq!(of("body.b.center=[1, 2]").bodies[0].center[..2], [1.0, 2.0]);
    assert_eq!(of("scene.gravity=[0, -9.81]").gravity, Some([0.0, -9.81, 0.0]));
    assert_eq!(of("solver.formulation=index-1").solver.formulation.as_deref(), Some("index-1"));
    assert_eq!(of("solver.step=1e-4").solver.step, Some(1e-4));
    assert!(format!("{:?}", of("parameter.k=36 kN/m").effects).contains("36000.0"));
    assert!(format!("{:?}", of("point.top[1]=1.5").effects).contains("1.5"));
    assert!(format!("{:?}", of("effect.spring.damping=12.5").effects).contains("12.5"));
}

#[test]
fn what_cannot_be_set_is_refused_at_its_place_in_the_assignment() {
    let cases = [
        ("body.b.mass", "`=` and a value are missing", "", 1),
        ("body.c.mass=1", "no [[body]] called `c`", "", 1),
        ("body.b.mas=1", "unknown key `mas`", "did you mean `mass`?", 1),
        ("effect.spring.stifness=1", "unknown key `stifness`", "did you mean `stiffness`?", 1),
        ("bodies.b.mass=1", "no table `bodies`", "", 1),
        ("solver.stp=1", "unknown key `stp`", "did you mean `step`?", 1),
        ("parameter.c=1", "`parameters` has no key `c`", "", 1),
        ("body.b.mass=2*q", "`q` is no parameter", "parameters: k", 15),
        ("body.b.mass=2 m", "`2 m` is a length, `mass` is in kg", "", 13),
        ("body.b.mass=[1, 2]", "expected a number, found a list", "", 13),
        ("=1", "this is no path", "", 1),
    ];
    for (assignment, message, hint, column) in cases {
        let error = set(assignment).expect_err(assignment);
        let text = error.render();
        assert!(text.contains(message) && text.contains(hint), "{text}");
        assert_eq!((error.file(), error.place().line), ("--set", 1), "{text}");
        assert_eq!(error.place().column, column, "{text}");
    }
}

#[test]
fn a_sweep_reaches_expressions_parameters_and_points() {
    let sweep = "[[vary]]\npath = \"parameter.k\"\nvalues = [1.0, 2.0]\n[[vary]]\npath = \"point.top[1]\"\nvalues = [3.0]\n\
                 [[vary]]\npath = \"body.b.mass\"\nshift = \"body.b.center[0]\"\nvalues = [4.0]\n";
    let sweep = SceneFile::parse(sweep, "sweep.toml").expect("TOML");
    let sweep = SceneSweep::new(&sweep.into(), &file(), &[]).unwrap_or_else(|e| panic!("{e:?}"));
    let member = sweep.member(&file(), 1).scene::<f64>().expect("a scene");
    let effects = format!("{:?}", member.effects);
    assert!(effects.contains("2.0") && effects.contains("3.0"), "{effects}");
    assert_eq!(member.bodies[0].mass, 4.0);
    assert_eq!(member.bodies[0].center[0], 2.5);
    assert_eq!(file().number("body.b.mass").expect("a number").to_f64(), 2.0);
}

#[test]
fn json_gives_the_scene_of_toml() {
    let json = r#"{
        "scene": { "dimension": 2, "duration": 1.0 },
        "parameters": { "k": "35.9 kN/m" },
        "point": [{ "name": "top", "at": [0.0, 1.0] }],
        "body": [{ "name": "b", "mass": "2 kg", "center": [0.5, 0.0], "inertia": 1.0 }],
        "effect": [{
            "name": "spring", "kind": "spring-damper", "bodies": ["ground", "b"],
            "points": ["top", [5e-1, 0.0]], "stiffness": "k", "free_length": 1.0, "damping": 0.5
        }]
    }"#;
    for name in ["test.json", "standard input"] {
        let scene = SceneFile::parse(json, name).and_then(|file| file.numbers());
        let scene = scene.unwrap_or_else(|e| panic!("{}", e.render()));
        let toml = file().numbers().expect("a scene");
        assert_eq!(Scene { name: toml.name.clone(), ..scene }, toml);
    }
}

#[test]
fn refusals_of_json_have_line_and_column() {
    let scene = "{\n  \"scene\": { \"dimension\": 2, \"duration\": 1.0, ";
    let cases = [
        ("\"gravty\": [0, 0] }\n}", "unknown key `gravty`", 47),
        ("\"gravity\": null }\n}", "`null` is no value", 58),
        ("\"gravity\": [0, 0], }\n}", "not JSON: key must be a string", 66),
        ("\"duration\": 2.0 }\n}", "the key `duration` stands here twice", 47),
        ("\"gravity\": [0, \"2*q\"] }\n}", "`q` is no parameter", 65),
        ("\"gravity\": [0, 01] }\n}", "not JSON: invalid number", 63),
    ];
    for (rest, message, column) in cases {
        let error = SceneFile::parse(&format!("{scene}{rest}"), "test.json")
            .and_then(|file| file.numbers())
            .expect_err(message);
        assert!(error.render().contains(message), "{}", error.render());
        assert_eq!((error.place().line, error.place().column), (2, column), "{}", error.render());
    }
    for text in [
        "",
        "[]",
        "{",
        "{}}",
        "\"a\"",
        "{\"a\":\"\\ud800\"}",
        &"[".repeat(100_000),
        &"{\"a\":".repeat(3000),
    ] {
        assert!(SceneFile::parse(text, "test.json").is_err(), "{text:.20}");
    }
}
