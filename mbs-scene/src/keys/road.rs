//! `[road]`: features under the wheels.

use super::guide::interpolation;
use super::table::{Key, KeyTable, Standing, inside, kinds, may, need, once};
use super::value::KeyValue::{Count, Number, RowsOrFile, TableOrTables, Word};

/// The header of a feature that stands inside `[road]`.
pub(crate) const FEATURE: &str = "road feature";

/// A road with one feature: `[road]` with `kind`; then a road with several; then features inside it.
pub(super) fn tables() -> Vec<KeyTable> {
    let speed = may(
        "speed",
        Number,
        "m/s",
        "0",
        "Speed at which the road runs towards the wheels, along x.",
    );
    let feature = |name, meaning| may(name, TableOrTables(FEATURE), "", "none", meaning);
    let several = once(
        "road",
        "The road under tires, whose heights add up: features under all wheels, or different ones on the left and on the right.",
        vec![
            feature("features", "Under all wheels."),
            feature("left", "Under the wheels on the left, y >= 0. `[]` is level."),
            feature("right", "Under the wheels on the right."),
            speed.clone(),
        ],
    );
    let features = kinds(FEATURE, &[], features());
    let alone = features.iter().cloned().map(|table| {
        let mut keys = table.keys;
        keys.push(speed.clone());
        KeyTable { header: "road", standing: Standing::Once, keys, ..table }
    });
    let alone: Vec<KeyTable> = alone.collect();
    [vec![several], alone, features].concat()
}

fn features() -> [(&'static str, KeyTable); 5] {
    let number = |name, meaning| need(name, Number, "m", meaning);
    let start = || number("start", "Where it begins, along x.");
    let of = |meaning, keys: Vec<Key>| inside(FEATURE, meaning, keys);
    [
        ("flat", of("A level road.", vec![may("height", Number, "m", "0", "Its height.")])),
        (
            "ramp",
            of(
                "A straight rise with rounded corners, which ends at its height.",
                vec![
                    start(),
                    number("length", "Its length."),
                    number("height", "Its height; negative falls."),
                    may("rounding", Number, "m", "0.1 `length`", "Length of each rounded corner."),
                ],
            ),
        ),
        (
            "stairs",
            of(
                "Stairs: edges that are rounded all through, each with a level part behind it.",
                vec![
                    start(),
                    number("height", "Height of each step; negative falls."),
                    number("riser", "Length of each edge, along x."),
                    number("tread", "Length of the level part behind it."),
                    need("count", Count, "", "Number of steps."),
                ],
            ),
        ),
        (
            "bump",
            of(
                "A bump, one minus cosine.",
                vec![
                    start(),
                    number("length", "Its length."),
                    may("height", Number, "m", "needed without `amplitude`", "Its height."),
                    may("amplitude", Number, "m", "none", "Half its height."),
                    may(
                        "shape",
                        Word(vec!["1-cos", "cosine"]),
                        "",
                        "1-cos",
                        "Its shape; both words mean the same.",
                    ),
                ],
            ),
        ),
        (
            "table",
            of(
                "Heights along the road, through points.",
                vec![
                    need("points", RowsOrFile, "m", "Points `[x, z]`."),
                    interpolation(vec!["spline", "monotone", "linear"]),
                ],
            ),
        ),
    ]
}
