//! Effects on sums: every kind reads its terms and is written as it was read. Faults have their place.

use super::{THREE_BODIES, read, read_back, refused};
use mbs_core::effects::{ActsOn, Value};
use mbs_core::scene::*;

const JOINTS: &str = r#"[[joint]]
name = "a"
kind = "revolute"
bodies = ["ground", "w"]
at = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 2.0]
[[joint]]
name = "c"
kind = "cylindrical"
bodies = ["ground", "u"]
at = [2.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
[[joint]]
name = "fix"
kind = "weld"
bodies = ["ground", "v"]
at = [1.0, 0.0, 0.0]
"#;

fn with(effect: &str) -> String {
    format!("{THREE_BODIES}{JOINTS}[[effect]]\n{effect}\n")
}

const TERMS: &str =
    "terms = [{ joint = \"a\" }, { joint = \"c\", coordinate = \"turn\", factor = -2.0 }]\n";

#[test]
fn every_kind_on_a_sum_is_written_as_it_was_read() {
    let line = "terms = [{ joint = \"a\", coefficients = [0.0, 0.1] }, { points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"u\", at = [2, 0, 0] }] }]\n";
    for rest in [
        "kind = \"torsion-spring\"\nstiffness = 3.0\nfree_value = 0.2",
        "kind = \"spring-damper\"\ndamping = 3.0",
        "kind = \"torque\"\ntable = [[0.0, 1.0], [1.0, 2.0]]",
        "kind = \"limit\"\nlower = -0.1\nupper = 0.2\nstiffness = 3.0",
        "kind = \"friction\"\ncoulomb = 3.0\nvalue = 0.5",
        "kind = \"polynomial-spring\"\ncoefficients = [[-1.0, 1.0, 0.0, 2.0]]",
        "kind = \"polynomial-damper\"\ncoefficients = [[-1.0, 1.0, 0.0, 2.0]]",
    ] {
        for terms in [TERMS, line] {
            let text = with(&format!("{terms}{rest}"));
            let scene = read_back(&text);
            assert_eq!(scene.effects[0].kind.acts_on(), ActsOn::Sum, "{rest}");
        }
    }
    let scene = read(&with(&format!("{TERMS}kind = \"torque\"\nvalue = 1.0"))).expect("it reads");
    let Value::Terms(terms) = &scene.effects[0].kind.values()[0] else { panic!("terms") };
    let of = |term: &CouplingTerm<f64>| (term.factor, term.of.coordinate());
    let joint = |joint, number| Some((JointId::new(joint), number));
    assert_eq!([of(&terms[0]), of(&terms[1])], [(1.0, joint(0, 0)), (-2.0, joint(1, 1))]);
}

const POINTS: &str = "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"ground\", at = [1, 0, 1] }, { body = \"u\", at = [2, 0, 0] }]\n";

#[test]
fn every_kind_on_a_line_is_written_as_it_was_read() {
    for rest in [
        "kind = \"spring-damper\"\nstiffness = 3.0",
        "kind = \"spring-damper\"\nstiffness = 3.0\ndamping = 0.1\nfree_length = 2.0\npulls_only = true",
        "kind = \"spring-damper\"\nstiffness = 3.0\nfree_length = \"reference\"",
        "kind = \"actuator\"\nvalue = -3.0",
        "kind = \"polynomial-spring\"\ncoefficients = [[0.0, 9.0, 0.0, 2.0]]",
        "kind = \"polynomial-damper\"\ncoefficients = [[-1.0, 1.0, 0.0, 2.0]]",
    ] {
        let text = with(&format!("{POINTS}{rest}"));
        let scene = read_back(&text);
        assert_eq!(scene.effects[0].kind.acts_on(), ActsOn::Line, "{rest}");
    }
    // With the key `pulls_only`, an effect between two bodies is read as an effect on a line.
    let pair = "bodies = [\"w\", \"u\"]\npoints = [[0, 0, 0], [2, 0, 0]]\nkind = \"spring-damper\"\nstiffness = 3.0\n";
    let slack = read(&with(&format!("{pair}pulls_only = true"))).expect("it reads");
    let EffectKind::LineSpring(spring) = &slack.effects[0].kind else { panic!("a line") };
    assert_eq!((spring.points.len(), spring.free_length, spring.pulls_only), (2, None, true));
    assert!(slack.effects[0].kind.is_one_sided());
    let both = read(&with(&format!("{pair}free_length = 2.0"))).expect("it reads");
    assert!(matches!(both.effects[0].kind, EffectKind::SpringDamper(_)));
    let sum = format!("{TERMS}kind = \"spring-damper\"\nstiffness = 3.0\npulls_only = true");
    let sum = read(&with(&sum)).expect("it reads");
    assert!(sum.effects[0].kind.is_one_sided());
}

/// Lines that are refused, each with its place, message and hint.
const REFUSED_LINES: &[[&str; 4]] = &[
    ["points = [{ body = \"w\", at = [0, 0, 0] }]", "37:10", "expected 2 entries, found 1", ""],
    [
        "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"u\", at = [0, 0, 0] }]",
        "37:10",
        "`points` has both points in the same place",
        "move one of the two points",
    ],
    [
        "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"w\", at = [1, 0, 0] }]",
        "37:10",
        "`points` has the same body twice",
        "name two different bodies",
    ],
    [
        "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"x\", at = [1, 0, 0] }]",
        "37:52",
        "unknown body `x`",
        "",
    ],
    [
        "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"u\", at = [2, 0, 0] }]\nbodies = [\"w\", \"u\"]",
        "38:10",
        "both `points` and `bodies` are given",
        "",
    ],
    [
        "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"u\", at = [2, 0, 0] }]\nfree_value = 1.0",
        "38:14",
        "both `points` and `free_value` are given",
        "",
    ],
    [
        "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"u\", at = [2, 0, 0] }]\nfree_length = \"relaxed\"",
        "38:16",
        "`relaxed` is no parameter",
        "",
    ],
    [
        "points = [{ body = \"w\", at = [0, 0, 0] }, { body = \"u\", at = [2, 0, 0] }]\nfree_length = -1.0",
        "38:15",
        "`free_length` must not be negative, but is -1",
        "",
    ],
    ["points = [[0, 0, 0], [2, 0, 0]]", "36:1", "`bodies` is missing", ""],
    ["pulls_only = true", "36:1", "`bodies` is missing", ""],
];

#[test]
fn lines_that_measure_nothing_are_refused_at_their_place() {
    for [line, place, message, hint] in REFUSED_LINES {
        let text = with(&format!("{line}\nkind = \"spring-damper\"\nstiffness = 1.0"));
        refused(&read(&text).unwrap_err(), place, message, hint);
    }
    let text =
        with(&format!("{TERMS}kind = \"spring-damper\"\nstiffness = -1.0\npulls_only = true"));
    refused(&read(&text).unwrap_err(), "39:13", "`stiffness` must not be negative, but is -1", "");
}

#[test]
fn an_effect_of_a_joint_is_taken_to_a_sum_in_code() {
    let (a, c) = (JointId::new(0), JointId::new(1));
    let terms = vec![CouplingTerm::of_joint(a, 0, 1.0), CouplingTerm::of_joint(c, 1, -2.0)];
    let clutch = Effect::friction(a, 3.0, 1e-3).on_terms(terms.clone());
    let EffectKind::SumFriction(of) = clutch.kind else { panic!("friction on a sum") };
    assert_eq!((of.terms, of.coulomb.to_f64()), (terms.clone(), 3.0));
    let spring = Effect::torsion_spring(a, 3.0, 0.1, 0.2).on_terms(terms.clone());
    assert!(matches!(spring.kind, EffectKind::SumSpring(_)));
    let drag = Effect::aero_drag(BodyId::Body(0), [0.0, 0.0, 0.0], 1.0, 1.2);
    assert_eq!(drag.clone().on_terms(terms), drag);
}

/// Terms that are refused, each with its place, message and hint.
const REFUSED: &[[&str; 4]] = &[
    ["terms = [{ joint = \"b\" }]", "37:20", "unknown joint `b`", ""],
    [
        "terms = [{ joint = \"c\" }]",
        "37:20",
        "one coordinate, by its name, is needed; the joint has: slide, turn",
        "add `coordinate`",
    ],
    [
        "terms = [{ joint = \"c\", coordinate = \"trun\" }]",
        "37:38",
        "unknown coordinate `trun`",
        "did you mean `turn`?",
    ],
    [
        "terms = [{ joint = \"c\", coordinate = 2 }]",
        "37:9",
        "`coordinate` is not there: the joint has 2 coordinates",
        "",
    ],
    [
        "terms = [{ joint = \"a\" }]\njoint = \"a\"",
        "37:9",
        "both `joint` and `terms` are given",
        "",
    ],
    [
        "terms = [{ joint = \"a\" }]\ncoordinate = 0",
        "38:14",
        "both `terms` and `coordinate` are given",
        "",
    ],
    ["terms = []", "37:9", "`terms` has no term with a factor that is not zero", ""],
    [
        "terms = [{ joint = \"a\", factor = 0.0 }]",
        "37:9",
        "`terms` has no term with a factor that is not zero",
        "",
    ],
    ["terms = [{ joint = \"fix\" }]", "37:9", "`joint` is a joint without coordinates", ""],
    [
        "terms = [{ joint = \"a\", fcator = 1.0 }]",
        "37:25",
        "unknown key `fcator`",
        "did you mean `factor`?",
    ],
    [
        "terms = 3",
        "37:9",
        "expected a list of terms like { joint = \"j\", factor = 1.0 }, found a number",
        "",
    ],
];

#[test]
fn sums_that_measure_nothing_are_refused_at_their_place() {
    for [terms, place, message, hint] in REFUSED {
        let text = with(&format!("{terms}\nkind = \"friction\"\ncoulomb = 1.0"));
        let e = read(&text).unwrap_err();
        refused(&e, place, message, hint);
    }
    let text = with("kind = \"friction\"\ncoulomb = 1.0");
    refused(&read(&text).unwrap_err(), "36:1", "`joint` is missing", "");
    let text = with(&format!("{TERMS}kind = \"limit\"\nlower = 1.0\nupper = 0.0\nstiffness = 1.0"));
    refused(
        &read(&text).unwrap_err(),
        "39:9",
        "`lower` is 1, which is not below the upper end 0",
        "",
    );
}
