//! `[[coupling]]`, its terms, and lines over points.

use super::guide::{interpolation, motion};
use super::table::{Key, KeyTable, inside, kinds, listed, may, name_or, need};
use super::value::KeyValue::{
    Coordinate, Counts, Flag, Number, NumberOr, Numbers, Of, Place, RowsOrFile, Several,
    SomeNumbers, Vector, Word,
};
use super::value::{KeyValue, Referent};

pub(super) fn tables() -> Vec<KeyTable> {
    let mut tables = kinds(
        "coupling",
        &[name_or("`coupling-N`")],
        [
            ("gear", gear()),
            ("rack", rack()),
            ("screw", screw()),
            ("belt", belt()),
            ("mimic", mimic()),
            ("differential", differential()),
            ("cam", cam()),
            ("rope", rope()),
            ("linear", linear()),
        ],
    );
    tables.extend([term(), point(), drum()]);
    tables
}

fn joints(n: usize, meaning: &str) -> Key {
    need("joints", Several(Referent::Joint, n), "", meaning)
}

/// Whether the sum is meant as it is drawn.
fn sense() -> Key {
    let meaning = "Says that the sense by places and axes is meant: nothing is noted where version 0.1 took another.";
    may("sense", Word(vec!["drawn"]), "", "as drawn, with a note", meaning)
}

fn rack() -> KeyTable {
    let radius = "Pitch radius of the pinion; negative for the other sense.";
    let keys = vec![
        joints(2, "Turn of the pinion, slide of the rack with `at` on its pitch line."),
        need("radius", Number, "m", radius),
        sense(),
    ];
    let meaning =
        "A rack on a pinion: at the pitch point both have the same velocity along the rack.";
    listed("coupling", meaning, keys)
}

fn belt() -> KeyTable {
    let crossed = "Whether the belt is crossed: the wheels turn in opposite senses.";
    let pretension = "Pull of each strand where the belt passes nothing on: the bearings then carry the strands.";
    let keys = vec![
        joints(2, "Turns of the wheels."),
        need("radii", Numbers(2), "m", "Radii of the wheels."),
        may("crossed", Flag, "", "false", crossed),
        may("pretension", Number, "N", "none", pretension),
        sense(),
    ];
    let meaning = "A belt or chain on two wheels: r1 w1 = r2 w2 in the body that carries both.";
    listed("coupling", meaning, keys)
}

fn mimic() -> KeyTable {
    let keys = vec![
        need("joint", Of(Referent::Joint), "", "The joint of x."),
        need("of", Of(Referent::Joint), "", "The joint of y."),
        may("factor", Number, "", "1", "Factor."),
        may("offset", Number, "rad or m", "0", "Offset."),
    ];
    listed("coupling", "One coordinate follows another: x - factor y = offset.", keys)
}

fn differential() -> KeyTable {
    let keys = vec![
        joints(3, "Turns of the two wheels, and of the cage."),
        may("teeth", Counts(2), "", "[1, 1]", "Teeth of the two wheels."),
        sense(),
    ];
    let meaning = "Wheels on a cage: Na (wa - wc) + Nb (wb - wc) = 0 about its axis. A planetary set has sun, ring and carrier.";
    listed("coupling", meaning, keys)
}

fn gear() -> KeyTable {
    let mut keys = vec![
        joints(2, "Turns of the wheels."),
        may(
            "teeth",
            Counts(2),
            "",
            "one of `teeth`, `radii`, `ratio` is needed",
            "Teeth of the wheels; axes parallel.",
        ),
        may("radii", Numbers(2), "m", "none", "Pitch radii of the wheels; axes parallel."),
        may("ratio", Number, "", "none", "Second angle per first, with its sign; any axes."),
        may(
            "mesh",
            Word(vec!["external", "internal"]),
            "",
            "external",
            "Whether one wheel stands inside the other.",
        ),
    ];
    keys.extend(mesh());
    keys.push(sense());
    let meaning = "Wheels in mesh: N1 w1 + N2 w2 = 0, internal N1 w1 - N2 w2 = 0, in the body that carries both.";
    listed("coupling", meaning, keys)
}

/// Keys of the place where teeth touch.
fn mesh() -> [Key; 2] {
    [
        may(
            "at",
            Place,
            "m",
            "none",
            "Pitch point: the bearings then carry the force of the teeth.",
        ),
        may(
            "pressure_angle",
            Number,
            "rad",
            "20 degrees",
            "Pressure angle of the teeth, beside `at`.",
        ),
    ]
}

fn screw() -> KeyTable {
    listed(
        "coupling",
        "A screw: s - lead/(2 pi) a = 0 along one sense of the axis.",
        vec![
            may(
                "joint",
                Of(Referent::Joint),
                "",
                "needed without `joints`",
                "A cylindrical joint, which has turn and slide.",
            ),
            may(
                "joints",
                Several(Referent::Joint, 2),
                "",
                "needed without `joint`",
                "The turn, the slide.",
            ),
            need("lead", Number, "m", "Slide per turn."),
            sense(),
        ],
    )
}

/// Ways in which the table of a curve is interpolated between its rows.
pub(super) const CURVE_WAYS: [&str; 3] = ["spline", "monotone", "linear"];

/// A curve of a number: a table or a polynomial.
pub(super) fn curve(table: &str, ways: &[&'static str]) -> Vec<Key> {
    vec![
        may("table", RowsOrFile, "", "none", table),
        interpolation(ways.to_vec()),
        may("periodic", Flag, "", "false", "Whether the table repeats with its first and last x."),
        may(
            "coefficients",
            SomeNumbers,
            "",
            "none",
            "A polynomial in place of a table: c0, c1, ... of increasing power.",
        ),
    ]
}

fn cam() -> KeyTable {
    let mut keys = vec![joints(2, "The shaft, the follower.")];
    keys.extend(curve(
        "Lift of the follower over the shaft: rows `[x, f]`.",
        &["spline", "monotone"],
    ));
    listed("coupling", "A cam: x - f(a) = 0.", keys)
}

fn rope() -> KeyTable {
    let mut keys = vec![
        may(
            "points",
            KeyValue::Tables("line point"),
            "",
            "needed without `terms`",
            "The points that the rope passes, each on its body.",
        ),
        may(
            "length",
            NumberOr(vec!["reference"]),
            "m",
            "`reference`",
            "Length of the rope; `reference`: that in the reference configuration.",
        ),
        may("drum", KeyValue::Table("drum"), "", "none", "A drum that takes the rope in."),
        may("terms", KeyValue::Tables("term"), "", "none", "A sum in place of `points`."),
        may("value", Number, "m", "0", "Length above that in the reference configuration."),
    ];
    keys.extend(motion("m"));
    listed(
        "coupling",
        "A rope of constant length, which holds both ways: length + radius a = value.",
        keys,
    )
}

fn linear() -> KeyTable {
    let mut keys = vec![
        need("terms", KeyValue::Tables("term"), "", "The terms of the sum."),
        may("value", Number, "rad or m", "0", "What the sum is."),
    ];
    keys.extend(mesh());
    keys.extend(motion("rad or m"));
    listed(
        "coupling",
        "A sum of coordinates and lengths that holds, or follows a function of time.",
        keys,
    )
}

/// Keys of what a sum or a signal measures, with the angles of a ball that it takes.
pub(super) fn measure(of_ball: &str) -> Vec<Key> {
    vec![
        may("joint", Of(Referent::Joint), "", "needed without `points`", "A joint."),
        may(
            "coordinate",
            Coordinate,
            "",
            "the only one",
            &format!("Its coordinate; of a ball {of_ball}."),
        ),
        may(
            "axis",
            Vector,
            "",
            "needed beside the angle of a ball",
            "The axis of the angle of a ball.",
        )
        .in_space(),
        may(
            "points",
            KeyValue::Tables("line point"),
            "",
            "none",
            "A line in place of a joint: its length.",
        ),
    ]
}

fn term() -> KeyTable {
    let mut keys = measure("`\"swing\"` or `\"twist\"`");
    keys.push(may("factor", Number, "", "1", "Factor of the coordinate or length."));
    keys.extend(curve("A curve of the coordinate or length: rows `[x, f]`.", &CURVE_WAYS));
    inside(
        "term",
        "A term of a sum: a coordinate of a joint or a length, from the reference configuration.",
        keys,
    )
}

fn point() -> KeyTable {
    inside(
        "line point",
        "A point of a line.",
        vec![
            need("body", Of(Referent::Body), "", "The body on which it is."),
            need("at", Place, "m", "Its place."),
        ],
    )
}

fn drum() -> KeyTable {
    inside(
        "drum",
        "A drum of a rope.",
        vec![
            need("joint", Of(Referent::Joint), "", "The turn of the drum."),
            need("radius", Number, "m", "Its radius; negative for the other sense."),
        ],
    )
}
