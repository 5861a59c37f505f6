//! Keys of the table `[[frame]]`.

use super::table::{KeyTable, listed, may, need};
use super::value::KeyValue::{Name, Of, Place, Vectors};
use super::value::Referent;

pub(super) fn tables() -> Vec<KeyTable> {
    let meaning = "A named place on a body or on the ground. Its name stands wherever a body's does; \
                   `at` of that table is then its place, unless another is written.";
    let frame = listed(
        "frame",
        meaning,
        vec![
            need("name", Name, "", "Its name, which is no other body's than its own."),
            need("body", Of(Referent::Body), "", "Its body."),
            need("at", Place, "m", "Its place in the reference configuration."),
            may("axes", Vectors(2), "", "x and y", "Its first and its second axis.").in_space(),
        ],
    );
    vec![frame]
}
