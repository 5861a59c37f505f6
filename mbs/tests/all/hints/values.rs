//! Values that are missing, given twice or of another type, and invalid numbers.

use super::Row;
use super::row;
use super::scenes::{PLANAR, SPATIAL};

pub(super) fn rows() -> Vec<Row> {
    values().into_iter().chain(numbers()).collect()
}

/// Hints on values that are missing, given twice, or of another type.
#[allow(clippy::too_many_lines, reason = "a table")]
fn values() -> Vec<Row> {
    vec![
        row(
            PLANAR,
            &[("duration = 0.02\n", "")],
            ["`duration` is missing", "add `duration`"],
            &[("dimension = 2", "dimension = 2\nduration = 0.02")],
        ),
        row(
            PLANAR,
            &[("dimension = 2\n", "")],
            ["`dimension` is missing", "add `dimension = 2`"],
            &[("[scene]", "[scene]\ndimension = 2")],
        ),
        row(
            PLANAR,
            &[("body = \"arm\"\nat = [2.0, 0.0]\nquantity = \"position\"", "quantity = \"value\"")],
            [
                "`joint, body, coupling, rolling, effect or signal` is missing",
                "add `joint = \"...\"`",
            ],
            &[("quantity = \"value\"", "joint = \"pin\"\nquantity = \"value\"")],
        ),
        row(
            PLANAR,
            &[("inertia = 0.1\n", "")],
            ["`inertia` is missing", "add `inertia`, about the centre of mass"],
            &[("center = [1.5, 0.0]", "center = [1.5, 0.0]\ninertia = 0.1")],
        ),
        // a point mass that is welded: the hint proposes an inertia of zeros
        row(
            SPATIAL,
            &[("inertia = [0.001, 0.001, 0.001, 0.0, 0.0, 0.0]\n", "")],
            ["`inertia` is missing", "a point mass that is welded to a body has zeros"],
            &[(
                "center = [1.0, 0.0, 0.0]",
                "center = [1.0, 0.0, 0.0]\ninertia = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]",
            )],
        ),
        row(
            PLANAR,
            &[("center = [1.5, 0.0]", "center = [1.5, 0.0, 0.0, 0.0]")],
            ["expected 2 entries, found 4", "write 2"],
            &[("[1.5, 0.0, 0.0, 0.0]", "[1.5, 0.0]")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = [2.0]")],
            ["expected a number, found a list", "write a number"],
            &[("[2.0]\ncenter", "2.0\ncenter")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = 2.0\nrod = { from = [1.0, 0.0], to = [2.0, 0.0] }")],
            ["both `rod` and `center`", "keep one of the two"],
            &[("center = [1.5, 0.0]\ninertia = 0.1\n", "")],
        ),
        row(
            PLANAR,
            &[("at = [1.0, 0.0]", "at = [1.0, 0.0]\naxis = [0.0, 1.0]")],
            ["`axis` has no meaning here", "remove it"],
            &[("\naxis = [0.0, 1.0]", "")],
        ),
        row(
            PLANAR,
            &[("body = \"arm\"", "body = \"ground\"")],
            ["the ground does not move", "name a body"],
            &[("body = \"ground\"", "body = \"arm\"")],
        ),
        row(
            PLANAR,
            &[("joint = \"elbow\"\nrate", "joint = \"elbw\"\nrate")],
            ["unknown joint `elbw`", "did you mean `elbow`?"],
            &[("elbw", "elbow")],
        ),
        row(
            PLANAR,
            &[
                ("name = \"arm\"", "name = \"crank\""),
                ("[\"crank\", \"arm\"]", "[\"crank\", \"ground\"]"),
            ],
            ["this name is already that of body 1", "give each its own name"],
            &[
                ("name = \"crank\"\nmass = 2.0", "name = \"arm\"\nmass = 2.0"),
                ("[\"crank\", \"ground\"]", "[\"crank\", \"arm\"]"),
            ],
        ),
        row(
            PLANAR,
            &[("name = \"tip\"", "name = \"t\"")],
            ["is empty or reserved", "choose another name"],
            &[("name = \"t\"", "name = \"time of the tip\"")],
        ),
        row(
            PLANAR,
            &[("table = [[0.0, 0.0], [1.0, 2.0]]\n", "")],
            ["`value, table or signal` is missing", "add one of them"],
            &[("joint = \"pin\"\n", "joint = \"pin\"\nvalue = 2.0\n")],
        ),
        row(
            PLANAR,
            &[("joint = \"pin\"\ntable", "table")],
            ["`body or joint` is missing", "add one of them"],
            &[("kind = \"torque\"", "kind = \"torque\"\nbody = \"crank\"")],
        ),
        row(PLANAR, &[("step = 1e-3", "step = = 1e-3")], ["not TOML", "toml.io"], &[("= =", "=")]),
        row(
            PLANAR,
            &[("[solver]", "[[initial]]\njoint = \"elbow\"\nrate = 0.1\n[solver]")],
            ["already prescribed by initial 1", "remove one of the two"],
            &[("[[initial]]\njoint = \"elbow\"\nrate = 0.1\n", "")],
        ),
        row(
            SPATIAL,
            &[("axis = [0.0, 1.0, 0.0]\n", "")],
            ["`axis` is missing", "add `axis`"],
            &[("at = [0.0, 0.0, 0.0]", "at = [0.0, 0.0, 0.0]\naxis = [0.0, 1.0, 0.0]")],
        ),
    ]
}

/// Hints on numbers with units, and on invalid numbers.
#[allow(clippy::too_many_lines, reason = "a table")]
fn numbers() -> Vec<Row> {
    vec![
        row(
            PLANAR,
            &[("mass = 2.0", "mass = \"2.0 s\"")],
            ["`2.0 s` is a time, `mass` is in kg", "write a number in kg, or with such a unit"],
            &[("\"2.0 s\"", "\"2.0 kg\"")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = 2.0 kg")],
            ["not TOML", "write 2.0, in SI units, or \"2.0 kg\" in quotes"],
            &[("2.0 kg", "2.0")],
        ),
        row(
            PLANAR,
            &[("free_length = 0.8", "free_length = \"800 mm + slack\"")],
            ["`slack` is no parameter", "give the name a value in [parameters]"],
            &[("\"800 mm + slack\"", "\"800 mm\"")],
        ),
        row(
            PLANAR,
            &[("at = [1.0, 0.0]", "at = [1000 mm, 0.0]")],
            ["not TOML", "write 1, in SI units, or \"1000 mm\" in quotes"],
            &[("1000 mm", "1.0")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = \"two\"")],
            ["`two` is no parameter", "write a number, or give the name a value in [parameters]"],
            &[("\"two\"", "\"2.0\"")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = nan")],
            ["`nan` is not a finite number", "finite decimal number"],
            &[("nan", "2.0")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = -2.0")],
            ["must not be negative, but is -2", "zero or more"],
            &[("-2.0", "2.0")],
        ),
        row(
            PLANAR,
            &[("duration = 0.02", "duration = 0.0")],
            ["must be larger than zero", "larger than zero"],
            &[("duration = 0.0", "duration = 0.02")],
        ),
        row(
            PLANAR,
            &[("rate = 0.5", "rate = [0.5, 0.1]")],
            ["needs 1 number, but has 2", "as many numbers as the joint"],
            &[("[0.5, 0.1]", "0.5")],
        ),
        row(
            PLANAR,
            &[("[1.0, 2.0]]", "[0.0, 2.0]]")],
            ["times that do not increase at row 2", "sort the rows"],
            &[("[[0.0, 0.0], [0.0, 2.0]]", "[[0.0, 0.0], [1.0, 2.0]]")],
        ),
    ]
}
