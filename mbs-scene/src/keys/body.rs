//! Keys of the table `[[body]]`.

use super::table::{KeyTable, inside, listed, may, need};
use super::value::KeyValue;
use super::value::KeyValue::{Name, Number, Place};

pub(super) fn tables() -> Vec<KeyTable> {
    let inertia = "Inertia about the centre of mass, global axes: one number in the plane, `[Ixx, Iyy, Izz, Ixy, Iyz, Izx]` in space.";
    let body = listed(
        "body",
        "A rigid body, a slender rod or a point mass. Write `center` and `inertia`, or `rod`, or `point`.",
        vec![
            need("name", Name, "", "Name. `ground` is taken."),
            need("mass", Number, "kg", "Mass; zero for a body whose motion others determine."),
            may(
                "center",
                Place,
                "m",
                "needed, unless `rod` or `point` is there",
                "Centre of mass.",
            ),
            may("inertia", KeyValue::SomeNumbers, "kg m^2", "needed beside `center`", inertia),
            may(
                "rod",
                KeyValue::Table("rod"),
                "",
                "none",
                "A uniform slender rod: centre and inertia follow.",
            ),
            may("point", Place, "m", "none", "A point mass: a place, and no orientation."),
            may("gravity_scale", Number, "", "1", "Factor of gravity on this body: 0 for none."),
        ],
    );
    let rod = inside(
        "rod",
        "The ends of a slender rod.",
        vec![need("from", Place, "m", "One end."), need("to", Place, "m", "The other end.")],
    );
    vec![body, rod]
}
