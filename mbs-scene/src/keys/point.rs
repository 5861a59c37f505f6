//! `[[include]]` and `[[point]]`, and what stands for places and directions.

use super::table::{KeyTable, inside, listed, may, need};
use super::value::KeyValue::{Name, Of, Parameters, Place, Text, Vector, Word};
use super::value::Referent;

/// The header of a place from a point.
pub(crate) const PLACE: &str = "place";
/// The header of a direction between two places.
pub(crate) const DIRECTION: &str = "direction";

pub(super) fn tables() -> Vec<KeyTable> {
    let prefix = "What stands before the names of its parts and points.";
    let include = listed(
        "include",
        "The parts of another file, which has no `[scene]`, `[solver]` and `[road]`. A name is looked up in that file first, then in this one.",
        vec![
            need(
                "file",
                Text,
                "",
                "The file, from the folder of this one. Its end says whether it is TOML or JSON.",
            ),
            may("prefix", Text, "", "nothing", prefix),
            may("set", Parameters, "", "none", "Other values for its `[parameters]`."),
        ],
    );
    let point = listed(
        "point",
        "A place by name. The name stands wherever a place does; `\"NAME.x\"` is a number.",
        vec![
            need("name", Name, "", "Its name."),
            need("at", Place, "m", "Its place in the reference configuration."),
        ],
    );
    let place = inside(
        PLACE,
        "A place from a point: mirrored first, then moved.",
        vec![
            need("of", Of(Referent::Point), "", "The point."),
            may(
                "mirror",
                Word(vec!["x", "y", "z"]),
                "",
                "none",
                "The coordinate that takes the other sign.",
            ),
            may("plus", Vector, "m", "none", "What is added."),
        ],
    );
    let direction = inside(
        DIRECTION,
        "The direction from one place to another. It stands wherever a vector does that is no place.",
        vec![need("from", Place, "m", "The first place."), need("to", Place, "m", "The second.")],
    );
    vec![include, point, place, direction]
}
