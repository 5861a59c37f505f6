//! The tables of sweep files: `[sweep]` and `[[vary]]`.

use super::table::{KeyTable, inside, listed, may, need, once};
use super::value::KeyValue;
use super::value::KeyValue::{Count, Number, Path, PathOrPaths, SomeNumbers, Text, Word};

/// The header of a sweep file itself.
pub(crate) const FILE: &str = "sweep file";

pub(super) fn tables() -> Vec<KeyTable> {
    let file = inside(
        FILE,
        "The tables of a sweep file.",
        vec![
            may("sweep", KeyValue::Table("sweep"), "", "a grid", "How values are combined."),
            need("vary", KeyValue::Tables("vary"), "", "The parameters."),
        ],
    );
    let sweep = once(
        "sweep",
        "How the values of a sweep are combined (a file of its own, for `mbs sweep SCENE SWEEP`).",
        vec![
            may("name", Text, "", "none", "Name of the sweep."),
            may(
                "combine",
                Word(vec!["grid", "zip", "latin-hypercube"]),
                "",
                "grid",
                "Each value with each; the first together, the second, ...; or samples.",
            ),
            may("samples", Count, "", "needed for `latin-hypercube`", "Number of samples."),
            may(
                "seed",
                Number,
                "",
                "needed for `latin-hypercube`",
                "A whole number from 0; the same seed gives the same samples.",
            ),
        ],
    );
    let vary = listed(
        "vary",
        "A parameter of a sweep: `values`, or a range `from`, `to` with `count` or `step`.",
        vec![
            need("path", Path, "", "The number of the scene."),
            may("also", PathOrPaths, "", "none", "More places that get the same value."),
            may("shift", PathOrPaths, "", "none", "Places that move by as much as `path` does."),
            may("name", Text, "", "the path", "Column of the table."),
            may("values", SomeNumbers, "", "needed without a range", "Its values."),
            may("from", Number, "", "none", "First value of a range."),
            may("to", Number, "", "none", "Last value of a range."),
            may(
                "count",
                Count,
                "",
                "needed without `step`",
                "Number of values, both ends included.",
            ),
            may("step", Number, "", "none", "Distance of values."),
            may(
                "scale",
                Word(vec!["linear", "log"]),
                "",
                "linear",
                "Equal distances, or equal ratios.",
            ),
        ],
    );
    vec![file, sweep, vary]
}
