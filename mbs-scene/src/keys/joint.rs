//! `[[joint]]`, by the kinds of joint of mbs-core.

use super::table::{Key, KeyTable, Standing, may, need};
use super::value::KeyValue::{
    Name, Number, Numbers, Place, Places, Several, Vector, Vectors, Word,
};
use super::value::Referent;
use mbs_core::scene::{Axis, Dimension, JointKind};

pub(super) fn tables() -> Vec<KeyTable> {
    JointKind::ALL.map(table).to_vec()
}

fn table(kind: JointKind) -> KeyTable {
    let mut keys = vec![
        need("name", Name, "", "Name, by which others refer to it."),
        need("kind", Word(vec![kind.name()]), "", "The kind."),
        need(
            "bodies",
            Several(Referent::Body, 2),
            "",
            "The two bodies; the second moves against the first.",
        ),
    ];
    keys.push(if kind.is_link() {
        need("points", Places(2), "m", "A place on each body.")
    } else if kind.is_free() {
        let of_center = "the centre of mass of the second body";
        may("at", Place, "m", of_center, "The point whose displacement is the coordinate.")
    } else {
        need("at", Place, "m", "The place of the joint.")
    });
    keys.extend(axes(kind));
    keys.extend(limits(kind));
    KeyTable {
        header: "joint",
        kind: Some(kind.name()),
        standing: Standing::Listed,
        meaning: meaning(kind),
        law: "",
        keys,
        example: None,
    }
}

/// Keys of the axes of a kind of joint, in the scenes in which it has them.
fn axes(kind: JointKind) -> Vec<Key> {
    let mut keys = Vec::new();
    for dimension in [Dimension::Planar, Dimension::Spatial] {
        if kind.is_spatial_only() && dimension == Dimension::Planar {
            continue;
        }
        let [first, second] = kind.axis_keys(dimension);
        // a kind of spatial scenes is refused in others as a whole
        let only = (!kind.is_spatial_only()).then_some(dimension);
        let of = |key: Key| Key { dimension: only, ..key };
        match kind.needs_axes(dimension) {
            [_, true] if first == "axes" => {
                let meaning =
                    "Two axes: the first is fixed in the first body, the second in the second.";
                keys.push(of(need("axes", Vectors(2), "", meaning)));
            }
            needed => {
                if needed[0] {
                    keys.push(of(need(first, Vector, "", axis(kind, dimension))));
                }
                if needed[1] {
                    let meaning = "The first slide, across the normal; the second slide is the normal times the first.";
                    keys.push(of(need(second, Vector, "", meaning)));
                }
            }
        }
    }
    if kind.is_link() {
        let meaning = "Hinge axis, fixed in the first body: the second point also stays in the plane across it.";
        keys.push(may("axis", Vector, "", "none", meaning).in_space());
    }
    // a key of both kinds of scene stands once
    if let [one, other] = &mut keys[..]
        && one.name == other.name
    {
        one.dimension = None;
        keys.pop();
    }
    keys
}

fn axis(kind: JointKind, dimension: Dimension) -> &'static str {
    let [along, across] =
        [Axis::First, Axis::Second].map(|axis| kind.slides_along(axis, dimension));
    if across {
        "Normal of the plane, in the first body."
    } else if along {
        "Direction of the slide, in the first body; its length does not matter."
    } else {
        "Axis, right-hand rule; its length does not matter."
    }
}

/// Keys of the limits that a joint is meant to keep. Kinds with one coordinate take them; those of others are refused with their place.
fn limits(kind: JointKind) -> Vec<Key> {
    let has_one = [Dimension::Planar, Dimension::Spatial]
        .into_iter()
        .any(|dimension| kind.n_coordinates(dimension) == 1);
    let key = |name, value, unit, meaning| {
        let key = may(name, value, unit, "none", meaning);
        if has_one {
            key
        } else {
            Key { default: "none; for kinds with one coordinate".into(), ..key }
        }
    };
    vec![
        key(
            "range",
            Numbers(2),
            "rad or m",
            "Ends of the coordinate. A run notes where it leaves them.",
        ),
        key("effort_limit", Number, "N m or N", "Largest moment or force of its drive."),
        key(
            "velocity_limit",
            Number,
            "rad/s or m/s",
            "Largest rate in both senses. A run notes where it is exceeded.",
        ),
    ]
}

fn meaning(kind: JointKind) -> String {
    let what = match kind {
        JointKind::Revolute => "A hinge: common point and axis.",
        JointKind::Spherical => "A ball joint: a common point. Spatial scenes alone.",
        JointKind::Universal => {
            "A cross: a common point, and two axes at a fixed angle. Spatial scenes alone."
        }
        JointKind::Prismatic => "A slide along an axis, without rotation.",
        JointKind::Cylindrical => {
            "A slide along an axis and a rotation about it. Spatial scenes alone."
        }
        JointKind::Planar => "A plane on a plane. Spatial scenes alone.",
        JointKind::PinInSlot => "A pin of the second body in a straight slot of the first.",
        JointKind::Weld => "No relative motion.",
        JointKind::Distance => {
            "Two points keep their distance: a massless link with two balls, or hinged at the first body."
        }
        JointKind::Free | JointKind::FreePoint => {
            "All relative motions: it has coordinates, and constrains nothing."
        }
    };
    let of = |dimension| coordinates(kind, dimension);
    let (planar, spatial) = (of(Dimension::Planar), of(Dimension::Spatial));
    let coordinates = match (kind.is_spatial_only() || planar == spatial, spatial.as_str()) {
        (true, "") => "It has no coordinates.".to_owned(),
        (true, names) => format!("Coordinates: {names}."),
        (false, names) => format!("Coordinates in the plane: {planar}; in space: {names}."),
    };
    format!(
        "{what} {coordinates} Its reaction is what the first body does to the second at the place of the joint."
    )
}

/// The coordinates of a joint, in their order.
fn coordinates(kind: JointKind, dimension: Dimension) -> String {
    let freedoms = kind.freedoms(dimension).iter();
    let mut number = 0;
    let names = freedoms.map(|freedom| {
        let name = kind.coordinate_name(dimension, number);
        number += freedom.n_coordinates();
        match name {
            Some(name) => format!("`{name}` [{}]", freedom.unit()),
            None => "rotation vector [rad]".to_owned(),
        }
    });
    names.collect::<Vec<_>>().join(", ")
}
