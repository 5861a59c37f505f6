//! Effects on swing and twist of ball joints: they are read as sums, and written as they were read. Faults have their place.

use super::{THREE_BODIES, read, read_back, refused};
use mbs_core::scene::*;

const JOINTS: &str = r#"[[joint]]
name = "a"
kind = "revolute"
bodies = ["ground", "w"]
at = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 2.0]
[[joint]]
name = "b"
kind = "spherical"
bodies = ["ground", "u"]
at = [2.0, 0.0, 0.0]
"#;

fn with(effect: &str) -> String {
    format!("{THREE_BODIES}{JOINTS}[[effect]]\n{effect}\n")
}

#[test]
fn every_kind_on_a_ball_is_a_sum_of_one_term() {
    for (rest, angle) in [
        ("kind = \"torsion-spring\"\nstiffness = 3.0\nfree_value = 0.2", BallAngle::Twist),
        ("kind = \"torque\"\nvalue = 3.0", BallAngle::Twist),
        ("kind = \"limit\"\nupper = 0.5\nstiffness = 3.0", BallAngle::Swing),
        ("kind = \"limit\"\nlower = -0.5\nupper = 0.5\nstiffness = 3.0", BallAngle::Twist),
        ("kind = \"friction\"\ncoulomb = 3.0", BallAngle::Swing),
    ] {
        let name = angle.name();
        let text = with(&format!(
            "joint = \"b\"\ncoordinate = \"{name}\"\naxis = [0.0, 0.0, 2.0]\n{rest}"
        ));
        let scene = read_back(&text);
        let of = CouplingMeasure::Ball { joint: JointId::new(1), angle, axis: [0.0, 0.0, 2.0] };
        let values = scene.effects[0].kind.values();
        let mbs_core::effects::Value::Terms(terms) = &values[0] else { panic!("terms: {rest}") };
        assert_eq!(terms, &[CouplingTerm { factor: 1.0, of, curve: None }], "{rest}");
    }
    let cone = "joint = \"b\"\ncoordinate = \"swing\"\naxis = [0, 0, 1]\nkind = \"limit\"\nupper = 0.5\nstiffness = 3.0";
    let scene = read(&with(cone)).expect("it reads");
    let EffectKind::SumLimit(limit) = &scene.effects[0].kind else { panic!("a limit") };
    assert_eq!(limit.lower, -core::f64::consts::PI);
}

/// Torsion springs that are refused, each with its place, message and hint.
const REFUSED: &[[&str; 4]] = &[
    [
        "joint = \"a\"\ncoordinate = \"swing\"\naxis = [0, 0, 1]",
        "33:1",
        "`axis` has no meaning here",
        "",
    ],
    ["joint = \"a\"\ncoordinate = \"swing\"", "32:14", "unknown coordinate `swing`", "turn"],
    ["joint = \"b\"\ncoordinate = \"twist\"", "30:1", "`axis` is missing", ""],
    [
        "joint = \"b\"\ncoordinate = \"twist\"\naxis = [0, 0, 0]",
        "33:8",
        "`axis` has no direction: all components are zero",
        "",
    ],
    [
        "joint = \"b\"\ncoordinate = \"twist\"\naxis = [0, 0, 1]\nterms = []",
        "33:1",
        "`axis` has no meaning here",
        "",
    ],
    ["joint = \"b\"\ncoordinate = \"swign\"", "32:14", "unknown coordinate `swign`", "swing"],
    ["terms = [{ joint = \"b\", coordinate = \"twist\" }]", "31:10", "`axis` is missing", ""],
    [
        "terms = [{ joint = \"a\", coordinate = \"turn\", axis = [0, 0, 1] }]",
        "31:46",
        "`axis` has no meaning here",
        "",
    ],
];

#[test]
fn angles_that_no_ball_has_are_refused_at_their_place() {
    for [on, place, message, hint] in REFUSED {
        let text = with(&format!("{on}\nkind = \"torsion-spring\"\nstiffness = 1.0"));
        refused(&read(&text).unwrap_err(), place, message, hint);
    }
    let gear = "[[coupling]]\nkind = \"linear\"\nterms = [{ joint = \"b\", coordinate = \"twist\", axis = [0, 0, 1] }]\n";
    let text = format!("{THREE_BODIES}{JOINTS}{gear}");
    let message = "`terms` has an angle of a ball, which no coupling holds";
    refused(&read(&text).unwrap_err(), "32:9", message, "effect");
}
