//! Couplings built in code, compared with the same couplings in scene files, and with their sums.

use mbs_core::real::DoubleDouble;
use mbs_core::scene::{BodyId, Coupling, CouplingTerm, Curve, GROUND, JointId, Number, Scene};
use mbs_scene::SceneFile;

/// Joints of three wheels, a slide and a cylindrical joint.
const JOINTS: &str = r#"
[scene]
dimension = 3
duration = 1.0
[[body]]
name = "u"
mass = 1.0
center = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[body]]
name = "v"
mass = 1.0
center = [1.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[body]]
name = "w"
mass = 1.0
center = [2.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[body]]
name = "x"
mass = 1.0
center = [3.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[body]]
name = "y"
mass = 1.0
center = [4.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[joint]]
name = "a"
kind = "revolute"
bodies = ["ground", "u"]
at = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
[[joint]]
name = "b"
kind = "revolute"
bodies = ["ground", "v"]
at = [1.0, 0.0, 0.0]
axis = [0.0, 0.0, 2.0]
[[joint]]
name = "c"
kind = "revolute"
bodies = ["ground", "w"]
at = [2.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
[[joint]]
name = "s"
kind = "prismatic"
bodies = ["ground", "x"]
at = [3.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
[[joint]]
name = "z"
kind = "cylindrical"
bodies = ["ground", "y"]
at = [4.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
"#;

const A: JointId = JointId::new(0);
const B: JointId = JointId::new(1);
const C: JointId = JointId::new(2);
const S: JointId = JointId::new(3);
const Z: JointId = JointId::new(4);

/// Scene with the coupling of a text.
fn read(text: &str) -> Scene<Number> {
    let text = format!("{JOINTS}[[coupling]]\nname = \"k\"\n{text}\n");
    let file = SceneFile::parse(&text, "x.toml").unwrap_or_else(|e| panic!("{}", e.render()));
    file.numbers().unwrap_or_else(|e| panic!("{}", e.render()))
}

/// Factor, joint and coordinate number of each term, in double precision.
fn terms(scene: &Scene<Number>) -> Vec<(f64, usize, usize)> {
    let coupling = &scene.resolve::<f64>().expect("a scene").couplings[0];
    assert!(coupling.value == 0.0 || coupling.terms.len() == 2, "only a mimic has an offset");
    let term = |term: &CouplingTerm<f64>| {
        let (joint, number) = term.of.coordinate().expect("a coordinate");
        (term.factor, joint.index(), number)
    };
    coupling.terms.iter().map(term).collect()
}

/// Asserts that code and text give equal couplings, in all digits of every precision.
fn is_the_same(coupling: Coupling<Number>, text: &str) -> Scene<Number> {
    let from_text = read(text);
    let in_code = Scene { couplings: vec![coupling.named("k")], ..from_text.clone() };
    assert_eq!(in_code.resolve::<f64>(), from_text.resolve::<f64>(), "{text}");
    assert_eq!(in_code.resolve::<f32>(), from_text.resolve::<f32>(), "{text}");
    let [code, text_] = [&in_code, &from_text].map(|s| s.resolve::<DoubleDouble>());
    assert_eq!(code, text_, "{text}");
    in_code
}

#[test]
fn couplings_of_joints_in_code_are_those_of_the_same_words() {
    let tau = core::f64::consts::TAU;
    for (coupling, text, expected) in [
        (
            Coupling::gear([A, B], [20, 40]),
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [20, 40]",
            vec![(20.0, 0, 0), (40.0, 1, 0)],
        ),
        (
            Coupling::internal_gear([A, B], [17, 51]),
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [17, 51]\nmesh = \"internal\"",
            vec![(17.0, 0, 0), (-51.0, 1, 0)],
        ),
        (
            Coupling::belt([A, C], [0.1, 0.25]),
            "kind = \"belt\"\njoints = [\"a\", \"c\"]\nradii = [0.1, 0.25]",
            vec![(0.1, 0, 0), (-0.25, 2, 0)],
        ),
        (
            Coupling::crossed_belt([A, C], [0.1, 0.25]),
            "kind = \"belt\"\njoints = [\"a\", \"c\"]\nradii = [0.1, 0.25]\ncrossed = true",
            vec![(0.1, 0, 0), (0.25, 2, 0)],
        ),
        (
            Coupling::rack([A, S], 0.3),
            "kind = \"rack\"\njoints = [\"a\", \"s\"]\nradius = 0.3",
            vec![(1.0, 3, 0), (-0.3, 0, 0)],
        ),
        (
            Coupling::screw(Z, 0.007),
            "kind = \"screw\"\njoint = \"z\"\nlead = 0.007",
            vec![(tau, 4, 0), (-0.007, 4, 1)],
        ),
        (
            Coupling::screw_between([B, S], -0.01),
            "kind = \"screw\"\njoints = [\"b\", \"s\"]\nlead = -0.01",
            vec![(tau, 3, 0), (0.01, 1, 0)],
        ),
        (
            Coupling::mimic([B, A], 0.7).holding(0.2),
            "kind = \"mimic\"\njoint = \"b\"\nof = \"a\"\nfactor = 0.7\noffset = 0.2",
            vec![(1.0, 1, 0), (-0.7, 0, 0)],
        ),
        (
            Coupling::differential([A, B, C], [24, 60]),
            "kind = \"differential\"\njoints = [\"a\", \"b\", \"c\"]\nteeth = [24, 60]",
            vec![(24.0, 0, 0), (60.0, 1, 0), (-84.0, 2, 0)],
        ),
        (
            Coupling::linear([(A, 1.0), (B, -2.5)]),
            "kind = \"linear\"\nterms = [{ joint = \"a\" }, { joint = \"b\", factor = -2.5 }]",
            vec![(1.0, 0, 0), (-2.5, 1, 0)],
        ),
    ] {
        assert_eq!(terms(&is_the_same(coupling, text)), expected, "{text}");
    }
}

#[test]
fn cams_and_ropes_in_code_are_those_of_the_same_words() {
    let rows = [[0.0, 0.0], [1.0, 0.1], [2.0, 0.0]].map(|row| row.map(Number::from));
    let cam = Coupling::cam([A, S], Curve::Table(rows.to_vec()));
    let text = "kind = \"cam\"\njoints = [\"a\", \"s\"]\ntable = [[0, 0], [1, 0.1], [2, 0]]";
    let scene = is_the_same(cam, text);
    assert_eq!(terms(&scene), [(1.0, 3, 0), (-1.0, 0, 0)]);
    let points = [(GROUND, [0.0, 0.0, 5.0]), (BodyId::Body(3), [3.0, 0.0, 0.0])];
    let rope = Coupling::rope(points).with_drum(A, 0.2);
    let text = "kind = \"rope\"\ndrum = { joint = \"a\", radius = 0.2 }\n\
                points = [{ body = \"ground\", at = [0, 0, 5] }, { body = \"x\", at = [3, 0, 0] }]";
    is_the_same(rope, text);
}
