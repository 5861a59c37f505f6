//! Keys of the table `[[shape]]`.

use super::table::{Key, KeyTable, inside, listed, may, need};
use super::value::KeyValue;
use super::value::KeyValue::{Flag, Name, Number, Of, Place, Text, Vectors};
use super::value::Referent;

/// The forms, as they are written.
pub(crate) const SHAPES: [&str; 7] =
    ["box", "sphere", "capsule", "cylinder", "disc", "polygon", "mesh"];

/// Colours that have a name.
pub(crate) const COLOURS: [(&str, [u8; 3]); 12] = [
    ("steel", [154, 164, 175]),
    ("rubber", [43, 47, 52]),
    ("wood", [181, 136, 84]),
    ("white", [245, 245, 245]),
    ("grey", [140, 140, 140]),
    ("black", [30, 30, 30]),
    ("red", [205, 65, 55]),
    ("orange", [226, 140, 50]),
    ("yellow", [226, 200, 70]),
    ("green", [85, 160, 90]),
    ("blue", [70, 120, 190]),
    ("violet", [142, 91, 208]),
];

pub(super) fn tables() -> Vec<KeyTable> {
    let form = |name: &'static str, meaning| may(name, KeyValue::Table(name), "", "none", meaning);
    let names: Vec<_> = COLOURS.iter().map(|(name, _)| format!("`{name}`")).collect();
    let colour = format!("`#rrggbb`, or {}.", names.join(", "));
    let shape = listed(
        "shape",
        "A form on a body or on the ground, where it is drawn. It has one of the forms. Pictures show it in place of the body's inertia; it carries no mass.",
        vec![
            may(
                "name",
                Name,
                "",
                "`shape-N`, N counted from 1",
                "Name, by which others refer to it.",
            ),
            need("body", Of(Referent::Body), "", "Its body."),
            form("box", "A box.").in_space(),
            form("sphere", "A sphere.").in_space(),
            form("capsule", "A cylinder with round ends; in the plane a bar with round ends."),
            form("cylinder", "A cylinder with flat ends.").in_space(),
            form("disc", "A disc.").in_the_plane(),
            form("polygon", "A polygon.").in_the_plane(),
            form("mesh", "A surface of triangles from a file.").in_space(),
            may("colour", Text, "", "that of its body", &colour),
            may("opacity", Number, "", "1", "From 0, not seen, to 1."),
            may(
                "visual",
                Flag,
                "",
                "true",
                "Whether it is for pictures alone. Nothing else uses shapes yet.",
            ),
        ],
    );
    let mut tables = vec![shape];
    tables.extend(forms());
    tables
}

/// A table for each form.
fn forms() -> Vec<KeyTable> {
    let radius = || need("radius", Number, "m", "Its radius.");
    let center = || need("center", Place, "m", "Its centre.");
    let ends = || -> Vec<Key> {
        let end = |name, meaning| need(name, Place, "m", meaning);
        vec![
            end("from", "The centre of one end."),
            end("to", "The centre of the other end."),
            radius(),
        ]
    };
    let block = vec![
        center(),
        need("size", KeyValue::Numbers(3), "m", "Its lengths along its axes."),
        may("axes", Vectors(2), "", "x and y", "Its first and its second axis."),
    ];
    let corners = "Its corners, one after the other.";
    let mesh = vec![
        need(
            "file",
            Text,
            "",
            "STL, OBJ, or MSH of MuJoCo; its path from the folder of the scene. Pages read it, and no other command: what is missing is a note there.",
        ),
        may("at", Place, "m", "the global origin", "Where its origin is."),
        may("axes", Vectors(2), "", "x and y", "Its first and its second axis."),
        may(
            "scale",
            KeyValue::SomeNumbers,
            "",
            "1",
            "Factor of its numbers, or three along its axes: 0.001 for a file in millimetres.",
        ),
    ];
    vec![
        inside("box", "The sizes of a box.", block),
        inside("sphere", "The sizes of a sphere.", vec![center(), radius()]),
        inside("capsule", "The sizes of a capsule.", ends()),
        inside("cylinder", "The sizes of a cylinder.", ends()),
        inside("disc", "The sizes of a disc.", vec![center(), radius()]),
        inside(
            "polygon",
            "The corners of a polygon.",
            vec![need("points", KeyValue::SomePlaces, "m", corners)],
        ),
        inside("mesh", "A file of triangles, and where it stands.", mesh),
    ]
}
