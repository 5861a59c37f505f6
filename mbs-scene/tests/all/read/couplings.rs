//! Couplings: every kind is read as its sum, and faults have their place.

use super::{THREE_BODIES, read, refused};
use mbs_core::scene::*;
use mbs_scene::{SceneFile, to_toml};

const JOINTS: &str = r#"[[joint]]
name = "a"
kind = "revolute"
bodies = ["ground", "w"]
at = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 2.0]
[[joint]]
name = "b"
kind = "revolute"
bodies = ["ground", "v"]
at = [1.0, 0.0, 0.0]
axis = [0.0, 0.0, -1.0]
[[joint]]
name = "c"
kind = "cylindrical"
bodies = ["ground", "u"]
at = [2.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
"#;

fn with(coupling: &str) -> String {
    format!("\n{THREE_BODIES}{JOINTS}[[coupling]]\n{coupling}\n")
}

/// Factor, joint and coordinate of each term, and the value of the sum.
fn sum(coupling: &str) -> (Vec<(f64, usize, usize)>, f64) {
    let scene = read(&with(coupling)).unwrap_or_else(|e| panic!("{}", e.render()));
    let [coupling] = &scene.couplings[..] else { panic!("one coupling") };
    let term = |term: &CouplingTerm<f64>| {
        let (joint, number) = term.of.coordinate().expect("a coordinate");
        (term.factor, joint.index(), number)
    };
    (coupling.terms.iter().map(term).collect(), coupling.value)
}

#[test]
fn every_kind_of_coupling_is_the_sum_that_it_says() {
    let tau = core::f64::consts::TAU;
    for (coupling, terms, value) in [
        // Wheels in external mesh about axes of opposite sense have angles of equal sign. Wheels with a belt about such axes have angles of
        // opposite sign.
        (
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [20, 40]",
            vec![(20.0, 0, 0), (-40.0, 1, 0)],
            0.0,
        ),
        (
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [20, 40]\nmesh = \"internal\"",
            vec![(20.0, 0, 0), (40.0, 1, 0)],
            0.0,
        ),
        (
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nratio = -0.5",
            vec![(1.0, 1, 0), (0.5, 0, 0)],
            0.0,
        ),
        (
            "kind = \"belt\"\njoints = [\"a\", \"b\"]\nradii = [0.1, 0.2]",
            vec![(0.1, 0, 0), (0.2, 1, 0)],
            0.0,
        ),
        (
            "kind = \"belt\"\njoints = [\"a\", \"b\"]\nradii = [0.1, 0.2]\ncrossed = true",
            vec![(0.1, 0, 0), (-0.2, 1, 0)],
            0.0,
        ),
        (
            "kind = \"rack\"\njoints = [\"a\", \"c\"]\nradius = 0.25",
            vec![(1.0, 2, 0), (-0.25, 0, 0)],
            0.0,
        ),
        ("kind = \"screw\"\njoint = \"c\"\nlead = 0.5", vec![(tau, 2, 0), (-0.5, 2, 1)], 0.0),
        (
            "kind = \"mimic\"\njoint = \"b\"\nof = \"a\"\nfactor = 2.0\noffset = 0.1",
            vec![(1.0, 1, 0), (-2.0, 0, 0)],
            0.1,
        ),
        (
            "kind = \"differential\"\njoints = [\"a\", \"b\", \"c\"]\nteeth = [20, 30]",
            vec![(20.0, 0, 0), (30.0, 1, 0), (-50.0, 2, 1)],
            0.0,
        ),
        (
            "kind = \"linear\"\nterms = [{ joint = \"c\", coordinate = 1, factor = 3.0 }, { joint = \"a\" }]\nvalue = 0.5",
            vec![(3.0, 2, 1), (1.0, 0, 0)],
            0.5,
        ),
    ] {
        assert_eq!(sum(coupling), (terms, value), "{coupling}");
    }
}

#[test]
fn a_written_coupling_reads_as_the_same_sum() {
    for coupling in [
        "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [20.0, 40]",
        "kind = \"gear\"\njoints = [\"a\", \"b\"]\nradii = [0.2, 0.4]\nmesh = \"internal\"\nsense = \"drawn\"",
        "kind = \"belt\"\njoints = [\"a\", \"b\"]\nradii = [0.1, 0.2]",
        "kind = \"rack\"\njoints = [\"a\", \"c\"]\nradius = -0.25\nsense = \"drawn\"",
        "kind = \"screw\"\njoint = \"c\"\nlead = 0.5",
        "kind = \"screw\"\njoints = [\"a\", \"c\"]\nlead = -0.5",
        "kind = \"differential\"\njoints = [\"a\", \"b\", \"c\"]\nteeth = [20, 30]",
        "kind = \"cam\"\njoints = [\"a\", \"b\"]\ntable = [[0.0, 0.0], [1.0, 0.5], [2.0, 0.0]]\nperiodic = true",
        "kind = \"cam\"\njoints = [\"a\", \"b\"]\ncoefficients = [0.0, 0.3, 0.1]",
        "kind = \"rope\"\npoints = [{ body = \"w\", at = [0.0, 1.0, 0.0] }, { body = \"ground\", at = [0.0, 3.0, 0.0] }]\nlength = 2.5\ndrum = { joint = \"b\", radius = 0.1 }",
        "kind = \"linear\"\nterms = [{ joint = \"a\" }]\nsine = { amplitude = 0.1, frequency = 2.0, phase = 0.0 }",
        "kind = \"linear\"\nterms = [{ joint = \"a\" }]\ninput = { value = 0.1 }",
        "kind = \"rope\"\nterms = [{ points = [{ body = \"w\", at = [0.0, 1.0, 0.0] }, { body = \"ground\", at = [0.0, 3.0, 0.0] }], factor = 2.0 }]\nvalue = 0.1",
        "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [20, 30]\nat = [0.4, 0.0, 0.2]",
        "kind = \"linear\"\nterms = [{ joint = \"a\", factor = 2 }, { joint = \"b\", factor = -3 }]\nat = [0.4, 0, 0]\npressure_angle = 0.3",
    ] {
        let scene = SceneFile::parse(&with(coupling), "c.toml").unwrap().numbers().unwrap();
        let again =
            SceneFile::parse(&to_toml(&scene).unwrap(), "c.toml").unwrap().numbers().unwrap();
        assert_eq!(again.couplings, scene.couplings, "{coupling}");
    }
}

#[test]
fn what_couples_nothing_is_refused_with_its_place() {
    for (coupling, place, message, hint) in [
        ("kind = \"gaer\"", "39:8", "unknown kind `gaer`", "did you mean `gear`?"),
        (
            "kind = \"gear\"\njoints = [\"a\", \"d\"]\nteeth = [1, 2]",
            "40:16",
            "unknown joint `d`",
            "joints: a, b, c",
        ),
        (
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [1.5, 2]",
            "41:10",
            "`1.5` does not count anything",
            "write a whole number from 1 to 1000000",
        ),
        (
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nradius = 1",
            "41:1",
            "`radius` has no meaning here",
            "remove it; keys: name, kind, joints, teeth, radii, ratio, mesh, at, pressure_angle, sense",
        ),
        (
            "kind = \"screw\"\njoint = \"c\"\nlead = 0",
            "41:8",
            "a screw without lead does not move its slide",
            "write how far the slide moves in one turn [m]",
        ),
        (
            "kind = \"linear\"\nterms = []",
            "40:9",
            "`terms` has no term with a factor that is not zero",
            "write a term with a factor that is not zero",
        ),
        (
            "kind = \"linear\"\nterms = [{ joint = \"c\", coordinate = 2 }]",
            "38:1",
            "`coordinate` is not there: the joint has 2 coordinates",
            "count the joint's coordinates from 0",
        ),
        (
            "kind = \"rope\"\npoints = [{ body = \"w\", at = [0, 0, 0] }]",
            "40:10",
            "expected 2 entries, found 1",
            "write 2, in the order of the format",
        ),
        (
            "kind = \"cam\"\njoints = [\"a\", \"b\"]\ntable = [[0, 0], [1, 1], [2, 1]]\nperiodic = true",
            "41:9",
            "`table` begins with 0 and ends with 1, but is periodic",
            "end the table with the value that it begins with",
        ),
    ] {
        refused(&read(&with(coupling)).unwrap_err(), place, message, hint);
    }
}

#[test]
fn pitch_points_and_ropes_that_say_two_things_are_refused_with_their_place() {
    for (coupling, place, message, hint) in [
        (
            "kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [20, 30]\nat = [0.5, 0, 0]",
            "42:6",
            "`at` is not where wheels with these factors touch, which is at [0.4, 0, 0]",
            "write this place, or move it along the axes",
        ),
        (
            "kind = \"rope\"\npoints = [{ body = \"w\", at = [0, 0, 0] }, { body = \"u\", at = [0, 1, 0] }]\nlength = 1\nvalue = 0",
            "42:9",
            "both `length` and `value` are given",
            "keep one",
        ),
    ] {
        refused(&read(&with(coupling)).unwrap_err(), place, message, hint);
    }
}

#[test]
fn a_joint_without_exactly_one_coordinate_of_the_kind_is_refused_with_those_it_has() {
    let other =
        "name another joint, or write the sum as kind `linear`, with `coordinate` in its terms";
    for (coupling, place, message) in [
        (
            "kind = \"linear\"\nterms = [{ joint = \"a\" }, { joint = \"c\" }]",
            "40:37",
            "one coordinate, by its name, is needed; the joint has: slide, turn",
        ),
        (
            "kind = \"mimic\"\njoint = \"c\"\nof = \"a\"",
            "40:9",
            "one coordinate is needed; the joint has: slide, turn",
        ),
        (
            "kind = \"rack\"\njoints = [\"a\", \"b\"]\nradius = 0.1",
            "40:16",
            "one slide is needed; the joint has: turn",
        ),
        (
            "kind = \"screw\"\njoint = \"a\"\nlead = 0.1",
            "40:9",
            "one slide is needed; the joint has: turn",
        ),
    ] {
        let hint = if coupling.contains("linear") { "add `coordinate`" } else { other };
        refused(&read(&with(coupling)).unwrap_err(), place, message, hint);
    }
}

#[test]
fn wheels_about_axes_that_are_not_parallel_need_a_ratio() {
    let text = with("kind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [1, 2]")
        .replace("[0.0, 0.0, -1.0]", "[0.0, 0.1, -1.0]");
    let message = "the axes of the two joints are not parallel in the reference configuration";
    let hint = "give `ratio`, the second angle per first, with its sign";
    refused(&read(&text).unwrap_err(), "41:9", message, hint);
    read(&text.replace("teeth = [1, 2]", "ratio = 0.5")).expect("a ratio is taken");
}

#[test]
fn start_values_that_contradict_a_coupling_are_refused() {
    let text = with("kind = \"gear\"\njoints = [\"a\", \"b\"]\nratio = 0.5")
        + "[[initial]]\njoint = \"a\"\nvalue = 1.0\n[[initial]]\njoint = \"b\"\nvalue = 0.75\n";
    let message = "`value` is 0.25 with the values of its joints at the start, but must be 0";
    let hint = "change one of the initial values, or leave it out: the others determine it";
    refused(&read(&text).unwrap_err(), "38:1", message, hint);
    read(&text.replace("0.75", "0.5")).expect("values that fit are taken");
}
