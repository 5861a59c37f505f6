//! Output channels of every quantity of a scene, as text.

use mbs::core::outputs::{Quantity, Target};
use mbs::core::scene::{BodyId, Dimension, Inertia, Scene};
use std::fmt::Write;

/// The channels of all quantities of a scene.
pub(crate) fn of(scene: &Scene<f64>) -> String {
    let mut text = String::new();
    let all = mbs_testkit::quantities::every(scene);
    for (i, quantity) in all.into_iter().filter(|q| !turns_point(q, scene)).enumerate() {
        let (name, keys) = (quantity.row().name, keys(&quantity, scene));
        let _ = write!(text, "[[output]]\nname = \"channel {i} {name}\"\n{keys}");
        let _ = writeln!(text, "quantity = \"{name}\"");
    }
    text + "[[output]]\nname = \"invariant\"\nquantity = \"invariant-error\"\n"
}

/// True if the quantity needs the orientation of a body that is a point, which has none.
fn turns_point(quantity: &Quantity<f64>, scene: &Scene<f64>) -> bool {
    let is_point = |id: BodyId| match id {
        BodyId::Ground => false,
        BodyId::Body(b) => matches!(scene.bodies[b].inertia, Inertia::Point),
    };
    match quantity.target() {
        Target::RelativePoint(of) => is_point(of.relative_to),
        Target::RelativeBody(id, other) => is_point(id) || is_point(other),
        Target::WheelCarrier(of) => is_point(of.body) || is_point(of.relative_to),
        Target::Body(id) => is_point(id) && quantity.row().name != "kinetic-energy",
        _ => false,
    }
}

/// The keys of an output that name the object of a quantity.
fn keys(quantity: &Quantity<f64>, scene: &Scene<f64>) -> String {
    let body = |id: BodyId| match id {
        BodyId::Ground => "ground".to_owned(),
        BodyId::Body(b) => scene.bodies[b].name.clone(),
    };
    let point = |x: [f64; 3]| match scene.dimension {
        Dimension::Planar => format!("{:?}", &x[..2]),
        Dimension::Spatial => format!("{x:?}"),
    };
    match quantity.target() {
        Target::Point(id, at) => format!("body = \"{}\"\nat = {}\n", body(id), point(at)),
        Target::RelativePoint(of) => format!(
            "body = \"{}\"\nat = {}\nrelative_to = \"{}\"\norigin = {}\n",
            body(of.body),
            point(of.at),
            body(of.relative_to),
            point(of.origin)
        ),
        Target::RelativeBody(id, other) => {
            format!("body = \"{}\"\nrelative_to = \"{}\"\n", body(id), body(other))
        }
        Target::WheelCarrier(of) => format!(
            "body = \"{}\"\nrelative_to = \"{}\"\nside = \"left\"\n",
            body(of.body),
            body(of.relative_to)
        ),
        Target::Body(id) => format!("body = \"{}\"\n", body(id)),
        Target::Joint(id) => format!("joint = \"{}\"\n", scene.joints[id].name),
        Target::Coupling(id) => format!("coupling = \"{}\"\n", scene.couplings[id].name),
        Target::Rolling(id) => format!("rolling = \"{}\"\n", scene.rollings[id].name),
        Target::Effect(id) => format!("effect = \"{}\"\n", scene.effects[id].name),
        Target::Signal(id) => format!("signal = \"{}\"\n", scene.signals[id].name),
        Target::Scene => String::new(),
    }
}
