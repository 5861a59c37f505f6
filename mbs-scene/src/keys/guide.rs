//! `[[initial]]` and `[[guide]]`, and functions of time.

use super::table::{Key, KeyTable, inside, listed, may, need};
use super::value::KeyValue::{
    Coordinate, Number, NumberOrVector, Of, Place, RowsOrFile, Some, SomeNumbers, Text, Texts,
    Vector, Word,
};
use super::value::{KeyValue, Referent, TABLE_FILE};

pub(super) fn tables() -> Vec<KeyTable> {
    let mut tables = initial();
    tables.extend(guides());
    tables.extend(functions());
    tables
}

/// The tables of entries by joint, then those by body.
fn initial() -> Vec<KeyTable> {
    let of_joint = listed(
        "initial",
        "Coordinates of a joint at the start. What is written holds exactly; the rest follows from the constraints by the smallest motion of the bodies.",
        vec![
            need("joint", Of(Referent::Joint), "", "The joint."),
            may(
                "value",
                SomeNumbers,
                "rad or m",
                "follows",
                "Its coordinates, from the reference configuration.",
            ),
            may(
                "rate",
                SomeNumbers,
                "rad/s or m/s",
                "follows",
                "Their rates; of a ball the relative angular velocity, global axes.",
            ),
        ],
    );
    let of_body = listed(
        "initial",
        "Velocities of a body at the start.",
        vec![
            need("body", Of(Referent::MovingBody), "", "The body."),
            may("at", Place, "m", "needed beside `velocity`", "A material point of it."),
            may("velocity", Vector, "m/s", "follows", "Velocity of that point."),
            may(
                "angular_velocity",
                NumberOrVector,
                "rad/s",
                "follows",
                "Angular velocity, global axes.",
            ),
        ],
    );
    vec![of_joint, of_body]
}

/// Key for the interpolation of a table between its rows, by words of which the first holds where none is written.
pub(super) fn interpolation(words: Vec<&'static str>) -> Key {
    let default = words[0];
    let meaning = "Between the rows; `monotone` stays between the values of the neighbouring rows.";
    may("interpolation", Word(words), "", default, meaning)
}

/// The keys that give a function of time.
pub(super) fn motion(unit: &'static str) -> Vec<Key> {
    vec![
        may("table", RowsOrFile, "s and rad or m", "none", "Rows `[time, value]`, held outside."),
        interpolation(vec!["spline", "monotone"]),
        may(
            "ends",
            Word(vec!["natural", "level"]),
            "",
            "natural",
            "Ends of the table: without curvature, or at rest.",
        ),
        may("sine", KeyValue::Table("sine"), "", "none", "A sine of time."),
        may("ramp", KeyValue::Table("ramp"), "", "none", "A constant rate."),
        may(
            "input",
            KeyValue::Table("motion input"),
            "",
            "none",
            "Set from outside between steps; here its start.",
        ),
        may("signal", Of(Referent::Signal), unit, "none", "A smooth signal."),
    ]
}

fn guides() -> Vec<KeyTable> {
    let mut keys = vec![
        need("joint", Of(Referent::Joint), "", "The joint."),
        may("coordinate", Coordinate, "", "0", "Which of its coordinates."),
    ];
    keys.extend(motion("rad or m"));
    let signals = "Signals for all coordinates, in their order.";
    keys.push(may("signals", Some(Referent::Signal), "rad or m", "none", signals));
    let of_joint = listed(
        "guide",
        "A prescribed motion of a joint coordinate, from the reference configuration: a motor of known motion. The joint's `effort` is the moment or force that it takes.",
        keys,
    );
    let of_body = listed(
        "guide",
        "A prescribed motion of a body against the ground. In the plane it has x, y and the angle; in space x, y, z and the rotation vector.",
        vec![
            need("body", Of(Referent::MovingBody), "", "The body."),
            may("at", Place, "m", "its centre of mass", "The point that is guided."),
            need("signals", Some(Referent::Signal), "m, rad", signals),
        ],
    );
    vec![of_joint, of_body]
}

fn table_file() -> KeyTable {
    inside(
        TABLE_FILE,
        "Columns of a CSV file in place of the rows of a table.",
        vec![
            need("file", Text, "", "The file, from the folder of the scene."),
            need("columns", Texts, "", "The names of its columns, those of a row in their order."),
            may(
                "units",
                Texts,
                "",
                "those of the file",
                "Their units, where the first row of the file has none in brackets.",
            ),
        ],
    )
}

fn functions() -> Vec<KeyTable> {
    vec![
        inside(
            "sine",
            "amplitude sin(2 pi frequency t + phase).",
            vec![
                need("amplitude", Number, "rad or m", "Amplitude."),
                need("frequency", Number, "Hz", "Frequency."),
                may("phase", Number, "rad", "0", "Phase at t = 0."),
            ],
        ),
        table_file(),
        inside("ramp", "rate t.", vec![need("rate", Number, "rad/s or m/s", "Rate.")]),
        inside(
            "motion input",
            "What a guide holds until it is set.",
            vec![
                may("value", Number, "rad or m", "0", "Value at the start."),
                may("rate", Number, "rad/s or m/s", "0", "Rate at the start."),
                may("acceleration", Number, "rad/s^2 or m/s^2", "0", "Acceleration at the start."),
            ],
        ),
    ]
}
