//! Keys of the table `[[rolling]]`.

use super::table::{KeyTable, inside, kinds, listed, may, name_or, need};
use super::value::KeyValue::{Number, Of, Place, Vector};
use super::value::{KeyValue, Referent};

pub(super) fn tables() -> Vec<KeyTable> {
    let common = [
        name_or("`rolling-N`"),
        need("body", Of(Referent::MovingBody), "", "The body that rolls or slides."),
        may("on", Of(Referent::Body), "", "ground", "The body on which it rolls."),
        may(
            "plane",
            KeyValue::Table("plane"),
            "",
            "level, and touching",
            "The plane, fixed in `on`.",
        ),
    ];
    let center = need("center", Place, "m", "Centre of the disc or ball.");
    let radius = need("radius", Number, "m", "Radius.");
    let axis = [
        need("axis", Vector, "", "Axis of the disc.").in_space(),
        may("axis", Vector, "", "z", "Axis of the disc.").in_the_plane(),
    ];
    let of = |meaning, keys| listed("rolling", meaning, keys);
    let wheel = of(
        "A thin disc that rolls on a plane without slipping.",
        [vec![center.clone(), radius.clone()], axis.to_vec()].concat(),
    );
    let ball = of(
        "A ball that rolls on a plane without slipping. Spatial scenes alone.",
        vec![center, radius],
    );
    let blade = of(
        "A blade, as of a skate: a point that does not move sideways.",
        vec![
            need("at", Place, "m", "The point."),
            need("direction", Vector, "", "Direction of the blade, in the body."),
        ],
    );
    let mut tables =
        kinds("rolling", &common, [("wheel", wheel), ("ball", ball), ("blade", blade)]);
    tables.push(inside(
        "plane",
        "A plane, fixed in a body.",
        vec![
            need("point", Place, "m", "A point of it."),
            need("normal", Vector, "", "Its normal, to the side of what rolls."),
        ],
    ));
    tables
}
